// SPDX-License-Identifier: MIT
#include "walker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace walk {
namespace {

/// Distance between the points of a foot's sole at which the height of the ground is sampled.
constexpr double sole_m = 0.15;

/// Depth to which a body may penetrate a solid without being pushed out.
constexpr float tolerance_m = 0.015F;

struct Depth {
    float depth_m = 0.0F;
    glm::vec3 out{0.0F}; ///< Direction in which the body must be pushed, a unit vector
};

/// Finds the triangle that a capsule penetrates most deeply.
Depth deepest(const glm::vec3& low, const glm::vec3& high, float radius_m, const std::vector<Triangle>& near)
{
    Depth worst;
    for (const Triangle& triangle : near) {
        const Nearest pair = nearest(low, high, triangle);
        const glm::vec3 out = pair.on_segment - pair.on_triangle;
        const float distance_m = glm::length(out);
        if (radius_m - distance_m > worst.depth_m) {
            worst.depth_m = radius_m - distance_m;
            worst.out = distance_m > 1e-6F ? out / distance_m : glm::vec3(0.0F);
        }
    }
    return worst;
}

} // namespace

std::optional<Footing> Place::footing(const glm::dvec3& place_m, const Body& body, double drop_m) const
{
    const Sand sand = sand_({place_m.x, place_m.z});
    std::optional<Footing> highest;
    if (sand.height_m >= place_m.y - drop_m) {
        highest = {sand.height_m, glm::normalize(glm::dvec3(-sand.slope.x, 1.0, -sand.slope.y)), true};
    }
    constexpr std::array<glm::dvec2, 5> touches{
        {{0.0, 0.0}, {sole_m, 0.0}, {-sole_m, 0.0}, {0.0, sole_m}, {0.0, -sole_m}}};
    const double from_m = place_m.y + static_cast<double>(body.step_m);
    for (const glm::dvec2& off : touches) {
        const std::optional<Support> stone = solids_->below({place_m.x + off.x, from_m, place_m.z + off.y},
                                                            static_cast<float>(from_m - place_m.y + drop_m));
        // Least height, above the middle of the sole, at which another point of the sole gives the ground's
        // height and normal.
        constexpr double flush_m = 1e-3;
        if (stone && (!highest || static_cast<double>(stone->height_m) > highest->height_m + flush_m)) {
            highest = {static_cast<double>(stone->height_m), glm::dvec3(stone->normal), false};
        }
    }
    return highest;
}

std::optional<glm::dvec3> Place::pushed_out(const glm::dvec3& feet_m, const Body& body) const
{
    // The body's capsule begins above the height of a step. The feet handle obstacles that are lower.
    const float low_m = body.step_m + body.radius_m;
    const float high_m = std::max(low_m, body.height_m - body.radius_m);
    const float around_m = 2.0F * body.radius_m;
    const glm::vec3 feet(feet_m);
    near_.clear();
    solids_->find(feet + glm::vec3(-around_m, body.step_m, -around_m),
                  feet + glm::vec3(around_m, body.height_m, around_m), near_);
    glm::vec3 off(0.0F);
    constexpr int rounds = 12;
    for (int round = 0; round < rounds; ++round) {
        const glm::vec3 at = feet + off;
        const Depth worst = deepest(at + glm::vec3(0.0F, low_m, 0.0F), at + glm::vec3(0.0F, high_m, 0.0F),
                                    body.radius_m, near_);
        if (worst.depth_m < 1e-4F) {
            return feet_m + glm::dvec3(off);
        }
        const glm::vec2 level(worst.out.x, worst.out.z);
        const float length = glm::length(level);
        // If the horizontal part of the normal is shorter, the surface is a ceiling or a floor.
        constexpr float flattest = 0.2F;
        if (length < flattest) {
            return worst.depth_m < tolerance_m ? std::optional(feet_m + glm::dvec3(off)) : std::nullopt;
        }
        const glm::vec2 push =
            level / length * std::min((worst.depth_m + 1e-4F) / length, 0.5F * body.radius_m);
        off += glm::vec3(push.x, 0.0F, push.y);
        if (glm::length(off) > body.radius_m) {
            return std::nullopt;
        }
    }
    const glm::vec3 at = feet + off;
    const Depth left =
        deepest(at + glm::vec3(0.0F, low_m, 0.0F), at + glm::vec3(0.0F, high_m, 0.0F), body.radius_m, near_);
    return left.depth_m < tolerance_m ? std::optional(feet_m + glm::dvec3(off)) : std::nullopt;
}

namespace {

constexpr double gravity_m_s2 = 9.81;
constexpr double fastest_fall_m_per_s = 25.0;

glm::dvec2 level(const glm::dvec3& of)
{
    return {of.x, of.z};
}

/// Returns the vector `from`, moved towards `to` by at most the length `most`.
glm::dvec2 towards(const glm::dvec2& from, const glm::dvec2& to, double most)
{
    const double length = glm::length(to - from);
    return length <= most ? to : from + most / length * (to - from);
}

} // namespace

Walker::Walker(Place place, const Body& body, const glm::dvec3& feet_m)
    : place_(std::move(place)), body_(body), feet_m_(feet_m)
{
    put(feet_m);
}

void Walker::put(const glm::dvec3& feet_m)
{
    feet_m_ = feet_m;
    velocity_m_s_ = glm::dvec3(0.0);
    feet_m_.y = std::max(feet_m_.y, place_.sand(level(feet_m)).height_m);
    const std::optional<Footing> under = place_.footing(feet_m_, body_, 0.05);
    is_on_ground_ = under.has_value();
    if (under) {
        footing_ = *under;
        feet_m_.y = under->height_m;
    }
    is_sliding_ = false;
    left_s_ = 0.0;
    eye_height_m_ = feet_m_.y + static_cast<double>(body_.eye_m);
    eye_before_m_ = {feet_m_.x, eye_height_m_, feet_m_.z};
}

void Walker::advance(const Intent& intent, double seconds)
{
    left_s_ += seconds;
    while (left_s_ >= step_s) {
        left_s_ -= step_s;
        step(intent);
    }
}

glm::dvec3 Walker::eye_m() const
{
    return glm::mix(eye_before_m_, glm::dvec3(feet_m_.x, eye_height_m_, feet_m_.z), left_s_ / step_s);
}

void Walker::step(const Intent& intent)
{
    eye_before_m_ = {feet_m_.x, eye_height_m_, feet_m_.z};
    const glm::dvec3 from_m = feet_m_;
    steer(intent);
    if (intent.jumps && is_on_ground_ && !is_sliding_) {
        velocity_m_s_.y = static_cast<double>(body_.jump_m_per_s);
        is_on_ground_ = false;
    }
    // The motion is divided into steps, so that the body does not pass through thin obstacles.
    const glm::dvec2 way_m = level(velocity_m_s_) * step_s;
    const int parts = 1 + static_cast<int>(glm::length(way_m) / (0.25 * static_cast<double>(body_.radius_m)));
    for (int part = 0; part < parts; ++part) {
        if (!go(way_m / static_cast<double>(parts))) {
            break;
        }
    }
    // Obstacles can reduce the walker's speed, but not increase it.
    const glm::dvec2 gone_m = level(feet_m_ - from_m);
    const double speed = glm::length(level(velocity_m_s_));
    const glm::dvec2 real = gone_m / step_s;
    const glm::dvec2 kept = glm::length(real) > speed ? real * (speed / glm::length(real)) : real;
    velocity_m_s_.x = kept.x;
    velocity_m_s_.z = kept.y;
    rise_or_fall();
    leave_prints(from_m);
    carry_eye();
}

void Walker::steer(const Intent& intent)
{
    glm::dvec2 way = intent.way;
    if (const double length = glm::length(way); length > 1.0) {
        way /= length;
    }
    glm::dvec2 wanted = way * static_cast<double>(intent.runs ? body_.run_m_per_s : body_.walk_m_per_s);
    glm::dvec2 now = level(velocity_m_s_);
    is_sliding_ = false;
    if (!is_on_ground_) {
        constexpr double in_air_m_s2 = 2.0;
        now = glm::length(way) > 0.0 ? towards(now, wanted, in_air_m_s2 * step_s) : now;
    } else {
        const glm::dvec2 slope = -level(footing_.normal) / footing_.normal.y;
        const double steep = glm::length(slope);
        const double limit = std::tan(
            glm::radians(static_cast<double>(footing_.is_sand ? body_.repose_deg : body_.steepest_deg)));
        // On sand, each step uphill is shortened, because the feet slide back.
        if (footing_.is_sand && glm::length(wanted) > 0.0) {
            wanted /= 1.0 + 1.3 * std::max(0.0, glm::dot(slope, glm::normalize(wanted)));
        }
        double grip_m_s2 = 14.0;
        if (steep > limit) {
            is_sliding_ = true;
            const glm::dvec2 up = slope / steep;
            // On a slope that is too steep, the walker may still move across the slope and down, but not up.
            wanted -= up * std::max(0.0, glm::dot(wanted, up));
            // On a slope that is too steep, the walker slides; friction of the sand slows the slide down.
            constexpr double drag_a_s = 1.6;
            const double sine = steep / std::sqrt(1.0 + steep * steep);
            const double over = sine - 0.8 * limit / std::sqrt(1.0 + steep * steep);
            now += -up * (gravity_m_s2 * over * step_s);
            now -= now * (drag_a_s * step_s);
            grip_m_s2 = 2.5;
            const double down = std::max(0.0, glm::dot(now, -up));
            wanted += -up * std::max(0.0, down - std::max(0.0, glm::dot(wanted, -up)));
        }
        now = towards(now, wanted, grip_m_s2 * step_s);
    }
    velocity_m_s_.x = now.x;
    velocity_m_s_.z = now.y;
}

bool Walker::go(const glm::dvec2& way_m)
{
    if (way_m == glm::dvec2(0.0)) {
        return true;
    }
    const auto try_place = [&](const glm::dvec3& wanted) {
        std::optional<glm::dvec3> there = place_.pushed_out(wanted, body_);
        if (!there) {
            return false;
        }
        if (const std::optional<Footing> under = place_.footing(*there, body_, 0.0)) {
            const double rise_m = under->height_m - there->y;
            if (rise_m > static_cast<double>(body_.step_m)) {
                return false; // The way is blocked by a bank of sand that is as steep as a wall
            }
            if (rise_m > 0.0) {
                there->y = under->height_m;
                const std::optional<glm::dvec3> above = place_.pushed_out(*there, body_);
                if (!above || glm::distance(*above, *there) > 1e-3) {
                    return false;
                }
            }
        }
        // A last check guarantees that the body never passes through a solid.
        const glm::vec3 waist(0.0F, 0.6F * body_.height_m, 0.0F);
        if (place_.solids().blocks(glm::vec3(feet_m_) + waist, glm::vec3(*there) + waist)) {
            return false;
        }
        feet_m_ = *there;
        return true;
    };
    const glm::dvec3 whole = feet_m_ + glm::dvec3(way_m.x, 0.0, way_m.y);
    // If the whole way is blocked, moving along one axis may be possible.
    return try_place(whole) || try_place(feet_m_ + glm::dvec3(way_m.x, 0.0, 0.0)) ||
           try_place(feet_m_ + glm::dvec3(0.0, 0.0, way_m.y));
}

void Walker::rise_or_fall()
{
    const auto step_m = static_cast<double>(body_.step_m);
    if (is_on_ground_) {
        // The walker is moved down to the ground, if the ground is within reach of a foot.
        if (const std::optional<Footing> under = place_.footing(feet_m_, body_, step_m)) {
            footing_ = *under;
            feet_m_.y = under->height_m;
            velocity_m_s_.y = 0.0;
            return;
        }
        is_on_ground_ = false;
        velocity_m_s_.y = 0.0;
    }
    velocity_m_s_.y = std::max(velocity_m_s_.y - gravity_m_s2 * step_s, -fastest_fall_m_per_s);
    const double drop_m = -velocity_m_s_.y * step_s;
    if (drop_m < 0.0) {
        const glm::dvec3 higher = feet_m_ - glm::dvec3(0.0, drop_m, 0.0);
        const std::optional<glm::dvec3> there = place_.pushed_out(higher, body_);
        if (there && glm::distance(*there, higher) < 1e-3) {
            feet_m_ = higher;
        } else {
            velocity_m_s_.y = 0.0;
        }
        return;
    }
    if (const std::optional<Footing> under = place_.footing(feet_m_, body_, drop_m)) {
        footing_ = *under;
        feet_m_.y = under->height_m;
        is_on_ground_ = true;
        velocity_m_s_.y = 0.0;
        return;
    }
    const std::optional<glm::dvec3> there = place_.pushed_out(feet_m_ - glm::dvec3(0.0, drop_m, 0.0), body_);
    if (there) {
        feet_m_ = *there;
    } else { // The body stands on an obstacle, and may walk or jump from there
        footing_ = {feet_m_.y, {0.0, 1.0, 0.0}, false};
        is_on_ground_ = true;
        velocity_m_s_.y = 0.0;
    }
}

void Walker::leave_prints(const glm::dvec3& from_m)
{
    const glm::dvec2 way_m = level(feet_m_ - from_m);
    const double length_m = glm::length(way_m);
    if (!is_on_sand() || length_m < 1e-9) {
        return;
    }
    gone_m_ += length_m;
    const glm::dvec2 ahead = way_m / length_m;
    const glm::dvec2 aside = glm::dvec2(-ahead.y, ahead.x);
    constexpr double slide_m = 0.3;
    if (is_sliding_) {
        if (gone_m_ > slide_m) {
            const glm::dvec2 at = level(feet_m_);
            for (const double side : {-0.13, 0.13}) {
                prints_.push_back(estampe::TrailStamp::drag(at - ahead * gone_m_ + side * aside,
                                                            at + side * aside, 0.11F, 0.06F));
            }
            gone_m_ = 0.0;
        }
        return;
    }
    const double speed = length_m / step_s;
    const double stride_m = glm::mix(0.66, 1.15, glm::smoothstep(1.5, 4.5, speed));
    if (gone_m_ > stride_m) {
        gone_m_ = 0.0;
        is_left_foot_ = !is_left_foot_;
        const glm::dvec2 at = level(feet_m_) + (is_left_foot_ ? -0.11 : 0.11) * aside;
        prints_.push_back(estampe::TrailStamp::foot(at, ahead, 0.32F, speed > 3.0 ? 0.075F : 0.055F));
    }
}

std::vector<estampe::TrailStamp> Walker::take_prints()
{
    return std::exchange(prints_, {});
}

void Walker::carry_eye()
{
    const double wanted_m = feet_m_.y + static_cast<double>(body_.eye_m);
    constexpr double follows_a_s = 11.0;
    eye_height_m_ += (wanted_m - eye_height_m_) * (1.0 - std::exp(-follows_a_s * step_s));
    const auto most_m = static_cast<double>(body_.step_m);
    eye_height_m_ = std::clamp(eye_height_m_, wanted_m - most_m, wanted_m + 0.1);
}

} // namespace walk
