// SPDX-License-Identifier: MIT
// Bodies as their front and their back are seen.
#include <algorithm>

#include "gpu/fills.hpp"
#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/cloth_see_comp.hpp"
#include "shaders/cloth_seen_comp.hpp"
#include "techniques/cloth/cloth.hpp"

namespace estampe::cloth {

void Cloths::set_bodies(gpu::Device& device, std::span<const Body> bodies)
{
    std::vector<glm::uvec4> triangles;
    uint32_t texel_count = 0;
    bodies_.clear();
    for (const Body& body : bodies) {
        bodies_.push_back({.first_triangle = static_cast<uint32_t>(triangles.size()),
                           .triangle_count = static_cast<uint32_t>(body.triangles.size()),
                           .nodes = body.nodes,
                           .first = texel_count});
        for (const glm::uvec3& triangle : body.triangles) {
            triangles.emplace_back(triangle, 0U);
        }
        texel_count += shared::cloth_seen_head + body.nodes.x * body.nodes.y;
    }
    triangles.resize(std::max<size_t>(triangles.size(), 1));
    body_triangles_ = gpu::upload_buffer(device, "cloth body triangles", triangles);
    for (gpu::Buffer& seen : seen_) {
        seen = gpu::upload_buffer(device, "cloth seen", std::vector<glm::vec4>(std::max(texel_count, 1U)));
    }
    has_seen_ = false;
    bodies_move_ = false;
}

void Cloths::add_bodies(gpu::Graph& graph, Handles& handles, gpu::BufferId posed_vertices)
{
    std::swap(seen_[0], seen_[1]);
    bodies_move_ = has_seen_;
    has_seen_ = true;
    const gpu::BufferId triangles = gpu::import_whole(graph, "cloth/body triangles", body_triangles_);
    for (shared::ClothBody body : bodies_) {
        const auto solid = std::ranges::find_if(solids_, [&](const shared::ClothCollider& other) {
            return other.kind == (shared::cloth_seen | body.first << shared::cloth_kind_bits);
        });
        if (solid == solids_.end()) {
            continue;
        }
        body.rotation = solid->rotation;
        body.centre_m = solid->centre_m;
        body.half_m = solid->half_m;
        const uint32_t node_count = body.nodes.x * body.nodes.y;
        gpu::BufferId ends = gpu::add_zeros(graph, "cloth/ends", 2 * sizeof(uint32_t) * node_count);
        auto see = graph.compute("cloth/see", shaders::cloth_see_comp);
        see.sample(triangles).read(posed_vertices);
        ends = see.modify(ends);
        see.push(body).dispatch_items(body.triangle_count);
        auto keep = graph.compute("cloth/seen", shaders::cloth_seen_comp);
        keep.read(ends);
        handles.seen[1] = keep.modify(handles.seen[1]);
        keep.push(body).dispatch_items(node_count);
    }
    graph.export_buffer(handles.seen[1]);
}

} // namespace estampe::cloth
