// SPDX-License-Identifier: MIT
#include "techniques/motion_blur/motion_blur.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/hash.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/blur_gather_comp.hpp"
#include "shaders/blur_pack_comp.hpp"
#include "shaders/blur_reach_comp.hpp"
#include "shaders/blur_tiles_comp.hpp"
#include "shaders/blur_tiles_wide_comp.hpp"
#include "shaders/scene.glsl.h"
#include "shaders/smear_lists_comp.hpp"
#include "shaders/smear_seeds_comp.hpp"
#include "shaders/smear_strokes_comp.hpp"
#include "shaders/smear_thin_comp.hpp"
#include "shaders/speed_lines_comp.hpp"
#include "shaders/speed_seeds_comp.hpp"
#include "shaders/speed_tiles_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/motion_blur/alternatives/within_outline.hpp"

namespace estampe::motion_blur {

const style::Table<MotionBlurStyle>& motion_blur_table()
{
    const auto of_lines = [](auto MotionMarks::*member) {
        return style::within(&MotionBlurStyle::speed_lines, member);
    };
    const auto of_smear = [](auto MotionMarks::*member) {
        return style::within(&MotionBlurStyle::smear, member);
    };
    static const auto table =
        style::Table<MotionBlurStyle>("motion_blur", "Motion blur, speed lines and smear strokes")
            .toggle("enabled", &MotionBlurStyle::enabled, "Turns motion blur on: moving objects are blurred")
            .choice("mode", &MotionBlurStyle::mode,
                    {{"tiles", Mode::tiles},
                     {"own", Mode::own},
                     {"stretched", Mode::stretched},
                     {"velocity", Mode::velocity}},
                    "How moving objects are blurred. tiles: over the things that they pass; own: within "
                    "their outline; stretched: within an outline lengthened along the motion; velocity: "
                    "shows speeds as colours, red to the right and green up.")
            .number("shutter_deg", &MotionBlurStyle::shutter_deg, {0.0F, 360.0F}, "deg",
                    "How long the shutter is open: 360 is the whole time between two frames, 180 is half "
                    "that time. More gives more blur and longer speed lines.")
            .number("frames_per_s", &MotionBlurStyle::frames_per_s, {1.0F, 1000.0F}, "/s",
                    "Frame rate from which the exposure time of a still picture is computed: less gives more "
                    "blur. Films use their own frame rate.")
            .number("largest_mm", &MotionBlurStyle::largest_mm, {0.1F, 60.0F}, "mm",
                    "Longest motion on the page that gives blur or smear strokes. Faster objects are blurred "
                    "as if they moved only this far.")
            .toggle("speed_lines.enabled", of_lines(&MotionMarks::enabled),
                    "Turns speed lines on: lines behind objects that move fast")
            .number("speed_lines.length", of_lines(&MotionMarks::length), {0.1F, 20.0F}, "",
                    "Length of speed lines, as a factor of the object's path while the shutter is open. More "
                    "makes objects look faster, up to lines of 30 mm. Only used when "
                    "motion_blur.speed_lines.enabled is true.")
            .number("speed_lines.spacing_mm", of_lines(&MotionMarks::spacing_mm), {0.5F, 50.0F}, "mm",
                    "Approximate distance from one speed line to the next: less gives more lines. Only used "
                    "when motion_blur.speed_lines.enabled is true.")
            .number("speed_lines.width_mm", of_lines(&MotionMarks::width_mm), {0.05F, 5.0F}, "mm",
                    "Width of a speed line at its start, next to the object: more is bolder. Only used when "
                    "motion_blur.speed_lines.enabled is true.")
            .number(
                "speed_lines.from_mm", of_lines(&MotionMarks::from_mm), {0.0F, 60.0F}, "mm",
                "Smallest motion on the page, while the shutter is open, that gives speed lines. Less gives "
                "speed lines to slow objects, too. Only used when motion_blur.speed_lines.enabled is true.")
            .color(
                "speed_lines.ink", of_lines(&MotionMarks::ink),
                "Colour of the ink of speed lines. Only used when motion_blur.speed_lines.enabled is true.")
            .toggle("smear.enabled", of_smear(&MotionMarks::enabled),
                    "Turns smear strokes on: strokes of a dry brush, drawn behind moving objects from their "
                    "rear edge")
            .number("smear.length", of_smear(&MotionMarks::length), {0.1F, 20.0F}, "",
                    "Length of the longest smear strokes, as a factor of the object's path while the shutter "
                    "is open. More looks faster. Paths count up to motion_blur.largest_mm. Only used when "
                    "motion_blur.smear.enabled is true.")
            .number("smear.spacing_mm", of_smear(&MotionMarks::spacing_mm), {0.2F, 50.0F}, "mm",
                    "Distance from one smear stroke to the next, across the motion: less gives more strokes. "
                    "Only used when motion_blur.smear.enabled is true.")
            .number("smear.width_mm", of_smear(&MotionMarks::width_mm), {0.05F, 10.0F}, "mm",
                    "Width of the broadest smear strokes at their start, next to the object: more is bolder. "
                    "Only used when motion_blur.smear.enabled is true.")
            .number(
                "smear.from_mm", of_smear(&MotionMarks::from_mm), {0.0F, 60.0F}, "mm",
                "Smallest motion on the page, while the shutter is open, that gives smear strokes. Less "
                "gives smear strokes to slow objects, too. Only used when motion_blur.smear.enabled is true.")
            .color("smear.ink", of_smear(&MotionMarks::ink),
                   "Colour of the ink of smear strokes. Only used when motion_blur.smear.enabled is true.");
    return table;
}

// The seeds (possible starts) of smear strokes are thinned out to a minimum distance by the second method of
// Matérn, "Spatial Variation", 1960. In Matérn's second method, each seed depends only on the seeds around
// the seed.

namespace {

constexpr uint32_t least_of_draw = 4;
constexpr uint32_t most_of_scene = 4 * smear_seed_count;

float unit_float(uint32_t bits)
{
    return static_cast<float>(bits >> 8U) / 16777216.0F;
}

/// Adds `count` seeds (possible starts) of smear strokes, one in each of `count` equal parts of a draw call's
/// area. `of_draw` lists the triangles of the draw call.
void spread_over(std::span<const uint32_t> of_draw, std::span<const glm::uvec4> triangles,
                 std::span<const glm::vec3> places, uint32_t count, std::vector<shared::SmearSeed>& seeds)
{
    std::vector<float> area_up_to;
    float area = 0.0F;
    for (const uint32_t number : of_draw) {
        const glm::uvec4& corners = triangles[number];
        const glm::vec3 a = places[corners.x];
        area += glm::length(glm::cross(places[corners.y] - a, places[corners.z] - a));
        area_up_to.push_back(area);
    }
    for (uint32_t i = 0; i < count && area > 0.0F; ++i) {
        const auto number = static_cast<uint32_t>(seeds.size());
        const uint32_t random = hash(number + 1U);
        const float wanted = area * (static_cast<float>(i) + unit_float(random)) / static_cast<float>(count);
        const auto found = std::ranges::upper_bound(area_up_to, wanted);
        const auto at = std::min(static_cast<size_t>(found - area_up_to.begin()), of_draw.size() - 1);
        glm::vec2 weight(unit_float(hash(random)), unit_float(hash(random + 1U)));
        weight = weight.x + weight.y > 1.0F ? 1.0F - weight : weight;
        seeds.push_back({.triangle = of_draw[at], .weight = weight, .number = number});
    }
}

} // namespace

std::vector<shared::SmearSeed> spread_seeds(std::span<const uint32_t> of,
                                            std::span<const glm::uvec4> triangles,
                                            std::span<const glm::vec3> places)
{
    std::map<uint32_t, std::vector<uint32_t>> draws;
    for (const uint32_t number : of) {
        draws[triangles[number].w & shared::triangle_draw_mask].push_back(number);
    }
    const auto draw_count = std::max(static_cast<uint32_t>(draws.size()), 1U);
    const uint32_t count = std::max(smear_seed_count / draw_count, least_of_draw);
    std::vector<shared::SmearSeed> seeds;
    for (const auto& [draw, of_draw] : draws) {
        if (seeds.size() + count <= most_of_scene) {
            spread_over(of_draw, triangles, places, count, seeds);
        }
    }
    return seeds;
}

SmearSeeds upload_seeds(gpu::Device& device, const std::vector<shared::SmearSeed>& seeds)
{
    SmearSeeds made{.count = static_cast<uint32_t>(seeds.size()), .is_made = true};
    if (!seeds.empty()) {
        made.places = gpu::upload_buffer(device, "smear seeds", seeds);
    }
    return made;
}

shared::SmearConstants smear_constants_of(const MotionBlurStyle& style, float scale, float most_px,
                                          float pixels_per_mm)
{
    return {.scale = scale,
            .most_px = most_px,
            .length_share = 2.0F * style.smear.length,
            .spacing_px = style.smear.spacing_mm * pixels_per_mm,
            .width_px = style.smear.width_mm * pixels_per_mm,
            .from_px = 0.5F * style.smear.from_mm * pixels_per_mm,
            .seed = static_cast<uint32_t>(style.seed),
            .ink = style.smear.ink};
}

gpu::ImageId add_smear(gpu::Graph& graph, const SmearScene& scene, const SmearPage& page, gpu::ImageId lines,
                       shared::SmearConstants constants)
{
    if (scene.seeds->count == 0) {
        return lines;
    }
    constants.clip_from_anchor_before = scene.clip_from_anchor_before;
    constants.size_px = page.size_px;
    constants.count = scene.seeds->count;
    const gpu::BufferDesc strokes_desc{.size_bytes = sizeof(shared::SmearStroke) * constants.count};
    auto find = graph.compute("smear/seeds", shaders::smear_seeds_comp);
    find.uniform(scene.frame).sample(gpu::import_whole(graph, "smear seeds", scene.seeds->places));
    find.sample(scene.triangles).sample(scene.posed_vertices).sample(scene.posed_vertices_before);
    find.sample(page.page).sample(page.owner_depth);
    const gpu::BufferId found = find.write(graph.buffer("smear/found", strokes_desc));
    find.push(constants).dispatch_items(constants.count);

    auto thin = graph.compute("smear/thin", shaders::smear_thin_comp);
    thin.sample(found);
    const gpu::BufferId kept = thin.write(graph.buffer("smear/kept", strokes_desc));
    thin.push(constants).dispatch_items(constants.count);

    const glm::uvec2 blocks = (page.size_px + shared::smear_block_px - 1U) / shared::smear_block_px;
    const uint32_t block_count = blocks.x * blocks.y;
    auto list = graph.compute("smear/lists", shaders::smear_lists_comp);
    list.sample(kept);
    const gpu::BufferId lists = list.write(graph.buffer(
        "smear/lists",
        {.size_bytes = sizeof(uint32_t) * (shared::most_smear_strokes + 1U) * uint64_t{block_count}}));
    list.push(constants).dispatch_items(block_count);

    auto draw = graph.compute("smear", shaders::smear_strokes_comp);
    draw.sample(kept).sample(lists, gpu::Format::r32ui);
    draw.sample(page.page).sample(page.owner_depth).sample(page.depth);
    const gpu::ImageId drawn = draw.modify(lines);
    draw.push(constants).dispatch_over(page.size_px.x, page.size_px.y);
    return drawn;
}

// Sources of the motion blur. Blur along the longest motion of tiles: McGuire, Hennessy, Bukowski and Osman,
// "A Reconstruction Filter for Plausible Motion Blur", I3D 2012. Blur along two motions: Guertin, McGuire and
// Nowrouzezahrai, "A Fast and Stable Feature-Aware Motion Blur Filter", HPG 2014. Separate foreground and
// background: Jimenez, "Next Generation Post Processing in Call of Duty", SIGGRAPH 2014.

namespace {

constexpr float longest_line_mm = 30.0F;

/// The layers and the motion of a page, packed into few images.
struct Packed {
    gpu::ImageId page;
    gpu::ImageId depth;
    /// Hatching and the sky's strokes, if sky strokes are added; otherwise a single texel.
    gpu::ImageId hatch;
};

Packed add_pack(gpu::Graph& graph, const MotionBlurInputs& in, uint32_t variant,
                const shared::MotionBlurConstants& constants)
{
    auto pass = graph.compute("motion blur/pack", shaders::blur_pack_comp);
    pass.sample(in.depth).sample(in.motion).sample(in.wash).sample(in.hatch).sample(in.lines).sample(
        in.sky_ink);
    pass.sample(in.own_motion);
    const glm::uvec2 hatch_px = (variant & shared::blur_lays_sky) != 0U ? in.size_px : glm::uvec2(1);
    const Packed packed{
        .page = pass.write(
            graph.image("motion blur/page",
                        {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba32ui})),
        .depth = pass.write(
            graph.image("motion blur/depth",
                        {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r32f})),
        .hatch = pass.write(graph.image(
            "motion blur/hatch", {.width = hatch_px.x, .height = hatch_px.y, .format = gpu::Format::r16f}))};
    pass.variant(variant | (in.own_motion == in.motion ? 0U : shared::blur_is_stretched));
    pass.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);
    return packed;
}

/// The longest displacement during half the exposure that reaches each tile of the page, and the list of
/// tiles to draw.
struct Reach {
    gpu::ImageId ways;
    gpu::BufferId tiles; ///< list of tiles, see shaders/tiles.glsl.h
};

Reach add_reach(gpu::Graph& graph, const MotionBlurInputs& in, gpu::ImageId page, uint32_t variant,
                const shared::MotionBlurConstants& constants)
{
    const glm::uvec2 tiles = (in.size_px + shared::blur_tile_px - 1U) / shared::blur_tile_px;
    const gpu::ImageDesc desc{.width = tiles.x, .height = tiles.y, .format = gpu::Format::rg16f};
    auto find = graph.compute("motion blur/tiles",
                              in.by_groups ? shaders::blur_tiles_wide_comp : shaders::blur_tiles_comp);
    find.sample(page);
    const gpu::ImageId found = find.write(graph.image("motion blur/tiles", desc));
    find.push(constants);
    if (in.by_groups) {
        find.dispatch(tiles.x, tiles.y);
    } else {
        find.dispatch_over(tiles.x, tiles.y);
    }
    const gpu::BufferId no_tiles = gpu::add_empty_tile_list(graph, "motion blur/passed", in.size_px);
    auto spread = graph.compute("motion blur/reach", shaders::blur_reach_comp);
    spread.sample(found);
    const gpu::ImageId ways = spread.write(graph.image("motion blur/reach", desc));
    const gpu::BufferId passed = spread.modify(no_tiles);
    spread.variant(variant).push(constants).dispatch_over(tiles.x, tiles.y);
    return {.ways = ways, .tiles = passed};
}

/// Blurs `layers` in place, in the tiles over which a moving surface passes.
void blur_in_place(gpu::Graph& graph, const MotionBlurInputs& in, const Packed& packed, uint32_t variant,
                   const shared::MotionBlurConstants& constants, MotionBlurLayers& layers)
{
    const Reach reach = add_reach(graph, in, packed.page, variant, constants);
    auto pass = graph.compute("motion blur", shaders::blur_gather_comp);
    pass.sample(packed.page).sample(packed.depth).sample(reach.ways);
    layers.wash = pass.modify(layers.wash);
    layers.hatch = pass.modify(layers.hatch);
    layers.lines = pass.modify(layers.lines);
    pass.read(reach.tiles);
    pass.variant(variant).push(constants).dispatch_indirect(reach.tiles);
}

gpu::ImageId add_speed_lines(gpu::Graph& graph, const MotionBlurInputs& in, const Packed& packed,
                             gpu::ImageId lines, const shared::MotionBlurConstants& constants)
{
    const glm::uvec2 cells(glm::ceil(glm::vec2(in.size_px) / constants.cell_px));
    auto seed = graph.compute("speed lines/seeds", shaders::speed_seeds_comp);
    seed.sample(packed.page).sample(packed.depth);
    const gpu::ImageId seeds = seed.write(graph.image(
        "speed lines/seeds", {.width = cells.x, .height = cells.y, .format = gpu::Format::rgba32f}));
    seed.push(constants).dispatch_over(cells.x, cells.y);

    const glm::uvec2 tiles = (in.size_px + shared::blur_tile_px - 1U) / shared::blur_tile_px;
    auto list = graph.compute("speed lines/tiles", shaders::speed_tiles_comp);
    list.sample(seeds);
    const gpu::ImageId listed = list.write(graph.image(
        "speed lines/tiles",
        {.width = tiles.x * shared::most_speed_lines, .height = tiles.y, .format = gpu::Format::rgba32f}));
    list.push(constants).dispatch_over(tiles.x, tiles.y);

    auto draw = graph.compute("speed lines", shaders::speed_lines_comp);
    draw.sample(listed).sample(packed.page);
    const gpu::ImageId drawn = draw.modify(lines);
    draw.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return drawn;
}

} // namespace

double exposure_s(const MotionBlurStyle& style)
{
    return static_cast<double>(style.shutter_deg) / 360.0 / static_cast<double>(style.frames_per_s);
}

bool is_wanted(const MotionBlurStyle& style)
{
    return style.shutter_deg > 0.0F && (style.enabled || style.speed_lines.enabled || style.smear.enabled);
}

shared::MotionBlurConstants constants_of(const MotionBlurStyle& style, float scale, float pixels_per_mm,
                                         float line_half_px)
{
    return {.scale = scale,
            .most_px = 0.5F * style.largest_mm * pixels_per_mm,
            .line_reach_px = std::ceil(std::max(line_half_px, 0.0F)) + 1.0F,
            .cell_px = std::max(style.speed_lines.spacing_mm * pixels_per_mm, 2.0F),
            .line_length = 2.0F * style.speed_lines.length,
            .line_most_px = longest_line_mm * pixels_per_mm,
            .line_half_px = 0.5F * style.speed_lines.width_mm * pixels_per_mm,
            .line_from_px = 0.5F * style.speed_lines.from_mm * pixels_per_mm,
            .seed = static_cast<uint32_t>(style.seed),
            .line_ink = style.speed_lines.ink};
}

struct Memory::Kept {
    CoincidentVertices coincident;
};

Memory::Memory() : kept_(std::make_unique<Kept>()) {}

Memory::~Memory() = default;

namespace {

bool blurs_by(const MotionBlurStyle& style, Mode mode)
{
    return style.enabled && style.mode == mode;
}

} // namespace

bool Memory::lacks_vertices(const MotionBlurStyle& style) const
{
    return blurs_by(style, Mode::stretched) && kept_->coincident.empty();
}

void Memory::set_vertices(gpu::Device& device, std::span<const glm::vec3> places,
                          std::span<const uint32_t> draw_of_vertex)
{
    kept_->coincident = upload_coincident(device, list_coincident(places, draw_of_vertex));
}

void Memory::forget()
{
    *kept_ = {};
}

std::optional<VelocityShape> add_velocity_shape(gpu::Graph& graph, Memory& memory,
                                                const VelocityShapeInputs& in, const MotionBlurStyle& style)
{
    return blurs_by(style, Mode::stretched) ? std::optional(add_stretch(graph, memory.kept_->coincident, in))
                                            : std::nullopt;
}

MotionBlurLayers add_motion_blur(gpu::Graph& graph, const MotionBlurInputs& in, const MotionBlurStyle& style,
                                 shared::MotionBlurConstants constants, const shared::SmearConstants& smear)
{
    constants.size_px = in.size_px;
    constants.window_min_px = in.window_min_px;
    constants.window_max_px = in.window_max_px;
    const uint32_t variant = in.has_sky ? shared::blur_has_sky : 0U;
    const bool blurs_within = blurs_by(style, Mode::own) || blurs_by(style, Mode::stretched);
    const bool lays_sky = in.has_sky && style.enabled && !blurs_within;
    const Packed packed = add_pack(graph, in, variant | (lays_sky ? shared::blur_lays_sky : 0U), constants);
    MotionBlurLayers layers{.wash = in.wash,
                            .hatch = lays_sky ? packed.hatch : in.hatch,
                            .lines = in.lines,
                            .holds_sky = lays_sky};
    if (blurs_within) {
        layers = add_own_blur(graph, in, packed.page, constants);
    } else if (style.enabled) {
        blur_in_place(graph, in, packed, style.mode == Mode::velocity ? shared::blur_shows_velocity : 0U,
                      constants, layers);
    }
    if (style.speed_lines.enabled) {
        layers.lines = add_speed_lines(graph, in, packed, layers.lines, constants);
    }
    if (in.smear) {
        layers.lines = add_smear(
            graph, *in.smear,
            {.page = packed.page, .owner_depth = packed.depth, .depth = in.depth, .size_px = in.size_px},
            layers.lines, smear);
    }
    return layers;
}

} // namespace estampe::motion_blur
