// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <span>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/pose.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

Bounds transformed(const Bounds& local, const glm::dmat4& place)
{
    Bounds result;
    for (int i = 0; i < 8 && !local.empty(); ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? local.max.x : local.min.x,
                                (i & 2) != 0 ? local.max.y : local.min.y,
                                (i & 4) != 0 ? local.max.z : local.min.z);
        result.extend(glm::dvec3(place * glm::dvec4(corner, 1.0)));
    }
    return result;
}

/// A floor: flat, level, and nothing below it, so that its shadow can fall on nothing.
bool is_lowest_floor(const Bounds& draw, const Bounds& scene)
{
    const double extent =
        std::max({scene.max.x - scene.min.x, scene.max.y - scene.min.y, scene.max.z - scene.min.z});
    return draw.max.y - draw.min.y <= 1e-3 * extent && draw.max.y <= scene.min.y + 2e-3 * extent;
}

bool is_mirrored(const shared::DrawRecord& draw)
{
    return (draw.flags & shared::draw_mirrored) != 0;
}

void set_mirrored(shared::DrawRecord& draw, bool mirrored)
{
    draw.flags = (draw.flags & ~shared::draw_mirrored) | (mirrored ? shared::draw_mirrored : 0U);
}

} // namespace

bool PoseData::operator==(const PoseData& other) const
{
    return draws.size() == other.draws.size() && joints == other.joints &&
           morph_weights == other.morph_weights &&
           std::memcmp(draws.data(), other.draws.data(), draws.size() * sizeof(shared::DrawRecord)) == 0;
}

PoseData pose_meshes(const MeshData& meshes, const Scene& scene, const ScenePose& pose)
{
    PoseData data;
    data.draws = meshes.draws;
    const glm::dmat4 anchor_from_world = glm::translate(glm::dmat4(1.0), -meshes.anchor);
    bool has_deforming = false;
    std::vector<Bounds> draw_bounds;
    Bounds all;
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        const DrawSource& source = meshes.sources[i];
        const auto& instances = scene.nodes[source.node].instances;
        glm::dmat4 place = pose.world_from_node[source.node];
        if (!instances.empty()) {
            place = place * glm::dmat4(instances[source.instance]);
        }
        data.draws[i].anchor_from_object = glm::mat4(anchor_from_world * place);
        has_deforming |=
            data.draws[i].first_skin_vertex != shared::no_skin || data.draws[i].morph_target_count > 0;
        draw_bounds.push_back(transformed(source.local_bounds, place));
        if (!draw_bounds.back().empty()) {
            all.extend(draw_bounds.back().min);
            all.extend(draw_bounds.back().max);
        }
    }
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh == no_index) {
            continue;
        }
        for (const glm::mat4& world_from_bind : skin_matrices(scene, pose, node)) {
            data.joints.emplace_back(anchor_from_world * glm::dmat4(world_from_bind));
        }
        const auto& weights = pose.morph_weights[node];
        data.morph_weights.insert(data.morph_weights.end(), weights.begin(), weights.end());
    }
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        shared::DrawRecord& draw = data.draws[i];
        const bool is_skinned = draw.first_skin_vertex != shared::no_skin;
        const glm::mat3 linear(is_skinned ? data.joints[draw.first_joint] : draw.anchor_from_object);
        set_mirrored(draw, glm::determinant(glm::dmat3(linear)) < 0.0);
    }
    if (has_deforming) {
        data.casters = scene_bounds(scene, pose);
        return data;
    }
    for (size_t i = 0; i < draw_bounds.size(); ++i) {
        const Bounds& bounds = draw_bounds[i];
        const bool see_through = scene.materials[meshes.draws[i].material].alpha_mode == AlphaMode::blend;
        const bool casts = (meshes.draws[i].groups >> 16U) != 0;
        if (!bounds.empty() && casts && !see_through && !is_lowest_floor(bounds, all)) {
            data.casters.extend(bounds.min);
            data.casters.extend(bounds.max);
        }
    }
    return data;
}

bool is_plain(std::span<const glm::uvec4> triangles)
{
    constexpr uint32_t flags = shared::triangle_two_sided | shared::triangle_mirrored;
    return std::ranges::all_of(triangles,
                               [](const glm::uvec4& triangle) { return (triangle.w & flags) == 0; });
}

bool turn_triangles(MeshData& meshes, const PoseData& pose)
{
    bool changed = false;
    for (size_t i = 0; i < meshes.draws.size(); ++i) {
        changed |= is_mirrored(meshes.draws[i]) != is_mirrored(pose.draws[i]);
        set_mirrored(meshes.draws[i], is_mirrored(pose.draws[i]));
    }
    if (!changed) {
        return false;
    }
    for (glm::uvec4& triangle : meshes.triangles) {
        const bool mirrored = is_mirrored(meshes.draws[triangle.w & shared::triangle_draw_mask]);
        triangle.w = (triangle.w & ~shared::triangle_mirrored) | (mirrored ? shared::triangle_mirrored : 0U);
    }
    for (Range* const range : {&meshes.opaque, &meshes.masked, &meshes.blended, &meshes.ground}) {
        range->plain = is_plain(std::span(meshes.triangles).subspan(range->first, range->count));
    }
    for (CasterRun& run : meshes.casters) {
        run.range.plain = is_plain(std::span(meshes.triangles).subspan(run.range.first, run.range.count));
    }
    return true;
}

} // namespace estampe::pose
