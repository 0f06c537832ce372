// SPDX-License-Identifier: MIT
#include "techniques/raster/views/views.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "gpu/graph/execute.hpp"
#include "shaders/bin_views_comp.hpp"
#include "shaders/bin_views_masked_comp.hpp"
#include "shaders/clear_view_tiles_comp.hpp"
#include "shaders/clear_views_comp.hpp"
#include "shaders/corner_views_vert.hpp"
#include "shaders/cull_views_comp.hpp"
#include "shaders/draw_views_masked_frag.hpp"
#include "shaders/merge_views_comp.hpp"
#include "shaders/small_views_comp.hpp"
#include "shaders/small_views_masked_comp.hpp"
#include "shaders/tile_views_comp.hpp"
#include "shaders/tile_views_masked_comp.hpp"
#include "techniques/raster/paths.hpp"

namespace estampe::raster {
namespace {

constexpr uint64_t most_large = 1ULL << 19U;
/// Most tiles in the list of large triangles' tiles. All clipmap levels of a sun together need more tiles
/// than a page. Single threads draw tiles that do not fit into the list.
constexpr uint64_t most_tiles_of_views = 1ULL << 20U;
constexpr uint32_t most_pixels_a_thread = 32768;
// Most pairs of cluster and view in the list of one batch.
constexpr uint64_t most_pairs = 1ULL << 22U;

uint32_t largest_side(const DepthViews& views)
{
    return std::ranges::max(views.list, {}, &shared::RasterView::size_px).size_px;
}

gpu::BufferId clear_views(gpu::Graph& graph, const gpu::Name& name, const DepthViews& views,
                          gpu::BufferId target)
{
    if (views.tiles) {
        auto pass = graph.compute(name + "/clear", shaders::clear_view_tiles_comp);
        pass.read(views.records).read(views.tiles->list);
        target = pass.modify(target);
        pass.dispatch(views.tiles->count);
        return target;
    }
    const uint32_t side = largest_side(views);
    auto pass = graph.compute(name + "/clear", shaders::clear_views_comp);
    pass.read(views.records);
    target = pass.modify(target);
    pass.dispatch((side * side / 4 + 255) / 256, static_cast<uint32_t>(views.list.size()));
    return target;
}

shared::ViewsConstants constants_of(const Batch& batch, const DepthViews& views)
{
    const auto count = static_cast<uint32_t>(views.list.size());
    const uint64_t side_tiles = (largest_side(views) + shared::raster_tile_px - 1U) / shared::raster_tile_px;
    const uint64_t large = std::min<uint64_t>(most_large, 2ULL * batch.triangle_count * count);
    return {.first_triangle = batch.first_triangle,
            .triangle_count = batch.triangle_count,
            .first_view = 0,
            .view_count = count,
            .large_capacity = static_cast<uint32_t>(large),
            .tile_capacity =
                static_cast<uint32_t>(std::min(most_tiles_of_views, large * side_tiles * side_tiles)),
            .small_area_px = std::min(views.tuning.small_area_px, most_pixels_a_thread / count),
            .groups = batch.groups,
            .image_px = glm::uvec2(0)};
}

gpu::BufferId compute_batch(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                            const Batch& batch, const DepthViews& views, gpu::BufferId target)
{
    const shared::ViewsConstants constants = constants_of(batch, views);
    gpu::BufferId counters =
        add_clear(graph, name + "/counters", graph.buffer(name + "/counters", {.size_bytes = 16}));
    gpu::BufferId large = graph.buffer(
        name + "/large", {.size_bytes = constants.large_capacity * sizeof(shared::LargeTriangle)});
    gpu::BufferId tiles =
        graph.buffer(name + "/tiles", {.size_bytes = constants.tile_capacity * sizeof(shared::TriangleTile)});
    const auto begin_stage = [&](const char* stage, const gpu::Shader& shader, bool first) {
        auto pass = graph.compute(name + "/" + stage, shader);
        pass.sample(in.triangles).sample(in.posed_vertices);
        counters = pass.modify(counters);
        large = first ? pass.write(large) : pass.modify(large);
        tiles = first ? pass.write(tiles) : pass.modify(tiles);
        target = pass.modify(target);
        pass.read(views.records).read(views.bounds);
        if (batch.masked) {
            bind_masks(pass, in);
        }
        pass.variant((batch.masked ? in.texture_classes : 0U) |
                     (first && views.tuning.threads_list_tiles ? shared::draw_lists_tiles : 0U));
        pass.push(constants);
        return pass;
    };
    begin_stage("small", batch.masked ? shaders::small_views_masked_comp : shaders::small_views_comp, true)
        .dispatch_items(cluster_count(batch) * shared::cluster_triangles);
    begin_stage("bin", batch.masked ? shaders::bin_views_masked_comp : shaders::bin_views_comp, false)
        .dispatch(std::min(views.tuning.list_groups, constants.large_capacity));
    begin_stage("tile", batch.masked ? shaders::tile_views_masked_comp : shaders::tile_views_comp, false)
        .dispatch(std::max(views.tuning.list_groups, constants.tile_capacity / most_tiles_a_group + 1));
    return target;
}

/// Lists the clusters of a batch that the views of `constants` may show, and draws them with the hardware
/// path.
gpu::ImageId hardware_batch(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                            const Batch& batch, const DepthViews& views,
                            const shared::ViewsConstants& constants, gpu::ImageId depth)
{
    gpu::BufferId arguments =
        add_clear(graph, name + "/count", graph.buffer(name + "/count", {.size_bytes = 16}));
    gpu::BufferId list =
        graph.buffer(name + "/list", {.size_bytes = sizeof(shared::ClusterInView) * cluster_count(batch) *
                                                    uint64_t{constants.view_count}});
    auto cull = graph.compute(name + "/cull", shaders::cull_views_comp);
    cull.read(views.records).read(views.bounds);
    list = cull.write(list);
    arguments = cull.modify(arguments);
    cull.push(constants).dispatch_items(cluster_count(batch));

    auto pass = batch.masked ? graph.raster(name + "/draw", shaders::corner_views_vert,
                                            shaders::draw_views_masked_frag)
                             : graph.raster(name + "/draw", shaders::corner_views_vert);
    pass.sample(in.triangles).sample(in.posed_vertices).read(views.records).read(list);
    if (batch.masked) {
        bind_masks(pass, in);
        pass.variant(in.texture_classes);
    }
    depth = pass.depth(depth);
    pass.push(constants).draw_indirect(arguments);
    return depth;
}

/// Copies each view from its square of the hardware path's image to its texels in the buffer.
auto copy_views(gpu::ImageId from, gpu::BufferId to, const std::vector<shared::RasterView>& views)
{
    std::vector<VkBufferImageCopy> regions;
    regions.reserve(views.size());
    for (const shared::RasterView& view : views) {
        regions.push_back({.bufferOffset = sizeof(uint32_t) * uint64_t{view.first_texel},
                           .imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1},
                           .imageOffset = {static_cast<int32_t>(view.origin_px.x),
                                           static_cast<int32_t>(view.origin_px.y), 0},
                           .imageExtent = {view.size_px, view.size_px, 1}});
    }
    return [from, to, regions](gpu::Recorder& recorder) {
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(from).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, recorder.buffer(to).handle(),
                               static_cast<uint32_t>(regions.size()), regions.data());
    };
}

gpu::BufferId draw_views_by_hardware(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                     std::span<const Batch> batches, const DepthViews& views,
                                     gpu::BufferId target)
{
    glm::uvec2 image_px(1);
    for (const shared::RasterView& view : views.list) {
        image_px = glm::max(image_px, view.origin_px + view.size_px);
    }
    gpu::ImageId depth = graph.image(
        name + "/depth", {.width = image_px.x, .height = image_px.y, .format = gpu::Format::depth32f});
    for (const Batch& batch : batches) {
        const uint64_t most_views = std::max<uint64_t>(most_pairs / cluster_count(batch), 1);
        shared::ViewsConstants constants = constants_of(batch, views);
        constants.image_px = image_px;
        for (uint32_t first = 0; first < views.list.size(); first += constants.view_count) {
            constants.first_view = first;
            constants.view_count =
                static_cast<uint32_t>(std::min<uint64_t>(most_views, views.list.size() - first));
            depth = hardware_batch(graph, name + (batch.masked ? "/masked" : ""), in, batch, views, constants,
                                   depth);
        }
    }
    auto copy = graph.custom(name + "/copy");
    copy.touch(depth, gpu::Access::transfer_read);
    const gpu::BufferId copied = copy.touch_write(target, gpu::Access::transfer_write);
    copy.execute(copy_views(depth, copied, views.list));
    return copied;
}

} // namespace

void place_views(std::vector<shared::RasterView>& views)
{
    std::vector<size_t> order(views.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, [&](size_t a, size_t b) { return views[a].size_px > views[b].size_px; });
    double area_px = 1.0;
    for (const shared::RasterView& view : views) {
        area_px += static_cast<double>(view.size_px) * view.size_px;
    }
    const auto width = std::bit_ceil(static_cast<uint32_t>(std::sqrt(area_px)));
    // Places the views' squares in rows, largest first, so that each row is as high as its first square.
    glm::uvec2 at(0);
    uint32_t row_height = 0;
    for (const size_t index : order) {
        shared::RasterView& view = views[index];
        if (at.x > 0 && at.x + view.size_px > width) {
            at = {0, at.y + row_height};
            row_height = 0;
        }
        view.origin_px = at;
        at.x += view.size_px;
        row_height = std::max(row_height, view.size_px);
    }
}

gpu::BufferId add_depth_views(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                              std::span<const Batch> batches, const DepthViews& views, gpu::BufferId target)
{
    if (views.list.empty()) {
        return target;
    }
    std::vector<Batch> drawn(batches.begin(), batches.end());
    std::erase_if(drawn, [](const Batch& batch) { return batch.triangle_count == 0; });
    if (views.path == RasterPath::hardware && !drawn.empty()) {
        return draw_views_by_hardware(graph, name, in, drawn, views, target);
    }
    target = clear_views(graph, name, views, target);
    for (const Batch& batch : drawn) {
        target = compute_batch(graph, name + (batch.masked ? "/masked" : ""), in, batch, views, target);
    }
    return target;
}

gpu::BufferId add_merged_views(gpu::Graph& graph, const gpu::Name& name, const DepthViews& views,
                               gpu::BufferId source, gpu::BufferId target)
{
    const uint32_t side = largest_side(views);
    auto pass = graph.compute(name, shaders::merge_views_comp);
    pass.read(views.records).read(source);
    target = pass.modify(target);
    pass.dispatch((side * side / 4 + 63) / 64, static_cast<uint32_t>(views.list.size()));
    return target;
}

} // namespace estampe::raster
