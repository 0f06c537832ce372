// SPDX-License-Identifier: MIT
#include "techniques/light/light.hpp"

#include <algorithm>

#include "shaders/light_comp.hpp"
#include "shaders/light_tiles_comp.hpp"
#include "shaders/light_variant.glsl.h"
#include "style/parameter.hpp"

namespace estampe::light {

using style::within;

const style::Table<LightStyle>& light_table()
{
    static const auto table =
        style::Table<LightStyle>("light", "Light sources and exposure")
            .choice(
                "source", &LightStyle::source,
                {{"auto", LightSource::automatic}, {"scene", LightSource::scene}, {"sun", LightSource::sun}},
                "Which lights shine on the scene. scene: the lights of the scene file; sun: one sun, placed "
                "by light.sun_azimuth_deg and light.sun_elevation_deg; auto: the lights of the file, or if "
                "there are none, the sun, and a lamp in a room.")
            .number("sun_azimuth_deg", &LightStyle::sun_azimuth_deg, {-360.0F, 360.0F}, "deg",
                    "Direction from which the sun shines, seen from above: 0 is the +z axis, 90 is the +x "
                    "axis. If light.turn_sun is true, the sun also turns with the camera.")
            .number("sun_elevation_deg", &LightStyle::sun_elevation_deg, {-10.0F, 90.0F}, "deg",
                    "Height of the sun above the horizon: low values throw long shadows, 90 is overhead")
            .toggle("turn_sun", &LightStyle::turn_sun,
                    "If true, the sun turns with the camera. The sun turns further if too much or too little "
                    "of the picture lies in shade. On an empty terrain, the sun is low, on the side that the "
                    "wind comes from. If false, the sun never turns.")
            .choice("metering", &LightStyle::metering,
                    {{"lights", Metering::lights}, {"page", Metering::page}, {"manual", Metering::manual}},
                    "What sets the exposure (brightness of the whole picture). lights: the lights of the "
                    "scene, the same for every view; page: the brightness of the picture, as in a camera; "
                    "manual: light.ev100, for files with light in lux.")
            .number("ev100", &LightStyle::ev100, {-10.0F, 24.0F}, "EV",
                    "Exposure value (EV) at ISO 100, as on a camera: a higher value darkens the picture. 15 "
                    "suits sunlight, 8 a lit room. Only used when light.metering is manual.")
            .number("adapt_stops_per_s", &LightStyle::adapt_stops_per_s, {0.0F, 100.0F}, "stops/s",
                    "Speed at which the brightness of a film adapts to the light, in stops (doublings) per "
                    "second. Less adapts slowly, like an eye; 0 adapts immediately. Only used when "
                    "light.metering is page.")
            .number(
                "exposure_stops", &LightStyle::exposure_stops, {-10.0F, 10.0F}, "stops",
                "Correction of the picture's brightness in stops: +1 doubles the light, -1 halves the light")
            .number("ambient", &LightStyle::ambient, {0.0F, 1.0F}, "",
                    "Light that comes from all directions, as a share of the sun's light. 0 leaves shade "
                    "black, more makes shade lighter.")
            .number("fill", &LightStyle::fill, {0.0F, 1.0F}, "",
                    "Strength of a second light on the side away from the sun, which throws no shadows. More "
                    "shows the forms of things in shade better. Only used when the sun of the style shines, "
                    "not the lights of the file.")
            .number(
                "falloff", &LightStyle::falloff, {0.05F, 4.0F}, "",
                "How quickly a surface gets darker as the surface turns away from the light. 1 is as in "
                "nature (Lambert's law), less keeps slanted surfaces bright, more darkens slanted surfaces.")
            .number("paling", &LightStyle::paling, {0.0F, 1.0F}, "",
                    "How much paler the scene's shadow on the blank ground gets towards its far end. 0 keeps "
                    "one darkness everywhere, 1 lets the far end fade into the lit ground.")
            .toggle("shadows", &LightStyle::shadows,
                    "Turns shadows on. To remove the shadow of one light or object, turn shadows off there: "
                    "[object.\"Glass\".light] shadows = false.")
            .integer("shadow_size", &LightStyle::shadow_size, {0, 4096}, "texels",
                     "Width and height of the sun's shadow map (image of stored shadows), in pixels of the "
                     "map. More gives sharper edges of shadows and takes more memory. 0 uses about one pixel "
                     "of the map per pixel of the picture.")
            .toggle("enabled", within(&LightStyle::changes, &LightChanges::enabled),
                    "Turns on a light of the scene file: if false, the light does not shine. Example for one "
                    "light: [object.\"Lamp\".light] enabled = false.")
            .number("intensity", within(&LightStyle::changes, &LightChanges::intensity), {0.0F, 1000.0F}, "",
                    "Factor on the brightness of a light of the scene file: 2 doubles the light, 0.5 halves "
                    "the light. Example for one light: [object.\"Lamp\".light] intensity = 2.")
            .number("range_m", within(&LightStyle::changes, &LightChanges::range_m), {-1.0F, 1e6F}, "m",
                    "Distance at which the light of a lamp in the scene file ends. Less lights only things "
                    "near the lamp, 0 has no limit. -1 keeps the range that the file sets.")
            .number(
                "radius_m", within(&LightStyle::changes, &LightChanges::radius_m), {-1.0F, 1000.0F}, "m",
                "Radius of a lamp in the scene file. More gives softer edges of shadows, 0 gives sharp "
                "edges. -1 keeps the radius of the file, or uses shadow.lamp_radius_m if the file has none.")
            .choice("attenuation", within(&LightStyle::changes, &LightChanges::attenuation),
                    {{"file", Attenuation::file},
                     {"inverse_square", Attenuation::inverse_square},
                     {"unit_volume", Attenuation::unit_volume}},
                    "How the light of a lamp in the scene file gets weaker with distance. file: as the file "
                    "says; inverse_square: as in nature, quickly near the lamp; unit_volume: gradually, "
                    "until no light is left at the end of the lamp's range.")
            .choice(
                "spot_volume", within(&LightStyle::changes, &LightChanges::spot_volume),
                {{"file", SpotVolume::file}, {"cone", SpotVolume::cone}, {"pyramid", SpotVolume::pyramid}},
                "Shape of the light of a spotlight in the scene file. file: as the file says; cone: a round "
                "patch of light; pyramid: a square patch of light.")
            .toggle("receives_shadows", within(&LightStyle::changes, &LightChanges::receives_shadows),
                    "If true, shadows fall on an object; if false, no shadows fall on this object. Example "
                    "for one object: [object.\"Figure\".light] receives_shadows = false.")
            .text("groups", within(&LightStyle::changes, &LightChanges::groups),
                  "Light groups of a light or an object, as numbers from 1 to 16: 1+3 means groups 1 and 3. "
                  "A light lights only the objects with which the light shares a group. If empty, the groups "
                  "of the scene file are used.")
            .text("shadow_groups", within(&LightStyle::changes, &LightChanges::shadow_groups),
                  "Shadow groups of a light or an object, as numbers from 1 to 16: 1+3 means groups 1 and 3. "
                  "An object throws shadows only in lights with which the object shares a group. If empty, "
                  "the groups of the scene file are used.")
            .by_surface({"shadows", "receives_shadows", "groups", "shadow_groups"})
            .by_object({"enabled", "intensity", "range_m", "radius_m", "attenuation", "spot_volume"});
    return table;
}

const style::Table<ToneStyle>& tone_table()
{
    static const auto table =
        style::Table<ToneStyle>("tone", "Tone curve: how light in the scene becomes darkness on the page")
            .choice(
                "curve", &ToneStyle::curve,
                {{"gamma", ToneCurve::gamma}, {"linear", ToneCurve::linear}, {"filmic", ToneCurve::filmic}},
                "How light turns into tone (light and dark on the page). gamma: light to the power of "
                "tone.gamma; linear: light without change; filmic: bright areas stay distinct instead of "
                "turning all white, then tone.gamma is applied.")
            .number("exposure", &ToneStyle::exposure, {0.05F, 20.0F}, "",
                    "Brightness factor on the light before light turns into tone: less is darker, more is "
                    "brighter")
            .number("gamma", &ToneStyle::gamma, {0.1F, 4.0F}, "",
                    "Exponent (power) applied to the light: below 1 lightens the shadows, above 1 darkens "
                    "the shadows. Not used when tone.curve is linear.")
            .number("contrast", &ToneStyle::contrast, {0.1F, 20.0F}, "",
                    "Contrast around the middle tone: less is flat and grey, more pushes tones towards black "
                    "and white")
            .number("floor", &ToneStyle::floor, {0.0F, 0.9F}, "",
                    "Darkness below which the paper stays white: more leaves larger areas blank")
            .number(
                "ceiling", &ToneStyle::ceiling, {0.1F, 1.0F}, "",
                "Darkest tone of the picture: less keeps the deepest shadows lighter, 1 allows full black")
            .number("local_value", &ToneStyle::local_value, {0.0F, 1.0F}, "",
                    "How much a material's own brightness changes its tone (light or dark). 0 shades all "
                    "materials alike, 1 makes dark materials darker than pale materials in the same light.")
            .number("occlusion", &ToneStyle::occlusion, {0.0F, 1.0F}, "",
                    "How much a material's occlusion texture (stored darkness of folds and seams) darkens "
                    "the tone. 0 ignores these textures, 1 applies them fully.")
            .by_surface_but({});
    return table;
}

namespace {

// Smallest number of local lights for which tiles get light lists; with fewer, every tile tests all lights.
constexpr uint32_t list_from = 64;
// Most bytes of all light lists; tiles are enlarged until the lists fit into most_list_bytes.
constexpr uint64_t most_list_bytes = 32ULL << 20;

/// The light lists of large tiles of the page.
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
           (in.bounced ? shared::light_has_bounced : 0U) | (in.points ? shared::light_has_points : 0U) |
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
        .uniform(in.shadows.edge_profile)
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
    pass.sample(in.bounced.value_or(in.depth)).sample(in.points.value_or(in.depth));
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
    constexpr double lowest_sun = 0.02; // sine of the sun's elevation below which shadows count as infinite
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
