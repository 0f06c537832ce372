// SPDX-License-Identifier: MIT
#include "techniques/terrain/trails/footprints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shaders/trail_relief_comp.hpp"

namespace estampe::terrain {
namespace {

constexpr double ticks_a_second = 120.0;
constexpr uint32_t window_texels = 1024;
constexpr double longest_step_s = 2.0; ///< beyond it time has jumped

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

/// What has been pressed in by a moment, as old as it is then.
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

/// Presses in what tracks do until a moment; after a jump, as it is seen by then.
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
