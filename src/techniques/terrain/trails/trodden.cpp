// SPDX-License-Identifier: MIT
#include "techniques/terrain/trails/trodden.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shaders/trail_relief_comp.hpp"

namespace estampe::terrain {
namespace {

constexpr double ticks_a_second = 120.0;
constexpr uint32_t side = 1024;
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

TroddenSand::TroddenSand(const TerrainDescription& terrain)
    : trails_(terrain.trails), tracks_(terrain.tracks), steps_(steps_of(tracks_))
{
}

void TroddenSand::set(const TerrainDescription& terrain)
{
    if (terrain.trails != trails_ || terrain.tracks != tracks_) {
        *this = TroddenSand(terrain);
    }
}

void TroddenSand::press(std::span<const TrailStamp> stamps)
{
    pressed_.insert(pressed_.end(), stamps.begin(), stamps.end());
}

void TroddenSand::prepare(gpu::Device& device, double time_s, glm::dvec2 centre_m)
{
    centre_m_ = centre_m;
    const bool is_back = field_ && time_s < moment_s_;
    if (is_back) {
        field_.reset();
        next_step_ = 0;
    }
    const bool has_steps = next_step_ < steps_.size() && steps_[next_step_].time_s <= time_s;
    if (!field_ && !has_steps && pressed_.empty()) {
        moment_s_ = time_s;
        return;
    }
    const bool is_new = !field_;
    if (is_new) {
        field_ = std::make_unique<TrailField>(device, side, extent_m());
        moment_s_ = time_s;
    }
    ticks_due_ = static_cast<uint32_t>(ticks_at(time_s) - ticks_at(moment_s_));
    walk_to(time_s, is_new || time_s - moment_s_ > longest_step_s);
    moment_s_ = time_s;
    field_->press(pressed_);
    pressed_.clear();
    field_->go_to(trails_, centre_m);
}

/// Presses in what tracks do until a moment; after a jump, as it is seen by then.
void TroddenSand::walk_to(double time_s, bool is_jump)
{
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

std::optional<TrailImage> TroddenSand::add_image(gpu::Graph& graph)
{
    if (!field_) {
        return std::nullopt;
    }
    return field_->add_step(graph, trails_, std::exchange(ticks_due_, 0), centre_m_);
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
        .dispatch_over(in.size_px.x, in.size_px.y);
    return bent;
}

} // namespace estampe::terrain
