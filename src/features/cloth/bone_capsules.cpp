// SPDX-License-Identifier: MIT
#include "features/cloth/bone_capsules.hpp"

#include <algorithm>

namespace estampe::features {
namespace {

constexpr size_t least_vertices = 8; // of a bone that counts

/// A bone as the skin was bound to it.
struct BoundBone {
    uint32_t from_joint = 0; ///< of the skin
    uint32_t to_joint = 0;
    glm::vec3 from{0.0F};
    glm::vec3 to{0.0F};
    std::vector<float> distances;
};

std::vector<BoundBone> bound_bones(const Scene& scene, const Skin& skin)
{
    std::vector<BoundBone> bones;
    const auto place_of = [&](size_t joint) {
        const bool is_bound = joint < skin.joint_from_bind.size();
        return is_bound ? glm::vec3(glm::inverse(skin.joint_from_bind[joint])[3]) : glm::vec3(0.0F);
    };
    for (uint32_t to = 0; to < skin.joints.size(); ++to) {
        const auto parent = std::ranges::find(skin.joints, scene.nodes[skin.joints[to]].parent);
        if (parent != skin.joints.end()) {
            const auto from = static_cast<uint32_t>(parent - skin.joints.begin());
            bones.push_back({.from_joint = from, .to_joint = to, .from = place_of(from), .to = place_of(to)});
        }
    }
    return bones;
}

float distance_to(const BoundBone& bone, const glm::vec3& place)
{
    const glm::vec3 way = bone.to - bone.from;
    const float share = glm::dot(place - bone.from, way) / std::max(glm::dot(way, way), 1e-12F);
    return glm::distance(place, bone.from + glm::clamp(share, 0.0F, 1.0F) * way);
}

/// Each vertex belongs to the nearest bone of the joint that moves it most.
void gather_distances(std::vector<BoundBone>& bones, const Primitive& primitive)
{
    for (size_t i = 0; i < std::min(primitive.joints_0.size(), primitive.weights_0.size()); ++i) {
        int heaviest = 0;
        for (int k = 1; k < 4; ++k) {
            heaviest = primitive.weights_0[i][k] > primitive.weights_0[i][heaviest] ? k : heaviest;
        }
        const uint32_t joint = primitive.joints_0[i][heaviest];
        BoundBone* nearest = nullptr;
        float nearest_m = 0.0F;
        for (BoundBone& bone : bones) {
            if (bone.from_joint != joint) {
                continue;
            }
            const float away_m = distance_to(bone, primitive.positions[i]);
            if (nearest == nullptr || away_m < nearest_m) {
                nearest = &bone;
                nearest_m = away_m;
            }
        }
        if (nearest != nullptr) {
            nearest->distances.push_back(nearest_m);
        }
    }
}

} // namespace

std::vector<BoneCapsule> bone_capsules(const Scene& scene)
{
    std::vector<BoneCapsule> capsules;
    for (const Node& node : scene.nodes) {
        if (node.skin >= scene.skins.size() || node.mesh >= scene.meshes.size()) {
            continue;
        }
        const Skin& skin = scene.skins[node.skin];
        std::vector<BoundBone> bones = bound_bones(scene, skin);
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            if (cloth_of(scene, node, primitive) == nullptr) {
                gather_distances(bones, primitive);
            }
        }
        for (BoundBone& bone : bones) {
            const float length_m = glm::distance(bone.from, bone.to);
            if (bone.distances.size() < least_vertices || !(length_m > 0.0F)) {
                continue;
            }
            const auto middle = bone.distances.begin() + static_cast<ptrdiff_t>(bone.distances.size() / 2);
            std::ranges::nth_element(bone.distances, middle);
            capsules.push_back({.from = skin.joints[bone.from_joint],
                                .to = skin.joints[bone.to_joint],
                                .radius_share = *middle / length_m});
        }
    }
    return capsules;
}

cloth::Solid placed_bone(const BoneCapsule& bone, const ScenePose& pose, const glm::dvec3& anchor)
{
    const glm::vec3 from(glm::dvec3(pose.world_from_node[bone.from][3]) - anchor);
    const glm::vec3 to(glm::dvec3(pose.world_from_node[bone.to][3]) - anchor);
    return cloth::capsule_between(from, to, std::max(bone.radius_share * glm::distance(from, to), 1e-4F));
}

} // namespace estampe::features
