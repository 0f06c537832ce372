// SPDX-License-Identifier: MIT
#include "techniques/motion_blur/alternatives/within_outline.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "gpu/resources.hpp"
#include "shaders/blur_own_comp.hpp"
#include "shaders/scene.glsl.h"
#include "shaders/stretch_comp.hpp"
#include "techniques/motion_blur/alternatives/stretch.glsl.h"

namespace estampe::motion_blur {

MotionBlurLayers add_own_blur(gpu::Graph& graph, const MotionBlurInputs& in, gpu::ImageId page,
                              const shared::MotionBlurConstants& constants)
{
    auto pass = graph.compute("motion blur", shaders::blur_own_comp);
    pass.sample(in.wash).sample(in.hatch).sample(in.lines).sample(in.sky_ink).sample(page);
    const auto write = [&](const char* name, gpu::Format format) {
        return pass.write(
            graph.image(name, {.width = in.size_px.x, .height = in.size_px.y, .format = format}));
    };
    const gpu::ImageId wash = write("motion blur/wash", gpu::Format::rgba16f);
    const gpu::ImageId hatch = write("motion blur/hatch", gpu::Format::r16f);
    const gpu::ImageId lines = write("motion blur/lines", gpu::Format::rgba8);
    pass.variant(in.has_sky ? shared::blur_has_sky : 0U).push(constants);
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return {.wash = wash, .hatch = hatch, .lines = lines};
}

CoincidentList list_coincident(std::span<const glm::vec3> places, std::span<const uint32_t> draw_of_vertex)
{
    const auto key = [&](uint32_t vertex) {
        const glm::vec3 place = places[vertex];
        return std::tuple(draw_of_vertex[vertex], place.x, place.y, place.z);
    };
    CoincidentList list;
    list.members.resize(places.size());
    std::iota(list.members.begin(), list.members.end(), 0U);
    std::ranges::sort(list.members,
                      [&](uint32_t a, uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
    list.of_vertex.resize(places.size());
    for (size_t first = 0; first < list.members.size();) {
        size_t end = first + 1;
        while (end < list.members.size() && key(list.members[end]) == key(list.members[first])) {
            ++end;
        }
        for (size_t i = first; i < end; ++i) {
            list.of_vertex[list.members[i]] = {first, end - first};
        }
        first = end;
    }
    return list;
}

CoincidentVertices upload_coincident(gpu::Device& device, const CoincidentList& list)
{
    CoincidentVertices buffers{.vertex_count = static_cast<uint32_t>(list.members.size())};
    if (!list.members.empty()) {
        buffers.of_vertex = gpu::upload_buffer(device, "together", list.of_vertex);
        buffers.members = gpu::upload_buffer(device, "members", list.members);
    }
    return buffers;
}

VelocityShape add_stretch(gpu::Graph& graph, CoincidentVertices& together, const VelocityShapeInputs& in)
{
    const shared::StretchConstants constants{
        .now_from_before = in.now_from_before, .share = in.share, .vertex_count = together.vertex_count};
    const gpu::BufferDesc desc{.size_bytes = sizeof(shared::PosedVertex) * together.vertex_count};
    auto pass = graph.compute("motion blur/stretch", shaders::stretch_comp);
    pass.sample(in.posed_vertices).sample(in.posed_vertices_before);
    pass.read(gpu::import_whole(graph, "together", together.of_vertex));
    pass.read(gpu::import_whole(graph, "members", together.members));
    const gpu::BufferId vertices = pass.write(graph.buffer("motion blur/stretched", desc));
    const gpu::BufferId before = pass.write(graph.buffer("motion blur/stretched before", desc));
    pass.push(constants).dispatch_items(together.vertex_count);
    return {.vertices = vertices, .before = before};
}

} // namespace estampe::motion_blur
