// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <span>

#include "gpu/graph/execute.hpp"
#include "shaders/corner_listed_behind_vert.hpp"
#include "shaders/corner_listed_vert.hpp"
#include "shaders/corner_vert.hpp"
#include "shaders/cull_list_comp.hpp"
#include "shaders/cull_triangles_comp.hpp"
#include "shaders/draw_behind_frag.hpp"
#include "shaders/draw_depth_frag.hpp"
#include "shaders/draw_depth_masked_frag.hpp"
#include "shaders/draw_ids_frag.hpp"
#include "shaders/draw_masked_frag.hpp"
#include "techniques/raster/passes.hpp"
#include "techniques/raster/raster.glsl.h"

namespace estampe::raster {
namespace {

/// What the batches draw into, one after another.
struct Attachments {
    gpu::ImageId words; ///< not drawn into when only depth is wanted
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

/// Clip space of the picture that is drawn: the middle of its pixel i is that of pixel 2 i + second_from.
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
            .second = second_bits(view)};
}

/// The triangles of a batch that may be seen.
struct Culled {
    gpu::BufferId listed;
    gpu::BufferId arguments;
};

Culled add_cull(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in, const Batch& batch,
                const View& view)
{
    const uint32_t words = (batch.triangle_count + 31) / 32;
    auto asking = graph.compute(name + "/cull", shaders::cull_triangles_comp);
    asking.sample(in.triangles).sample(in.posed_vertices);
    const gpu::BufferId kept =
        asking.write(graph.buffer(name + "/kept", {.size_bytes = uint64_t{words} * sizeof(uint32_t)}));
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

/// Draws from a list of triangles.
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

/// A batch of many triangles without masks: drawn from a list of those that may be seen.
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

void add_batch(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in, const Batch& batch,
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

/// Parts of an image, row by row, into a buffer of such rows.
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
    if (parts.size() == 1) { // as in every frame, without a list
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
            add_batch(graph, name + (batch.masked ? "/masked/draw" : "/draw"), in, batch, view, depth_only,
                      to);
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

} // namespace estampe::raster
