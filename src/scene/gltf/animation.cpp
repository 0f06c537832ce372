// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string_view>

#include "scene/gltf/convert.hpp"

namespace estampe::gltf {
namespace {

std::optional<AnimatedPath> path_of(const std::string& path)
{
    if (path == "translation") {
        return AnimatedPath::translation;
    }
    if (path == "rotation") {
        return AnimatedPath::rotation;
    }
    if (path == "scale") {
        return AnimatedPath::scale;
    }
    if (path == "weights") {
        return AnimatedPath::weights;
    }
    return std::nullopt;
}

constexpr auto pointer_extension = "KHR_animation_pointer";

/// The node and the property that a channel animates.
struct Target {
    Index node = no_index;
    AnimatedPath path = AnimatedPath::translation;
};

/// Splits a pointer such as "/nodes/3/rotation" into the node and the property.
std::optional<std::pair<Index, std::string>> node_and_property(const Scene& scene, std::string_view pointer)
{
    constexpr std::string_view nodes = "/nodes/";
    if (!pointer.starts_with(nodes)) {
        return std::nullopt;
    }
    pointer.remove_prefix(nodes.size());
    Index node = no_index;
    const auto [end, problem] = std::from_chars(pointer.data(), pointer.data() + pointer.size(), node);
    pointer.remove_prefix(static_cast<size_t>(end - pointer.data()));
    if (problem != std::errc{} || node >= scene.nodes.size() || !pointer.starts_with('/')) {
        return std::nullopt;
    }
    return std::pair(node, std::string(pointer.substr(1)));
}

/// Finds the target of KHR_animation_pointer. Only properties of nodes are supported; all others cause a
/// warning.
std::optional<Target> pointer_target(Data& data, const Scene& scene, const tinygltf::AnimationChannel& source,
                                     const std::string& place)
{
    const std::string place_of_pointer = fmt::format("{}/target/extensions/{}", place, pointer_extension);
    const std::string pointer =
        source.target_extensions.at(pointer_extension).Get("pointer").Get<std::string>();
    const auto property = node_and_property(scene, pointer);
    if (!property) {
        data.warn(place_of_pointer, fmt::format("\"{}\" is not animated; it keeps the value in the file",
                                                pointer.substr(0, 120)));
        return std::nullopt;
    }
    if (const auto path = path_of(property->second)) {
        return Target{.node = property->first, .path = *path};
    }
    const Node& node = scene.nodes[property->first];
    if (property->second == "extensions/KHR_node_visibility/visible") {
        data.warn(place_of_pointer,
                  fmt::format("the visibility of node {} \"{}\" is not animated; it stays {}",
                              property->first, node.name, node.visible ? "visible" : "hidden"));
    } else {
        data.warn(place_of_pointer, fmt::format("\"{}\" of node {} \"{}\" is not animated",
                                                property->second.substr(0, 80), property->first, node.name));
    }
    return std::nullopt;
}

/// Finds the target of an animation channel. Returns nothing if the channel animates nothing in this scene.
/// Adds a warning if the target is not supported.
std::optional<Target> target_of(Data& data, const Scene& scene, const tinygltf::AnimationChannel& source,
                                const std::string& place)
{
    if (source.target_path == "pointer" && source.target_extensions.contains(pointer_extension)) {
        return pointer_target(data, scene, source, place);
    }
    const auto path = path_of(source.target_path);
    if (source.target_node < 0) {
        return std::nullopt;
    }
    if (!path) {
        data.warn(place + "/target/path",
                  fmt::format("\"{}\" is not animated", source.target_path.substr(0, 40)));
        return std::nullopt;
    }
    return Target{.node = static_cast<Index>(source.target_node), .path = *path};
}

/// Returns the number of floats per key, without the tangents of cubic splines. Returns 0 if there is nothing
/// to animate.
size_t key_width(const Scene& scene, const AnimationChannel& channel)
{
    switch (channel.path) {
    case AnimatedPath::rotation:
        return 4;
    case AnimatedPath::weights: {
        const Index mesh = scene.nodes[channel.node].mesh;
        return mesh == no_index ? 0 : scene.meshes[mesh].morph_weights.size();
    }
    default:
        return 3;
    }
}

void sort_keys(Data& data, AnimationChannel& channel, const std::string& pointer)
{
    if (std::is_sorted(channel.times_s.begin(), channel.times_s.end())) {
        return;
    }
    data.warn(pointer, "the times do not ascend; the keys were sorted");
    const size_t width = channel.values.size() / channel.times_s.size();
    std::vector<size_t> order(channel.times_s.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return channel.times_s[a] < channel.times_s[b]; });
    AnimationChannel sorted = channel;
    for (size_t i = 0; i < order.size(); ++i) {
        sorted.times_s[i] = channel.times_s[order[i]];
        std::copy_n(channel.values.begin() + static_cast<std::ptrdiff_t>(order[i] * width), width,
                    sorted.values.begin() + static_cast<std::ptrdiff_t>(i * width));
    }
    channel = std::move(sorted);
}

void check_finite(const Data& data, const std::vector<float>& values, int accessor)
{
    const auto bad =
        std::find_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); });
    if (bad != values.end()) {
        data.fail(accessor_pointer(accessor),
                  fmt::format("animation value {} is not finite", std::distance(values.begin(), bad)),
                  "export the file again");
    }
}

void read_keys(Data& data, const tinygltf::AnimationSampler& sampler, size_t width, AnimationChannel& channel,
               const std::string& pointer)
{
    if (component_count(accessor_of(data, sampler.input)) != 1) {
        data.fail(pointer + "/input", fmt::format("accessor {} is not SCALAR", sampler.input));
    }
    channel.times_s = read_floats(data, sampler.input, 1);
    channel.values = read_floats(data, sampler.output, component_count(accessor_of(data, sampler.output)));
    check_finite(data, channel.times_s, sampler.input);
    check_finite(data, channel.values, sampler.output);
    const size_t parts = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (channel.values.size() != channel.times_s.size() * parts * width) {
        data.fail(pointer + "/output",
                  fmt::format("has {} numbers, but {} keys need {}", channel.values.size(),
                              channel.times_s.size(), channel.times_s.size() * parts * width));
    }
    sort_keys(data, channel, pointer + "/input");
}

std::optional<AnimationChannel> import_channel(Data& data, const Scene& scene,
                                               const tinygltf::Animation& animation, size_t index,
                                               const std::string& animation_pointer)
{
    const tinygltf::AnimationChannel& source = animation.channels[index];
    const std::string pointer = fmt::format("{}/channels/{}", animation_pointer, index);
    if (source.sampler < 0 || static_cast<size_t>(source.sampler) >= animation.samplers.size()) {
        data.fail(pointer + "/sampler", fmt::format("index {} is outside the animation's {} samplers",
                                                    source.sampler, animation.samplers.size()));
    }
    const std::optional<Target> target = target_of(data, scene, source, pointer);
    if (!target) {
        return std::nullopt;
    }
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<size_t>(source.sampler)];
    AnimationChannel channel;
    channel.node = target->node;
    channel.path = target->path;
    channel.interpolation = sampler.interpolation == "STEP"          ? Interpolation::step
                            : sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubic_spline
                                                                     : Interpolation::linear;
    if (scene.nodes[channel.node].matrix && channel.path != AnimatedPath::weights) {
        data.warn(pointer + "/target/node",
                  "the node has a matrix, which cannot be animated; the channel is left out");
        return std::nullopt;
    }
    const size_t width = key_width(scene, channel);
    if (width == 0) {
        data.warn(pointer + "/target", "the node has no morph targets; the channel is left out");
        return std::nullopt;
    }
    read_keys(data, sampler, width, channel,
              fmt::format("{}/samplers/{}", animation_pointer, source.sampler));
    return channel;
}

} // namespace

void import_animations(Data& data, Scene& scene)
{
    const auto& sources = data.model().animations;
    for (size_t i = 0; i < sources.size(); ++i) {
        Animation animation;
        animation.name = sources[i].name;
        for (size_t c = 0; c < sources[i].channels.size(); ++c) {
            auto channel = import_channel(data, scene, sources[i], c, fmt::format("/animations/{}", i));
            if (channel) {
                animation.duration_s = std::max(animation.duration_s, channel->times_s.back());
                animation.channels.push_back(std::move(*channel));
            }
        }
        scene.animations.push_back(std::move(animation));
    }
}

} // namespace estampe::gltf
