// SPDX-License-Identifier: MIT
#include "techniques/raster/paths.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include <estampe/error.hpp>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "shaders/bin_behind_comp.hpp"
#include "shaders/bin_depth_comp.hpp"
#include "shaders/bin_depth_masked_comp.hpp"
#include "shaders/bin_ids_comp.hpp"
#include "shaders/bin_masked_comp.hpp"
#include "shaders/clear_counted_comp.hpp"
#include "shaders/corner_listed_behind_vert.hpp"
#include "shaders/corner_listed_vert.hpp"
#include "shaders/corner_vert.hpp"
#include "shaders/cull_list_comp.hpp"
#include "shaders/cull_triangles_comp.hpp"
#include "shaders/cull_triangles_seen_comp.hpp"
#include "shaders/draw_behind_frag.hpp"
#include "shaders/draw_depth_frag.hpp"
#include "shaders/draw_depth_masked_frag.hpp"
#include "shaders/draw_ids_frag.hpp"
#include "shaders/draw_masked_frag.hpp"
#include "shaders/fill_comp.hpp"
#include "shaders/scene.glsl.h"
#include "shaders/small_behind_comp.hpp"
#include "shaders/small_depth_comp.hpp"
#include "shaders/small_depth_masked_comp.hpp"
#include "shaders/small_ids_comp.hpp"
#include "shaders/small_ids_listed_comp.hpp"
#include "shaders/small_masked_comp.hpp"
#include "shaders/tile_behind_comp.hpp"
#include "shaders/tile_depth_comp.hpp"
#include "shaders/tile_depth_masked_comp.hpp"
#include "shaders/tile_ids_comp.hpp"
#include "shaders/tile_masked_comp.hpp"
#include "techniques/raster/raster.glsl.h"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

gpu::BufferId add_clear(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId buffer)
{
    struct {
        uint32_t value;
        uint32_t quad_count;
    } constants{0, static_cast<uint32_t>(graph.describe(buffer).size_bytes / 16)};

    auto pass = graph.compute(name + "/clear", shaders::fill_comp);
    const gpu::BufferId cleared = pass.write(buffer);
    pass.push(constants).dispatch_items((constants.quad_count + 255) / 256 * 64);
    return cleared;
}

void bind_masks(gpu::Pass& pass, const RasterInputs& in)
{
    pass.sample(in.draws).read(in.rest_vertices).sample(in.materials);
    for (const gpu::ImageId texture : in.textures) {
        pass.sample(texture, gpu::Sampling::linear_repeat);
    }
}

namespace {

/// Bits of `variant` that select the pixels to draw in depth peeling at half resolution, see draws_second.
uint32_t second_bits(const View& view)
{
    return view.second_from ? shared::draws_second | view.second_from->x << 1U | view.second_from->y << 2U
                            : 0U;
}

/// Bits of `variant` for drawing a batch. Shaders for depth peeling can test alpha masks; a bit turns that
/// off if the batch has no masks.
uint32_t mask_variant(const RasterInputs& in, const Batch& batch, const View& view)
{
    if (batch.masked) {
        return in.texture_classes;
    }
    return view.behind ? shared::draw_has_no_masks : 0U;
}

struct Stages {
    const gpu::Shader& small;
    const gpu::Shader& bin;
    const gpu::Shader& tile;
};

Stages stages(bool depth_only, bool masked, bool behind)
{
    if (behind) {
        return {shaders::small_behind_comp, shaders::bin_behind_comp, shaders::tile_behind_comp};
    }
    if (depth_only) {
        return masked ? Stages{shaders::small_depth_masked_comp, shaders::bin_depth_masked_comp,
                               shaders::tile_depth_masked_comp}
                      : Stages{shaders::small_depth_comp, shaders::bin_depth_comp, shaders::tile_depth_comp};
    }
    return masked ? Stages{shaders::small_masked_comp, shaders::bin_masked_comp, shaders::tile_masked_comp}
                  : Stages{shaders::small_ids_comp, shaders::bin_ids_comp, shaders::tile_ids_comp};
}

/// Creates counters for a batch; they must be cleared before use.
gpu::BufferId new_counters(gpu::Graph& graph, const gpu::Name& name)
{
    return graph.buffer(name + "/counters", {.size_bytes = (sizeof(shared::RasterCounters) + 15) / 16 * 16});
}

/// Clears the buffers `target` and `counters`, and updates their handles.
void add_clear_of_both(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId& target,
                       gpu::BufferId& counters)
{
    const auto quad_count = static_cast<uint32_t>(graph.describe(target).size_bytes / 16);
    auto pass = graph.compute(name + "/clear", shaders::clear_counted_comp);
    target = pass.write(target);
    counters = pass.write(counters);
    pass.push(quad_count).dispatch_items((quad_count + 255) / 256 * 64);
}

gpu::BufferId add_batch(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in, const Batch& batch,
                        const View& view, gpu::BufferId target, gpu::BufferId counters, bool depth_only)
{
    const uint32_t large_capacity = 2 * batch.triangle_count; // clipping splits a triangle into at most two
    const glm::uvec2 page_tiles = (view.size_px + shared::raster_tile_px - 1U) / shared::raster_tile_px;
    const auto tile_capacity = static_cast<uint32_t>(
        std::min(most_tiles, static_cast<uint64_t>(large_capacity) * page_tiles.x * page_tiles.y));
    const shared::RasterConstants constants{.clip_from_anchor = view.clip_from_anchor,
                                            .size_px = view.size_px,
                                            .first_triangle = batch.first_triangle,
                                            .triangle_count = batch.triangle_count,
                                            .large_capacity = large_capacity,
                                            .tile_capacity = tile_capacity,
                                            .cull_back_faces = view.cull_back_faces ? 1U : 0U,
                                            .small_area_px = view.tuning.small_area_px,
                                            .second = second_bits(view),
                                            .least_alpha = batch.least_alpha,
                                            .alpha_below = batch.alpha_below};
    const auto clusters = depth_only ? std::nullopt : add_seen_clusters(graph, name, batch, view, constants);
    const Stages shaders = stages(depth_only, batch.masked, view.behind.has_value());
    const gpu::Shader& small = clusters ? shaders::small_ids_listed_comp : shaders.small;
    gpu::BufferId large =
        graph.buffer(name + "/large", {.size_bytes = large_capacity * sizeof(shared::LargeTriangle)});
    gpu::BufferId tiles =
        graph.buffer(name + "/tiles", {.size_bytes = tile_capacity * sizeof(shared::TriangleTile)});
    const auto begin_stage = [&](const char* stage, const gpu::Shader& shader) {
        auto pass = graph.compute(name + "/" + stage, shader);
        pass.sample(in.triangles).sample(in.posed_vertices);
        const bool first = &shader == &small;
        counters = pass.modify(counters);
        large = first ? pass.write(large) : pass.modify(large);
        tiles = first ? pass.write(tiles) : pass.modify(tiles);
        target = pass.modify(target);
        if (batch.masked || view.behind) {
            bind_masks(pass, in);
        }
        pass.variant(mask_variant(in, batch, view) |
                     (first && view.tuning.threads_list_tiles ? shared::draw_lists_tiles : 0U));
        if (view.behind) {
            pass.sample(*view.behind, gpu::Format::rg32ui);
        }
        pass.push(constants);
        return pass;
    };
    if (clusters) {
        begin_stage("small", small).read(*clusters).dispatch_indirect(*clusters);
    } else {
        begin_stage("small", small).dispatch_items(batch.triangle_count);
    }
    begin_stage("bin", shaders.bin).dispatch(std::min(view.tuning.list_groups, large_capacity));
    begin_stage("tile", shaders.tile)
        .dispatch(std::max(view.tuning.list_groups, tile_capacity / most_tiles_a_group + 1));
    return target;
}

} // namespace

gpu::BufferId draw_by_compute(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                              std::span<const Batch> batches, const View& view, gpu::BufferId target,
                              bool depth_only)
{
    gpu::BufferId counters = new_counters(graph, name);
    add_clear_of_both(graph, name, target, counters);
    bool is_first = true;
    for (const Batch& batch : batches) {
        if (batch.triangle_count == 0) {
            continue;
        }
        const gpu::Name of_batch = name + (batch.masked ? "/masked" : "");
        if (!std::exchange(is_first, false)) {
            counters = add_clear(graph, of_batch + "/counters", new_counters(graph, of_batch));
        }
        target = add_batch(graph, of_batch, in, batch, view, target, counters, depth_only);
    }
    return target;
}

namespace {

/// The images into which the hardware path draws all batches, one after another.
struct Attachments {
    gpu::ImageId words; ///< numbers of triangles; not used if only depth is wanted
    gpu::ImageId depth;
};

gpu::Pass begin_draw(gpu::Graph& graph, const gpu::Name& name, bool masked, bool depth_only, bool tests_sides,
                     bool behind)
{
    if (behind) {
        return graph.raster(name, shaders::corner_vert, shaders::draw_behind_frag);
    }
    if (depth_only && !masked) {
        return tests_sides ? graph.raster(name, shaders::corner_vert, shaders::draw_depth_frag)
                           : graph.raster(name, shaders::corner_vert);
    }
    if (depth_only) {
        return graph.raster(name, shaders::corner_vert, shaders::draw_depth_masked_frag);
    }
    return graph.raster(name, shaders::corner_vert,
                        masked ? shaders::draw_masked_frag : shaders::draw_ids_frag);
}

/// Projection of the picture that is drawn. In depth peeling at half resolution, the pixel at the index i has
/// the centre of the full picture's pixel 2 i + second_from.
glm::mat4 drawn_clip(const View& view)
{
    if (!view.second_from) {
        return view.clip_from_anchor;
    }
    const glm::dvec2 size_px(view.size_px);
    const glm::dvec2 drawn_px(view.drawn_px());
    const glm::dvec2 scale = 0.5 * size_px / drawn_px;
    const glm::dvec2 offset = (0.5 * size_px + 0.5 - glm::dvec2(*view.second_from)) / drawn_px - 1.0;
    glm::dmat4 drawn_from_whole(1.0);
    drawn_from_whole[0][0] = scale.x;
    drawn_from_whole[1][1] = scale.y;
    drawn_from_whole[3][0] = offset.x;
    drawn_from_whole[3][1] = offset.y;
    return {drawn_from_whole * glm::dmat4(view.clip_from_anchor)};
}

shared::DrawConstants constants_of(const Batch& batch, const View& view)
{
    return {.clip_from_anchor = drawn_clip(view),
            .size_px = view.drawn_px(),
            .first_triangle = batch.first_triangle,
            .triangle_count = batch.triangle_count,
            .peeled_width_px = view.size_px.x,
            .second = second_bits(view),
            .least_alpha = batch.least_alpha,
            .alpha_below = batch.alpha_below};
}

/// The triangles of a batch that remain after culling, because they may be visible.
struct Culled {
    gpu::BufferId listed;
    gpu::BufferId arguments;
};

Culled add_cull(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in, const Batch& batch,
                const View& view)
{
    const uint32_t words = (batch.triangle_count + 31) / 32;
    const bool leaves_out = view.seen_clusters && !view.behind;
    auto asking = graph.compute(name + "/cull", leaves_out ? shaders::cull_triangles_seen_comp
                                                           : shaders::cull_triangles_comp);
    asking.sample(in.triangles).sample(in.posed_vertices);
    const gpu::BufferId kept =
        asking.write(graph.buffer(name + "/kept", {.size_bytes = uint64_t{words} * sizeof(uint32_t)}));
    if (leaves_out) {
        asking.read(*view.seen_clusters);
    }
    asking.variant(view.cull_back_faces ? shared::cull_drops_backs : 0U);
    asking.push(constants_of(batch, view)).dispatch_items(words);

    auto listing = graph.compute(name + "/list", shaders::cull_list_comp);
    listing.read(kept);
    const gpu::BufferId listed = listing.write(
        graph.buffer(name + "/listed", {.size_bytes = uint64_t{batch.triangle_count} * sizeof(uint32_t)}));
    const gpu::BufferId arguments =
        listing.write(graph.buffer(name + "/arguments", {.size_bytes = 4 * sizeof(uint32_t)}));
    listing.push(constants_of(batch, view)).dispatch(1);
    return {listed, arguments};
}

/// Begins a hardware draw from a list of triangles.
gpu::Pass begin_listed_draw(gpu::Graph& graph, const gpu::Name& name, bool depth_only, bool tests_sides,
                            bool behind)
{
    if (behind) {
        return graph.raster(name, shaders::corner_listed_behind_vert, shaders::draw_behind_frag);
    }
    if (depth_only && !tests_sides) {
        return graph.raster(name, shaders::corner_listed_vert);
    }
    return graph.raster(name, shaders::corner_listed_vert,
                        depth_only ? shaders::draw_depth_frag : shaders::draw_ids_frag);
}

/// Culls a batch of many triangles without masks, and draws the remaining triangles from a list.
void add_culled_batch(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in, const Batch& batch,
                      const View& view, bool depth_only, Attachments& to)
{
    const Culled culled = add_cull(graph, name, in, batch, view);
    const bool tests_sides = view.cull_back_faces && !batch.plain;
    auto pass = begin_listed_draw(graph, name, depth_only, tests_sides, view.behind.has_value());
    pass.sample(in.triangles).sample(in.posed_vertices);
    if (view.behind) {
        bind_masks(pass, in);
        pass.sample(*view.behind, gpu::Format::rg32ui);
    }
    pass.sample(culled.listed, gpu::Format::r32ui);
    if (!depth_only) {
        to.words = pass.color(to.words);
    }
    to.depth = pass.depth(to.depth);
    if (view.cull_back_faces && !tests_sides) {
        pass.cull_back_faces();
    }
    pass.variant(mask_variant(in, batch, view) | (tests_sides ? shared::draw_tests_sides : 0U));
    pass.push(constants_of(batch, view)).draw_indirect(culled.arguments);
}

void add_whole_batch(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in, const Batch& batch,
                     const View& view, bool depth_only, Attachments& to)
{
    const bool tests_sides = view.cull_back_faces && !batch.plain;
    auto pass = begin_draw(graph, name, batch.masked, depth_only, tests_sides, view.behind.has_value());
    pass.sample(in.triangles).sample(in.posed_vertices);
    if (batch.masked || view.behind) {
        bind_masks(pass, in);
    }
    if (view.behind) {
        pass.sample(*view.behind, gpu::Format::rg32ui);
    }
    if (!depth_only) {
        to.words = pass.color(to.words);
    }
    to.depth = pass.depth(to.depth);
    if (view.cull_back_faces && !tests_sides) {
        pass.cull_back_faces();
    }
    pass.variant(mask_variant(in, batch, view) | (tests_sides ? shared::draw_tests_sides : 0U));
    pass.push(constants_of(batch, view)).draw(3 * batch.triangle_count);
}

/// Copies rectangles of an image, row by row, into a buffer with rows of `row_texels`.
gpu::BufferId add_copy(gpu::Graph& graph, const gpu::Name& name, gpu::ImageId from, VkImageAspectFlags aspect,
                       std::span<const DepthPart> parts, uint32_t row_texels, gpu::BufferId target)
{
    const auto region_of = [&](const DepthPart& part) {
        return VkBufferImageCopy{
            .bufferOffset = sizeof(uint32_t) * uint64_t{part.first_texel},
            .bufferRowLength = row_texels,
            .imageSubresource = {aspect, 0, 0, 1},
            .imageOffset = {static_cast<int32_t>(part.from_px.x), static_cast<int32_t>(part.from_px.y), 0},
            .imageExtent = {part.size_px.x, part.size_px.y, 1}};
    };
    const auto record = [](gpu::Recorder& recorder, gpu::ImageId image, gpu::BufferId buffer,
                           std::span<const VkBufferImageCopy> regions) {
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(image).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, recorder.buffer(buffer).handle(),
                               static_cast<uint32_t>(regions.size()), regions.data());
    };
    auto copy = graph.custom(name + "/copy");
    copy.touch(from, gpu::Access::transfer_read);
    const gpu::BufferId to = copy.touch_write(target, gpu::Access::transfer_write);
    if (parts.size() == 1) { // the usual case; needs no list of parts and allocates no memory
        copy.execute([from, to, record, region = region_of(parts.front())](gpu::Recorder& recorder) {
            record(recorder, from, to, {&region, 1});
        });
        return to;
    }
    std::vector<VkBufferImageCopy> regions;
    std::ranges::transform(parts, std::back_inserter(regions), region_of);
    copy.execute(
        [from, to, record, regions](gpu::Recorder& recorder) { record(recorder, from, to, regions); });
    return to;
}

Attachments draw_batches(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                         std::span<const Batch> batches, const View& view, bool depth_only)
{
    const auto image = [&](const char* part, gpu::Format format) {
        const glm::uvec2 drawn_px = view.drawn_px();
        return graph.image(name + part, {.width = drawn_px.x, .height = drawn_px.y, .format = format});
    };
    Attachments to{image("/words", gpu::Format::rg32ui), image("/depth", gpu::Format::depth32f)};
    for (const Batch& batch : batches) {
        if (batch.triangle_count >= view.tuning.culled_from && !batch.masked) {
            add_culled_batch(graph, name + "/draw", in, batch, view, depth_only, to);
        } else if (batch.triangle_count > 0) {
            add_whole_batch(graph, name + (batch.masked ? "/masked/draw" : "/draw"), in, batch, view,
                            depth_only, to);
        }
    }
    return to;
}

} // namespace

gpu::BufferId draw_by_hardware(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                               std::span<const Batch> batches, const View& view, gpu::BufferId target,
                               bool depth_only)
{
    const Attachments drawn = draw_batches(graph, name, in, batches, view, depth_only);
    const DepthPart whole{.size_px = view.drawn_px()};
    return add_copy(graph, name, depth_only ? drawn.depth : drawn.words,
                    depth_only ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT, {&whole, 1},
                    whole.size_px.x, target);
}

gpu::BufferId draw_parts_by_hardware(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                     std::span<const Batch> batches, const View& view,
                                     const std::vector<DepthPart>& parts, uint32_t row_texels,
                                     gpu::BufferId map)
{
    const Attachments drawn = draw_batches(graph, name, in, batches, view, true);
    return add_copy(graph, name, drawn.depth, VK_IMAGE_ASPECT_DEPTH_BIT, parts, row_texels, map);
}

namespace {

constexpr glm::uvec2 page_px(1280, 720);
constexpr uint32_t quads_across = 128;
constexpr double worthwhile = 0.8;
constexpr int rounds = 3;

struct Mesh {
    std::vector<shared::PosedVertex> vertices;
    std::vector<glm::uvec4> triangles;
};

/// Adds a wavy sheet over the whole page to the test scene, in clip space.
void add_sheet(Mesh& mesh, float depth, bool faces_the_eye)
{
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    constexpr uint32_t row = quads_across + 1;
    for (uint32_t y = 0; y < row; ++y) {
        for (uint32_t x = 0; x < row; ++x) {
            const glm::vec2 place = 2.0F * glm::vec2(x, y) / static_cast<float>(quads_across) - 1.0F;
            const float wave = std::sin(9.0F * place.x) * std::sin(7.0F * place.y);
            mesh.vertices.push_back({.position = {place, depth + 0.05F * wave}});
        }
    }
    for (uint32_t y = 0; y < quads_across; ++y) {
        for (uint32_t x = 0; x < quads_across; ++x) {
            const uint32_t a = first + y * row + x;
            const uint32_t b = faces_the_eye ? a + row : a + 1;
            const uint32_t c = faces_the_eye ? a + 1 : a + row;
            mesh.triangles.emplace_back(a, b, c, 0U);
            mesh.triangles.emplace_back(b, a + row + 1, c, 0U);
        }
    }
}

double total_ms(const std::vector<PassTiming>& timings)
{
    double sum = 0.0;
    for (const PassTiming& pass : timings) {
        sum += pass.gpu_ms;
    }
    return sum;
}

} // namespace

RasterPath measure_paths(gpu::Device& device, gpu::Executor& executor)
{
    Mesh mesh; // test scene: the front side of a body, and its back side behind it
    add_sheet(mesh, 0.7F, true);
    add_sheet(mesh, 0.3F, false);
    gpu::Buffer vertices = gpu::upload_buffer(device, "measured vertices", mesh.vertices);
    gpu::Buffer triangles = gpu::upload_buffer(device, "measured triangles", mesh.triangles);
    const auto draw_ms = [&](RasterPath path) {
        gpu::Graph graph;
        const RasterInputs in = unmasked_inputs(graph, gpu::import_whole(graph, "triangles", triangles),
                                                gpu::import_whole(graph, "vertices", vertices));
        const Batch batch{.triangle_count = static_cast<uint32_t>(mesh.triangles.size()), .plain = true};
        graph.export_buffer(
            add_visibility(graph, "measured", in, {&batch, 1}, {.size_px = page_px, .path = path}));
        executor.run(graph);
        return total_ms(executor.timings());
    };
    double hardware_ms = std::numeric_limits<double>::max();
    double compute_ms = std::numeric_limits<double>::max();
    for (int round = 0; round <= rounds; ++round) {
        const double hardware_now_ms = draw_ms(RasterPath::hardware);
        const double compute_now_ms = draw_ms(RasterPath::compute);
        if (round > 0) { // the first round is a warm-up and is not measured
            hardware_ms = std::min(hardware_ms, hardware_now_ms);
            compute_ms = std::min(compute_ms, compute_now_ms);
        }
    }
    return hardware_ms < worthwhile * compute_ms ? RasterPath::hardware : RasterPath::compute;
}

std::optional<RasterPath> settled_path(const DeviceInfo& device, RasterPath wanted)
{
    if (wanted == RasterPath::compute && !device.compute_raster) {
        throw Error(device.name + " cannot draw triangles in compute: it lacks 64-bit buffer atomics",
                    "raster", "use hardware or auto");
    }
    if (wanted != RasterPath::automatic) {
        return wanted;
    }
    return device.software || !device.compute_raster ? std::optional(RasterPath::hardware) : std::nullopt;
}

Paths paths_of(const DeviceInfo& device, RasterPath wanted, RasterPath chosen, const PageWork& work)
{
    Paths paths{.page = chosen, .maps = chosen};
    const bool is_free = device.software && device.compute_raster && wanted == RasterPath::automatic;
    if (is_free && !work.has_masks && 8 * work.triangles >= work.pixels) {
        paths.page = RasterPath::compute;
    }
    return paths;
}

RasterPath choose_path(gpu::Device& device, gpu::Executor& executor, RasterPath wanted)
{
    const auto settled = settled_path(device.info(), wanted);
    return settled ? *settled : measure_paths(device, executor);
}

} // namespace estampe::raster

namespace estampe {

const char* name_of(RasterPath path)
{
    switch (path) {
    case RasterPath::automatic:
        return "auto";
    case RasterPath::hardware:
        return "hardware";
    case RasterPath::compute:
        return "compute";
    }
    return "";
}

} // namespace estampe
