// SPDX-License-Identifier: MIT
#include "demon.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace temple {
namespace {

constexpr auto dt = static_cast<float>(Demon::step_s);
constexpr float half_turn = std::numbers::pi_v<float>;

/// Returns the share of a distance that exponential smoothing with this time constant covers in one step.
float nearer(float within_s)
{
    return 1.0F - std::exp(-dt / within_s);
}

float turned_to(float from_rad, float to_rad, float share)
{
    constexpr float most_rad_s = 2.6F;
    const float off = std::remainder(to_rad - from_rad, 2.0F * half_turn);
    return from_rad + glm::clamp(share * off, -dt * most_rad_s, dt * most_rad_s);
}

glm::vec3 about_y(const glm::vec3& way, float angle_rad)
{
    const float c = std::cos(angle_rad);
    const float s = std::sin(angle_rad);
    return {c * way.x + s * way.z, way.y, -s * way.x + c * way.z};
}

} // namespace

const std::array<Strand, strand_count>& strands()
{
    static const std::array<Strand, strand_count> all{{
        {5, 0.39F, {0.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 1.0F},
        {4, 0.27F, {-0.34F, -0.42F, 0.03F}, glm::normalize(glm::vec3(-0.42F, -1.0F, 0.22F)), 0.8F},
        {4, 0.27F, {0.34F, -0.42F, 0.03F}, glm::normalize(glm::vec3(0.42F, -1.0F, 0.22F)), 0.8F},
        {4, 0.40F, {-0.2F, -0.34F, -0.2F}, glm::normalize(glm::vec3(-0.25F, -0.75F, -0.7F)), 0.4F},
        {4, 0.46F, {0.03F, -0.12F, -0.2F}, glm::normalize(glm::vec3(0.0F, -0.5F, -0.9F)), 0.35F},
        {4, 0.38F, {0.2F, -0.42F, -0.2F}, glm::normalize(glm::vec3(0.25F, -0.8F, -0.65F)), 0.4F},
    }};
    return all;
}

Demon::Demon(Haunt haunt, std::function<float(const glm::vec2&)> ground_m, Dice dice)
    : haunt_(std::move(haunt)), ground_m_(std::move(ground_m)), dice_(dice)
{
    phase_ = dice_.between(0.0F, 40.0F);
    yaw_rad_ = dice_.between(-half_turn, half_turn);
    place_m_ = glm::mix(haunt_.low_m, haunt_.high_m, glm::vec2(dice_.share(), dice_.share()));
    keep_in_haunt();
    velocity_m_s_ = {};
    goal_m_ = place_m_;
    height_m_ = ground_m_(place_m_) + head_m * haunt_.size;
    for (size_t i = 0; i < joints_.size(); ++i) {
        const Strand& strand = strands()[i];
        for (int k = 0; k <= strand.joints; ++k) {
            const glm::vec3 rest = strand.root_m + static_cast<float>(k) * strand.length_m * strand.hangs;
            joints_[i].push_back(hung(rest));
            keep_between_walls(joints_[i].back());
        }
        joint_velocities_[i].resize(joints_[i].size(), glm::vec3(0.0F));
    }
}

glm::vec3 Demon::hung(const glm::vec3& from_head) const
{
    return glm::vec3(place_m_.x, height_m_, place_m_.y) + haunt_.size * about_y(from_head, yaw_rad_);
}

void Demon::dissolve()
{
    if (mood_ != Mood::gone) {
        mood_ = Mood::dissolve;
    }
}

float Demon::stain_m() const
{
    if (mood_ == Mood::gone) {
        return 0.0F;
    }
    const float rushes =
        std::sqrt(glm::smoothstep(0.0F, 0.7F, spilled_)) * (1.0F - glm::smoothstep(0.85F, 1.0F, spilled_));
    return haunt_.size * (0.55F + 8.0F * rushes) * (1.0F - glm::smoothstep(0.97F, 1.0F, spilled_));
}

void Demon::choose_mood(const glm::vec3& walker_m)
{
    if (mood_ == Mood::dissolve || mood_ == Mood::gone) {
        return;
    }
    const float away_m = glm::distance(walker_m, glm::vec3(place_m_.x, height_m_, place_m_.y));
    // Hysteresis: a demon that is afraid of a visitor, or watches one, stays so until the visitor is a little
    // farther away.
    const float fear_m = shies_m * (mood_ == Mood::shy ? 1.35F : 1.0F);
    const float sight_m = sees_m * (mood_ == Mood::watch ? 1.2F : 1.0F);
    mood_ = away_m < fear_m ? Mood::shy : away_m < sight_m ? Mood::watch : Mood::wander;
    despair_s_ = away_m < despairs_m * haunt_.size ? despair_s_ + dt : std::max(despair_s_ - dt, 0.0F);
    if (despair_s_ > despairs_s) {
        mood_ = Mood::dissolve;
    }
}

void Demon::choose_goal(const glm::vec3& walker_m)
{
    const auto clamped = [&](const glm::vec2& place) {
        return glm::clamp(place, haunt_.low_m, haunt_.high_m);
    };
    if (mood_ == Mood::watch || mood_ == Mood::dissolve) {
        goal_m_ = place_m_;
        rests_s_ = 0.5F;
    } else if (mood_ == Mood::shy) {
        // The demon flees to the place nearby that is farthest from the visitor, so that a demon against a
        // wall slips past the visitor.
        const glm::vec2 walker(walker_m.x, walker_m.z);
        float best = -1e9F;
        for (int i = 0; i < 12; ++i) {
            const float angle = 2.0F * half_turn * static_cast<float>(i) / 12.0F;
            const glm::vec2 way(std::cos(angle), std::sin(angle));
            const glm::vec2 there = clamped(place_m_ + 2.5F * way);
            const glm::vec2 half_way = 0.5F * (place_m_ + there);
            const float worth = glm::distance(there, walker) + glm::distance(half_way, walker);
            if (worth > best + 1e-4F) {
                best = worth;
                goal_m_ = there;
            }
        }
        rests_s_ = 0.0F;
    } else if (goes_s_ += dt; glm::distance(place_m_, goal_m_) < 0.3F || goes_s_ > 14.0F) {
        // The demon gives up on a goal that it does not reach in time, because an obstacle may cover the
        // goal.
        rests_s_ -= dt;
        if (rests_s_ < 0.0F) {
            goes_s_ = 0.0F;
            const glm::vec2 share(dice_.share(), dice_.share());
            const glm::vec2 anywhere = glm::mix(haunt_.low_m, haunt_.high_m, share);
            const glm::vec2 way = anywhere - place_m_;
            goal_m_ = clamped(place_m_ + way * std::min(1.0F, 7.0F / std::max(glm::length(way), 0.01F)));
            rests_s_ = dice_.between(0.5F, 4.0F);
        }
    }
}

void Demon::move(float most_m_per_s)
{
    const glm::vec2 way = goal_m_ - place_m_;
    const float far_m = glm::length(way);
    const glm::vec2 wanted =
        far_m > 0.05F ? way / far_m * std::min(most_m_per_s, 1.2F * far_m) : glm::vec2(0.0F);
    velocity_m_s_ += nearer(mood_ == Mood::shy ? 0.35F : 0.9F) * (wanted - velocity_m_s_);
    place_m_ += dt * velocity_m_s_;
    keep_in_haunt();
    if (mood_ == Mood::wander && rests_s_ <= 0.0F) {
        goal_m_ = glm::clamp(goal_m_, haunt_.low_m, haunt_.high_m);
    }
}

void Demon::keep_in_haunt()
{
    // The demon is pushed out of obstacles several times, because a push out of a pillar may end in a wall,
    // and a push out of a wall in a pillar.
    for (int round = 0; round < 4; ++round) {
        for (const glm::vec3& pillar : haunt_.pillars) {
            const glm::vec2 off = place_m_ - glm::vec2(pillar);
            const float near_m = glm::length(off);
            if (near_m < pillar.z) {
                const glm::vec2 out = near_m > 1e-3F ? off / near_m : glm::vec2(1.0F, 0.0F);
                place_m_ = glm::vec2(pillar) + (pillar.z + 1e-3F) * out;
                velocity_m_s_ -= std::min(glm::dot(velocity_m_s_, out), 0.0F) * out;
                // Moves the demon around the pillar, not against the pillar.
                velocity_m_s_ += 0.6F * dt * glm::vec2(-out.y, out.x);
            }
        }
        for (int axis = 0; axis < 2; ++axis) {
            const float kept = glm::clamp(place_m_[axis], haunt_.low_m[axis], haunt_.high_m[axis]);
            velocity_m_s_[axis] = kept == place_m_[axis] ? velocity_m_s_[axis] : 0.0F;
            place_m_[axis] = kept;
        }
    }
}

void Demon::look(const glm::vec3& walker_m)
{
    const glm::vec3 head(place_m_.x, height_m_, place_m_.y);
    const glm::vec3 to_walker = walker_m - head;
    const bool is_looking = mood_ == Mood::watch || mood_ == Mood::shy || mood_ == Mood::dissolve;
    if (is_looking) {
        // A fleeing demon looks back.
        yaw_rad_ = turned_to(yaw_rad_, std::atan2(to_walker.x, to_walker.z), nearer(0.5F));
    } else if (glm::length(velocity_m_s_) > 0.1F) {
        yaw_rad_ = turned_to(yaw_rad_, std::atan2(velocity_m_s_.x, velocity_m_s_.y), nearer(0.8F));
    }
    const float level_m = std::max(glm::length(glm::vec2(to_walker.x, to_walker.z)), 0.5F);
    const float pitch = is_looking ? glm::clamp(-std::atan2(to_walker.y, level_m), -0.5F, 0.6F) : 0.1F;
    pitch_rad_ += nearer(0.4F) * (pitch - pitch_rad_);
    until_blink_s_ -= dt;
    if (until_blink_s_ < -0.16F) {
        until_blink_s_ = dice_.between(1.5F, 7.0F);
    }
    const float open = mood_ == Mood::shy ? 1.25F : mood_ == Mood::watch ? 1.05F : 0.8F;
    const float wanted = mood_ == Mood::dissolve ? std::max(1.2F - 2.0F * spilled_, 0.0F)
                         : until_blink_s_ < 0.0F ? 0.05F
                                                 : open;
    eyes_ += nearer(0.05F) * (wanted - eyes_);
}

void Demon::keep_between_walls(glm::vec3& joint) const
{
    if (!haunt_.is_on_floor) {
        return;
    }
    const float beyond_m = half_width_m * haunt_.size;
    joint.x = glm::clamp(joint.x, haunt_.low_m.x - beyond_m, haunt_.high_m.x + beyond_m);
    joint.z = glm::clamp(joint.z, haunt_.low_m.y - beyond_m, haunt_.high_m.y + beyond_m);
}

void Demon::drift(const glm::vec2& wind_m_per_s)
{
    constexpr float damping_per_s = 3.2F;
    const float size = haunt_.size;
    const auto time = static_cast<float>(std::fmod(time_s_, 4096.0)) + phase_;
    const float indoors = haunt_.is_on_floor ? 0.2F : 1.0F;
    for (size_t i = 0; i < joints_.size(); ++i) {
        const Strand& strand = strands()[i];
        std::vector<glm::vec3>& joints = joints_[i];
        // Sleeves and ribbons start at the shoulders. The shoulders follow the head with a delay, as the body
        // does.
        const glm::vec3 lag = i == 0 ? glm::vec3(0.0F)
                                     : (joints_[0][1] - hung(-strands()[0].length_m * glm::vec3(0, 1, 0))) *
                                           (-strand.root_m.y / strands()[0].length_m);
        joints[0] = hung(strand.root_m) + lag;
        for (size_t k = 1; k < joints.size(); ++k) {
            const auto down = static_cast<float>(k);
            const float length_m = size * strand.length_m * (1.0F + 0.35F * spilled_);
            const glm::vec3 rest = joints[k - 1] + length_m * about_y(strand.hangs, yaw_rad_);
            const float wave = 0.9F * time - 0.7F * down + 1.9F * static_cast<float>(i);
            const glm::vec3 sway(std::sin(1.7F * wave) + 0.6F * std::sin(2.9F * wave + 1.0F),
                                 0.7F * std::sin(2.3F * wave + 0.5F) + 0.4F, std::cos(1.3F * wave));
            const float loose = down / static_cast<float>(strand.joints);
            glm::vec3& velocity = joint_velocities_[i][k];
            const float spring = 46.0F * strand.stiffness / (1.0F + 1.6F * loose);
            const glm::vec3 air = 0.55F * indoors * glm::vec3(wind_m_per_s.x, 0.0F, wind_m_per_s.y) +
                                  (0.9F + 1.6F * loose) * sway;
            velocity += dt * (spring * (rest - joints[k]) / size + loose * air);
            velocity *= std::exp(-damping_per_s * dt);
            joints[k] += dt * velocity;
            // A segment of a sleeve or ribbon stretches by a fifth at most; a compressed segment lengthens
            // gradually.
            const glm::vec3 off = joints[k] - joints[k - 1];
            const float far_m = glm::length(off);
            const float opens_m = std::max(far_m, std::min(far_m + 0.02F, 0.8F * length_m));
            const float kept_m = std::min(opens_m, 1.2F * length_m);
            joints[k] = far_m > 1e-4F ? joints[k - 1] + kept_m / far_m * off : rest;
            keep_between_walls(joints[k]);
        }
    }
}

void Demon::step(const glm::vec3& walker_m, const glm::vec2& wind_m_per_s)
{
    time_s_ += step_s;
    if (mood_ == Mood::gone) {
        return;
    }
    choose_mood(walker_m);
    choose_goal(walker_m);
    move(mood_ == Mood::shy ? 3.2F : 0.75F);
    look(walker_m);
    if (mood_ == Mood::dissolve) {
        dissolving_s_ += dt;
        spilled_ = glm::smoothstep(0.0F, dissolves_s, dissolving_s_);
        if (dissolving_s_ >= dissolves_s) {
            spilled_ = 1.0F;
            mood_ = Mood::gone;
        }
    }
    const auto time = static_cast<float>(std::fmod(time_s_, 4096.0)) + phase_;
    const float crouch = mood_ == Mood::shy ? 0.25F : 0.0F;
    const float hovers_m = 0.09F * std::sin(1.1F * time) + 0.05F * std::sin(2.3F * time + 2.0F) - crouch;
    const float wanted_m =
        ground_m_(place_m_) + haunt_.size * (head_m + hovers_m) * (1.0F - 0.55F * spilled_);
    height_m_ += nearer(0.35F) * (wanted_m - height_m_);
    drift(wind_m_per_s);
}

} // namespace temple
