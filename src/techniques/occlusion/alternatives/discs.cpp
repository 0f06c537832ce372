// SPDX-License-Identifier: MIT
// Sorts discs, combines them into a tree, and sums their occlusion at vertices, pixels or texels.
#include "techniques/occlusion/alternatives/discs.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "gpu/resources.hpp"
#include "shaders/disc_gather_comp.hpp"
#include "shaders/disc_leaves_comp.hpp"
#include "shaders/disc_map_gather_comp.hpp"
#include "shaders/disc_map_page_comp.hpp"
#include "shaders/disc_nodes_comp.hpp"
#include "shaders/disc_page_comp.hpp"
#include "shaders/disc_splats_comp.hpp"

namespace estampe::occlusion {
namespace {

/// Sorts vertices so that neighbours in space are neighbours in the list. Splits the list recursively along
/// the longest side of its bounding box, at multiples of whole tree nodes.
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

/// Shader constants: the levels of the tree of discs, and the settings of the style.
shared::DiscConstants constants_of(uint32_t disc_count, const DiscSettings& settings)
{
    shared::DiscConstants constants{.counts = {disc_count}, .level_count = 1};
    uint32_t count = disc_count;
    while (count > shared::disc_children && constants.level_count < shared::most_disc_levels) {
        count = (count + shared::disc_children - 1) / shared::disc_children;
        constants.counts[constants.level_count++] = count;
    }
    constants.radius_m = settings.radius_m;
    constants.apart = settings.apart;
    return constants;
}

/// Adds passes that place the discs at posed vertices, and build the tree level by level. Returns the tree.
gpu::BufferId add_disc_tree(gpu::Graph& graph, DiscBuffers& buffers, gpu::BufferId posed_vertices,
                            shared::DiscConstants constants)
{
    const uint64_t node_count =
        std::accumulate(std::begin(constants.counts), std::end(constants.counts), 0ULL);
    auto leaves = graph.compute("occlusion/discs", shaders::disc_leaves_comp);
    leaves.sample(posed_vertices).read(gpu::import_whole(graph, "discs", buffers.vertices));
    gpu::BufferId discs =
        leaves.write(graph.buffer("occlusion/tree", {.size_bytes = sizeof(shared::Disc) * node_count}));
    leaves.push(constants).dispatch_items(constants.counts[0]);
    for (constants.level = 1; constants.level < constants.level_count; ++constants.level) {
        auto nodes = graph.compute("occlusion/nodes", shaders::disc_nodes_comp);
        discs = nodes.modify(discs);
        nodes.push(constants).dispatch_items(constants.counts[constants.level]);
    }
    return discs;
}

/// Creates the output images of a pass over pixels, and sets its variant.
AmbientOcclusion write_page(gpu::Graph& graph, gpu::Pass& pass, glm::uvec2 size_px, bool bounces)
{
    const glm::uvec2 bounced_px = bounces ? size_px : glm::uvec2(1);
    const gpu::ImageId visibility = pass.write(graph.image(
        "occlusion/open", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f}));
    const gpu::ImageId bounced = pass.write(
        graph.image("occlusion/bounced",
                    {.width = bounced_px.x, .height = bounced_px.y, .format = gpu::Format::rgba16f}));
    pass.variant(bounces ? shared::discs_bounce : 0U);
    return {.visibility = visibility, .bounced = bounces ? std::optional(bounced) : std::nullopt};
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

void color_discs(DiscList& list, std::span<const glm::vec3> color_of_vertex)
{
    std::vector<float> areas_m2 = list.areas_m2;
    list.colors.clear();
    for (const uint32_t vertex : list.vertices) {
        list.colors.emplace_back(color_of_vertex[vertex], 1.0F);
    }
    const shared::DiscConstants constants = constants_of(static_cast<uint32_t>(list.vertices.size()), {});
    size_t below = 0;
    for (uint32_t level = 1; level < constants.level_count; ++level) {
        const size_t end = below + constants.counts[level - 1];
        for (; below < end; below += std::min<size_t>(shared::disc_children, end - below)) {
            glm::vec4 sum(0.0F);
            float area_m2 = 0.0F;
            for (size_t child = below; child < std::min<size_t>(below + shared::disc_children, end);
                 ++child) {
                sum += areas_m2[child] * list.colors[child];
                area_m2 += areas_m2[child];
            }
            list.colors.push_back(sum / area_m2);
            areas_m2.push_back(area_m2);
        }
    }
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
        buffers.visibility =
            gpu::upload_buffer(device, "open of vertices", std::vector<float>(vertex_count, 1.0F));
        const std::vector<glm::vec4> none(1, glm::vec4(0.0F));
        buffers.colors =
            gpu::upload_buffer(device, "colors of discs", list.colors.empty() ? none : list.colors);
        buffers.bounced = gpu::upload_buffer(
            device, "bounced on vertices",
            std::vector<glm::vec4>(list.colors.empty() ? 1 : vertex_count, glm::vec4(0.0F)));
    }
    return buffers;
}

VertexOcclusion add_discs(gpu::Graph& graph, DiscBuffers& buffers, gpu::BufferId posed_vertices,
                          const DiscSettings& settings)
{
    const gpu::BufferId visibility = gpu::import_whole(graph, "open of vertices", buffers.visibility);
    const gpu::BufferId bounced = gpu::import_whole(graph, "bounced on vertices", buffers.bounced);
    if (buffers.is_found && buffers.radius_m == settings.radius_m &&
        (buffers.has_bounced || !settings.bounces)) {
        return {.visibility = visibility,
                .bounced = settings.bounces ? std::optional(bounced) : std::nullopt};
    }
    const shared::DiscConstants constants = constants_of(buffers.disc_count, settings);
    const gpu::BufferId discs = add_disc_tree(graph, buffers, posed_vertices, constants);
    auto gather = graph.compute("occlusion/gather", shaders::disc_gather_comp);
    gather.sample(posed_vertices).read(gpu::import_whole(graph, "discs", buffers.vertices));
    gather.sample(discs, gpu::Format::rgba32f);
    gather.sample(gpu::import_whole(graph, "colors of discs", buffers.colors), gpu::Format::rgba32f);
    const gpu::BufferId found = gather.modify(visibility);
    const gpu::BufferId found_bounced = gather.modify(bounced);
    gather.variant(settings.bounces ? shared::discs_bounce : 0U);
    gather.push(constants).dispatch_items(constants.counts[0]);
    buffers.is_found = true;
    buffers.has_bounced = settings.bounces;
    buffers.radius_m = settings.radius_m;
    return {.visibility = found, .bounced = settings.bounces ? std::optional(found_bounced) : std::nullopt};
}

AmbientOcclusion add_disc_splats(gpu::Graph& graph, DiscBuffers& buffers, gpu::BufferId posed_vertices,
                                 const OcclusionInputs& in, const OcclusionStyle& style, float apart)
{
    const bool bounces = style.bleeding > 0.0F;
    shared::DiscConstants constants =
        constants_of(buffers.disc_count, {.radius_m = in.radius_m, .apart = apart, .bounces = bounces});
    constants.strength = style.strength;
    constants.bleeding = style.bleeding;
    const gpu::BufferId discs = add_disc_tree(graph, buffers, posed_vertices, constants);
    auto pass = graph.compute("occlusion/splats", shaders::disc_splats_comp);
    pass.uniform(in.frame).sample(in.depth).sample(in.normal).sample(discs, gpu::Format::rgba32f);
    pass.sample(gpu::import_whole(graph, "colors of discs", buffers.colors), gpu::Format::rgba32f);
    const AmbientOcclusion page = write_page(graph, pass, in.size_px, bounces);
    pass.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return page;
}

DiscMapBuffers make_disc_map(gpu::Device& device, uint32_t size)
{
    DiscMapBuffers map;
    map.found =
        gpu::Buffer(device, "open of texels", sizeof(glm::vec4) * size * size, gpu::MemoryUse::device);
    map.size = size;
    return map;
}

gpu::BufferId add_disc_map(gpu::Graph& graph, DiscBuffers& discs, DiscMapBuffers& map,
                           const DiscMapInputs& in, const DiscSettings& settings)
{
    const gpu::BufferId found = gpu::import_whole(graph, "open of texels", map.found);
    if (map.is_found && map.radius_m == settings.radius_m && (map.has_bounced || !settings.bounces)) {
        return found;
    }
    const shared::DiscConstants constants = constants_of(discs.disc_count, settings);
    const gpu::BufferId tree = add_disc_tree(graph, discs, in.posed_vertices, constants);
    auto gather = graph.compute("occlusion/texels", shaders::disc_map_gather_comp);
    gather.sample(in.map_texels).sample(in.triangles).sample(in.posed_vertices);
    gather.sample(tree, gpu::Format::rgba32f);
    gather.sample(gpu::import_whole(graph, "colors of discs", discs.colors), gpu::Format::rgba32f);
    const gpu::BufferId written = gather.write(found);
    gather.variant(settings.bounces ? shared::discs_bounce : 0U);
    gather.push(constants).dispatch_items(map.size * map.size);
    map.is_found = true;
    map.has_bounced = settings.bounces;
    map.radius_m = settings.radius_m;
    return written;
}

namespace {

/// Adds a pass that interpolates the results of add_discs() between the vertices of each pixel's triangle.
AmbientOcclusion add_vertex_page(gpu::Graph& graph, const OcclusionInputs& in, const PosedSurfaces& surfaces,
                                 const VertexOcclusion& found, uint32_t vertex_count,
                                 const OcclusionStyle& style)
{
    struct Constants {
        float strength;
        float bleeding;
        uint32_t vertex_count;
    };

    auto pass = graph.compute("occlusion/page", shaders::disc_page_comp);
    pass.uniform(in.frame).sample(surfaces.visibility, gpu::Format::rg32ui);
    pass.sample(surfaces.triangles).sample(surfaces.posed_vertices).read(found.visibility);
    pass.sample(found.bounced.value_or(surfaces.posed_vertices), gpu::Format::rgba32f);
    const AmbientOcclusion page = write_page(graph, pass, in.size_px, found.bounced.has_value());
    pass.push(Constants{style.strength, style.bleeding, vertex_count});
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return page;
}

/// Adds a pass that interpolates the results of add_disc_map() between texels.
AmbientOcclusion add_map_page(gpu::Graph& graph, const OcclusionInputs& in, const PosedSurfaces& surfaces,
                              gpu::BufferId found, bool bounces, const OcclusionStyle& style)
{
    struct Constants {
        float strength;
        float bleeding;
        int32_t size;
    };

    auto pass = graph.compute("occlusion/page", shaders::disc_map_page_comp);
    pass.uniform(in.frame).sample(surfaces.visibility, gpu::Format::rg32ui);
    pass.sample(surfaces.triangles).sample(surfaces.posed_vertices);
    pass.sample(surfaces.map->corners, gpu::Format::rg32ui).sample(found, gpu::Format::rgba32f);
    const AmbientOcclusion page = write_page(graph, pass, in.size_px, bounces);
    pass.push(Constants{style.strength, style.bleeding, static_cast<int32_t>(surfaces.map->size)});
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return page;
}

} // namespace

std::optional<AmbientOcclusion> add_disc_occlusion(gpu::Graph& graph, DiscBuffers& discs, DiscMapBuffers& map,
                                                   const OcclusionInputs& in, const OcclusionStyle& style)
{
    if (discs.empty()) {
        return std::nullopt;
    }
    const PosedSurfaces& surfaces = in.surfaces.value();
    if (style.method == Method::splats) {
        return add_disc_splats(graph, discs, surfaces.posed_vertices, in, style);
    }
    const DiscSettings settings{.radius_m = in.radius_m, .bounces = style.bleeding > 0.0F};
    if (style.method == Method::uv) {
        const gpu::BufferId found = add_disc_map(graph, discs, map,
                                                 {.map_texels = surfaces.map.value().texels,
                                                  .triangles = surfaces.triangles,
                                                  .posed_vertices = surfaces.posed_vertices},
                                                 settings);
        return add_map_page(graph, in, surfaces, found, settings.bounces, style);
    }
    const VertexOcclusion found = add_discs(graph, discs, surfaces.posed_vertices, settings);
    return add_vertex_page(graph, in, surfaces, found, discs.vertex_count, style);
}

} // namespace estampe::occlusion
