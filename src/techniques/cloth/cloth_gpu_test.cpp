// SPDX-License-Identifier: MIT
// Cloth stretches little, passes through nothing, and recovers from every state.
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

/// Sorted strains of a sheet's edges after the sheet was released, held by two corners.
std::vector<double> strained_by_hanging(uint32_t particles, std::optional<ClothSolver> solver = {})
{
    Sheet sheet = lying_square(particles, 0.0F);
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    sheet.held.front() = 1.0F;
    sheet.held[particles - 1] = 1.0F;
    Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    lab.cloths().set_solver(test::shared_device(), solver);
    return strains(sheet, lab.run(5.0));
}

/// Particles along a side. ESTAMPE_LONG adds finer sheets, which take most of a minute.
std::vector<uint32_t> finenesses()
{
    if (std::getenv("ESTAMPE_LONG") != nullptr) {
        return {32, 64, 128};
    }
    return {32};
}

TEST(Cloth, HangsByTwoCornersWithoutStretching)
{
    for (const uint32_t particles : finenesses()) {
        const auto strained = strained_by_hanging(particles);
        EXPECT_LE(percentile(strained, 0.99), 0.02) << particles;
        EXPECT_LE(strained.back(), 0.03) << particles;
    }
}

TEST(Cloth, ThesisMethodStretchesMore)
{
    EXPECT_GT(percentile(strained_by_hanging(32, ClothSolver::verlet), 0.99), 0.03);
}

TEST(Cloth, BlockDescentStretchesLittle)
{
    const auto strained = strained_by_hanging(20, ClothSolver::block_descent);
    EXPECT_LE(percentile(strained, 0.99), 0.03);
    EXPECT_LE(percentile(strained, 0.5), 0.005); // tethers alone would not achieve this
}

TEST(Cloth, BlockDescentAgreesWithSmallSteps)
{
    // A stiff strip, clamped at one end, droops equally as a grid and with lists of links.
    for (const bool is_grid : {true, false}) {
        std::array<double, 2> droop_m{};
        for (const bool descends : {false, true}) {
            Sheet sheet = grid_sheet({13, 5}, {0.0F, 0.0F, 0.0F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.13F},
                                     {.bending_n_m = 2e-2F, .damping_per_s = 8.0F});
            sheet.held.assign(sheet.rest_m.size(), 0.0F);
            for (size_t i = 0; i < sheet.rest_m.size(); ++i) {
                sheet.held[i] = i % 13 < 2 ? 1.0F : 0.0F;
                sheet.rest_m[i].z += is_grid ? 0.0F : 2e-3F * std::sin(40.0F * sheet.rest_m[i].x);
            }
            Lab lab(sheet);
            lab.cloths().set_solver(test::shared_device(),
                                    descends ? ClothSolver::block_descent : ClothSolver::small_steps);
            droop_m.at(descends ? 1 : 0) = -lab.run(1.5).places_m[13 * 2 + 12].y;
        }
        EXPECT_GT(droop_m[0], 0.05) << is_grid;
        EXPECT_NEAR(droop_m[1], droop_m[0], 0.05 * droop_m[0]) << is_grid;
    }
}

TEST(Cloth, SolversTakeTurns)
{
    Sheet sheet = hanging_square(20);
    sheet.held.front() = 1.0F;
    Lab lab(sheet);
    double lowest_m = 0.0;
    for (const ClothSolver solver : {ClothSolver::small_steps, ClothSolver::verlet,
                                     ClothSolver::block_descent, ClothSolver::small_steps}) {
        lab.cloths().set_solver(test::shared_device(), solver);
        const State state = lab.run(2.0);
        lowest_m = 0.0;
        for (const glm::dvec3& place : state.places_m) {
            ASSERT_TRUE(std::isfinite(place.x));
            lowest_m = std::min(lowest_m, place.y);
        }
        EXPECT_LT(lowest_m, -1.2);
    }
    EXPECT_GT(lowest_m, -1.0 * std::numbers::sqrt2 - 0.02);
}

TEST(Cloth, LargeAndSmallWaysAgree)
{
    // 33 x 33 goes by a dispatch a step, 32 x 32 by a workgroup a sheet: half of the first is as the second.
    const auto lowest = [](uint32_t side, uint32_t other) {
        Sheet sheet = grid_sheet({side, other}, {}, {0.5F, 0.0F, 0.0F}, {0.0F, -0.5F, 0.0F});
        sheet.held.assign(sheet.rest_m.size(), 0.0F);
        sheet.held[0] = 1.0F;
        Lab lab(sheet);
        lab.air.effort = 1.0F;
        const State state = lab.run(0.6);
        return state.places_m.back();
    };
    EXPECT_LE(glm::distance(lowest(32, 32), lowest(33, 32)), 0.02);
}

/// State of a sheet that is pulled, blown and passed by solids, with this many threads.
State blown(const Sheet& sheet, bool is_wide)
{
    Lab lab(sheet);
    lab.cloths().set_wide(test::shared_device(), is_wide);
    lab.air.air_kg_m3 = 1.2F;
    lab.air.wind = {.speed_m_per_s = 5.0F, .towards_deg = 10.0F};
    State state;
    for (int i = 0; i < 10; ++i) {
        const float way_m = 0.03F * static_cast<float>(i);
        lab.move_to([&](glm::vec3 rest) { return rest + glm::vec3(way_m, 0.0F, 0.0F); });
        lab.cloths().set_solids(test::shared_device(), std::array{ball({way_m, -0.5F, 0.1F}, 0.2F),
                                                                  Solid{.kind = SolidKind::box,
                                                                        .half_m = {2.0F, 0.1F, 2.0F},
                                                                        .centre_m = {0.0F, -1.0F, 0.0F}}});
        state = lab.run(1.0 / 30.0);
    }
    return state;
}

TEST(Cloth, IsOnAProcessorWhatItIsOnAGpu)
{
    const auto cut = [](uint32_t columns, uint32_t rows) {
        Sheet sheet = grid_sheet({columns, rows}, {}, {1.0F, 0.0F, 0.0F}, {0.0F, -0.8F, 0.1F});
        sheet.held.assign(sheet.rest_m.size(), 0.0F);
        std::fill_n(sheet.held.begin(), columns / 2, 1.0F);
        return sheet;
    };
    // As large as they get, narrow and broad ones that end within a thread's share, lists.
    for (const Sheet& sheet :
         {cut(32, 32), cut(5, 190), cut(250, 4), cut(7, 9), out_of_rank(cut(31, 33), 1e-3F)}) {
        const State by_few = blown(sheet, false);
        const State by_many = blown(sheet, true);
        EXPECT_TRUE(by_many.places_m == by_few.places_m) << sheet.rest_m.size();
        EXPECT_TRUE(by_many.speeds_m_per_s == by_few.speeds_m_per_s) << sheet.rest_m.size();
        EXPECT_GT(glm::distance(by_few.places_m.back(), glm::dvec3(sheet.rest_m.back())), 0.05) << "it blows";
    }
}

TEST(Cloth, WhatIsHeldALittleComesNearer)
{
    for (const uint32_t side : {10U, 34U}) {
        std::array<double, 2> forward_m{};
        for (const float share : {0.0F, 0.1F}) {
            Sheet sheet = hanging_square(side);
            std::fill_n(sheet.held.begin(), side, 1.0F);
            sheet.held.back() = share;
            Lab lab(sheet);
            lab.move_to([](glm::vec3 rest) {
                return rest + glm::vec3(0.0F, 0.0F, rest.x > 0.99F && rest.y < -0.99F ? 0.2F : 0.0F);
            });
            forward_m.at(share > 0.0F ? 1 : 0) = lab.run(1.0).places_m.back().z;
        }
        EXPECT_NEAR(forward_m[0], 0.0, 1e-3) << side;
        EXPECT_NEAR(forward_m[1], 0.2, 0.05) << side;
    }
}

TEST(Cloth, IrregularMeshesHangInAllSolvers)
{
    for (const ClothSolver solver :
         {ClothSolver::small_steps, ClothSolver::verlet, ClothSolver::block_descent}) {
        Sheet sheet = out_of_rank(hanging_square(16), 0.01F);
        sheet.held[0] = 1.0F;
        sheet.held[15] = 1.0F;
        Lab lab(sheet);
        lab.air.air_kg_m3 = 1.2F;
        lab.cloths().set_solver(test::shared_device(), solver);
        const auto strained = strains(sheet, lab.run(3.0));
        RecordProperty(fmt::format("strain_99_per_10000_{}", static_cast<int>(solver)),
                       static_cast<int>(1e4 * percentile(strained, 0.99)));
        EXPECT_LE(percentile(strained, 0.99), solver == ClothSolver::verlet ? 0.05 : 0.03)
            << static_cast<int>(solver);
    }
}

TEST(Cloth, ThesisMethodHoldsWholeEdges)
{
    Sheet sheet = hanging_square(12);
    std::fill_n(sheet.held.begin(), 12, 1.0F);
    Lab lab(sheet);
    lab.cloths().set_solver(test::shared_device(), ClothSolver::verlet);
    for (const glm::dvec3& place : lab.run(1.0).places_m) {
        ASSERT_LE(glm::length(place), 2.0); // fails for NaN, too
    }
}

/// Whether friction holds a sheet on a slope.
bool sticks(float slope_deg, float friction)
{
    const float slope_rad = slope_deg * std::numbers::pi_v<float> / 180.0F;
    const glm::vec3 normal(std::sin(slope_rad), std::cos(slope_rad), 0.0F);
    const glm::vec3 down(std::cos(slope_rad), -std::sin(slope_rad), 0.0F);
    Cloth cloth{.damping_per_s = 0.0F, .friction = friction};
    Lab lab(grid_sheet({8, 8}, cloth.thickness_m * normal, 0.2F * down, {0.0F, 0.0F, -0.2F}, cloth));
    const std::array slope{below({}, normal)};
    lab.cloths().set_solids(test::shared_device(), slope);
    const State begin = lab.run(0.2);
    const State end = lab.run(1.0);
    return glm::distance(begin.places_m.front(), end.places_m.front()) < 0.01;
}

TEST(Cloth, SticksOnSlopesAsFrictionSays)
{
    const float limit_deg = std::atan(0.5F) * 180.0F / std::numbers::pi_v<float>;
    EXPECT_TRUE(sticks(limit_deg - 1.0F, 0.5F));
    EXPECT_FALSE(sticks(limit_deg + 1.0F, 0.5F));
}

TEST(Cloth, BallPushedThroughIsNeverWithin)
{
    Sheet sheet = hanging_square(24);
    sheet.held.front() = 1.0F;
    sheet.held[23] = 1.0F;
    Lab lab(sheet);
    constexpr float radius_m = 0.2F;
    constexpr float speed_m_per_s = 5.0F;
    lab.cloths().set_solids(test::shared_device(), std::array{ball({0.5F, -0.5F, -0.6F}, radius_m)});
    double deepest_m = 0.0;
    for (int step = 1; step <= 40; ++step) {
        const glm::vec3 centre(0.5F, -0.5F, -0.6F + speed_m_per_s * static_cast<float>(step) / 120.0F);
        lab.cloths().set_solids(test::shared_device(), std::array{ball(centre, radius_m)});
        for (const glm::dvec3& place : lab.run(1.0 / 120.0).places_m) {
            deepest_m = std::max(deepest_m, radius_m - glm::distance(place, glm::dvec3(centre)));
        }
    }
    EXPECT_LE(deepest_m, 1e-3);
}

TEST(Cloth, ThinSolidsStopItAtTenMetresASecond)
{
    Sheet sheet = lying_square(12, 5.2F, {.damping_per_s = 0.0F}); // falls at 10 m/s on arrival
    Lab lab(sheet);
    const std::array solids{
        Solid{.kind = SolidKind::box, .half_m = {2.0F, 0.004F, 2.0F}},
    };
    lab.cloths().set_solids(test::shared_device(), solids);
    double lowest_m = 1.0;
    for (int i = 0; i < 30; ++i) {
        for (const glm::dvec3& place : lab.run(0.05).places_m) {
            lowest_m = std::min(lowest_m, place.y);
        }
    }
    EXPECT_GE(lowest_m, 0.0);
    EXPECT_LT(lowest_m, 0.02);
}

TEST(Cloth, LiesOnEverySolidAndInNone)
{
    const glm::dmat4 place =
        glm::rotate(glm::translate(glm::dmat4(1.0), {0.02, 0.0, 0.01}), 0.3, glm::dvec3(0.0, 0.0, 1.0));
    for (const SolidKind kind :
         {SolidKind::ellipsoid, SolidKind::box, SolidKind::cylinder, SolidKind::capsule}) {
        const Solid solid = placed({.kind = kind, .half_m = {0.22F, 0.15F, 0.3F}}, place);
        Lab lab(lying_square(20, 0.5F));
        lab.air.air_kg_m3 = 1.2F;
        lab.cloths().set_solids(test::shared_device(),
                                std::array{solid, below({0.0F, -0.4F, 0.0F}, {0, 1, 0})});
        const State state = lab.run(1.5);
        const glm::dmat3 back = glm::transpose(glm::dmat3(glm::mat3_cast(glm::dquat(solid.rotation))));
        double deepest = 0.0;
        double nearest_m = 1.0;
        for (const glm::dvec3& particle : state.places_m) {
            const glm::dvec3 own = back * (particle - glm::dvec3(solid.centre_m));
            const glm::dvec3 half(solid.half_m);
            const double off_axis_m = std::hypot(own.x, own.z);
            double away_m = 0.0;
            if (kind == SolidKind::ellipsoid) {
                away_m = (glm::length(own / half) - 1.0) * std::min({half.x, half.y, half.z});
            } else if (kind == SolidKind::box) {
                const glm::dvec3 beyond = glm::abs(own) - half;
                away_m = std::max({beyond.x, beyond.y, beyond.z});
            } else if (kind == SolidKind::cylinder) {
                away_m = std::max(off_axis_m - half.x, std::abs(own.y) - half.y);
            } else {
                away_m = std::hypot(off_axis_m, std::max(std::abs(own.y) - half.y, 0.0)) - half.x;
            }
            deepest = std::max(deepest, -away_m);
            nearest_m = std::min(nearest_m, away_m);
            ASSERT_GE(particle.y, -0.4);
        }
        EXPECT_LE(deepest, 0.0) << static_cast<int>(kind);
        EXPECT_LE(nearest_m, 0.012) << static_cast<int>(kind);
    }
}

TEST(Cloth, SettlesAgainAfterATeleportAndAStall)
{
    Sheet sheet = hanging_square(16);
    for (size_t i = 0; i < 16; ++i) {
        sheet.held[i] = 1.0F;
    }
    Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    lab.run(1.0);
    const glm::vec3 away(100.0F, 0.0F, 0.0F);
    lab.cloths().forget_before();
    lab.move_to([&](glm::vec3 rest) { return rest + away; });
    lab.carry(glm::translate(glm::mat4(1.0F), away));
    State state = lab.run(4.0);
    const auto check = [&] {
        const auto strained = strains(sheet, state);
        EXPECT_LE(strained.back(), 0.05);
        for (size_t i = 0; i < state.places_m.size(); ++i) {
            EXPECT_LE(glm::length(state.speeds_m_per_s[i]), 0.3);
            EXPECT_LE(std::abs(state.places_m[i].x - 100.0 - sheet.rest_m[i].x), 0.1);
        }
    };
    check();
    const float usual_s = lab.air.step_s;
    lab.air.step_s = 2.0F;
    lab.run(2.0);
    lab.air.step_s = usual_s;
    state = lab.run(4.0);
    check();
}

TEST(Cloth, MirroredSetUpsGiveMirroredResults)
{
    const auto run = [](float side) {
        Sheet sheet =
            grid_sheet({15, 15}, {0.0F, 0.0F, 0.0F}, {side * 0.7F, 0.0F, 0.0F}, {0.0F, -0.7F, 0.1F});
        sheet.held.assign(sheet.rest_m.size(), 0.0F);
        sheet.held[0] = 1.0F;
        Lab lab(sheet);
        lab.air.air_kg_m3 = 1.2F;
        lab.air.wind = {.speed_m_per_s = 3.0F,
                        .towards_deg = side > 0.0F ? 40.0F : -40.0F,
                        .gustiness = 0.0F,
                        .turbulence = 0.0F};
        lab.cloths().set_solids(test::shared_device(), std::array{ball({side * 0.3F, -0.6F, 0.3F}, 0.2F)});
        return lab.run(1.0);
    };
    const State right = run(1.0F);
    const State left = run(-1.0F);
    for (size_t i = 0; i < right.places_m.size(); ++i) {
        const glm::dvec3 mirrored = right.places_m[i] * glm::dvec3(-1.0, 1.0, 1.0);
        ASSERT_LE(glm::distance(left.places_m[i], mirrored), 1e-4);
    }
}

TEST(Cloth, SameRunsGiveSameBytes)
{
    const auto run = [] {
        Sheet sheet = hanging_square(14);
        sheet.held[0] = 1.0F;
        Lab lab(sheet);
        lab.air.air_kg_m3 = 1.2F;
        lab.air.wind = {.speed_m_per_s = 6.0F, .towards_deg = 70.0F};
        return lab.run(1.0).places_m;
    };
    EXPECT_EQ(run(), run());
}

} // namespace
} // namespace estampe::cloth
