// SPDX-License-Identifier: MIT
// The shape of ripples, by the functions of the shader, and the constants that the processor passes to it.
#include "techniques/terrain/ripples/ripples.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/glsl.hpp"

namespace estampe::terrain {

namespace ripples_in_glsl {
using namespace test::glsl; // NOLINT(google-build-using-namespace): GLSL's names are the point
#include "techniques/terrain/ripples/ripples.glsl"
} // namespace ripples_in_glsl

namespace {

namespace in_glsl = ripples_in_glsl;

const glm::vec2 cells(shared::ripple_cell_along, shared::ripple_cell_across);

TEST(Ripples, KnowHowTheirWaveChanges)
{
    constexpr float step = 1e-3F;
    for (const glm::vec2 at : {glm::vec2(0.3F, 0.4F), glm::vec2(-2.7F, 5.21F), glm::vec2(11.9F, -3.05F)}) {
        const auto wave = in_glsl::ripple_wave({7, -3}, at, 0.7F);
        const auto change = [&](glm::vec2 way) {
            return (in_glsl::ripple_wave({7, -3}, at + way, 0.7F).z -
                    in_glsl::ripple_wave({7, -3}, at - way, 0.7F).z) /
                   (2.0F * step);
        };
        EXPECT_LT(glm::distance(change({step, 0.0F}), wave.z_along), 0.01F);
        EXPECT_LT(glm::distance(change({0.0F, step}), wave.z_across), 0.01F);
    }
}

TEST(Ripples, AreGentleToWindwardAndSteepInTheLee)
{
    double sum = 0.0;
    float rise = 0.0F;
    float fall = 0.0F;
    int crests = 0;
    constexpr int count = 4000; // over ten cells
    float last = in_glsl::ripple_lean({0, 0}, {0.0F, 0.5F}, 0.0F, cells).x;
    for (int i = 1; i <= count; ++i) {
        const glm::vec2 at(10.0F * static_cast<float>(i) / count, 0.5F);
        const glm::vec2 lean = in_glsl::ripple_lean({0, 0}, at, 0.0F, cells);
        EXPECT_NEAR(lean.y, 0.0F, 1e-4F) << "straight where they do not meander";
        sum += static_cast<double>(lean.x);
        rise = std::max(rise, lean.x);
        fall = std::max(fall, -lean.x);
        crests += last > 0.0F && lean.x <= 0.0F ? 1 : 0;
        last = lean.x;
    }
    EXPECT_EQ(crests, 40) << "one a wavelength";
    EXPECT_NEAR(sum / count, 0.0, 1e-3) << "the ground stays level";
    EXPECT_GT(fall, 2.0F * rise);
}

TEST(Ripples, ForkTheMoreTheMoreTheyMeander)
{
    // Around each point where waves end, the phase makes one turn.
    const auto ends = [](float meander) {
        int count = 0;
        constexpr int side = 100;
        const auto phase = [&](int i, int j) {
            const glm::vec2 z = in_glsl::ripple_wave({0, 0}, 0.1F * glm::vec2(i, j), meander).z;
            return std::atan2(z.y, z.x);
        };
        const auto turn = [](float from, float to) {
            return std::remainder(to - from, 2.0F * glm::pi<float>());
        };
        for (int i = 0; i < side; ++i) {
            for (int j = 0; j < side; ++j) {
                const float round =
                    turn(phase(i, j), phase(i + 1, j)) + turn(phase(i + 1, j), phase(i + 1, j + 1)) +
                    turn(phase(i + 1, j + 1), phase(i, j + 1)) + turn(phase(i, j + 1), phase(i, j));
                count += std::abs(round) > 3.0F ? 1 : 0;
            }
        }
        return count;
    };
    EXPECT_EQ(ends(0.0F), 0);
    EXPECT_GT(ends(0.5F), 5);
    EXPECT_GT(ends(1.0F), ends(0.5F));
}

TEST(Ripples, GoWithTheWind)
{
    TerrainDescription terrain;
    terrain.wind.towards_deg = 0.0F;
    terrain.ripples.drift_m_per_s = 0.01F;
    const auto later = ripples_at(terrain, 1, {640.0, 0.0, 64.0}, 500.0);
    const auto upwind = ripples_at(terrain, 1, {640.0, 0.0, 59.0}, 0.0);
    ASSERT_TRUE(later && upwind);
    EXPECT_EQ(later->cell, upwind->cell);
    EXPECT_LT(glm::distance(later->rest, upwind->rest), 1e-5F);
    terrain.ripples.height_m = 0.0F;
    EXPECT_FALSE(ripples_at(terrain, 1, {640.0, 0.0, 64.0}, 500.0));
}

TEST(Ripples, KeepTheirPhaseAMillionMetresOut)
{
    TerrainDescription terrain;
    terrain.wind.towards_deg = 70.0F;
    for (const double out_m : {0.0, 1e6, -3e6}) {
        const glm::dvec3 anchor(64.0 * std::floor(out_m / 64.0), 0.0, 128.0);
        const auto here = ripples_at(terrain, 1, anchor, 12.0).value();
        const auto aside = ripples_at(terrain, 1, anchor + glm::dvec3(64.0, 0.0, -64.0), 12.0).value();
        const glm::vec2 across(-here.wind.y, here.wind.x);
        const auto at = [&](const shared::RippleConstants& ripples, glm::vec2 place) {
            return ripples.rest + glm::vec2(glm::dot(place, ripples.wind), glm::dot(place, across)) /
                                      (ripples.wavelength_m * cells);
        };
        for (int i = 0; i < 50; ++i) {
            const glm::vec2 place(30.0F + 0.07F * static_cast<float>(i), -31.0F);
            const auto lean = [&](const shared::RippleConstants& ripples, glm::vec2 from) {
                return in_glsl::ripple_lean(glm::ivec2(ripples.cell), at(ripples, from), 0.5F, cells);
            };
            EXPECT_LT(glm::distance(lean(here, place), lean(aside, place - glm::vec2(64.0F, -64.0F))), 4e-3F);
        }
    }
}

} // namespace
} // namespace estampe::terrain
