// SPDX-License-Identifier: MIT
#pragma once

#include "scene/outlook/outlook.hpp"
#include "style/parameter.hpp"

namespace estampe::light {

enum class LightSource : uint8_t { automatic, scene, sun };

struct LightStyle {
    LightSource source = LightSource::automatic;
    float sun_azimuth_deg = house_sun_azimuth_deg;
    float sun_elevation_deg = house_sun_elevation_deg;
    bool turn_sun = true;
    float exposure_stops = 0.0F;
    float ambient = 0.15F;
    float fill = 0.2F;
    float falloff = 0.62F;
    bool shadows = true;
    int shadow_size = 0;
};

inline const style::Table<LightStyle>& light_table()
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
                "from between +z and +x), and further where it would leave too much or too little in shade")
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
            .toggle("shadows", &LightStyle::shadows, "Whether the sun throws shadows")
            .integer("shadow_size", &LightStyle::shadow_size, {0, 4096}, "texels",
                     "Side of the sun's shadow map; 0 takes about a texel for each pixel of the picture");
    return table;
}

struct ToneStyle {
    float exposure = 1.14F;
    float gamma = 0.8F;
    float contrast = 1.05F;
    float floor = 0.12F;
    float ceiling = 0.97F;
    float local_value = 0.3F;
    float occlusion = 1.0F;
};

inline const style::Table<ToneStyle>& tone_table()
{
    static const auto table =
        style::Table<ToneStyle>("tone", "How light becomes darkness on the page")
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
                    "How much the materials' occlusion textures darken what they cover");
    return table;
}

} // namespace estampe::light
