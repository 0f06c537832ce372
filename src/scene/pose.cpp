// SPDX-License-Identifier: MIT
#include "scene/pose.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace estampe {

glm::dmat4 Transform::matrix() const
{
    glm::dmat4 result = glm::mat4_cast(rotation);
    for (int axis = 0; axis < 3; ++axis)
        result[axis] *= scale[axis];
    result[3] = glm::dvec4(translation, 1.0);
    return result;
}

namespace {

/// The two keys around a moment, and how far between them it lies (0 to 1).
struct KeySpan {
    size_t before = 0;
    size_t after = 0;
    double part = 0.0;
    double length_s = 0.0;
};

KeySpan find_keys(const std::vector<float>& times_s, double time_s)
{
    const auto next = std::upper_bound(times_s.begin(), times_s.end(), time_s, [](double time, float key) {
        return time < static_cast<double>(key);
    });
    if (next == times_s.begin())
        return {};
    const auto after = static_cast<size_t>(next - times_s.begin());
    if (next == times_s.end())
        return {.before = after - 1, .after = after - 1};
    const double start_s = times_s[after - 1];
    const double length_s = static_cast<double>(*next) - start_s;
    return {.before = after - 1, .after = after, .part = (time_s - start_s) / length_s, .length_s = length_s};
}

/// Values a key holds, or 0 when the channel's arrays do not agree.
size_t values_per_key(const AnimationChannel& channel)
{
    const size_t keys =
        channel.times_s.size() * (channel.interpolation == Interpolation::cubic_spline ? 3 : 1);
    if (keys == 0 || channel.values.size() % keys != 0)
        return 0;
    return channel.values.size() / keys;
}

glm::dquat quaternion_of(const std::vector<double>& xyzw)
{
    const glm::dquat quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const double length = glm::length(quaternion);
    return length > 0.0 ? quaternion / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// Hermite spline of glTF: each key holds in-tangent, value, out-tangent; tangents are per second.
std::vector<double> sample_cubic(const AnimationChannel& channel, const KeySpan& span, size_t count)
{
    const double t = span.part;
    const double t2 = t * t;
    const double t3 = t2 * t;
    std::vector<double> result(count);
    for (size_t i = 0; i < count; ++i) {
        const auto value = [&](size_t key, size_t part) -> double {
            return channel.values[(3 * key + part) * count + i];
        };
        result[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * value(span.before, 1) +
                    span.length_s * (t3 - 2.0 * t2 + t) * value(span.before, 2) +
                    (3.0 * t2 - 2.0 * t3) * value(span.after, 1) +
                    span.length_s * (t3 - t2) * value(span.after, 0);
    }
    return result;
}

std::vector<double> sample(const AnimationChannel& channel, double time_s, size_t count)
{
    const KeySpan span = find_keys(channel.times_s, time_s);
    if (channel.interpolation == Interpolation::cubic_spline)
        return sample_cubic(channel, span, count);
    const auto key = [&](size_t index) {
        const auto first = channel.values.begin() + static_cast<std::ptrdiff_t>(index * count);
        return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(count));
    };
    std::vector<double> result = key(span.before);
    if (channel.interpolation == Interpolation::step || span.part == 0.0)
        return result;
    const std::vector<double> after = key(span.after);
    if (channel.path == AnimatedPath::rotation) {
        const glm::dquat turned = glm::slerp(quaternion_of(result), quaternion_of(after), span.part);
        return {turned.x, turned.y, turned.z, turned.w};
    }
    for (size_t i = 0; i < count; ++i)
        result[i] += span.part * (after[i] - result[i]);
    return result;
}

void apply(const AnimationChannel& channel, double time_s, std::vector<Transform>& transforms,
           ScenePose& pose)
{
    const size_t count = values_per_key(channel);
    const size_t wanted = channel.path == AnimatedPath::rotation ? 4 : 3;
    if (channel.node >= transforms.size() || count == 0)
        return;
    if (channel.path == AnimatedPath::weights) {
        std::vector<float>& weights = pose.morph_weights[channel.node];
        const std::vector<double> values = sample(channel, time_s, count);
        for (size_t i = 0; i < std::min(weights.size(), values.size()); ++i)
            weights[i] = static_cast<float>(values[i]);
        return;
    }
    if (count != wanted)
        return;
    const std::vector<double> values = sample(channel, time_s, count);
    Transform& transform = transforms[channel.node];
    if (channel.path == AnimatedPath::rotation)
        transform.rotation = quaternion_of(values);
    else if (channel.path == AnimatedPath::translation)
        transform.translation = {values[0], values[1], values[2]};
    else
        transform.scale = {values[0], values[1], values[2]};
}

double looped(double time_s, double duration_s)
{
    if (!(duration_s > 0.0) || !std::isfinite(time_s))
        return 0.0;
    const double rest_s = std::fmod(time_s, duration_s);
    return rest_s < 0.0 ? rest_s + duration_s : rest_s;
}

/// The node's own weights or its mesh's, as many as the mesh has targets.
std::vector<float> rest_weights(const Scene& scene, const Node& node)
{
    if (node.mesh >= scene.meshes.size())
        return {};
    const Mesh& mesh = scene.meshes[node.mesh];
    size_t targets = 0;
    for (const Primitive& primitive : mesh.primitives)
        targets = std::max(targets, primitive.morph_targets.size());
    std::vector<float> weights = node.morph_weights.empty() ? mesh.morph_weights : node.morph_weights;
    weights.resize(targets, 0.0F);
    return weights;
}

} // namespace

ScenePose pose_scene(const Scene& scene, double time_s, Index animation)
{
    ScenePose pose;
    pose.world_from_node.assign(scene.nodes.size(), glm::dmat4(1.0));
    std::vector<Transform> transforms;
    transforms.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        transforms.push_back(node.transform);
        pose.morph_weights.push_back(rest_weights(scene, node));
    }
    if (animation < scene.animations.size()) {
        const Animation& playing = scene.animations[animation];
        for (const AnimationChannel& channel : playing.channels)
            apply(channel, looped(time_s, playing.duration_s), transforms, pose);
    }
    std::vector<Index> pending = scene.roots;
    while (!pending.empty()) {
        const Index index = pending.back();
        pending.pop_back();
        const Node& node = scene.nodes[index];
        const glm::dmat4 parent_from_node = node.matrix ? *node.matrix : transforms[index].matrix();
        pose.world_from_node[index] =
            node.parent == no_index ? parent_from_node : pose.world_from_node[node.parent] * parent_from_node;
        pending.insert(pending.end(), node.children.begin(), node.children.end());
    }
    return pose;
}

} // namespace estampe
