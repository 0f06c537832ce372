// SPDX-License-Identifier: MIT
#include "features/ink/flowing_ink.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace estampe::features {
namespace {

constexpr uint32_t water_side = shared::ink_map_side;
const ink::Page page{.size_px = {200, 150}, .pixels_per_mm = 1.0F};

ink::InkStyle solved(float share)
{
    ink::InkStyle style;
    style.solved = share;
    return style;
}

std::vector<float> stirred(InkWater& water, const ink::InkStyle& style, const ink::Time& time,
                           const std::vector<shared::InkZone>& zones = {})
{
    gpu::Executor executor(test::shared_device());
    return water.stirred(test::shared_device(), executor, style, page, time, zones);
}

std::vector<float> fresh(const ink::InkStyle& style, const std::vector<shared::InkZone>& zones = {})
{
    InkWater water;
    return stirred(water, style, {.from_s = 0.0, .to_s = 1.0, .steps = 24, .is_fresh = true}, zones);
}

/// Velocity in mm/s, from the differences between neighbouring nodes.
glm::dvec2 velocity(const std::vector<float>& stream, uint32_t x, uint32_t y)
{
    const auto psi = [&](uint32_t right, uint32_t down) {
        return static_cast<double>(stream[(y + down) * water_side + x + right]);
    };
    const glm::dvec2 apart_mm = glm::dvec2(page.size_mm()) / static_cast<double>(water_side - 1);
    return {(psi(0, 1) - psi(0, 0)) / apart_mm.y, -(psi(1, 0) - psi(0, 0)) / apart_mm.x};
}

double rms(const std::vector<float>& stream)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < (water_side - 1) * (water_side - 1); ++i) {
        const glm::dvec2 v = velocity(stream, i % (water_side - 1), i / (water_side - 1));
        sum += glm::dot(v, v);
    }
    return std::sqrt(sum / ((water_side - 1) * (water_side - 1)));
}

TEST(InkWater, StaysOnThePageAndFlowsAboutAsFastAsWhatStirsIt)
{
    const ink::InkStyle style = solved(1.0F);
    const std::vector<float> stream = fresh(style);
    ASSERT_EQ(stream.size(), size_t{water_side} * water_side);
    for (uint32_t i = 0; i < water_side; ++i) {
        EXPECT_NEAR(stream[i], 0.0F, 1e-3F);
        EXPECT_NEAR(stream[(water_side - 1) * water_side + i], 0.0F, 1e-1F)
            << "what flows down has come from there";
        EXPECT_NEAR(stream[i * water_side], 0.0F, 1e-3F);
        EXPECT_NEAR(stream[i * water_side + water_side - 1], 0.0F, 1e-3F);
    }
    const auto swirl_mm_per_s = static_cast<double>(style.swirl_mm_per_s);
    EXPECT_NEAR(rms(stream), swirl_mm_per_s, 0.4 * swirl_mm_per_s);
    const std::vector<float> half = fresh(solved(0.5F));
    for (size_t i = 0; i < stream.size(); ++i) {
        ASSERT_FLOAT_EQ(half[i], 0.5F * stream[i]);
    }
}

void expect_to_go_on_from_what_it_was(ink::Solver solver)
{
    ink::InkStyle style = solved(1.0F);
    style.solver = solver;
    constexpr double gap_s = 1.0 / 24.0;
    const ink::Time next{.from_s = 1.0, .to_s = 1.0 + gap_s, .steps = 1, .is_fresh = false};
    InkWater water;
    const std::vector<float> before =
        stirred(water, style, {.from_s = 0.0, .to_s = 1.0, .steps = 24, .is_fresh = true});
    gpu::Executor executor(test::shared_device());
    const auto kept = water.kept(test::shared_device(), executor);
    ASSERT_TRUE(kept);
    const std::vector<float> after = stirred(water, style, next);
    double change = 0.0;
    double size = 0.0;
    for (size_t i = 0; i < after.size(); ++i) {
        change = std::max(change, std::abs(static_cast<double>(after[i] - before[i])));
        size = std::max(size, std::abs(static_cast<double>(before[i])));
    }
    EXPECT_GT(change, 0.0);
    EXPECT_LT(change, 0.2 * size);
    InkWater other;
    other.recall(*kept);
    EXPECT_EQ(stirred(other, style, next), after) << "to the bit from what was kept";
}

TEST(InkWater, GoesOnFromWhatItWas)
{
    expect_to_go_on_from_what_it_was(ink::Solver::automatic);
    expect_to_go_on_from_what_it_was(ink::Solver::mass);
}

/// The mass solver leaves sound in the water, whose divergence a stream function cannot hold.
TEST(InkWater, OfTheMassSolverStaysOnThePageToo)
{
    ink::InkStyle style = solved(1.0F);
    style.solver = ink::Solver::mass;
    const std::vector<float> stream = fresh(style);
    for (uint32_t i = 0; i < water_side; ++i) {
        EXPECT_NEAR(stream[i], 0.0F, 1e-3F);
        EXPECT_NEAR(stream[(water_side - 1) * water_side + i], 0.0F, 1e-3F);
    }
    EXPECT_NEAR(rms(stream), style.swirl_mm_per_s, 0.4 * static_cast<double>(style.swirl_mm_per_s));
}

TEST(InkWater, IsSolvedAsTheStyleSays)
{
    const auto left_by = [](ink::Solver solver, uint32_t passes) {
        ink::InkStyle style = solved(1.0F);
        style.solver = solver;
        style.jacobi_passes = passes;
        InkWater water;
        gpu::Executor executor(test::shared_device());
        static_cast<void>(water.stirred(test::shared_device(), executor, style, page,
                                        {.from_s = 0.0, .to_s = 0.5, .steps = 12, .is_fresh = true}, {},
                                        true));
        return water.solver_report().value();
    };
    const SolverReport usual = left_by(ink::Solver::automatic, 80);
    EXPECT_EQ(usual.solver, "multigrid");
    EXPECT_EQ(left_by(ink::Solver::multigrid, 80).divergence_left, usual.divergence_left);
    const SolverReport rounds = left_by(ink::Solver::jacobi, 80);
    EXPECT_EQ(rounds.solver, "jacobi");
    EXPECT_GT(rounds.divergence_left, 10.0 * usual.divergence_left);
    EXPECT_LT(left_by(ink::Solver::jacobi, 400).divergence_left, 0.8 * rounds.divergence_left);
    EXPECT_EQ(left_by(ink::Solver::mass, 80).solver, "mass");
}

TEST(InkWater, ZonesStirIt)
{
    ink::InkStyle style = solved(1.0F);
    style.swirl_mm_per_s = 0.0F;
    EXPECT_LT(rms(fresh(style)), 1e-6);
    const shared::InkZone fan{
        .middle_mm = {100.0F, 75.0F}, .radius_mm = 30.0F, .velocity_mm_per_s = {40.0F, 0.0F}};
    const std::vector<float> stream = fresh(style, {fan});
    EXPECT_GT(velocity(stream, 31, 31).x, 15.0) << "to the right in its middle";
    EXPECT_GT(velocity(stream, 46, 31).x, 1.0) << "and beyond its end, by what it pushes on";
    EXPECT_LT(velocity(stream, 31, 8).x, -0.2) << "and back along the walls";
}

} // namespace
} // namespace estampe::features
