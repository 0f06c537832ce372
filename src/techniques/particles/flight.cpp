// SPDX-License-Identifier: MIT
// How particles are born and fly.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/constants.hpp>

#include "core/pcg.hpp"
#include "techniques/particles/particles.hpp"

namespace estampe::particles {
namespace {

double hashed(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return static_cast<double>(hash(a ^ hash(b ^ hash(c ^ hash(d)))) >> 8U) * 0x1p-24;
}

uint32_t lattice(double coordinate)
{
    return static_cast<uint32_t>(static_cast<int64_t>(coordinate));
}

/// Value noise in [0, 1] and its gradient; smooth twice, so that the gradient has no kinks.
glm::dvec3 noise_gradient(const glm::dvec3& place, uint32_t seed)
{
    const glm::dvec3 cell = glm::floor(place);
    const glm::dvec3 f = place - cell;
    const glm::dvec3 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    const glm::dvec3 slope = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    glm::dvec3 gradient(0.0);
    for (uint32_t corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at((corner & 1U) != 0 ? 1.0 : 0.0, (corner & 2U) != 0 ? 1.0 : 0.0,
                            (corner & 4U) != 0 ? 1.0 : 0.0);
        const double value =
            hashed(lattice(cell.x + at.x), lattice(cell.y + at.y), lattice(cell.z + at.z), seed);
        const glm::dvec3 weight = glm::mix(1.0 - s, s, at);
        const glm::dvec3 change = slope * (2.0 * at - 1.0);
        gradient += value * glm::dvec3(change.x * weight.y * weight.z, weight.x * change.y * weight.z,
                                       weight.x * weight.y * change.z);
    }
    return gradient;
}

/// A unit vector within `spread` of `direction`, even over that cap.
glm::dvec3 scattered(const glm::dvec3& direction, double spread_rad, double a, double b)
{
    const double up = 1.0 - a * (1.0 - std::cos(spread_rad));
    const double level = std::sqrt(std::max(1.0 - up * up, 0.0));
    const double turn = 2.0 * std::numbers::pi * b;
    const glm::dvec3 other =
        std::abs(direction.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(direction, other));
    return up * direction + level * (std::cos(turn) * right + std::sin(turn) * glm::cross(direction, right));
}

Particle fly(const ParticleStyle& style, const Emitter& emitter, uint32_t number, uint32_t emitter_number,
             double age_s)
{
    constexpr double longest_step_s = 0.35;
    constexpr double drag_s = 0.8; // in which air takes a particle along
    const auto seed = static_cast<uint32_t>(style.seed);
    const auto trait = [&](uint32_t which) { return hashed(number, emitter_number, which, seed); };
    const double bearing = glm::radians(static_cast<double>(style.wind_deg));
    const glm::dvec3 wind =
        static_cast<double>(style.wind_mps) * glm::dvec3(std::sin(bearing), 0.0, std::cos(bearing));
    const double spread_rad = glm::radians(static_cast<double>(style.spread_deg));
    const double speed = static_cast<double>(style.speed_mps) * (0.7 + 0.6 * trait(2));
    glm::dvec3 own = speed * scattered(emitter.direction, spread_rad, trait(3), trait(4));
    const auto gains = static_cast<double>(style.lift_mps2);
    const auto swirls = static_cast<double>(style.swirl_mps);
    const auto swirl_m = static_cast<double>(style.swirl_m);
    Particle particle{.place = emitter.place,
                      .velocity = own,
                      .age = static_cast<float>(age_s / static_cast<double>(style.life_s)),
                      .size = static_cast<float>(emitter.size),
                      .trait = static_cast<float>(trait(0)),
                      .trait_b = static_cast<float>(trait(1))};
    const auto steps = static_cast<int>(std::ceil(age_s / longest_step_s));
    const double step_s = steps > 0 ? age_s / steps : 0.0;
    for (int i = 0; i < steps; ++i) {
        const double at_s = (i + 0.5) * step_s;
        const double taken = 1.0 - std::exp(-at_s / drag_s);
        const auto velocity_at = [&](const glm::dvec3& place) {
            const glm::dvec3 turned = swirls * taken * swirl(place / swirl_m, seed);
            return own * (1.0 - 0.6 * taken) + wind * taken + glm::dvec3(0.0, gains * at_s, 0.0) + turned;
        };
        const glm::dvec3 middle = particle.place + 0.5 * step_s * velocity_at(particle.place);
        particle.velocity = velocity_at(middle);
        particle.place += step_s * particle.velocity;
    }
    return particle;
}

/// Where an emitter stood so long ago: straight on between what is known, and at the oldest before that.
Emitter stood(const Emitter& emitter, double ago_s)
{
    if (emitter.before.empty() || emitter.step_s <= 0.0) {
        return {.place = emitter.place, .direction = emitter.direction, .size = emitter.size};
    }
    const auto at = [&](size_t i) -> const Emitter& {
        return i == 0 ? emitter : emitter.before[std::min(i, emitter.before.size()) - 1];
    };
    const double steps = ago_s / emitter.step_s;
    const auto whole = static_cast<size_t>(steps);
    const Emitter& late = at(whole);
    const Emitter& early = at(whole + 1);
    const double part = steps - static_cast<double>(whole);
    const glm::dvec3 direction = glm::mix(late.direction, early.direction, part);
    const bool gives = late.direction != glm::dvec3(0.0) && early.direction != glm::dvec3(0.0) &&
                       glm::length(direction) > 0.0;
    return {.place = glm::mix(late.place, early.place, part),
            .direction = gives ? glm::normalize(direction) : glm::dvec3(0.0),
            .size = glm::mix(late.size, early.size, part)};
}

} // namespace

glm::dvec3 swirl(const glm::dvec3& place, uint32_t seed)
{
    const glm::dvec3 x = noise_gradient(place, 3U * seed);
    const glm::dvec3 y = noise_gradient(place + 19.1, 3U * seed + 1U);
    const glm::dvec3 z = noise_gradient(place - 27.7, 3U * seed + 2U);
    return {z.y - y.z, x.z - z.x, y.x - x.y};
}

std::vector<Particle> particles_at(const ParticleStyle& style, std::span<const Emitter> emitters,
                                   double time_s)
{
    std::vector<Particle> particles;
    const auto per_s = static_cast<double>(style.per_s);
    const auto life_s = static_cast<double>(style.life_s);
    if (per_s <= 0.0) {
        return particles;
    }
    const auto newest = static_cast<int64_t>(std::floor(time_s * per_s));
    const auto oldest = static_cast<int64_t>(std::ceil((time_s - life_s) * per_s)) - 1;
    for (uint32_t emitter = 0; emitter < emitters.size(); ++emitter) {
        for (int64_t i = oldest; i <= newest; ++i) {
            const auto number = static_cast<uint32_t>(i);
            const double born =
                (static_cast<double>(i) + hashed(number, emitter, 9U, static_cast<uint32_t>(style.seed))) /
                per_s;
            const double age_s = time_s - born;
            if (age_s < 0.0 || age_s >= life_s) {
                continue;
            }
            const Emitter then = stood(emitters[emitter], age_s);
            if (then.direction != glm::dvec3(0.0)) {
                particles.push_back(fly(style, then, number, emitter, age_s));
            }
        }
    }
    return particles;
}

} // namespace estampe::particles
