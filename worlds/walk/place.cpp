// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "walker.hpp"

namespace walk {
namespace {

/// Between the places where a sole touches.
constexpr double sole_m = 0.15;

/// How deep a body may be in something and still have room.
constexpr float tolerance_m = 0.015F;

struct Depth {
    float depth_m = 0.0F;
    glm::vec3 out{0.0F}; ///< unit, towards the body
};

/// The triangle that a capsule is deepest in.
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
        constexpr double flush_m = 1e-3; // the middle says how the ground lies
        if (stone && (!highest || static_cast<double>(stone->height_m) > highest->height_m + flush_m)) {
            highest = {static_cast<double>(stone->height_m), glm::dvec3(stone->normal), false};
        }
    }
    return highest;
}

std::optional<glm::dvec3> Place::pushed_out(const glm::dvec3& feet_m, const Body& body) const
{
    // What is lower than a step is for the feet.
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
        constexpr float flattest = 0.2F; // a wall that leans so far over is a ceiling, or a floor
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

} // namespace walk
