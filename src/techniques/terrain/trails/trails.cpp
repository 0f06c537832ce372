// SPDX-License-Identifier: MIT
#include "techniques/terrain/trails/trails.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/trail_fill_comp.hpp"
#include "shaders/trail_image_comp.hpp"
#include "shaders/trail_press_comp.hpp"
#include "shaders/trail_slump_comp.hpp"
#include "techniques/terrain/trails/trails.glsl.h"

namespace estampe::terrain {
namespace {

constexpr uint32_t ticks_a_step = 4;
constexpr double steps_a_second = 30.0;
constexpr uint32_t most_steps = 30 * 3600;   ///< at once: an hour
constexpr uint32_t steps_a_dispatch = 16384; ///< lavapipe stops a thread after 65535 rounds of its loops
constexpr double farthest_m = 1e12;          ///< from the origin: texels can still be counted

std::vector<float> even_ground(uint32_t side, double extent_m)
{
    if (!std::has_single_bit(side) || side < 16 || side > 1024 || !(extent_m > 0.0)) {
        throw std::logic_error(
            "a field of trails has a side of 16 to 1024 texels, a power of two, and an extent");
    }
    return std::vector<float>(static_cast<size_t>(side) * side);
}

shared::TrailWindow window_at(uint32_t side, glm::i64vec2 first)
{
    const auto kept = [&](int64_t number) { return static_cast<uint32_t>(number) & (side - 1); };
    return {.side = side, .first_x = kept(first.x), .first_y = kept(first.y)};
}

bool is_usable(const TrailStamp& stamp)
{
    const double sum = stamp.from_m.x + stamp.from_m.y + stamp.to_m.x + stamp.to_m.y;
    const bool is_near = std::isfinite(sum) && glm::length(stamp.from_m) < farthest_m &&
                         glm::length(stamp.to_m - stamp.from_m) <= 100.0;
    const auto is_size = [](float value, float least) { return value >= least && value <= 100.0F; };
    return is_near && is_size(stamp.from_radius_m, 0.0F) && is_size(stamp.to_radius_m, 0.0F) &&
           is_size(stamp.depth_m, 1e-4F) && is_size(stamp.rim_m, 1e-3F);
}

/// Where a stamp meets a window. Places are counted from a texel of the ground near the stamp, so that they
/// are the same wherever the window is.
shared::TrailPress press_of(const TrailStamp& stamp, uint32_t side, double texel_m, glm::i64vec2 first)
{
    const glm::i64vec2 base(glm::floor(stamp.from_m / texel_m));
    const glm::dvec2 base_m = (glm::dvec2(base) + 0.5) * texel_m;
    const glm::dvec2 from = stamp.from_m - base_m;
    const glm::dvec2 to = stamp.to_m - base_m;
    const double reach = static_cast<double>(std::max(stamp.from_radius_m, stamp.to_radius_m) +
                                             std::max(stamp.rim_m, static_cast<float>(2.0 * texel_m)));
    const glm::i64vec2 in_window = base - first;
    const glm::i64vec2 low =
        glm::max(glm::i64vec2(glm::floor((glm::min(from, to) - reach) / texel_m)), -in_window);
    const glm::i64vec2 high = glm::min(glm::i64vec2(glm::ceil((glm::max(from, to) + reach) / texel_m)),
                                       glm::i64vec2(side) - int64_t{1} - in_window);
    const bool is_seen = low.x <= high.x && low.y <= high.y;
    return {.window = window_at(side, first),
            .base_x = is_seen ? static_cast<int>(in_window.x) : 0,
            .base_y = is_seen ? static_cast<int>(in_window.y) : 0,
            .low_x = is_seen ? static_cast<int>(low.x) : 0,
            .low_y = is_seen ? static_cast<int>(low.y) : 0,
            .high_x = is_seen ? static_cast<int>(high.x) : -1,
            .high_y = is_seen ? static_cast<int>(high.y) : -1,
            .from = glm::vec2(from),
            .to = glm::vec2(to),
            .from_radius_m = stamp.from_radius_m,
            .to_radius_m = stamp.to_radius_m,
            .depth_m = stamp.depth_m,
            .rim_m = std::max(stamp.rim_m, static_cast<float>(2.0 * texel_m)),
            .texel_m = static_cast<float>(texel_m)};
}

} // namespace

TrailStamp TrailStamp::disc(glm::dvec2 place_m, float radius_m, float depth_m)
{
    return drag(place_m, place_m, radius_m, depth_m);
}

TrailStamp TrailStamp::drag(glm::dvec2 from_m, glm::dvec2 to_m, float radius_m, float depth_m)
{
    return {.from_m = from_m,
            .to_m = to_m,
            .from_radius_m = radius_m,
            .to_radius_m = radius_m,
            .depth_m = depth_m};
}

TrailStamp TrailStamp::foot(glm::dvec2 place_m, glm::dvec2 towards, float length_m, float depth_m)
{
    constexpr double heel = 0.13; // radii, of the length
    constexpr double ball = 0.18;
    const double length = glm::length(towards);
    const glm::dvec2 ahead =
        static_cast<double>(length_m) * (length > 0.0 ? towards / length : glm::dvec2(1.0, 0.0));
    return {.from_m = place_m - (0.5 - heel) * ahead,
            .to_m = place_m + (0.5 - ball) * ahead,
            .from_radius_m = static_cast<float>(heel) * length_m,
            .to_radius_m = static_cast<float>(ball) * length_m,
            .depth_m = depth_m};
}

TrailField::TrailField(gpu::Device& device, uint32_t side, double extent_m)
    : heights_(gpu::upload_buffer(device, "trails", even_ground(side, extent_m))), side_(side),
      texel_m_(extent_m / side)
{
}

void TrailField::press(std::span<const TrailStamp> stamps)
{
    std::copy_if(stamps.begin(), stamps.end(), std::back_inserter(waiting_), is_usable);
}

gpu::BufferId TrailField::add_presses(gpu::Graph& graph, gpu::BufferId heights)
{
    for (uint32_t i = 0; i < most_presses() && !waiting_.empty(); waiting_.pop_front()) {
        const shared::TrailPress press = press_of(waiting_.front(), side_, texel_m_, first_);
        if (press.low_x > press.high_x) {
            continue;
        }
        auto pass = graph.compute("trails/press", shaders::trail_press_comp);
        heights = pass.modify(heights);
        pass.push(press).dispatch(1);
        ++i;
        slumps_left_ = -1;
    }
    return heights;
}

gpu::BufferId TrailField::add_slump(gpu::Graph& graph, const TrailStyle& style, gpu::BufferId heights)
{
    const double beside_m = texel_m_ * std::tan(glm::radians(static_cast<double>(style.repose_deg)));
    for (uint32_t phase = 0; phase < 4; ++phase) {
        // The second place where blocks begin lies across a corner from the first.
        const glm::uvec2 begin(phase & 1U, (phase ^ (phase >> 1U)) & 1U);
        auto pass = graph.compute("trails/slump", shaders::trail_slump_comp);
        heights = pass.modify(heights);
        pass.push(shared::TrailSlump{.window = window_at(side_, first_),
                                     .skip_x = (static_cast<uint32_t>(first_.x) + begin.x) & 1U,
                                     .skip_y = (static_cast<uint32_t>(first_.y) + begin.y) & 1U,
                                     .beside_m = static_cast<float>(beside_m),
                                     .aslant_m = static_cast<float>(std::sqrt(2.0) * beside_m)})
            .dispatch_over(side_ / 2, side_ / 2);
    }
    return heights;
}

gpu::BufferId TrailField::add_fill(gpu::Graph& graph, const TrailStyle& style, glm::i64vec2 moved,
                                   uint32_t steps, gpu::BufferId heights) const
{
    const auto far = static_cast<int64_t>(side_);
    const glm::ivec2 within(glm::clamp(moved, glm::i64vec2(-far), glm::i64vec2(far)));
    auto pass = graph.compute("trails/fill", shaders::trail_fill_comp);
    heights = pass.modify(heights);
    pass.push(shared::TrailFill{.window = window_at(side_, first_),
                                .moved_x = within.x,
                                .moved_y = within.y,
                                .steps = steps,
                                .kept = static_cast<float>(std::exp2(
                                    -1.0 / (steps_a_second * static_cast<double>(style.half_life_s))))})
        .dispatch_over(side_, side_);
    return heights;
}

gpu::BufferId TrailField::add_passing_steps(gpu::Graph& graph, const TrailStyle& style, uint32_t steps,
                                            gpu::BufferId heights)
{
    for (; slumps_left_ > 0 && steps > 0; --slumps_left_, --steps) {
        heights = add_slump(graph, style, heights);
        heights = add_fill(graph, style, {}, 1, heights);
    }
    for (; steps > 0; steps -= std::min(steps, steps_a_dispatch)) {
        heights = add_fill(graph, style, {}, std::min(steps, steps_a_dispatch), heights);
    }
    return heights;
}

TrailImage TrailField::add_step(gpu::Graph& graph, const TrailStyle& style, uint32_t ticks,
                                glm::dvec2 centre_m)
{
    gpu::BufferId heights = gpu::import_whole(graph, "trails", heights_);
    if (std::isfinite(centre_m.x + centre_m.y)) {
        const glm::dvec2 middle = glm::clamp(centre_m, -farthest_m, farthest_m) / texel_m_;
        const glm::i64vec2 moved =
            glm::i64vec2(glm::round(middle)) - static_cast<int64_t>(side_ / 2) - first_;
        first_ += moved;
        if (moved != glm::i64vec2(0)) {
            heights = add_fill(graph, style, moved, 0, heights);
        }
    }
    heights = add_presses(graph, heights);
    if (slumps_left_ < 0) {
        slumps_left_ = style.slumps;
    }
    ticks_ += std::min(ticks, ticks_a_step * most_steps);
    const uint32_t steps = ticks_ / ticks_a_step;
    ticks_ %= ticks_a_step;
    heights = add_passing_steps(graph, style, steps, heights);

    auto pass = graph.compute("trails/image", shaders::trail_image_comp);
    pass.sample(heights, gpu::Format::r32f);
    const gpu::ImageId image = pass.write(
        graph.image("trails/height", {.width = side_, .height = side_, .format = gpu::Format::r32f}));
    pass.push(shared::TrailImageConstants{.window = window_at(side_, first_), .edge = side_ / 16})
        .dispatch_over(side_, side_);
    return {.height = image, .corner_m = glm::dvec2(first_) * texel_m_, .texel_m = texel_m_};
}

} // namespace estampe::terrain
