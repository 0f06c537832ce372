// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <limits>
#include <set>

#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

void extend(Bounds& place, const Bounds& local, const glm::mat4& anchor_from_local)
{
    for (int i = 0; i < 8 && !local.empty(); ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? local.max.x : local.min.x,
                                (i & 2) != 0 ? local.max.y : local.min.y,
                                (i & 4) != 0 ? local.max.z : local.min.z);
        place.extend(glm::dvec3(glm::dmat4(anchor_from_local) * glm::dvec4(corner, 1.0)));
    }
}

/// The matrices that place one draw's vertices.
struct Places {
    size_t first = 0;
    size_t count = 0;
    bool are_joints = false;

    [[nodiscard]] const glm::mat4& of(const PoseData& pose, size_t draw, size_t index) const
    {
        return are_joints ? pose.joints[first + index] : pose.draws[draw].anchor_from_object;
    }
};

Places places_of(const shared::DrawRecord& draw, const std::set<uint32_t>& first_joints, size_t joint_count)
{
    if (draw.first_skin_vertex == shared::no_skin) {
        return {.count = 1};
    }
    const auto next = first_joints.upper_bound(draw.first_joint);
    const size_t end = next == first_joints.end() ? joint_count : *next;
    return {.first = draw.first_joint, .count = end - draw.first_joint, .are_joints = true};
}

bool morphs_differ(const shared::DrawRecord& draw, const PoseData& before, const PoseData& now)
{
    const auto first = static_cast<std::ptrdiff_t>(draw.first_morph_weight);
    return !std::equal(now.morph_weights.begin() + first,
                       now.morph_weights.begin() + first + draw.morph_target_count,
                       before.morph_weights.begin() + first);
}

} // namespace

Bounds everywhere()
{
    constexpr double endless = std::numeric_limits<double>::infinity();
    return {.min = glm::dvec3(-endless), .max = glm::dvec3(endless)};
}

std::vector<Bounds> moved_places(const MeshData& meshes, const PoseData& before, const PoseData& now)
{
    std::set<uint32_t> first_joints;
    for (const shared::DrawRecord& draw : now.draws) {
        if (draw.first_skin_vertex != shared::no_skin) {
            first_joints.insert(draw.first_joint);
        }
    }
    std::vector<Bounds> moved;
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        const shared::DrawRecord& draw = now.draws[i];
        const Places places = places_of(draw, first_joints, now.joints.size());
        bool differs = false;
        Bounds place;
        for (size_t k = 0; k < places.count; ++k) {
            const glm::mat4& was = places.of(before, i, k);
            const glm::mat4& is = places.of(now, i, k);
            differs = differs || was != is;
            extend(place, meshes.sources[i].local_bounds, was);
            extend(place, meshes.sources[i].local_bounds, is);
        }
        if (morphs_differ(draw, before, now)) {
            moved.push_back(everywhere());
        } else if (differs) {
            moved.push_back(place);
        }
    }
    return moved;
}

} // namespace estampe::pose
