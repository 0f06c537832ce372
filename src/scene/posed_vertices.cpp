// SPDX-License-Identifier: MIT
#include "scene/pose.hpp"

#include <algorithm>

#include "scene/visibility.hpp"

namespace estampe {
namespace {

std::vector<glm::dmat4> world_from_bind(const Scene& scene, const ScenePose& pose, Index node)
{
    std::vector<glm::dmat4> matrices;
    const Index skin_index = scene.nodes[node].skin;
    if (skin_index >= scene.skins.size())
        return matrices;
    const Skin& skin = scene.skins[skin_index];
    for (size_t joint = 0; joint < skin.joints.size(); ++joint) {
        const glm::dmat4 joint_from_bind =
            joint < skin.joint_from_bind.size() ? glm::dmat4(skin.joint_from_bind[joint]) : glm::dmat4(1.0);
        matrices.push_back(pose.world_from_node[skin.joints[joint]] * joint_from_bind);
    }
    return matrices;
}

/// Of every `stride`-th vertex.
std::vector<glm::dvec3> morphed(const Primitive& primitive, const std::vector<float>& weights, size_t stride)
{
    std::vector<glm::dvec3> positions;
    positions.reserve(primitive.positions.size() / stride + 1);
    for (size_t i = 0; i < primitive.positions.size(); i += stride) {
        positions.emplace_back(primitive.positions[i]);
    }
    for (size_t target = 0; target < std::min(weights.size(), primitive.morph_targets.size()); ++target) {
        const std::vector<glm::vec3>& offsets = primitive.morph_targets[target].position_offsets;
        if (weights[target] == 0.0F)
            continue;
        for (size_t i = 0; i < positions.size() && i * stride < offsets.size(); ++i)
            positions[i] += static_cast<double>(weights[target]) * glm::dvec3(offsets[i * stride]);
    }
    return positions;
}

glm::dmat4 blend(const std::vector<glm::dmat4>& matrices, const Primitive& primitive, size_t vertex)
{
    glm::dmat4 sum(0.0);
    const auto add = [&](const std::vector<glm::u16vec4>& joints, const std::vector<glm::vec4>& weights) {
        if (vertex >= joints.size() || vertex >= weights.size())
            return;
        for (int i = 0; i < 4; ++i) {
            const size_t joint = joints[vertex][i];
            if (weights[vertex][i] != 0.0F && joint < matrices.size())
                sum += static_cast<double>(weights[vertex][i]) * matrices[joint];
        }
    };
    add(primitive.joints_0, primitive.weights_0);
    add(primitive.joints_1, primitive.weights_1);
    return sum;
}

bool turns_inside_out(const glm::dmat4& matrix)
{
    return glm::determinant(glm::dmat3(matrix)) < 0.0;
}

/// `stride_of` says of a number of vertices the how manieth are visited.
void visit_some(const Scene& scene, const ScenePose& pose, const std::function<size_t(size_t)>& stride_of,
                const std::function<void(const PosedPrimitive&)>& visit)
{
    std::vector<glm::dvec3> placed;
    const std::vector<bool> visible = visible_nodes(scene);
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        const Node& node = scene.nodes[index];
        if (!visible[index] || node.mesh >= scene.meshes.size())
            continue;
        const std::vector<glm::dmat4> joints = world_from_bind(scene, pose, index);
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            const size_t stride = stride_of(primitive.positions.size());
            const std::vector<glm::dvec3> local = morphed(primitive, pose.morph_weights[index], stride);
            placed.resize(local.size());
            if (!joints.empty() && !primitive.joints_0.empty()) {
                for (size_t i = 0; i < local.size(); ++i)
                    placed[i] = glm::dvec3(blend(joints, primitive, i * stride) * glm::dvec4(local[i], 1.0));
                visit({index, &primitive, placed, turns_inside_out(joints.front())});
                continue;
            }
            const size_t copies = std::max<size_t>(node.instances.size(), 1);
            for (size_t copy = 0; copy < copies; ++copy) {
                glm::dmat4 world_from_mesh = pose.world_from_node[index];
                if (!node.instances.empty())
                    world_from_mesh *= glm::dmat4(node.instances[copy]);
                for (size_t i = 0; i < local.size(); ++i)
                    placed[i] = glm::dvec3(world_from_mesh * glm::dvec4(local[i], 1.0));
                visit({index, &primitive, placed, turns_inside_out(world_from_mesh)});
            }
        }
    }
}

} // namespace

std::vector<glm::mat4> skin_matrices(const Scene& scene, const ScenePose& pose, Index node)
{
    const std::vector<glm::dmat4> matrices = world_from_bind(scene, pose, node);
    return {matrices.begin(), matrices.end()};
}

void visit_posed(const Scene& scene, const ScenePose& pose,
                 const std::function<void(const PosedPrimitive&)>& visit)
{
    visit_some(
        scene, pose, [](size_t) { return size_t{1}; }, visit);
}

void visit_posed_samples(const Scene& scene, const ScenePose& pose, size_t about,
                         const std::function<void(const PosedPrimitive&)>& visit)
{
    visit_some(
        scene, pose, [about](size_t count) { return std::max<size_t>(1, count / about); }, visit);
}

Bounds scene_bounds(const Scene& scene, const ScenePose& pose)
{
    Bounds bounds;
    visit_posed(scene, pose, [&bounds](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions)
            bounds.extend(position);
    });
    return bounds;
}

} // namespace estampe
