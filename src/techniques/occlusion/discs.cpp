// SPDX-License-Identifier: MIT
#include "techniques/occlusion/discs.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/disc_gather_comp.hpp"
#include "shaders/disc_leaves_comp.hpp"
#include "shaders/disc_nodes_comp.hpp"
#include "shaders/disc_page_comp.hpp"

namespace estampe::occlusion {
namespace {

/// Puts what lies together one after another: halves along the longest side, at whole nodes of the tree.
void sort_by_place(std::span<uint32_t> vertices, std::span<const glm::vec3> places)
{
    if (vertices.size() <= shared::disc_children) {
        return;
    }
    glm::vec3 least(places[vertices.front()]);
    glm::vec3 most = least;
    for (const uint32_t vertex : vertices) {
        least = glm::min(least, places[vertex]);
        most = glm::max(most, places[vertex]);
    }
    const glm::vec3 side = most - least;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    size_t node = shared::disc_children;
    while (node * shared::disc_children < vertices.size()) {
        node *= shared::disc_children;
    }
    const size_t half = (vertices.size() / node + 1) / 2 * node;
    const auto middle = vertices.begin() + static_cast<std::ptrdiff_t>(half);
    std::nth_element(vertices.begin(), middle, vertices.end(), [&](uint32_t a, uint32_t b) {
        return std::pair(places[a][axis], a) < std::pair(places[b][axis], b);
    });
    sort_by_place(vertices.first(half), places);
    sort_by_place(vertices.subspan(half), places);
}

shared::DiscConstants constants_of(uint32_t disc_count, float radius_m, float apart)
{
    shared::DiscConstants constants{.counts = {disc_count}, .level_count = 1};
    uint32_t count = disc_count;
    while (count > shared::disc_children && constants.level_count < shared::most_disc_levels) {
        count = (count + shared::disc_children - 1) / shared::disc_children;
        constants.counts[constants.level_count++] = count;
    }
    constants.radius_m = radius_m;
    constants.apart = apart;
    return constants;
}

} // namespace

DiscList list_discs(std::span<const glm::vec3> places, float unit_m, std::span<const glm::uvec4> triangles)
{
    std::vector<float> areas_m2(places.size(), 0.0F);
    for (const glm::uvec4& corners : triangles) {
        const glm::vec3 a = places[corners.x];
        const float third =
            unit_m * unit_m / 6.0F * glm::length(glm::cross(places[corners.y] - a, places[corners.z] - a));
        for (int corner = 0; corner < 3; ++corner) {
            areas_m2[corners[corner]] += third;
        }
    }
    DiscList list;
    for (uint32_t vertex = 0; vertex < places.size(); ++vertex) {
        if (areas_m2[vertex] > 0.0F) {
            list.vertices.push_back(vertex);
        }
    }
    sort_by_place(list.vertices, places);
    for (const uint32_t vertex : list.vertices) {
        list.areas_m2.push_back(areas_m2[vertex]);
    }
    return list;
}

DiscBuffers upload_discs(gpu::Device& device, const DiscList& list, uint32_t vertex_count)
{
    std::vector<glm::uvec2> words;
    for (size_t i = 0; i < list.vertices.size(); ++i) {
        words.emplace_back(list.vertices[i], std::bit_cast<uint32_t>(list.areas_m2[i]));
    }
    DiscBuffers buffers{.disc_count = static_cast<uint32_t>(words.size()), .vertex_count = vertex_count};
    if (!words.empty()) {
        buffers.vertices = gpu::upload_buffer(device, "discs", words);
        buffers.open = gpu::upload_buffer(device, "open of vertices", std::vector<float>(vertex_count, 1.0F));
    }
    return buffers;
}

gpu::BufferId add_discs(gpu::Graph& graph, DiscBuffers& buffers, gpu::BufferId posed_vertices, float radius_m,
                        float apart)
{
    const gpu::BufferId open = gpu::import_whole(graph, "open of vertices", buffers.open);
    if (buffers.is_found && buffers.radius_m == radius_m) {
        return open;
    }
    const gpu::BufferId vertices = gpu::import_whole(graph, "discs", buffers.vertices);
    shared::DiscConstants constants = constants_of(buffers.disc_count, radius_m, apart);
    const uint64_t node_count =
        std::accumulate(std::begin(constants.counts), std::end(constants.counts), 0ULL);
    auto leaves = graph.compute("occlusion/discs", shaders::disc_leaves_comp);
    leaves.sample(posed_vertices).read(vertices);
    gpu::BufferId discs =
        leaves.write(graph.buffer("occlusion/tree", {.size_bytes = sizeof(shared::Disc) * node_count}));
    leaves.push(constants).dispatch_items(constants.counts[0]);
    for (constants.level = 1; constants.level < constants.level_count; ++constants.level) {
        auto nodes = graph.compute("occlusion/nodes", shaders::disc_nodes_comp);
        discs = nodes.modify(discs);
        nodes.push(constants).dispatch_items(constants.counts[constants.level]);
    }
    auto gather = graph.compute("occlusion/gather", shaders::disc_gather_comp);
    gather.sample(posed_vertices).read(vertices).sample(discs, gpu::Format::rgba32f);
    const gpu::BufferId found = gather.modify(open);
    gather.push(constants).dispatch_items(constants.counts[0]);
    buffers.is_found = true;
    buffers.radius_m = radius_m;
    return found;
}

gpu::ImageId add_disc_page(gpu::Graph& graph, const DiscPageInputs& in, float strength)
{
    struct Constants {
        float strength;
        uint32_t vertex_count;
    };

    auto pass = graph.compute("occlusion/page", shaders::disc_page_comp);
    pass.uniform(in.frame).sample(in.visibility, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices).read(in.open);
    const gpu::ImageId page = pass.write(graph.image(
        "occlusion/open", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.push(Constants{strength, in.vertex_count}).dispatch_over(in.size_px.x, in.size_px.y);
    return page;
}

} // namespace estampe::occlusion
