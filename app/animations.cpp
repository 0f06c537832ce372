// SPDX-License-Identifier: MIT
#include "animations.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>
#include <vector>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"

namespace estampe::app {
namespace {

std::string name_of(const Animation& animation, size_t index)
{
    return animation.name.empty() ? std::to_string(index) : in_quotes(animation.name);
}

} // namespace

bool add_all_animations(Scene& scene)
{
    const bool is_named = std::ranges::any_of(
        scene.animations, [](const Animation& animation) { return animation.name == all_animations; });
    if (scene.animations.size() < 2 || is_named) {
        return true;
    }
    Animation all{.name = all_animations, .start_s = scene.animations.front().start_s};
    std::set<std::pair<Index, AnimatedPath>> animated;
    std::set<Index> contested;
    for (const Animation& animation : scene.animations) {
        std::set<std::pair<Index, AnimatedPath>> own;
        for (const AnimationChannel& channel : animation.channels) {
            const std::pair key(channel.node, channel.path);
            if (animated.contains(key)) {
                contested.insert(channel.node);
                continue;
            }
            own.insert(key);
            all.channels.push_back(channel);
        }
        animated.merge(own);
        all.duration_s = std::max(all.duration_s, animation.duration_s);
        all.start_s = std::min(all.start_s, animation.start_s);
    }
    if (!contested.empty()) {
        scene.warnings.push_back(fmt::format(
            "several animations move the same nodes ({}, such as \"{}\"): there the first of them is played",
            contested.size(), scene.nodes.at(*contested.begin()).name));
    }
    scene.animations.push_back(std::move(all));
    return contested.empty();
}

Index choose_animation(const DrawOptions& draw, const Scene& scene)
{
    if (draw.animation.empty()) {
        return 0;
    }
    std::vector<std::string> names;
    for (const Animation& animation : scene.animations) {
        if (animation.name == draw.animation) {
            return static_cast<Index>(names.size());
        }
        names.push_back(in_quotes(animation.name));
    }
    if (draw.animation == all_animations && !names.empty()) {
        return 0; // the only one
    }
    Index index = 0;
    const char* const end = draw.animation.data() + draw.animation.size();
    const auto [stop, problem] = std::from_chars(draw.animation.data(), end, index);
    if (problem == std::errc{} && stop == end && index < names.size()) {
        return index;
    }
    throw Error(fmt::format("no animation {}", in_quotes(draw.animation)), draw.scene,
                names.empty() ? "the file has none"
                              : fmt::format("it has {}, or all", fmt::join(names, ", ")));
}

std::string note_of_animations(const DrawOptions& draw, const Scene& scene)
{
    if (!draw.animation.empty() || scene.animations.size() < 2) {
        return {};
    }
    constexpr size_t most_names = 12;
    std::vector<std::string> others;
    for (size_t i = 1; i < std::min(scene.animations.size(), most_names + 1); ++i) {
        others.push_back(name_of(scene.animations[i], i));
    }
    const size_t more = scene.animations.size() - 1 - others.size();
    return fmt::format("plays animation {} of {}; --animation picks another, or all: {}{}",
                       name_of(scene.animations.front(), 0), scene.animations.size(), fmt::join(others, ", "),
                       more > 0 ? fmt::format(" and {} more", more) : std::string());
}

} // namespace estampe::app
