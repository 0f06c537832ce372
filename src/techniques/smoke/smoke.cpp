// SPDX-License-Identifier: MIT
// Energy-conserving integration at any step size: Hillaire, "Physically-based & Unified Volumetric Rendering
// in Frostbite", SIGGRAPH 2015 course.
#include "techniques/smoke/smoke.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/light_variant.glsl.h"
#include "shaders/smoke_ink_comp.hpp"
#include "shaders/smoke_light_comp.hpp"
#include "shaders/smoke_march_comp.hpp"
#include "shaders/smoke_pack_comp.hpp"
#include "shaders/smoke_puffs_comp.hpp"
#include "shaders/smoke_seen_comp.hpp"
#include "shaders/smoke_shape_comp.hpp"
#include "shaders/smoke_thrown_comp.hpp"

namespace estampe::smoke {
namespace {

uint32_t groups_of(uint32_t count, uint32_t size)
{
    return (count + size - 1) / size;
}

glm::uvec3 bricks_of(const glm::uvec3& cells)
{
    return (cells + (shared::smoke_brick - 1)) / shared::smoke_brick;
}

glm::uvec3 light_cells_of(const glm::uvec3& cells)
{
    return (cells + (shared::smoke_light_cells - 1)) / shared::smoke_light_cells;
}

/// Description of an image array for a field. Images have at least two layers, so that shaders see an array.
gpu::ImageDesc field_desc(const glm::uvec3& size, gpu::Format format)
{
    return {.width = size.x, .height = size.y, .format = format, .layers = std::max(size.z, 2U)};
}

/// Converts a lamp to the coordinates of a smoke box. `strength` is a luminance here, not yet a share of all
/// light.
shared::SmokeLight light_of(const Lamp& lamp, const Box& box)
{
    const glm::mat3 turned = box.cell_m * glm::mat3(box.grid_from_anchor);
    const bool is_near = lamp.range_m > 0.0F;
    shared::SmokeLight light{.place = is_near ? glm::vec3(box.grid_from_anchor * glm::vec4(lamp.place, 1.0F))
                                              : glm::normalize(turned * lamp.place),
                             .strength = lamp.luminance,
                             .range_m = lamp.range_m,
                             .falloff = 1.0F,
                             .beam = turned * lamp.beam,
                             .cone_scale = lamp.cone_scale,
                             .cone_offset = lamp.cone_offset,
                             .shadow = lamp.shadow};
    if (is_near) {
        const glm::vec3 way_m = box.cell_m * (light.place - 0.5F * glm::vec3(box.cells));
        // The distance from the lamp to the middle of the box, at least half the box's width.
        const float away_m = std::max(glm::length(way_m), 0.5F * box.width_m());
        light.falloff = away_m * away_m;
        light.strength /= light.falloff;
        light.strength *= away_m < lamp.range_m ? 1.0F : 0.0F;
    }
    return light;
}

glm::vec3 towards(const shared::SmokeLight& light, const Box& box)
{
    return light.range_m > 0.0F ? glm::normalize(light.place - 0.5F * glm::vec3(box.cells) + 1e-4F)
                                : light.place;
}

/// Rounds a number of layers up to whole bricks, because the next box begins at a whole brick.
uint32_t whole_bricks(uint32_t layers)
{
    return shared::smoke_brick * groups_of(layers, shared::smoke_brick);
}

shared::SmokeBox box_of(const Box& box, const SmokeStyle& style, const Surroundings& around)
{
    const float puff_cells = style.puff * box.width_m() / box.cell_m;
    const glm::vec3 risen = box.puffs_risen_m / box.cell_m;
    shared::SmokeBox record{.grid_from_anchor = box.grid_from_anchor,
                            .anchor_from_grid = glm::mat4(glm::inverse(glm::dmat4(box.grid_from_anchor))),
                            .cells = box.cells,
                            .first_layer = 0,
                            .cell_m = box.cell_m,
                            .extinction_per_m = style.thickness / (0.1F * box.width_m()),
                            .puff_cells = puff_cells,
                            .puffs_risen = risen,
                            .puffs_from = glm::floor(-risen / puff_cells) - 1.0F,
                            .puff_counts = glm::uvec3(glm::ceil(glm::vec3(box.cells) / puff_cells)) + 3U,
                            .lights = {},
                            .light_count = 0,
                            .ambient = 1.0F,
                            .step_m = style.step * box.cell_m,
                            .towards_light = {0.0F, 1.0F, 0.0F},
                            .gap_m = 0.25F * style.puff * box.width_m(),
                            .stroke_rise_m = box.strokes_risen_m,
                            .seed = static_cast<uint32_t>(style.seed) + 7919U * box.number};
    std::vector<shared::SmokeLight> lights;
    for (const Lamp& lamp : around.lamps) {
        lights.push_back(light_of(lamp, box));
    }
    std::ranges::stable_sort(lights, std::greater(), &shared::SmokeLight::strength);
    std::erase_if(lights, [](const shared::SmokeLight& light) { return light.strength <= 0.0F; });
    lights.resize(std::min<size_t>(lights.size(), shared::smoke_most_lights));
    float sum = std::max(around.ambient, 1e-6F);
    for (const shared::SmokeLight& light : lights) {
        sum += light.strength;
    }
    record.ambient = std::max(around.ambient, 1e-6F) / sum;
    for (shared::SmokeLight& light : lights) {
        light.strength /= sum;
        record.lights[record.light_count++] = light; // NOLINT(*-constant-array-index): resized above
    }
    if (!lights.empty()) {
        record.towards_light = towards(lights.front(), box);
    }
    return record;
}

gpu::BufferId add_puffs(gpu::Graph& graph, const shared::SmokeBox& box, gpu::BufferId globals,
                        gpu::ImageId density, shared::SmokeTurn turn)
{
    const uint32_t count = box.puff_counts.x * box.puff_counts.y * box.puff_counts.z;
    auto pass = graph.compute("smoke/puffs", shaders::smoke_puffs_comp);
    pass.uniform(globals).sample(density);
    const gpu::BufferId puffs =
        pass.write(graph.buffer("smoke/puffs", {.size_bytes = sizeof(glm::vec4) * count}));
    pass.push(turn).dispatch_items(count);
    return puffs;
}

/// The quantities of a smoke box that are drawn: density, and fire if there is any.
struct Seen {
    gpu::ImageId density;
    std::optional<gpu::ImageId> fire = {};
};

Seen add_seen(gpu::Graph& graph, const shared::SmokeBox& box, const SmokeStyle& style, const Fields& in,
              gpu::ImageId quantities)
{
    if (!is_burning(style) && !is_moist(style)) {
        return {.density = quantities};
    }
    auto pass = graph.compute("smoke/seen", shaders::smoke_seen_comp);
    pass.sample(quantities);
    const gpu::ImageId density =
        pass.write(graph.image("smoke/density", field_desc(box.cells, gpu::Format::r32f)));
    const gpu::ImageId fire = pass.write(graph.image("smoke/fire", field_desc(box.cells, gpu::Format::r16f)));
    pass.push(shared::SmokeSeen{.cells = box.cells, .ignition = in.ignition, .flame = style.flame})
        .variant((is_burning(style) ? shared::smoke_has_fire : 0U) |
                 (is_moist(style) ? shared::smoke_has_cloud : 0U));
    pass.dispatch(groups_of(box.cells.x, 8), groups_of(box.cells.y, 8), box.cells.z);
    return {.density = density, .fire = is_burning(style) ? std::optional(fire) : std::nullopt};
}

/// Handle of an image that several smoke boxes write one after another: the first box's pass writes the
/// image, the passes of later boxes modify it.
template <class Handle>
Handle write_turn(gpu::Pass& pass, Handle into, bool is_first)
{
    return is_first ? pass.write(into) : pass.modify(into);
}

/// Whether some texels of the field images belong to no smoke box.
bool has_gaps(std::span<const shared::SmokeBox> boxes, const shared::SmokeGlobals& globals)
{
    const glm::uvec2 sides(globals.field_cells);
    return std::ranges::any_of(boxes, [&](const shared::SmokeBox& box) {
        return glm::uvec2(box.cells) != sides || box.cells.z != whole_bricks(box.cells.z);
    });
}

uint32_t shaded_variant(const Fields& in)
{
    constexpr uint32_t of_map = shared::light_has_sun_levels | shared::light_has_sun_warp;
    return in.shadows ? shared::smoke_is_shaded | (in.shadows->variant & of_map) : 0U;
}

/// Binds the scene's shadow maps. The buffer `blank` stands in for missing maps.
void bind_shadows(gpu::Pass& pass, const Fields& in, gpu::BufferId blank)
{
    const SceneShadows shadows = in.shadows.value_or(SceneShadows{.frame = in.globals,
                                                                  .sun_map = blank,
                                                                  .sun_shadow = in.globals,
                                                                  .local_shadows = blank,
                                                                  .local_maps = blank});
    pass.uniform(shadows.frame).sample(shadows.sun_map, gpu::Format::r32f).uniform(shadows.sun_shadow);
    pass.read(shadows.local_shadows).sample(shadows.local_maps, gpu::Format::r32f);
}

} // namespace

shared::SmokeGlobals globals_of(std::span<const Box> boxes, const SmokeStyle& style,
                                const Surroundings& around)
{
    shared::SmokeGlobals globals{.boxes = {},
                                 .box_count = 0,
                                 .field_cells = glm::uvec3(0),
                                 .edge = style.edge,
                                 .scatter = style.scatter};
    for (const Box& box : boxes.first(std::min<size_t>(boxes.size(), shared::smoke_most_boxes))) {
        shared::SmokeBox record = box_of(box, style, around);
        record.first_layer = whole_bricks(globals.field_cells.z);
        globals.field_cells = {std::max(globals.field_cells.x, box.cells.x),
                               std::max(globals.field_cells.y, box.cells.y),
                               record.first_layer + box.cells.z};
        globals.boxes[globals.box_count++] = record; // NOLINT(*-constant-array-index): no more than there are
    }
    return globals;
}

void VolumeMemory::ensure(gpu::Device& device, const shared::SmokeGlobals& globals)
{
    const bool fits = globals.field_cells == globals_.field_cells;
    globals_ = globals;
    if (fits) {
        return;
    }
    const glm::uvec3 bricks = bricks_of(globals.field_cells);
    packed_ = gpu::Image(device, "smoke", field_desc(globals.field_cells, gpu::Format::rgba16f));
    bricks_ = gpu::Buffer(device, "smoke bricks", sizeof(float) * bricks.x * bricks.y * bricks.z,
                          gpu::MemoryUse::device);
}

Volume VolumeMemory::import(gpu::Graph& graph)
{
    return {.packed = gpu::import_uploaded(graph, "smoke/packed", packed_),
            .bricks = gpu::import_whole(graph, "smoke/bricks", bricks_),
            .has_several = globals_.box_count > 1};
}

Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style, const Fields& in)
{
    const shared::SmokeGlobals& known = memory.globals_;
    const std::span boxes = std::span(known.boxes).first(known.box_count);
    const uint32_t several = boxes.size() > 1 ? shared::smoke_has_several : 0U;
    const uint32_t shaded = shaded_variant(in);
    const gpu::BufferId blank = gpu::add_zeros(graph, "smoke/nothing", sizeof(glm::vec4));
    const glm::uvec3 light_cells = light_cells_of(known.field_cells);
    gpu::ImageId shape = graph.image("smoke/shape", field_desc(known.field_cells, gpu::Format::r16f));
    gpu::ImageId light = graph.image("smoke/light", field_desc(light_cells, gpu::Format::r16f));
    gpu::ImageId packed =
        graph.import_image("smoke/packed", memory.packed_, memory.packed_.desc(), gpu::Layout::undefined);
    gpu::BufferId densest = gpu::import_whole(graph, "smoke/bricks", memory.bricks_);
    // Texture filters read texels next to boxes with weight 0, so the texels next to boxes must not hold NaN.
    const bool is_blank = boxes.size() > 1 && has_gaps(boxes, known);
    if (is_blank) {
        for (gpu::ImageId* const field : {&shape, &light, &packed}) {
            *field = gpu::add_fill(graph, "smoke/blank", *field, glm::vec4(0.0F));
        }
    }
    const auto is_first = [&](shared::SmokeTurn turn) { return turn.box == 0 && !is_blank; };
    std::vector<Seen> seen;
    for (shared::SmokeTurn turn{.box = 0}; turn.box < boxes.size(); ++turn.box) {
        const shared::SmokeBox& box = boxes[turn.box];
        seen.push_back(add_seen(graph, box, style, in, in.densities.at(turn.box)));
        const gpu::ImageId density = seen.back().density;
        const gpu::BufferId puffs = style.puffs ? add_puffs(graph, box, in.globals, density, turn) : blank;
        auto pass = graph.compute("smoke/shape", shaders::smoke_shape_comp);
        pass.uniform(in.globals).sample(density).sample(puffs, gpu::Format::rgba32f);
        shape = write_turn(pass, shape, is_first(turn));
        pass.variant(style.puffs ? shared::smoke_has_puffs : 0U).push(turn);
        pass.dispatch(groups_of(box.cells.x, 8), groups_of(box.cells.y, 8), box.cells.z);
    }
    for (shared::SmokeTurn turn{.box = 0}; turn.box < boxes.size(); ++turn.box) {
        const glm::uvec3 cells = light_cells_of(boxes[turn.box].cells);
        auto pass = graph.compute("smoke/light", shaders::smoke_light_comp);
        pass.uniform(in.globals).sample(shape, gpu::Sampling::linear);
        bind_shadows(pass, in, blank);
        light = write_turn(pass, light, is_first(turn));
        pass.variant(several | shaded).push(turn);
        pass.dispatch(groups_of(cells.x, 8), groups_of(cells.y, 8), cells.z);
    }
    for (shared::SmokeTurn turn{.box = 0}; turn.box < boxes.size(); ++turn.box) {
        const glm::uvec3 bricks = bricks_of(boxes[turn.box].cells);
        auto pass = graph.compute("smoke/pack", shaders::smoke_pack_comp);
        const std::optional<gpu::ImageId>& fire = seen[turn.box].fire;
        pass.uniform(in.globals).sample(shape).sample(light, gpu::Sampling::linear);
        pass.sample(fire.value_or(shape));
        packed = write_turn(pass, packed, is_first(turn));
        densest = write_turn(pass, densest, turn.box == 0);
        pass.variant(several | (fire ? shared::smoke_has_fire : 0U)).push(turn);
        pass.dispatch(bricks.x, bricks.y, bricks.z);
    }
    auto keep = graph.custom("smoke/keep");
    keep.touch(packed, gpu::Access::compute_sampled).keep().execute([](gpu::Recorder&) {});
    return {.packed = packed, .bricks = densest, .has_several = boxes.size() > 1};
}

gpu::ImageId add_march(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style, const ViewInputs& in)
{
    auto pass = graph.compute("smoke/march", shaders::smoke_march_comp);
    pass.uniform(in.frame).uniform(in.globals).sample(volume.packed, gpu::Sampling::linear);
    pass.sample(volume.bricks, gpu::Format::r32f).sample(in.depth);
    const gpu::ImageId marched = pass.write(graph.image(
        "smoke/marched", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba32f}));
    pass.variant((style.sampling == Sampling::axis   ? shared::smoke_by_axis
                  : style.sampling == Sampling::view ? shared::smoke_by_view
                                                     : 0U) |
                 (volume.has_several ? shared::smoke_has_several : 0U));
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return marched;
}

gpu::ImageId add_thrown(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                        const ThrownInputs& in)
{
    auto pass = graph.compute("smoke/thrown", shaders::smoke_thrown_comp);
    pass.uniform(in.view.frame).uniform(in.view.globals).sample(volume.packed, gpu::Sampling::linear);
    pass.sample(volume.bricks, gpu::Format::r32f).sample(in.view.depth);
    pass.sample(in.share.value_or(in.view.depth));
    const glm::uvec2 size_px = in.view.size_px;
    const gpu::ImageId share = pass.write(
        graph.image("smoke/share", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f}));
    pass.push(shared::SmokeThrown{.towards_sun = in.towards_sun, .strength = style.shadow})
        .variant((volume.has_several ? shared::smoke_has_several : 0U) |
                 (in.share ? shared::smoke_has_share : 0U));
    pass.dispatch_over_page(size_px.x, size_px.y);
    return share;
}

Layer add_ink(gpu::Graph& graph, const SmokeStyle& style, const InkInputs& in)
{
    const glm::uvec2 size_px = in.view.size_px;
    auto pass = graph.compute("smoke/ink", shaders::smoke_ink_comp);
    pass.uniform(in.view.frame)
        .uniform(in.view.globals)
        .sample(in.marched)
        .sample(in.view.depth)
        .sample(in.lines)
        .sample(in.haze ? in.haze->sky : in.lines);
    const gpu::ImageId paint = pass.write(
        graph.image("smoke/paint", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba8}));
    const gpu::ImageId ink = pass.write(
        graph.image("smoke/ink", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f}));
    pass.push(shared::SmokeInk{.color = style.color,
                               .shade_below = style.shade_below,
                               .shade_color = style.shade_color,
                               .deep_below = style.deep_below,
                               .deep_color = style.deep_color,
                               .opacity = style.opacity,
                               .form = style.form,
                               .line_px = style.line_mm * in.pixels_per_mm,
                               .scene_line_px = in.scene_line_px,
                               .stroke_px = style.stroke_mm * in.pixels_per_mm,
                               .darkness = style.darkness,
                               .stroke_axis = glm::normalize(glm::vec3(0.25F, 0.95F, 0.2F)),
                               .haze_start_m = in.haze ? in.haze->start_m : 0.0F,
                               .haze_halves_per_m = in.haze ? 1.0F / in.haze->reach_m : 0.0F,
                               .haze_ink = in.haze ? in.haze->ink : 0.0F,
                               .flame_color = style.flame_color});
    pass.variant((style.medium != Medium::strokes ? shared::smoke_has_wash : 0U) |
                 (style.medium != Medium::wash ? shared::smoke_has_strokes : 0U) |
                 (in.haze ? shared::smoke_has_haze : 0U) | (is_burning(style) ? shared::smoke_has_fire : 0U));
    pass.dispatch_over_page(size_px.x, size_px.y);
    return {paint, ink};
}

uint32_t reach_px(const SmokeStyle& style, float pixels_per_mm)
{
    return style.enabled ? static_cast<uint32_t>(std::ceil(1.5F * style.line_mm * pixels_per_mm)) + 2U : 0U;
}

} // namespace estampe::smoke
