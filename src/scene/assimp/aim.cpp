// SPDX-License-Identifier: MIT
#include "scene/assimp/aim.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace estampe {
namespace {

/// Columns are right, up and back.
std::optional<glm::dmat3> looking_axes(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                                       double roll_rad)
{
    const double distance = glm::distance(eye, target);
    if (!(distance > 0.0) || !std::isfinite(distance))
        return std::nullopt;
    const glm::dvec3 back = (eye - target) / distance;
    glm::dvec3 right = glm::cross(up, back);
    if (!(glm::length(right) > 1e-6 * glm::length(up)))
        right = glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1), back);
    right = glm::normalize(right);
    const glm::dvec3 upright = glm::cross(back, right);
    const double c = std::cos(roll_rad);
    const double s = std::sin(roll_rad);
    return glm::dmat3(c * right - s * upright, c * upright + s * right, back);
}

/// The turn within a parent, whose scale and mirroring do not matter for where -z and y point.
std::optional<glm::dquat> turn_within(const glm::dmat4& world_from_parent, glm::dmat3 axes)
{
    glm::dmat3 parent(world_from_parent);
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(parent[axis]);
        if (!(length > 0.0))
            return std::nullopt;
        parent[axis] /= length;
    }
    const double determinant = glm::determinant(parent);
    if (!(std::abs(determinant) > 1e-6))
        return std::nullopt;
    if (determinant < 0.0)
        axes[0] = -axes[0];
    return glm::normalize(glm::quat_cast(glm::inverse(parent) * axes));
}

std::optional<glm::dquat> turn_at(const Scene& scene, const ScenePose& pose, Index looking, Index target,
                                  const Upward& upward)
{
    const glm::dvec3 eye(pose.world_from_node[looking][3]);
    const glm::dvec3 up =
        upward.node == no_index ? upward.direction : glm::dvec3(pose.world_from_node[upward.node][3]) - eye;
    const std::optional<glm::dmat3> axes =
        looking_axes(eye, glm::dvec3(pose.world_from_node[target][3]), up, upward.roll_rad);
    if (!axes)
        return std::nullopt;
    return turn_within(pose.world_from_node[scene.nodes[looking].parent], *axes);
}

std::vector<bool> nodes_above(const Scene& scene, std::initializer_list<Index> nodes)
{
    std::vector<bool> above(scene.nodes.size(), false);
    for (Index node : nodes)
        for (; node != no_index && !above[node]; node = scene.nodes[node].parent)
            above[node] = true;
    return above;
}

/// How often the direction is taken: once a frame, less often where that would take too long.
size_t sample_count(const Scene& scene, float duration_s)
{
    constexpr double most_node_samples = 2e7;
    const double wanted =
        1.0 + std::ceil(static_cast<double>(duration_s) * scene.frames_per_s.value_or(30.0));
    const double most = most_node_samples / static_cast<double>(scene.nodes.size());
    return static_cast<size_t>(std::clamp(std::min(wanted, most), 2.0, 4000.0));
}

AnimationChannel aimed_channel(const Scene& scene, Index animation, Index looking, Index target,
                               const Upward& upward)
{
    AnimationChannel channel{.node = looking, .path = AnimatedPath::rotation};
    const float duration_s = scene.animations[animation].duration_s;
    const size_t count = sample_count(scene, duration_s);
    for (size_t i = 0; i < count; ++i) {
        const float time_s = duration_s * static_cast<float>(i) / static_cast<float>(count - 1);
        // At its very end an animation is at its beginning again.
        const double just_before_s = std::min<double>(time_s, 0.999999 * duration_s);
        const std::optional<glm::dquat> turn =
            turn_at(scene, pose_scene(scene, just_before_s, animation), looking, target, upward);
        if (!turn)
            continue;
        channel.times_s.push_back(time_s);
        for (const double value : {turn->x, turn->y, turn->z, turn->w})
            channel.values.push_back(static_cast<float>(value));
    }
    return channel;
}

} // namespace

void aim_node(Scene& scene, Index looking, Index target, const Upward& upward)
{
    const std::optional<glm::dquat> turn =
        turn_at(scene, pose_scene(scene, 0.0, no_index), looking, target, upward);
    if (!turn)
        return;
    Node& node = scene.nodes[looking];
    if (node.matrix)
        node.transform.translation = glm::dvec3((*node.matrix)[3]);
    node.matrix.reset();
    node.transform.rotation = *turn;
    const std::vector<bool> moving = upward.node == no_index
                                         ? nodes_above(scene, {looking, target})
                                         : nodes_above(scene, {looking, target, upward.node});
    for (Index index = 0; index < scene.animations.size(); ++index) {
        Animation& animation = scene.animations[index];
        const bool moves = std::any_of(animation.channels.begin(), animation.channels.end(),
                                       [&](const AnimationChannel& channel) { return moving[channel.node]; });
        if (!moves || !(animation.duration_s > 0.0F))
            continue;
        AnimationChannel channel = aimed_channel(scene, index, looking, target, upward);
        if (!channel.times_s.empty())
            animation.channels.push_back(std::move(channel));
    }
}

} // namespace estampe
