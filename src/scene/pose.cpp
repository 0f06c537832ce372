// SPDX-License-Identifier: MIT
#include "scene/pose.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/visibility.hpp"

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

/// The two animation keys before and after a moment, and the position of the moment between them (0 to 1).
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

/// Returns the number of values per animation key. Returns 0 when the sizes of the channel's arrays do not
/// match.
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

/// Evaluates a Hermite spline as in glTF: each key consists of in-tangent, value and out-tangent. Tangents
/// are per second.
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

/// Returns the morph weights of the node, or of its mesh if the node has none. The result has one weight per
/// morph target.
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

/// Returns the positions of every `stride`-th vertex after morphing.
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

glm::dmat4 blend(std::span<const glm::dmat4> matrices, const Primitive& primitive, size_t vertex)
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

/// Visits primitives like visit_posed(), but only some of the vertices. `stride_of` returns the stride for a
/// given number of vertices.
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
                visit({.node = index,
                       .primitive = &primitive,
                       .positions = placed,
                       .mirrored = turns_inside_out(joints.front()),
                       .joints = joints});
                continue;
            }
            const size_t copies = std::max<size_t>(node.instances.size(), 1);
            for (size_t copy = 0; copy < copies; ++copy) {
                glm::dmat4 world_from_mesh = pose.world_from_node[index];
                if (!node.instances.empty())
                    world_from_mesh *= glm::dmat4(node.instances[copy]);
                for (size_t i = 0; i < local.size(); ++i)
                    placed[i] = glm::dvec3(world_from_mesh * glm::dvec4(local[i], 1.0));
                visit({.node = index,
                       .primitive = &primitive,
                       .positions = placed,
                       .mirrored = turns_inside_out(world_from_mesh),
                       .world_from_mesh = world_from_mesh});
            }
        }
    }
}

} // namespace

glm::dmat4 world_from_vertex(const PosedPrimitive& posed, size_t vertex)
{
    return posed.joints.empty() ? posed.world_from_mesh : blend(posed.joints, *posed.primitive, vertex);
}

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
