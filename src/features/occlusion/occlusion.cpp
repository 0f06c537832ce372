// SPDX-License-Identifier: MIT
#include "features/occlusion/occlusion.hpp"

#include <vector>

#include <glm/gtc/packing.hpp>

namespace estampe::features {
namespace {

/// Linear colour of each posed vertex: the vertex's own colour times the mean colour of its material.
std::vector<glm::vec3> colors_of_vertices(const pose::MeshData& layout,
                                          const surface::MaterialBuffers& materials)
{
    std::vector<glm::vec3> colors(layout.stroke_coordinates.size(), glm::vec3(1.0F));
    for (const shared::DrawRecord& draw : layout.draws) {
        const glm::vec3 mean = materials.records[draw.material].mean_color;
        for (uint32_t i = 0; i < draw.vertex_count; ++i) {
            const glm::vec4 own = glm::unpackUnorm4x8(layout.rest_vertices[draw.first_rest_vertex + i].color);
            // The mean colour is stored as a square root, so it is squared here.
            colors[draw.first_posed_vertex + i] = mean * glm::vec3(own * own);
        }
    }
    return colors;
}

/// Collects all surfaces that can occlude others: all surfaces except blank ground and terrain.
occlusion::OccluderMesh occluders_of(const pose::MeshData& layout, const surface::MaterialBuffers& materials)
{
    occlusion::OccluderMesh occluders{.places = layout.stroke_coordinates,
                                      .unit_m = static_cast<float>(layout.stroke_unit_m),
                                      .triangles = {},
                                      .color_of_vertex = colors_of_vertices(layout, materials)};
    for (const uint32_t triangle : pose::solid_triangles(layout)) {
        occluders.triangles.push_back(layout.triangles[triangle]);
    }
    return occluders;
}

} // namespace

void Occlusion::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::layout_replaced) {
        memory_.forget_surfaces();
    }
    if (event == Event::pose_changed) {
        memory_.forget_pose();
    }
}

void Occlusion::prepare(gpu::Device& device, const pose::MeshData& layout,
                        const surface::MaterialBuffers& materials, const occlusion::OcclusionStyle& style)
{
    if (memory_.lacks_surfaces(style)) {
        memory_.set_surfaces(device, occluders_of(layout, materials));
    }
    memory_.ensure(device, style);
}

std::optional<occlusion::AmbientOcclusion> Occlusion::record(gpu::Graph& graph,
                                                             const occlusion::OcclusionInputs& in,
                                                             const occlusion::OcclusionStyle& style)
{
    return occlusion::add_occlusion(graph, memory_, in, style);
}

} // namespace estampe::features
