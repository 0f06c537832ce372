// SPDX-License-Identifier: MIT
// The flight of particles against known properties.
#include "techniques/particles/particles.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace estampe::particles {
namespace {

const Emitter chimney{.place = {1.0, 2.0, 3.0}, .direction = {0.0, 1.0, 0.0}};

/// A style without wind and swirls.
ParticleStyle still_air()
{
    return {.per_s = 40.0F,
            .life_s = 3.0F,
            .speed_m_per_s = 2.0F,
            .spread_deg = 0.0F,
            .wind_m_per_s = 0.0F,
            .swirl_m_per_s = 0.0F};
}

std::vector<Particle> alive(const ParticleStyle& style, double time_s)
{
    return particles_at(style, std::span(&chimney, 1), time_s);
}

TEST(Particles, SwirlsHaveNoDivergence)
{
    constexpr double h = 1e-4;
    double fastest = 0.0;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 place(0.37 * i - 60.0, 11.3 * std::sin(i), 7.7 * std::cos(3.0 * i));
        double divergence = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = h;
            divergence += (swirl(place + step, 5)[axis] - swirl(place - step, 5)[axis]) / (2.0 * h);
        }
        EXPECT_LT(std::abs(divergence), 1e-5);
        fastest = std::max(fastest, glm::length(swirl(place, 5)));
    }
    EXPECT_GT(fastest, 0.5);
    EXPECT_LT(fastest, 6.0);
}

TEST(Particles, AreAsManyAsTheirRateAndLifeSay)
{
    for (const double time_s : {0.0, 1.234, 1e5}) {
        const auto particles = alive(still_air(), time_s);
        EXPECT_NEAR(static_cast<double>(particles.size()), 120.0, 2.0) << time_s;
        for (const Particle& particle : particles) {
            EXPECT_GE(particle.age, 0.0F);
            EXPECT_LT(particle.age, 1.0F);
        }
    }
    ParticleStyle none = still_air();
    none.per_s = 0.0F;
    EXPECT_TRUE(alive(none, 3.0).empty());
}

TEST(Particles, InStillAirFlyAsAirSlowsThem)
{
    for (const Particle& particle : alive(still_air(), 5.0)) {
        const double age_s = 3.0 * static_cast<double>(particle.age);
        const double way = 0.4 * age_s + 0.6 * 0.8 * (1.0 - std::exp(-age_s / 0.8));
        const double flown_m = particle.place.y - chimney.place.y;
        const double speed_m_per_s = flown_m / way;
        EXPECT_GT(speed_m_per_s, 2.0 * 0.69);
        EXPECT_LT(speed_m_per_s, 2.0 * 1.31);
        EXPECT_NEAR(particle.place.x, chimney.place.x, 1e-9);
        EXPECT_NEAR(particle.place.z, chimney.place.z, 1e-9);
    }
}

TEST(Particles, LeaveWithinTheirSpread)
{
    ParticleStyle style = still_air();
    style.spread_deg = 25.0F;
    double widest = 0.0;
    for (const Particle& particle : alive(style, 7.0)) {
        const glm::dvec3 way = glm::normalize(particle.place - chimney.place);
        widest = std::max(widest, glm::degrees(std::acos(std::min(way.y, 1.0))));
    }
    EXPECT_LE(widest, 25.0 + 1e-6);
    EXPECT_GT(widest, 18.0);
}

TEST(Particles, MoveSmoothlyAndAreTheSameWhateverWasAskedBefore)
{
    ParticleStyle style;
    style.per_s = 20.0F;
    const auto before = alive(style, 10.0);
    const auto after = alive(style, 10.01);
    EXPECT_EQ(alive(style, 10.0).front().place, before.front().place);
    size_t found = 0;
    for (const Particle& particle : before) {
        const auto same = std::ranges::find(after, particle.trait, &Particle::trait);
        if (same != after.end()) {
            ++found;
            EXPECT_LT(glm::distance(same->place, particle.place), 0.01 * 6.0) << particle.age;
        }
    }
    EXPECT_GT(found + 3, before.size());
    EXPECT_NE(before.front().place, alive({.per_s = 20.0F, .seed = 2}, 10.0).front().place);
}

TEST(Particles, StayBehindWhenTheirEmitterMoves)
{
    // The emitter moves along x at 4 m/s and emits straight up.
    constexpr double speed = 4.0;
    constexpr double step_s = 0.15;
    Emitter moving{.place = {12.0, 0.0, 0.0}, .step_s = step_s};
    for (int i = 1; i <= 20; ++i) {
        moving.before.push_back({.place = {12.0 - speed * step_s * i, 0.0, 0.0}});
    }
    const auto particles = particles_at(still_air(), std::span(&moving, 1), 5.0);
    ASSERT_GT(particles.size(), 100U);
    for (const Particle& particle : particles) {
        const double age_s = 3.0 * static_cast<double>(particle.age);
        EXPECT_NEAR(particle.place.x, 12.0 - speed * std::min(age_s, 3.0), 1e-5) << age_s;
    }
}

TEST(Particles, AreBornOnlyWhereTheirEmitterGaveThenAndAsLargeAsItWas)
{
    Emitter emitter{.size = 3.0, .step_s = 1.0};
    emitter.before = {{.size = 1.0}, {.direction = glm::dvec3(0.0)}, {.direction = glm::dvec3(0.0)}};
    const auto particles = particles_at(still_air(), std::span(&emitter, 1), 5.0);
    EXPECT_NEAR(static_cast<double>(particles.size()), 40.0, 2.0) << "of the last of three seconds";
    for (const Particle& particle : particles) {
        EXPECT_NEAR(particle.size, 3.0F - 2.0F * 3.0F * particle.age, 1e-3F);
    }
}

} // namespace
} // namespace estampe::particles
