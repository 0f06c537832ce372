// SPDX-License-Identifier: MIT
// Integration that keeps energy at any step: Hillaire, "Physically-based & Unified Volumetric Rendering in
// Frostbite", SIGGRAPH 2015 course.
#include "techniques/smoke/smoke.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gpu/fills.hpp"
#include "gpu/imports.hpp"
#include "shaders/smoke_ink_comp.hpp"
#include "shaders/smoke_light_comp.hpp"
#include "shaders/smoke_march_comp.hpp"
#include "shaders/smoke_pack_comp.hpp"
#include "shaders/smoke_puffs_comp.hpp"
#include "shaders/smoke_shape_comp.hpp"

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

/// There are at least two layers, so that it is an array to shaders.
gpu::ImageDesc field_desc(const glm::uvec3& size, gpu::Format format)
{
    return {.width = size.x, .height = size.y, .format = format, .layers = std::max(size.z, 2U)};
}

/// A lamp as the box sees it, with its share still in luminance.
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
                             .cone_offset = lamp.cone_offset};
    if (is_near) {
        const glm::vec3 way_m = box.cell_m * (light.place - 0.5F * glm::vec3(box.cells));
        // As far as to the middle of the box, but no nearer than its sides.
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

gpu::BufferId add_puffs(gpu::Graph& graph, const Fields& in)
{
    auto pass = graph.compute("smoke/puffs", shaders::smoke_puffs_comp);
    pass.uniform(in.globals).sample(in.density);
    const gpu::BufferId puffs =
        pass.write(graph.buffer("smoke/puffs", {.size_bytes = sizeof(glm::vec4) * in.puff_count}));
    pass.dispatch_items(in.puff_count);
    return puffs;
}

} // namespace

shared::SmokeGlobals globals_of(const Box& box, const SmokeStyle& style, const Surroundings& around)
{
    const float puff_cells = style.puff * box.width_m() / box.cell_m;
    const glm::vec3 risen = around.puffs_risen_m / box.cell_m;
    shared::SmokeGlobals globals{.grid_from_anchor = box.grid_from_anchor,
                                 .cells = box.cells,
                                 .cell_m = box.cell_m,
                                 .extinction_per_m = style.thickness / (0.1F * box.width_m()),
                                 .puff_cells = puff_cells,
                                 .puffs_risen = risen,
                                 .puffs_from = glm::floor(-risen / puff_cells) - 1.0F,
                                 .puff_counts = glm::uvec3(glm::ceil(glm::vec3(box.cells) / puff_cells)) + 3U,
                                 .lights = {},
                                 .light_count = 0,
                                 .ambient = 1.0F,
                                 .edge = style.edge,
                                 .step_m = style.step * box.cell_m,
                                 .scatter = style.scatter,
                                 .towards_light = {0.0F, 1.0F, 0.0F},
                                 .seed = static_cast<uint32_t>(style.seed)};
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
    globals.ambient = std::max(around.ambient, 1e-6F) / sum;
    for (shared::SmokeLight& light : lights) {
        light.strength /= sum;
        globals.lights[globals.light_count++] = light; // NOLINT(*-constant-array-index): resized above
    }
    if (!lights.empty()) {
        globals.towards_light = towards(lights.front(), box);
    }
    return globals;
}

void VolumeMemory::provide(gpu::Device& device, const glm::uvec3& cells)
{
    if (cells == cells_) {
        return;
    }
    const glm::uvec3 bricks = bricks_of(cells);
    packed_ = gpu::Image(device, "smoke", field_desc(cells, gpu::Format::rgba16f));
    bricks_ = gpu::Buffer(device, "smoke bricks", sizeof(float) * bricks.x * bricks.y * bricks.z,
                          gpu::MemoryUse::device);
    cells_ = cells;
}

Volume VolumeMemory::import(gpu::Graph& graph)
{
    return {gpu::import_uploaded(graph, "smoke/packed", packed_),
            gpu::import_whole(graph, "smoke/bricks", bricks_)};
}

Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style, const Fields& in)
{
    const glm::uvec3 cells = memory.cells_;
    const gpu::BufferId puffs =
        style.puffs ? add_puffs(graph, in) : gpu::add_zeros(graph, "smoke/no puffs", sizeof(glm::vec4));
    auto shape_pass = graph.compute("smoke/shape", shaders::smoke_shape_comp);
    shape_pass.uniform(in.globals).sample(in.density).sample(puffs, gpu::Format::rgba32f);
    const gpu::ImageId shape =
        shape_pass.write(graph.image("smoke/shape", field_desc(cells, gpu::Format::r16f)));
    shape_pass.variant(style.puffs ? shared::smoke_has_puffs : 0U);
    shape_pass.dispatch(groups_of(cells.x, 8), groups_of(cells.y, 8), cells.z);

    const glm::uvec3 light_cells = (cells + (shared::smoke_light_cells - 1)) / shared::smoke_light_cells;
    auto light_pass = graph.compute("smoke/light", shaders::smoke_light_comp);
    light_pass.uniform(in.globals).sample(shape, gpu::Sampling::linear);
    const gpu::ImageId light =
        light_pass.write(graph.image("smoke/light", field_desc(light_cells, gpu::Format::r16f)));
    light_pass.dispatch(groups_of(light_cells.x, 8), groups_of(light_cells.y, 8), light_cells.z);

    const glm::uvec3 bricks = bricks_of(cells);
    auto pack = graph.compute("smoke/pack", shaders::smoke_pack_comp);
    pack.uniform(in.globals).sample(shape).sample(light, gpu::Sampling::linear);
    const gpu::ImageId packed = pack.write(
        graph.import_image("smoke/packed", memory.packed_, memory.packed_.desc(), gpu::Layout::undefined));
    const gpu::BufferId densest = pack.write(gpu::import_whole(graph, "smoke/bricks", memory.bricks_));
    pack.dispatch(bricks.x, bricks.y, bricks.z);
    auto keep = graph.custom("smoke/keep");
    keep.touch(packed, gpu::Access::compute_sampled).keep().execute([](gpu::Recorder&) {});
    return {packed, densest};
}

gpu::ImageId add_march(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style, const ViewInputs& in)
{
    auto pass = graph.compute("smoke/march", shaders::smoke_march_comp);
    pass.uniform(in.frame).uniform(in.globals).sample(volume.packed, gpu::Sampling::linear);
    pass.sample(volume.bricks, gpu::Format::r32f).sample(in.depth);
    const gpu::ImageId marched = pass.write(graph.image(
        "smoke/marched", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba32f}));
    pass.variant(style.sampling == Sampling::axis   ? shared::smoke_by_axis
                 : style.sampling == Sampling::view ? shared::smoke_by_view
                                                    : 0U);
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return marched;
}

Layer add_ink(gpu::Graph& graph, const SmokeStyle& style, const InkInputs& in)
{
    const glm::uvec2 size_px = in.view.size_px;
    auto pass = graph.compute("smoke/ink", shaders::smoke_ink_comp);
    pass.uniform(in.view.frame)
        .uniform(in.view.globals)
        .sample(in.marched)
        .sample(in.view.depth)
        .sample(in.lines);
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
                               .gap_m = 0.25F * style.puff * in.width_m,
                               .stroke_axis = glm::normalize(glm::vec3(0.25F, 0.95F, 0.2F)),
                               .stroke_rise_m = in.rise_m});
    pass.variant((style.medium != Medium::strokes ? shared::smoke_has_wash : 0U) |
                 (style.medium != Medium::wash ? shared::smoke_has_strokes : 0U));
    pass.dispatch_over(size_px.x, size_px.y);
    return {paint, ink};
}

uint32_t reach_px(const SmokeStyle& style, float pixels_per_mm)
{
    return style.drawn ? static_cast<uint32_t>(std::ceil(1.5F * style.line_mm * pixels_per_mm)) + 2U : 0U;
}

} // namespace estampe::smoke
