// SPDX-License-Identifier: MIT
#include "techniques/hatch/hatch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/trigonometric.hpp>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/darkness_comp.hpp"
#include "shaders/dots_comp.hpp"
#include "shaders/group_smooth_comp.hpp"
#include "shaders/group_tones_comp.hpp"
#include "shaders/groups_comp.hpp"
#include "shaders/lines_comp.hpp"
#include "shaders/map_comp.hpp"
#include "shaders/overrun_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {
namespace {

/// Returns the axis perpendicular to strokes. At 0 degrees, strokes run along the texture coordinate u.
glm::vec2 turned(float degrees)
{
    return {-glm::sin(glm::radians(degrees)), glm::cos(glm::radians(degrees))};
}

bool groups_tones(const HatchStyle& style)
{
    return style.groups >= 2 && style.group_strength > 0.0F;
}

/// Whether small areas of a tone are joined to others, which takes passes of its own.
bool joins_areas(const HatchStyle& style)
{
    return groups_tones(style) && style.group_area_mm2 > 0.0F;
}

constexpr uint32_t tile_px = 8;
constexpr uint32_t most_listed_tiles = 65535; // number of workgroups in x that every Vulkan device supports

gpu::BufferId add_empty_list(gpu::Graph& graph, glm::uvec2 size_px)
{
    const glm::uvec2 tiles = (size_px + tile_px - 1U) / tile_px;
    const uint32_t count = tiles.x * tiles.y;
    return gpu::add_empty_list(graph, "hatch/tiles", sizeof(glm::uvec4) + sizeof(glm::uvec2) * count);
}

gpu::ImageId ink_image(gpu::Graph& graph, glm::uvec2 size_px)
{
    return graph.image("hatch/ink", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f});
}

} // namespace

uint32_t reach_px(const HatchStyle& style, float pixels_per_mm)
{
    const float overrun_px = style.overrun_mm * pixels_per_mm;
    // Jump flooding with halved steps, down to 1, reaches a source up to twice the first step minus one pixel
    // away.
    const uint32_t overrun_reach_px =
        overrun_px > 0.0F ? 2U * std::bit_ceil(static_cast<uint32_t>(std::ceil(overrun_px))) : 0U;
    return overrun_reach_px + static_cast<uint32_t>(std::ceil(style.loose_mm * pixels_per_mm));
}

gpu::ImageId add_overrun(gpu::Graph& graph, const HatchInputs& in, gpu::ImageId darkness,
                         const HatchStyle& style)
{
    const float overrun_px = style.overrun_mm * in.pixels_per_mm;
    if (overrun_px <= 0.0F) {
        return in.draw;
    }
    auto step_px = static_cast<int32_t>(std::bit_ceil(static_cast<uint32_t>(std::ceil(overrun_px))));
    gpu::ImageId source = in.draw;
    for (bool is_first = true; step_px > 0; step_px /= 2, is_first = false) {
        auto pass = graph.compute("hatch/overrun", shaders::overrun_comp);
        pass.sample(darkness).sample(in.draw).sample(source);
        source = pass.write(graph.image(
            "hatch/source", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r32ui}));
        pass.variant(is_first ? shared::overrun_is_first : 0U);
        pass.push(shared::OverrunConstants{.size_px = in.size_px, .step_px = step_px})
            .dispatch_over(in.size_px.x, in.size_px.y);
    }
    return source;
}

FirstLayer first_layer(const HatchStyle& style)
{
    // Largest darkness of a single layer of strokes, as a share of the darkness of full shadow.
    constexpr float single_share = 0.7F;
    // The formula must give the results of kept_share() of shaders/lines.glsl; a test checks the equality.
    const float ends_mm = style.gap_mm > 0.0F ? 0.75F * (style.gap_mm + style.taper_mm) : 0.0F;
    const float kept = std::max(1.0F - ends_mm / std::max(style.length_mm, 1e-3F), 0.1F);
    const float share = style.layers > 1 ? shared::first_layer_share : single_share;
    const float wind = glm::radians(style.wind.towards_deg);
    return {.width_mm = style.width_mm,
            .darkness = std::min(share / kept, 1.0F),
            .seed = static_cast<uint32_t>(style.seed),
            .flat_axis = turned(style.slant_deg),
            .wind = {glm::sin(wind), glm::cos(wind)}};
}

shared::LineConstants line_constants(const HatchInputs& in, const HatchStyle& style)
{
    const FirstLayer layer = first_layer(style);
    return {.size_px = in.size_px,
            .width_px = layer.width_mm * in.pixels_per_mm,
            .wobble_px = style.wobble_mm * in.pixels_per_mm,
            .gap_px = style.gap_mm * in.pixels_per_mm,
            .taper_px = style.taper_mm * in.pixels_per_mm,
            .cell_px = style.length_mm * in.pixels_per_mm,
            .pressure = style.pressure,
            .growth = style.growth,
            .black_above = style.enabled ? style.black_above : 2.0F,
            .layers = style.enabled ? static_cast<uint32_t>(style.layers) : 0U,
            .seed = layer.seed,
            .flat_axis_0 = layer.flat_axis,
            .flat_axis_1 = turned(style.slant_deg + 50.0F),
            .flat_axis_2 = turned(style.slant_deg - 41.0F),
            .wind = layer.wind,
            .ground_wind = in.ground_wind,
            .towards_light = in.towards_light,
            .overrun_px = style.overrun_mm * in.pixels_per_mm,
            .loose_px = style.loose_mm * in.pixels_per_mm};
}

uint32_t line_variant(const HatchInputs& in, const HatchStyle& style)
{
    return (style.growth > 0.0F ? shared::lines_has_growth : 0U) |
           (style.overrun_mm > 0.0F ? shared::lines_has_overrun : 0U) |
           (style.loose_mm > 0.0F ? shared::lines_has_loose_ends : 0U) |
           (in.strongest_light ? shared::lines_has_local_light : 0U) |
           (in.ink_before ? shared::lines_has_ink : 0U) | (in.marks_solid ? shared::lines_marks_solid : 0U) |
           in.strokes_present << shared::lines_kinds_shift;
}

MapInputs import_map(gpu::Graph& graph, MapImages& map)
{
    return {.tones = gpu::import_uploaded(graph, "map tones", map.tones),
            .thresholds = gpu::import_uploaded(graph, "map thresholds", map.thresholds),
            .ramp = gpu::import_whole(graph, "map ramp", map.ramp),
            .size_px = map.size_px,
            .tone_count = map.tone_count,
            .level_count = map.level_count};
}

bool needs_causes(const HatchStyle& style)
{
    return style.form_shade != 1.0F || style.cast_shade != 1.0F || style.ground_shade != 1.0F ||
           style.under_shade != 1.0F;
}

uint32_t group_reach_px(const HatchStyle& style, float pixels_per_mm)
{
    // Four times the width of a square of the least area, beyond the distance over which tones are smoothed.
    const float reach_mm = 4.0F * std::sqrt(style.group_area_mm2) + style.group_smooth_mm;
    return joins_areas(style) ? static_cast<uint32_t>(std::ceil(reach_mm * pixels_per_mm)) : 0U;
}

namespace {

/// Groups the darkness into tones, and lists the tiles that are not blank in `tiles`.
gpu::ImageId add_groups(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style,
                        gpu::ImageId darkness, gpu::BufferId& tiles)
{
    const uint64_t size_bytes = sizeof(uint32_t) * uint64_t{in.size_px.x} * in.size_px.y;
    gpu::BufferId parents = graph.buffer("hatch/parents", {.size_bytes = size_bytes});
    gpu::BufferId sizes = graph.buffer("hatch/sizes", {.size_bytes = size_bytes});
    gpu::ImageId borders = graph.image("hatch/borders", {.width = in.size_px.x,
                                                         .height = in.size_px.y,
                                                         .format = gpu::Format::r32ui,
                                                         .layers = static_cast<uint32_t>(style.groups)});
    const float pixels_per_mm2 = in.pixels_per_mm * in.pixels_per_mm;
    const shared::GroupConstants constants{.size_px = in.size_px,
                                           .count = static_cast<uint32_t>(style.groups),
                                           .strength = style.group_strength,
                                           .least_px = style.group_area_mm2 * pixels_per_mm2,
                                           .smooth_px = style.group_smooth_mm * in.pixels_per_mm};
    const gpu::ImageDesc image{.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f};
    gpu::ImageId smooth = darkness;
    if (constants.smooth_px >= 1.0F) {
        auto smoothing = graph.compute("hatch/smooth", shaders::group_smooth_comp);
        smoothing.sample(darkness);
        smooth = smoothing.write(graph.image("hatch/smooth", image));
        smoothing.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    }
    for (const uint32_t step :
         {shared::groups_start, shared::groups_unite, shared::groups_measure, shared::groups_borders}) {
        auto pass = graph.compute("hatch/areas", shaders::groups_comp);
        pass.sample(smooth);
        const bool starts = step == shared::groups_start;
        parents = starts ? pass.write(parents) : pass.modify(parents);
        sizes = starts ? pass.write(sizes) : pass.modify(sizes);
        borders = starts ? pass.write(borders) : pass.modify(borders);
        pass.variant(step).push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    }
    auto pass = graph.compute("hatch/grouped", shaders::group_tones_comp);
    pass.sample(smooth).read(parents).read(sizes).read(borders).sample(darkness);
    const gpu::ImageId grouped = pass.write(graph.image("hatch/grouped", image));
    tiles = pass.modify(tiles);
    pass.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return grouped;
}

} // namespace

Darkness add_darkness(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style)
{
    const bool is_grouped = joins_areas(style);
    const bool has_halo = in.halo && style.halo_mm > 0.0F;
    gpu::BufferId tiles = add_empty_list(graph, in.size_px);
    auto pass = graph.compute("hatch/darkness", shaders::darkness_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(in.color).sample(in.light);
    pass.sample(in.screen);
    const gpu::ImageId darkness = pass.write(graph.image(
        "hatch/darkness", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    const gpu::ImageId blank =
        in.ink_before ? pass.modify(*in.ink_before) : pass.write(ink_image(graph, in.size_px));
    tiles = pass.modify(tiles);
    pass.sample(in.variant_of_draw.value_or(in.frame), gpu::Format::r32ui);
    pass.sample(in.sun.value_or(in.light)).sample(in.normal);
    pass.sample(in.halo.value_or(in.light), in.halo ? gpu::Sampling::linear : gpu::Sampling::nearest);
    pass.variant((in.sun && needs_causes(style) ? shared::darkness_has_causes : 0U) |
                 (style.fade < 1.0F ? shared::darkness_has_fade : 0U) |
                 (in.has_screen ? shared::darkness_has_screen : 0U) |
                 (in.variant_of_draw ? shared::darkness_has_variants : 0U) |
                 (in.ink_before ? shared::darkness_keeps_ink : 0U) |
                 (is_grouped ? shared::darkness_is_grouped : 0U) |
                 (has_halo ? shared::darkness_has_halo : 0U));
    pass.push(shared::DarknessConstants{.tone = in.tone,
                                        .fade = style.fade,
                                        .fade_distance_m = style.fade_distance_m,
                                        .style_variant = in.variant,
                                        .form_shade = style.form_shade,
                                        .cast_shade = style.cast_shade,
                                        .ground_shade = style.ground_shade,
                                        .under_shade = style.under_shade,
                                        .ground_draws = in.ground_draws,
                                        .halo_px = style.halo_mm * in.pixels_per_mm,
                                        .group_count = groups_tones(style) && !is_grouped
                                                           ? static_cast<uint32_t>(style.groups)
                                                           : 0U,
                                        .group_strength = style.group_strength})
        .dispatch_over(in.size_px.x, in.size_px.y);
    const gpu::ImageId grouped = is_grouped ? add_groups(graph, in, style, darkness, tiles) : darkness;
    return {grouped, blank, tiles};
}

gpu::ImageId add_lines(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                       const HatchStyle& style)
{
    const gpu::ImageId source = add_overrun(graph, in, darkness.image, style);
    const glm::uvec2 tiles = (in.size_px + tile_px - 1U) / tile_px;
    // Strokes that run out of shade reach tiles that are blank themselves.
    const bool runs_out = style.overrun_mm > 0.0F || style.loose_mm > 0.0F;
    const bool all_tiles = runs_out || tiles.x * tiles.y > most_listed_tiles;
    auto pass = graph.compute("hatch/lines", shaders::lines_comp);
    pass.sample(darkness.image).sample(in.draw).sample(in.normal).sample(in.coordinate).sample(in.footprint);
    pass.sample(source).sample(in.strongest_light.value_or(in.draw));
    pass.sample(darkness.tiles, gpu::Format::rg32ui);
    const gpu::ImageId ink = pass.modify(darkness.blank);
    pass.variant(line_variant(in, style) | (all_tiles ? shared::lines_has_all_tiles : 0U))
        .push(line_constants(in, style));
    if (all_tiles) {
        pass.dispatch_over(in.size_px.x, in.size_px.y);
    } else {
        pass.dispatch_indirect(darkness.tiles);
    }
    return ink;
}

gpu::ImageId add_map(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                     const HatchStyle& style)
{
    const float overrun_px = style.overrun_mm * in.pixels_per_mm;
    const gpu::ImageId source = add_overrun(graph, in, darkness.image, style);
    auto pass = graph.compute("hatch/map", shaders::map_comp);
    pass.sample(darkness.image).sample(in.draw).sample(in.coordinate).sample(in.footprint);
    pass.sample(in.map->tones, gpu::Sampling::linear_repeat);
    pass.sample(in.map->thresholds, gpu::Sampling::linear_repeat).read(in.map->ramp).sample(source);
    const gpu::ImageId ink = pass.modify(darkness.blank);
    pass.variant(static_cast<uint32_t>(style.map_tone) | (overrun_px > 0.0F ? shared::map_has_overrun : 0U) |
                 (in.ink_before ? shared::map_has_ink : 0U) |
                 (in.marks_solid ? shared::map_marks_solid : 0U));
    pass.push(shared::MapConstants{.size_px = in.size_px,
                                   .map_size_texels = in.map->size_px,
                                   .tone_count = in.map->tone_count,
                                   .level_count = in.map->level_count,
                                   .texels_per_px = 1.0F / (style.map_texel_mm * in.pixels_per_mm),
                                   .contrast = style.map_contrast,
                                   .black_above = style.black_above,
                                   .overrun_px = overrun_px})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

gpu::ImageId add_dots(gpu::Graph& graph, const HatchInputs& in, const Darkness& darkness,
                      const HatchStyle& style)
{
    auto pass = graph.compute("hatch/dots", shaders::dots_comp);
    pass.uniform(in.frame).sample(darkness.image).sample(in.draw).sample(in.draws.value());
    const gpu::ImageId ink = pass.modify(darkness.blank);
    const glm::vec2 across = turned(style.dots_deg);
    pass.variant((in.ink_before ? shared::dots_has_ink : 0U) |
                 (in.marks_solid ? shared::dots_marks_solid : 0U));
    pass.push(shared::DotConstants{.pitch_px = style.dots_mm * in.pixels_per_mm,
                                   .axis = {across.y, across.x},
                                   .steps = static_cast<uint32_t>(style.dots_tones),
                                   .black_above = style.black_above})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

namespace {

gpu::ImageId add_variant(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style)
{
    const Darkness darkness = add_darkness(graph, in, style);
    if (in.map && style.enabled && style.strokes == Strokes::map) {
        return add_map(graph, in, darkness, style);
    }
    return style.enabled && style.strokes == Strokes::dots ? add_dots(graph, in, darkness, style)
                                                           : add_lines(graph, in, darkness, style);
}

} // namespace

HatchInputs inputs_of_variant(const HatchInputs& in, const std::vector<HatchVariant>& variants,
                              uint32_t number, std::optional<gpu::ImageId> ink_before)
{
    HatchInputs of_variant = in;
    of_variant.tone = variants[number].tone;
    of_variant.map = variants[number].map;
    of_variant.variant = number;
    of_variant.ink_before = ink_before;
    return of_variant;
}

gpu::ImageId add_hatch(gpu::Graph& graph, const HatchInputs& in, const std::vector<HatchVariant>& variants)
{
    std::optional<gpu::ImageId> ink;
    for (uint32_t variant = 0; variant < variants.size(); ++variant) {
        ink = add_variant(graph, inputs_of_variant(in, variants, variant, ink), variants[variant].style);
    }
    return ink.value();
}

const style::Table<HatchStyle>& hatch_table()
{
    static const auto table =
        style::Table<HatchStyle>("hatch", "Hatching: pen strokes that make light and dark tones")
            .toggle("enabled", &HatchStyle::enabled,
                    "Turns hatching on: strokes or dots that show light and shade")
            .choice("strokes", &HatchStyle::strokes,
                    {{"lines", Strokes::lines}, {"map", Strokes::map}, {"dots", Strokes::dots}},
                    "Marks that make the tone. lines: pen strokes, spaced to match the tone exactly; map: "
                    "strokes of a tonal art map (set of stroke textures); dots: the dots of a screentone.")
            .number("width_mm", &HatchStyle::width_mm, {0.02F, 10.0F}, "mm",
                    "Width of a hatching stroke on the page. Wider strokes also lie farther apart, so the "
                    "tone stays the same. Only used when hatch.strokes is lines.")
            .integer("layers", &HatchStyle::layers, {1, 3}, "",
                     "Largest number of layers of hatching strokes that cross in dark tones. 1 never "
                     "crosses, 2 and 3 draw cross-hatching. Only used when hatch.strokes is lines.")
            .choice("coordinates", &HatchStyle::coordinates,
                    {{"auto", Coordinates::automatic},
                     {"uv", Coordinates::uv},
                     {"solid", Coordinates::solid},
                     {"form", Coordinates::form},
                     {"height", Coordinates::height},
                     {"wind", Coordinates::wind},
                     {"light", Coordinates::light},
                     {"page", Coordinates::page},
                     {"slope", Coordinates::slope}},
                    "What hatching strokes follow. uv: texture coordinates; solid: parallel slices; form: "
                    "curvature; height: contour levels; wind, light, page: as named; slope: "
                    "ground slopes; auto: slope on terrain, form on round bodies, else uv or solid.")
            .number("slant_deg", &HatchStyle::slant_deg, {-180.0F, 180.0F}, "deg",
                    "Angle by which hatching strokes are turned that follow texture coordinates (uv) or the "
                    "page. The second and third layer turn with the first layer.")
            .number("wobble_mm", &HatchStyle::wobble_mm, {0.0F, 5.0F}, "mm",
                    "How far a hatching stroke wavers sideways: 0 is straight as with a ruler, more is a "
                    "shaky hand. Only used when hatch.strokes is lines.")
            .number("gap_mm", &HatchStyle::gap_mm, {0.0F, 20.0F}, "mm",
                    "Gap of white paper between the end of one hatching stroke and the next: 0 draws "
                    "unbroken lines. Only used when hatch.strokes is lines.")
            .number("taper_mm", &HatchStyle::taper_mm, {0.0F, 50.0F}, "mm",
                    "Length over which a hatching stroke thins towards its ends. 0 gives blunt ends, more "
                    "gives pointed ends. Only used when hatch.strokes is lines.")
            .number("length_mm", &HatchStyle::length_mm, {1.0F, 500.0F}, "mm",
                    "Length of the shortest hatching strokes on the page: more draws longer strokes. The "
                    "longest strokes are twice as long. Only used when hatch.strokes is lines.")
            .number("pressure", &HatchStyle::pressure, {0.0F, 1.0F}, "",
                    "How much the width varies along a hatching stroke: 0 is even, as from a technical pen, "
                    "1 varies most. Only used when hatch.strokes is lines.")
            .number(
                "growth", &HatchStyle::growth, {0.0F, 1.0F}, "",
                "How new hatching strokes appear as tones get darker. 0: as thin lines that get thicker; 1: "
                "as short strokes of full width that get longer. Only used when hatch.strokes is lines.")
            .number("overrun_mm", &HatchStyle::overrun_mm, {0.0F, 5.0F}, "mm",
                    "How far hatching strokes run past outlines onto bare paper: 0 stops strokes at the "
                    "outline. Not used when hatch.strokes is dots.")
            .number("loose_mm", &HatchStyle::loose_mm, {0.0F, 10.0F}, "mm",
                    "How far hatching strokes end, at random, before or beyond the edge of a shade: 0 ends "
                    "them all at the edge, more draws ragged edges as a quick hand does. Only used when "
                    "hatch.strokes is lines.")
            .number("black_above", &HatchStyle::black_above, {0.1F, 2.0F}, "",
                    "Darkness above which an area is filled with solid ink: less fills more areas. Above 1, "
                    "no area is filled.")
            .number("form_shade", &HatchStyle::form_shade, {0.0F, 16.0F}, "",
                    "How densely surfaces that turn away from the sun are hatched: 0 leaves such surfaces "
                    "blank, 1 keeps the tone, 2 draws a second layer of as much ink, more draws black")
            .number("cast_shade", &HatchStyle::cast_shade, {0.0F, 16.0F}, "",
                    "How densely shadows that things throw in the sun are hatched: 0 leaves such shadows "
                    "blank, 1 keeps the tone, 2 draws a second layer of as much ink, more draws black")
            .number("ground_shade", &HatchStyle::ground_shade, {0.0F, 16.0F}, "",
                    "How densely the ground and level surfaces are hatched, in the light and in shade: 0 "
                    "leaves such surfaces blank, 1 keeps the tone, less is lighter, more is darker")
            .number("under_shade", &HatchStyle::under_shade, {0.0F, 16.0F}, "",
                    "How densely shade is hatched on surfaces that face down, such as vaults, eaves and the "
                    "undersides of things: 0 leaves such surfaces blank, 1 keeps the tone, more is darker")
            .number("halo_mm", &HatchStyle::halo_mm, {0.0F, 30.0F}, "mm",
                    "Width of the halo around things that stand on the ground: there the strokes of the "
                    "ground in the light thin out towards the things. 0 draws no halo.")
            .integer("groups", &HatchStyle::groups, {0, shared::most_groups}, "",
                     "Number of tones into which hatching groups the picture, paper and black included: 3 "
                     "or 4 make large shapes, more keep more of the light. 0 does not group; 2 is the least "
                     "that does.")
            .number("group_strength", &HatchStyle::group_strength, {0.0F, 1.0F}, "",
                    "How strongly tones are grouped: 0 keeps the tone of each place, 1 draws each area in "
                    "one tone. Only used when hatch.groups is 2 or more.")
            .number("group_area_mm2", &HatchStyle::group_area_mm2, {0.0F, 100.0F}, "mm2",
                    "Smallest area of a grouped tone on the page: smaller areas take the tone of the areas "
                    "around them. Only used when hatch.groups is 2 or more.")
            .number("group_smooth_mm", &HatchStyle::group_smooth_mm, {0.0F, 5.0F}, "mm",
                    "Radius on the page within which fine texture is smoothed before tones are grouped: more "
                    "gives simpler areas. Edges of shade stay where they are. Only used when "
                    "hatch.group_area_mm2 is above 0.")
            .file("map", &HatchStyle::map,
                  "Tonal art map (set of stroke textures): a .tam file, or a folder of PNG or DDS files. If "
                  "empty, the strokes are made with the values of section tam. Only used when hatch.strokes "
                  "is map.")
            .choice("map_tone", &HatchStyle::map_tone,
                    {{"order", MapTone::order}, {"blend", MapTone::blend}, {"step", MapTone::step}},
                    "How the strokes of a tonal art map (set of stroke textures) change from one tone to the "
                    "next. order: stroke by stroke; blend: by smooth blending; step: in hard steps, as in "
                    "cel animation. Only used when hatch.strokes is map.")
            .number("map_contrast", &HatchStyle::map_contrast, {1.0F, 100.0F}, "",
                    "Contrast of the strokes of a tonal art map (set of stroke textures). 1 keeps the greys "
                    "of the map, more gives crisper strokes. Only used when hatch.strokes is map.")
            .number("map_texel_mm", &HatchStyle::map_texel_mm, {0.01F, 5.0F}, "mm",
                    "Size on the page of one pixel of the tonal art map (set of stroke textures). More gives "
                    "wider, longer strokes that lie farther apart. Only used when hatch.strokes is map.")
            .number("dots_mm", &HatchStyle::dots_mm, {0.1F, 20.0F}, "mm",
                    "Distance from one dot of the screentone to the next: less gives a finer screentone. "
                    "Only used when hatch.strokes is dots.")
            .number("dots_deg", &HatchStyle::dots_deg, {-90.0F, 90.0F}, "deg",
                    "Angle of the rows of dots of the screentone on the page: 0 is level, 45 is diagonal. "
                    "Only used when hatch.strokes is dots.")
            .integer(
                "dots_tones", &HatchStyle::dots_tones, {0, 32}, "",
                "Number of grey tones of the screentone, black included, as with printed sheets of "
                "screentone. 0 varies the size of the dots smoothly. Only used when hatch.strokes is dots.")
            .by_surface_but({});
    return table;
}

} // namespace estampe::hatch
