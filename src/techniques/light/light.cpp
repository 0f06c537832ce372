// SPDX-License-Identifier: MIT
#include "techniques/light/light.hpp"

#include <algorithm>

#include "shaders/light_comp.hpp"
#include "shaders/light_tiles_comp.hpp"
#include "shaders/light_variant.glsl.h"
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

namespace {

constexpr uint32_t list_from = 64;                // lights; fewer are looked at by every tile
constexpr uint64_t most_list_bytes = 32ULL << 20; // larger tiles keep within it

/// The lists of lights of the page's large tiles.
struct Lists {
    shared::ListTiles tiles{.columns = 1, .tile_px = 64};
    gpu::BufferId words;
    bool made = false;
};

Lists add_lists(gpu::Graph& graph, const LightInputs& in)
{
    Lists lists{.words = in.lights};
    if (in.local_count <= list_from || in.looks_at_all || in.points) {
        return lists;
    }
    const auto tiles_across = [&](uint32_t length_px) {
        return (length_px + lists.tiles.tile_px - 1) / lists.tiles.tile_px;
    };
    const auto size_bytes = [&] {
        return sizeof(uint32_t) * (in.local_count + 1ULL) * tiles_across(in.size_px.x) *
               tiles_across(in.size_px.y);
    };
    while (size_bytes() > most_list_bytes && lists.tiles.tile_px < 1U << 14U) {
        lists.tiles.tile_px *= 2;
    }
    lists.tiles.columns = tiles_across(in.size_px.x);
    auto pass = graph.compute("light/tiles", shaders::light_tiles_comp);
    pass.uniform(in.frame).uniform(in.lighting).read(in.lights);
    lists.words = pass.write(graph.buffer("light/lists", {.size_bytes = (size_bytes() + 15) / 16 * 16}));
    lists.made = true;
    pass.push(lists.tiles).dispatch(lists.tiles.columns * tiles_across(in.size_px.y));
    return lists;
}

uint32_t light_variant(const LightInputs& in, const Lists& lists)
{
    return in.shadows.variant | (in.shadows.has_sun ? shared::light_has_shadow : 0U) |
           (in.local_count > 0 ? shared::light_has_local_lights : 0U) |
           (in.has_emissive ? shared::light_has_emissive : 0U) |
           (in.has_links ? shared::light_has_links : 0U) | (lists.made ? shared::light_has_lists : 0U) |
           (in.counts_visits ? shared::light_counts_visits : 0U) |
           (in.keeps_strongest ? shared::light_keeps_strongest : 0U) |
           (in.looks_at_all || in.points ? shared::light_looks_at_all : 0U) |
           (in.shadows.has_local ? shared::light_has_local_shadows : 0U) |
           (in.sun_share ? shared::light_has_sun_share : 0U) |
           (in.lightmap ? shared::light_has_lightmap : 0U) |
           (!in.occlusion     ? 0U
            : in.occludes_all ? shared::light_occludes_all
                              : shared::light_occludes_ambient) |
           (in.thrown ? shared::light_has_thrown : 0U) | (in.points ? shared::light_has_points : 0U) |
           (in.tiles ? shared::light_has_tiles : 0U) | (in.keeps_sun ? shared::light_keeps_sun : 0U);
}

} // namespace

shared::ToneConstants tone_constants(const ToneStyle& style)
{
    return {.curve = static_cast<uint32_t>(style.curve),
            .exposure = style.exposure,
            .gamma = style.gamma,
            .contrast = style.contrast,
            .floor = style.floor,
            .ceiling = style.ceiling,
            .local_value = style.local_value,
            .occlusion = style.occlusion};
}

LitPixels add_light(gpu::Graph& graph, const LightInputs& in)
{
    const Lists lists = add_lists(graph, in);
    auto pass = graph.compute("light", shaders::light_comp);
    pass.uniform(in.frame).uniform(in.lighting).sample(in.lights);
    pass.sample(in.draw)
        .sample(in.depth)
        .sample(in.normal)
        .sample(in.draws)
        .sample(in.materials)
        .sample(in.shadows.sun, gpu::Format::r32f)
        .uniform(in.shadows.sun_globals)
        .sample(in.coordinate)
        .sample(in.footprint)
        .uniform(in.shadows.edge_look)
        .read(lists.words);
    const gpu::ImageId light = pass.write(graph.image(
        "light", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    const glm::uvec2 kept_px = in.keeps_strongest ? in.size_px : glm::uvec2(1);
    const gpu::ImageId strongest = pass.write(graph.image(
        "light/strongest", {.width = kept_px.x, .height = kept_px.y, .format = gpu::Format::r32ui}));
    pass.sample(in.shadows.local_shadows).sample(in.shadows.local, gpu::Format::r32f);
    pass.sample(in.lightmap.value_or(in.depth));
    const glm::uvec2 sun_px = in.keeps_sun ? in.size_px : glm::uvec2(1);
    const gpu::ImageId sun = pass.write(
        graph.image("light/sun", {.width = sun_px.x, .height = sun_px.y, .format = gpu::Format::r32f}));
    pass.sample(in.sun_share.value_or(in.depth)).sample(in.occlusion.value_or(in.depth));
    pass.sample(in.thrown.value_or(in.depth)).sample(in.points.value_or(in.depth));
    pass.variant(light_variant(in, lists));
    pass.read(in.tiles.value_or(lists.words));
    pass.push(lists.tiles);
    if (in.tiles) {
        pass.dispatch_indirect(*in.tiles);
    } else {
        pass.dispatch_over(in.size_px.x, in.size_px.y);
    }
    return {.light = light, .strongest = strongest, .sun = sun};
}

Paling ground_paling(const Bounds& bounds, const glm::dvec3& anchor, const glm::dvec3& towards_sun,
                     float most)
{
    constexpr double lowest_sun = 0.02; // below it shadows have no end
    const glm::dvec3 level(-towards_sun.x, 0.0, -towards_sun.z);
    if (bounds.empty() || towards_sun.y < lowest_sun || glm::length(level) < 1e-6) {
        return {};
    }
    const glm::dvec3 away = glm::normalize(level);
    const double thrown_m = glm::length(level) / towards_sun.y * (bounds.max.y - bounds.min.y);
    const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
    const double end_m = std::max(thrown_m + std::abs(away.x) * half.x + std::abs(away.z) * half.z, 1e-9);
    const glm::dvec3 share_per_m = away * (static_cast<double>(most) / end_m);
    return {.share_per_m = glm::vec3(share_per_m),
            .share_at_anchor = static_cast<float>(glm::dot(share_per_m, anchor - bounds.center()))};
}

} // namespace estampe::light
