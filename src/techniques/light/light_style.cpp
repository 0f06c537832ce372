// SPDX-License-Identifier: MIT
#include "techniques/light/light_style.hpp"

#include "style/parameter.hpp"

namespace estampe::light {

const style::Table<LightStyle>& light_table()
{
    static const auto table =
        style::Table<LightStyle>("light", "Where the light comes from")
            .choice(
                "source", &LightStyle::source,
                {{"auto", LightSource::automatic}, {"scene", LightSource::scene}, {"sun", LightSource::sun}},
                "The scene's own lights, the sun below, or (auto) where the scene has no light: the sun, and "
                "in a "
                "room a lamp")
            .number("sun_azimuth_deg", &LightStyle::sun_azimuth_deg, {-360.0F, 360.0F}, "deg",
                    "Bearing of the sun: 0 is +z, 90 +x")
            .number("sun_elevation_deg", &LightStyle::sun_elevation_deg, {-10.0F, 90.0F}, "deg",
                    "Height of the sun above the horizon")
            .toggle(
                "turn_sun", &LightStyle::turn_sun,
                "Whether the sun turns with the side that the framed view shows (the bearing is right for "
                "one "
                "from between +z and +x), and further where it would leave too much or too little in shade; "
                "over ground that nothing stands on, that of -34 and 45 degrees comes low from upwind")
            .choice("metering", &LightStyle::metering,
                    {{"lights", Metering::lights}, {"page", Metering::page}, {"manual", Metering::manual}},
                    "What sets the exposure: the scene's lights, whatever the view; a histogram of the page; "
                    "or ev100, for files in lux and candela")
            .number("ev100", &LightStyle::ev100, {-10.0F, 24.0F}, "EV",
                    "Exposure value at ISO 100 of manual metering: 15 is sunlight, 8 a lit room")
            .number("adapt_stops_per_s", &LightStyle::adapt_stops_per_s, {0.0F, 100.0F}, "stops/s",
                    "How fast the exposure by the page follows in the scene's time; 0: at once")
            .number("exposure_stops", &LightStyle::exposure_stops, {-10.0F, 10.0F}, "stops",
                    "Brighter or darker than the exposure that the scene's lights suggest")
            .number("ambient", &LightStyle::ambient, {0.0F, 1.0F}, "",
                    "Light from everywhere, as a share of the sun's")
            .number("fill", &LightStyle::fill, {0.0F, 1.0F}, "",
                    "Strength of a second, shadowless light from the sun's other side, which models what is "
                    "in shade; "
                    "for the style's sun alone")
            .number("falloff", &LightStyle::falloff, {0.05F, 4.0F}, "",
                    "Exponent of the cosine: 1 is Lambert's law, less keeps slanted light bright")
            .number(
                "paling", &LightStyle::paling, {0.0F, 1.0F}, "",
                "Share of the sun's light that comes back to the far end of its shadow on the blank ground")
            .toggle("shadows", &LightStyle::shadows, "Whether lights throw shadows")
            .integer("shadow_size", &LightStyle::shadow_size, {0, 4096}, "texels",
                     "Side of the sun's shadow map; 0 takes about a texel for each pixel of the picture")
            .text("lights", &LightStyle::lights,
                  "What single lights do, by their own name or their node's, as in \"Lamp=unit_volume "
                  "no_shadow, Sun=off\"; see the manual of light")
            .text("objects", &LightStyle::objects,
                  "How single objects stand to the lights, by node or material, as in \"Glass=no_cast, "
                  "Figure=groups:2 no_receive\"");
    return table;
}

const style::Table<ToneStyle>& tone_table()
{
    static const auto table =
        style::Table<ToneStyle>("tone", "How light becomes darkness on the page")
            .choice(
                "curve", &ToneStyle::curve,
                {{"gamma", ToneCurve::gamma}, {"linear", ToneCurve::linear}, {"filmic", ToneCurve::filmic}},
                "Light to the power of gamma; as it is; or with a shoulder that keeps bright light apart, "
                "to the power of gamma")
            .number("exposure", &ToneStyle::exposure, {0.05F, 20.0F}, "", "Light is multiplied by this first")
            .number("gamma", &ToneStyle::gamma, {0.1F, 4.0F}, "",
                    "Exponent of light; below 1 opens the shadows")
            .number("contrast", &ToneStyle::contrast, {0.1F, 20.0F}, "",
                    "Darkness is multiplied about its middle by this, and saturates")
            .number("floor", &ToneStyle::floor, {0.0F, 0.9F}, "", "Darkness under this stays white paper")
            .number("ceiling", &ToneStyle::ceiling, {0.1F, 1.0F}, "", "No tone is darker than this")
            .number("local_value", &ToneStyle::local_value, {0.0F, 1.0F}, "",
                    "How much a dark material is drawn darker than a pale one in the same light")
            .number("occlusion", &ToneStyle::occlusion, {0.0F, 1.0F}, "",
                    "How much the materials' occlusion textures darken what they cover")
            .by_surface_but({});
    return table;
}

} // namespace estampe::light
