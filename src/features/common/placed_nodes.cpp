// SPDX-License-Identifier: MIT
#include "features/common/placed_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "scene/static_triangles.hpp"

namespace estampe::features {
namespace {

bool is_finite(const Transform& transform)
{
    const auto all = [](const auto& values, int count) {
        for (int i = 0; i < count; ++i) {
            if (!std::isfinite(values[i])) {
                return false;
            }
        }
        return true;
    };
    return all(transform.translation, 3) && all(transform.rotation, 4) && all(transform.scale, 3);
}

Transform between(const Transform& a, const Transform& b, double part)
{
    return {.translation = glm::mix(a.translation, b.translation, part),
            .rotation = glm::slerp(a.rotation, b.rotation, part),
            .scale = glm::mix(a.scale, b.scale, part)};
}

} // namespace

void PlacedNodes::place(std::span<const NodePlace> places, double time_s)
{
    for (auto& [node, stands] : stands_) {
        while (!stands.empty() && stands.back().time_s >= time_s) {
            stands.pop_back();
        }
    }
    for (const NodePlace& place : places) {
        std::deque<Stand>& stands = stands_[place.node];
        stands.push_back({time_s, place.transform});
        while (stands.size() > 2 && stands[1].time_s < time_s - remembered_s) {
            stands.pop_front();
        }
    }
    std::erase_if(stands_, [](const auto& node) { return node.second.empty(); });
}

void PlacedNodes::put(Scene& scene, double time_s) const
{
    for (const auto& [index, stands] : stands_) {
        Transform& transform = scene.nodes[index].transform;
        const auto after = std::ranges::upper_bound(stands, time_s, {}, &Stand::time_s);
        if (after == stands.begin()) {
            transform = stands.front().transform;
        } else if (after == stands.end()) {
            transform = stands.back().transform;
        } else {
            const Stand& before = *(after - 1);
            transform = between(before.transform, after->transform,
                                (time_s - before.time_s) / (after->time_s - before.time_s));
        }
    }
}

void check_places(std::span<const NodePlace> places, size_t node_count, double time_s)
{
    if (!std::isfinite(time_s)) {
        throw Error("nodes cannot be moved at a moment that is no number", "place");
    }
    for (const NodePlace& place : places) {
        if (place.node >= node_count) {
            throw Error(fmt::format("there is no node {} to move", place.node), "place",
                        fmt::format("the scene has {}", node_count));
        }
        if (!is_finite(place.transform)) {
            throw Error(fmt::format("node {} cannot be moved to a place that is no number", place.node),
                        "place");
        }
    }
}

bool take_over(Scene& scene, std::span<const NodePlace> places)
{
    const std::vector<bool> moved_before = moving_nodes(scene);
    std::vector<bool> is_placed(scene.nodes.size(), false);
    for (const NodePlace& place : places) {
        is_placed[place.node] = true;
        scene.nodes[place.node].matrix.reset();
        if (!moved_before[place.node]) {
            if (scene.animations.empty()) {
                scene.animations.emplace_back();
            }
            scene.animations.front().channels.push_back({.node = place.node});
        }
    }
    for (Animation& animation : scene.animations) {
        for (AnimationChannel& channel : animation.channels) {
            if (channel.node < is_placed.size() && is_placed[channel.node] &&
                channel.path != AnimatedPath::weights) {
                channel.times_s.clear();
                channel.values.clear();
            }
        }
    }
    const std::vector<bool> moves = moving_nodes(scene);
    for (size_t node = 0; node < scene.nodes.size(); ++node) {
        // True if the node was treated as static. A node with a skinned mesh is never static.
        const bool stood = scene.nodes[node].mesh != no_index && scene.nodes[node].skin == no_index;
        if (stood && moves[node] && !moved_before[node]) {
            return true;
        }
    }
    return false;
}

} // namespace estampe::features
