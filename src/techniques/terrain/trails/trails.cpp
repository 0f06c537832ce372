// SPDX-License-Identifier: MIT
#include "techniques/terrain/trails/trails.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gpu/resources.hpp"
#include "shaders/trail_fill_comp.hpp"
#include "shaders/trail_image_comp.hpp"
#include "shaders/trail_press_comp.hpp"
#include "shaders/trail_relief_comp.hpp"
#include "shaders/trail_slump_comp.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {
namespace {

constexpr uint32_t ticks_a_step = 4;
constexpr double steps_a_second = 30.0;
/// Largest number of time steps of 1/30 s that may pass in one call: an hour.
constexpr uint32_t most_steps = 30 * 3600;
/// Largest number of time steps per dispatch; lavapipe stops a thread after 65535 loop rounds.
constexpr uint32_t steps_a_dispatch = 16384;
/// Number of steps during which sand slumps after a stamp (a pressed shape).
constexpr int slumps = 8;
constexpr float least_m = 0.001F;   ///< stamps (pressed shapes) less than a millimetre deep are forgotten
constexpr double farthest_m = 1e12; ///< largest distance from the origin at which texels can still be counted

std::vector<float> even_ground(uint32_t side, double extent_m)
{
    if (!std::has_single_bit(side) || side < 16 || side > 1024 || !(extent_m > 0.0)) {
        throw std::logic_error(
            "a field of trails has a side of 16 to 1024 texels, a power of two, and an extent");
    }
    return std::vector<float>(static_cast<size_t>(side) * side);
}

/// Returns whether the whole stamp (a pressed shape) was inside the window before the window moved by `moved`
/// texels.
bool lay_within(const shared::TrailPress& press, glm::i64vec2 moved, uint32_t side)
{
    const glm::i64vec2 base = moved + glm::i64vec2(press.base_x, press.base_y);
    const glm::i64vec2 low = base + glm::i64vec2(press.low_x, press.low_y);
    const glm::i64vec2 high = base + glm::i64vec2(press.high_x, press.high_y);
    return glm::all(glm::greaterThanEqual(low, glm::i64vec2(0))) &&
           glm::all(glm::lessThan(high, glm::i64vec2(side)));
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

/// Converts a stamp (a pressed shape) to texels of a window. A stamp longer than the window is cut a little
/// outside the window. Positions are relative to a texel of the ground near the stamp, so that positions do
/// not depend on the window. Returns none if the stamp touches no texel.
std::optional<shared::TrailPress> press_of(const TrailStamp& stamp, uint32_t side, double texel_m,
                                           glm::i64vec2 first)
{
    const glm::i64vec2 base(glm::floor(stamp.from_m / texel_m));
    const glm::dvec2 base_m = (glm::dvec2(base) + 0.5) * texel_m;
    const glm::dvec2 from = stamp.from_m - base_m;
    const glm::dvec2 to = stamp.to_m - base_m;
    const double reach = static_cast<double>(std::max(stamp.from_radius_m, stamp.to_radius_m) +
                                             std::max(stamp.rim_m, static_cast<float>(2.0 * texel_m)));
    const glm::i64vec2 in_window = base - first;
    const glm::i64vec2 least(glm::floor((glm::min(from, to) - reach) / texel_m));
    const glm::i64vec2 most(glm::ceil((glm::max(from, to) + reach) / texel_m));
    const glm::i64vec2 last = glm::i64vec2(side) - int64_t{1} - in_window;
    if (glm::any(glm::lessThan(most, -in_window)) || glm::any(glm::greaterThan(least, last))) {
        return std::nullopt;
    }
    const auto beyond = static_cast<int64_t>(std::ceil(2.0 * reach / texel_m));
    const bool is_long = glm::any(glm::greaterThan(most - least, glm::i64vec2(side)));
    const glm::i64vec2 low = is_long ? glm::max(least, -in_window - beyond) : least;
    const glm::i64vec2 high = is_long ? glm::min(most, last + beyond) : most;
    return shared::TrailPress{.window = window_at(side, first),
                              .base_x = static_cast<int>(in_window.x),
                              .base_y = static_cast<int>(in_window.y),
                              .low_x = static_cast<int>(low.x),
                              .low_y = static_cast<int>(low.y),
                              .high_x = static_cast<int>(high.x),
                              .high_y = static_cast<int>(high.y),
                              .from = glm::vec2(from),
                              .to = glm::vec2(to),
                              .from_radius_m = stamp.from_radius_m,
                              .to_radius_m = stamp.to_radius_m,
                              .depth_m = stamp.depth_m,
                              .rim_m = std::max(stamp.rim_m, static_cast<float>(2.0 * texel_m)),
                              .texel_m = static_cast<float>(texel_m),
                              .steepness = 1.0F,
                              .moved_x = 0,
                              .moved_y = 0,
                              .is_known = 0};
}

} // namespace

TrailField::TrailField(gpu::Device& device, uint32_t side, double extent_m)
    : heights_(gpu::upload_buffer(device, "trails", even_ground(side, extent_m))), side_(side),
      texel_m_(extent_m / side)
{
}

void TrailField::press(std::span<const TrailStamp> stamps)
{
    std::copy_if(stamps.begin(), stamps.end(), std::back_inserter(waiting_), is_usable);
}

void TrailField::remember(const TrailStamp& stamp, double age_s)
{
    if (is_usable(stamp) && age_s < static_cast<double>(most_steps) / steps_a_second) {
        know({.stamp = stamp,
              .pressed_ticks = now_ticks_ - static_cast<int64_t>(age_s * ticks_a_step * steps_a_second)});
    }
}

void TrailField::pass(uint32_t ticks)
{
    now_ticks_ += ticks;
    is_placed_ = false;
}

void TrailField::know(const Known& known)
{
    known_.push_back(known);
    if (known_.size() > most_known()) {
        known_.pop_front();
    }
}

gpu::BufferId TrailField::add_press(gpu::Graph& graph, const shared::TrailPress& press, gpu::BufferId heights)
{
    auto pass = graph.compute("trails/press", shaders::trail_press_comp);
    heights = pass.modify(heights);
    pass.push(press).dispatch(1);
    return heights;
}

gpu::BufferId TrailField::add_presses(gpu::Graph& graph, gpu::BufferId heights)
{
    for (uint32_t i = 0; i < most_presses() && !waiting_.empty(); waiting_.pop_front()) {
        know({.stamp = waiting_.front(), .pressed_ticks = now_ticks_});
        if (const auto press = press_of(waiting_.front(), side_, texel_m_, first_)) {
            heights = add_press(graph, *press, heights);
            ++i;
            slumps_left_ = slumps;
        }
    }
    return heights;
}

void TrailField::go_to(const TerrainTrails& style, glm::dvec2 centre_m)
{
    if (!std::isfinite(centre_m.x + centre_m.y)) {
        return;
    }
    const glm::dvec2 middle = glm::clamp(centre_m, -farthest_m, farthest_m) / texel_m_;
    const glm::i64vec2 first = glm::i64vec2(glm::round(middle)) - static_cast<int64_t>(side_ / 2);
    if (is_placed_ && first == first_) {
        return;
    }
    // If some remembered stamps (pressed shapes) are not repeated yet, all remembered stamps are collected
    // again.
    const bool is_whole = !std::exchange(is_placed_, true) || !arriving_.empty();
    const glm::i64vec2 far(side_);
    const glm::i64vec2 moved = is_whole ? far : glm::clamp(first - first_ + moved_, -far, far);
    arriving_.clear();
    is_arriving_whole_ = is_whole;
    moved_ = moved;
    first_ = first;
    for (const Known& known : known_) {
        const double age_s =
            static_cast<double>(now_ticks_ - known.pressed_ticks) / (ticks_a_step * steps_a_second);
        TrailStamp faded = known.stamp;
        faded.depth_m *= static_cast<float>(std::exp2(-age_s / static_cast<double>(style.half_life_s)));
        auto press = faded.depth_m < least_m ? std::nullopt : press_of(faded, side_, texel_m_, first_);
        if (!press || (!is_whole && lay_within(*press, moved, side_))) {
            continue;
        }
        press->steepness = std::tan(glm::radians(style.repose_deg));
        press->moved_x = static_cast<int>(moved.x);
        press->moved_y = static_cast<int>(moved.y);
        press->is_known = 1;
        arriving_.push_back(*press);
    }
}

/// Sets the new texels of the window to level ground, and repeats the remembered stamps (pressed shapes) in
/// the new texels.
gpu::BufferId TrailField::add_arriving(gpu::Graph& graph, const TerrainTrails& style, size_t most,
                                       gpu::BufferId heights)
{
    if (moved_ != glm::i64vec2(0)) {
        heights = add_fill(graph, style, std::exchange(moved_, glm::i64vec2(0)), 0, heights);
    }
    for (size_t i = 0; i < most && !arriving_.empty(); ++i) {
        heights = add_press(graph, arriving_.front(), heights);
        arriving_.pop_front();
    }
    if (arriving_.empty() && std::exchange(is_arriving_whole_, false) && !known_.empty()) {
        for (int i = 0; i < slumps; ++i) {
            heights = add_slump(graph, style, heights);
        }
    }
    return heights;
}

void TrailField::add_catching_up(gpu::Graph& graph, const TerrainTrails& style)
{
    const gpu::BufferId heights =
        add_arriving(graph, style, 4 * most_presses(), gpu::import_whole(graph, "trails", heights_));
    graph.custom("trails").touch(heights, gpu::Access::compute_storage_read).keep();
}

gpu::BufferId TrailField::add_slump(gpu::Graph& graph, const TerrainTrails& style, gpu::BufferId heights)
{
    const double beside_m = texel_m_ * std::tan(glm::radians(static_cast<double>(style.repose_deg)));
    for (uint32_t phase = 0; phase < 4; ++phase) {
        // Sand slides within blocks of 2 x 2 texels, which take four offsets in turn. The second offset is
        // diagonal to the first offset.
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

gpu::BufferId TrailField::add_fill(gpu::Graph& graph, const TerrainTrails& style, glm::i64vec2 moved,
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
        .dispatch_over_page(side_, side_);
    return heights;
}

gpu::BufferId TrailField::add_passing_steps(gpu::Graph& graph, const TerrainTrails& style, uint32_t steps,
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

TrailImage TrailField::add_step(gpu::Graph& graph, const TerrainTrails& style, uint32_t ticks,
                                glm::dvec2 centre_m)
{
    gpu::BufferId heights = gpu::import_whole(graph, "trails", heights_);
    go_to(style, centre_m);
    heights = add_arriving(graph, style, arriving_.size(), heights);

    heights = add_presses(graph, heights);
    now_ticks_ += ticks;
    ticks_ += std::min(ticks, ticks_a_step * most_steps);
    const uint32_t steps = ticks_ / ticks_a_step;
    ticks_ %= ticks_a_step;
    heights = add_passing_steps(graph, style, steps, heights);

    auto pass = graph.compute("trails/image", shaders::trail_image_comp);
    pass.sample(heights, gpu::Format::r32f);
    const gpu::ImageId image = pass.write(
        graph.image("trails/height", {.width = side_, .height = side_, .format = gpu::Format::r32f}));
    pass.push(shared::TrailImageConstants{.window = window_at(side_, first_), .edge = side_ / 16})
        .dispatch_over_page(side_, side_);
    return {.height = image, .corner_m = glm::dvec2(first_) * texel_m_, .texel_m = texel_m_};
}

namespace {

constexpr double ticks_a_second = 120.0;
constexpr uint32_t window_texels = 1024;
/// A step of more than 2 s between two frames counts as a jump in time.
constexpr double longest_step_s = 2.0;

int64_t ticks_at(double time_s)
{
    return std::llround(time_s * ticks_a_second);
}

std::vector<TimedStamp> steps_of(const std::vector<TerrainTrack>& tracks)
{
    std::vector<TimedStamp> steps;
    for (const TerrainTrack& track : tracks) {
        const std::vector<TimedStamp> own = stamps_of(track);
        steps.insert(steps.end(), own.begin(), own.end());
    }
    std::ranges::stable_sort(steps, {}, &TimedStamp::time_s);
    return steps;
}

} // namespace

Footprints::Footprints(const TerrainDescription& terrain)
    : trails_(terrain.trails), tracks_(terrain.tracks), steps_(steps_of(tracks_))
{
}

void Footprints::set(const TerrainDescription& terrain)
{
    if (terrain.trails != trails_ || terrain.tracks != tracks_) {
        *this = Footprints(terrain);
    }
}

void Footprints::press(std::span<const TrailStamp> stamps)
{
    waiting_.insert(waiting_.end(), stamps.begin(), stamps.end());
}

void Footprints::prepare(gpu::Device& device, const FootprintMoment& moment)
{
    const bool is_back = moment.time_s < moment_.time_s;
    const bool is_same = field_ && is_made_afresh_ && waiting_.empty() && moment.time_s == moment_.time_s &&
                         moment.centre_m == moment_.centre_m;
    if (is_back) {
        std::erase_if(pressed_, [&](const TimedStamp& step) { return step.time_s > moment.time_s; });
    }
    for (const TrailStamp& stamp : waiting_) {
        pressed_.push_back({.stamp = stamp, .time_s = moment.time_s});
    }
    if (!is_same && (!moment.follows || !field_ || is_back)) {
        make_afresh(device, moment.time_s);
    } else if (!is_same) {
        walk_on(moment.time_s);
        field_->press(waiting_);
        is_made_afresh_ = false;
    }
    waiting_.clear();
    if (pressed_.size() > TrailField::most_known()) {
        pressed_.erase(pressed_.begin(), pressed_.end() - TrailField::most_known());
    }
    moment_ = moment;
    if (field_) {
        field_->go_to(trails_, moment_.centre_m);
    }
}

/// Rebuilds the trails from all stamps (pressed shapes) before a given time, each stamp at its age.
void Footprints::make_afresh(gpu::Device& device, double time_s)
{
    next_step_ = static_cast<size_t>(std::ranges::upper_bound(steps_, time_s, {}, &TimedStamp::time_s) -
                                     steps_.begin());
    std::vector<TimedStamp> all(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(next_step_));
    all.insert(all.end(), pressed_.begin(), pressed_.end());
    std::ranges::stable_sort(all, {}, &TimedStamp::time_s);
    ticks_due_ = 0;
    is_made_afresh_ = true;
    field_ = all.empty() ? nullptr : std::make_unique<TrailField>(device, window_texels, extent_m());
    for (const TimedStamp& step : all) {
        field_->remember(step.stamp, time_s - step.time_s);
    }
}

/// Presses the tracks' stamps (shapes), up to a given time, into the sand. After a jump in time, presses each
/// stamp in the state that the stamp has at its age.
void Footprints::walk_on(double time_s)
{
    const bool is_jump = time_s - moment_.time_s > longest_step_s;
    ticks_due_ = static_cast<uint32_t>(ticks_at(time_s) - ticks_at(moment_.time_s));
    if (is_jump) {
        field_->pass(std::exchange(ticks_due_, 0));
    }
    for (; next_step_ < steps_.size() && steps_[next_step_].time_s <= time_s; ++next_step_) {
        const TimedStamp& step = steps_[next_step_];
        if (is_jump) {
            field_->remember(step.stamp, time_s - step.time_s);
        } else {
            field_->press({&step.stamp, 1});
        }
    }
}

std::optional<TrailImage> Footprints::add_image(gpu::Graph& graph)
{
    if (!field_) {
        return std::nullopt;
    }
    return field_->add_step(graph, trails_, std::exchange(ticks_due_, 0), moment_.centre_m);
}

gpu::ImageId add_trail_relief(gpu::Graph& graph, const ReliefInputs& in, const TrailImage& trails)
{
    auto pass = graph.compute("trails/relief", shaders::trail_relief_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth);
    pass.sample(trails.height, gpu::Sampling::linear);
    const gpu::ImageId bent = pass.modify(in.normal);
    pass.push(shared::TrailRelief{.corner_m = glm::vec2(trails.corner_m - in.anchor_m),
                                  .texel_m = static_cast<float>(trails.texel_m),
                                  .draw = in.terrain_draw,
                                  .towards_sun = in.towards_sun})
        .dispatch_over_page(in.size_px.x, in.size_px.y);
    return bent;
}

} // namespace estampe::terrain
