// SPDX-License-Identifier: MIT
// Cloth against the laws of mechanics.
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

/// A thread of particles along x, held at the first and, if `held_last`, at the last.
Sheet thread_of(uint32_t points, float length_m, float compliance_m_n, bool held_last)
{
    Sheet sheet{.cloth = {.damping_per_s = 0.0F}};
    const float spacing_m = length_m / static_cast<float>(points - 1);
    for (uint32_t i = 0; i < points; ++i) {
        sheet.rest_m.emplace_back(static_cast<float>(i) * spacing_m, 0.0F, 0.0F);
        const bool is_end = i == 0 || i + 1 == points;
        sheet.masses_kg.push_back((is_end ? 0.5F : 1.0F) * 0.1F * spacing_m);
        sheet.held.push_back(i == 0 || (held_last && i + 1 == points) ? 1.0F : 0.0F);
        if (i > 0) {
            sheet.threads.push_back({.from = i - 1, .to = i, .compliance_m_n = compliance_m_n});
        }
    }
    return sheet;
}

TEST(ClothLaws, ThreadHangsAsACatenary)
{
    constexpr double a_m = 0.469542; // of span 1 and length 1.2
    Sheet sheet = thread_of(33, 1.2F, 0.0F, true);
    sheet.cloth.damping_per_s = 3.0F;
    Lab lab(sheet);
    lab.air.effort = 8.0F;
    lab.run(0.1);
    lab.move_to([](glm::vec3 rest) { return rest.x > 1.0F ? glm::vec3(1.0F, 0.0F, 0.0F) : rest; });
    const State state = lab.run(10.0);
    double lowest_m = 0.0;
    double most_off_m = 0.0;
    for (const glm::dvec3& place : state.places_m) {
        const double exact_m = a_m * (std::cosh((place.x - 0.5) / a_m) - std::cosh(0.5 / a_m));
        most_off_m = std::max(most_off_m, std::abs(place.y - exact_m));
        lowest_m = std::min(lowest_m, place.y);
    }
    EXPECT_LE(most_off_m, 3e-3);
    EXPECT_NEAR(lowest_m, -0.292344, 3e-3);
    RecordProperty("most_off_um", static_cast<int>(1e6 * most_off_m));
}

TEST(ClothLaws, FreeSheetFalls)
{
    constexpr double seconds = 1.0;
    Lab lab(lying_square(16, 0.0F, {.damping_per_s = 0.0F}));
    const State state = lab.run(seconds);
    // Steps of one speed each fall short of the parabola by one step's worth.
    for (size_t i = 0; i < state.places_m.size(); ++i) {
        const double small_s = 1.0 / (120.0 * 4.0);
        const double exact_m = -0.5 * gravity_m_s2 * seconds * (seconds + small_s);
        ASSERT_NEAR(state.places_m[i].y, exact_m, 1e-4 * gravity_m_s2 * seconds * seconds);
        ASSERT_NEAR(state.speeds_m_per_s[i].y, -gravity_m_s2 * seconds, 2e-3);
    }
}

/// How far the free end of a soft hanging thread sinks.
double extension_m(ClothSolver solver, float effort, float step_s, double seconds)
{
    constexpr float compliance_m_n = 8.0F / 16.0F; // EA 2 N of a metre
    Sheet sheet = thread_of(17, 1.0F, compliance_m_n / 16.0F * 2.0F, false);
    for (glm::vec3& place : sheet.rest_m) {
        place = {0.0F, -place.x, 0.0F};
    }
    sheet.held.assign(sheet.held.size(), 0.0F);
    sheet.held[0] = 0.9999F; // avoids tethers, which would limit the length
    sheet.masses_kg[0] = 1e6F;
    sheet.cloth.damping_per_s = 6.0F;
    Lab lab(sheet);
    lab.cloths().set_solver(test::shared_device(), solver);
    lab.air.effort = effort;
    lab.air.step_s = step_s;
    const State state = lab.run(seconds);
    return state.places_m.front().y - state.places_m.back().y - 1.0;
}

TEST(ClothLaws, StiffnessDoesNotHangOnSteps)
{
    // rho g L^2 / (2 EA), with the mass of half a spacing at the free end: equal to second order.
    constexpr double mass_kg = 0.1;
    constexpr double compliance_1_n = 16.0 * (8.0 / 16.0) / 16.0 * 2.0; // of a length of one metre
    const double exact_m = 0.5 * mass_kg * gravity_m_s2 * compliance_1_n;
    for (const ClothSolver solver : {ClothSolver::small_steps, ClothSolver::block_descent}) {
        const double seconds = solver == ClothSolver::small_steps ? 4.0 : 2.0;
        const double usual_m = extension_m(solver, 1.0F, 1.0F / 120.0F, seconds);
        EXPECT_NEAR(usual_m, exact_m, 0.01 * exact_m);
        EXPECT_NEAR(extension_m(solver, 4.0F, 1.0F / 120.0F, seconds), usual_m, 0.05 * exact_m);
    }
    const double shorter_m = extension_m(ClothSolver::small_steps, 1.0F, 1.0F / 480.0F, 4.0);
    EXPECT_NEAR(shorter_m, exact_m, 0.05 * exact_m);
}

TEST(ClothLaws, FreeSheetKeepsItsMomentum)
{
    for (const bool is_grid : {true, false}) {
        Sheet sheet = lying_square(12, 0.0F, {.bending_n_m = 1e-3F, .damping_per_s = 0.0F});
        if (!is_grid) {
            sheet = out_of_rank(sheet, 0.003F);
        }
        Lab lab(sheet);
        lab.air.gravity_m_s2 = glm::vec3(0.0F);
        // Crumples, as it is born bent; then spins by a carry that shears.
        lab.carry(glm::rotate(glm::mat4(1.0F), 1.0F, glm::vec3(0.0F, 1.0F, 0.0F)) *
                  glm::scale(glm::mat4(1.0F), glm::vec3(0.9F, 1.0F, 1.05F)));
        const State begin = lab.run(0.5);
        const State end = lab.run(1.0);
        glm::dvec3 change(0.0);
        glm::dvec3 spin_before(0.0);
        glm::dvec3 spin_after(0.0);
        double quickest = 0.0;
        const auto masses = build_structure(sheet).masses_kg;
        for (size_t i = 0; i < masses.size(); ++i) {
            const double mass = masses[i];
            change += mass * (end.speeds_m_per_s[i] - begin.speeds_m_per_s[i]);
            spin_before += mass * glm::cross(begin.places_m[i], begin.speeds_m_per_s[i]);
            spin_after += mass * glm::cross(end.places_m[i], end.speeds_m_per_s[i]);
            quickest = std::max(quickest, glm::length(begin.speeds_m_per_s[i]));
        }
        EXPECT_GT(quickest, 0.01) << is_grid;
        EXPECT_LE(glm::length(change), 1e-5) << is_grid;
        EXPECT_LE(glm::length(spin_after - spin_before), 1e-5) << is_grid;
    }
}

TEST(ClothLaws, EnergyNeverGrowsWithoutWind)
{
    Sheet sheet = hanging_square(17);
    sheet.held[0] = 1.0F;
    Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    const auto masses = build_structure(sheet).masses_kg;
    lab.carry(glm::rotate(glm::mat4(1.0F), 1.2F, glm::vec3(0.0F, 0.0F, 1.0F)));
    double before_j = 1e9;
    for (int i = 0; i < 60; ++i) {
        const State state = lab.run(0.1);
        double energy_j = 0.0;
        for (size_t k = 0; k < masses.size(); ++k) {
            if (sheet.held[k] < 1.0F) {
                energy_j += masses[k] * (0.5 * glm::dot(state.speeds_m_per_s[k], state.speeds_m_per_s[k]) +
                                         gravity_m_s2 * state.places_m[k].y);
            }
        }
        ASSERT_LE(energy_j, before_j + 2e-4) << "after " << 0.1 * i << " s";
        before_j = energy_j;
    }
}

TEST(ClothLaws, PendulumKeepsItsEnergy)
{
    // A metre let go half a radian from where it hangs, 40 small steps a sixtieth. Speeds are half a small
    // step older than places, so what counts is the mean over a period.
    Lab lab(thread_of(2, 1.0F, 0.0F, false));
    lab.air.effort = 5.0F;
    lab.air.gravity_m_s2 = {static_cast<float>(gravity_m_s2) * std::cos(0.5F),
                            -static_cast<float>(gravity_m_s2) * std::sin(0.5F), 0.0F};
    const glm::dvec3 up = -glm::normalize(glm::dvec3(lab.air.gravity_m_s2));
    const auto mean_energy = [&] {
        constexpr int samples = 49; // of five steps: 2.04 s
        double sum = 0.0;
        for (int i = 0; i < samples; ++i) {
            const State state = lab.run(5.0 / 120.0);
            EXPECT_NEAR(glm::length(state.places_m[1]), 1.0, 4e-3);
            sum += 0.5 * glm::dot(state.speeds_m_per_s[1], state.speeds_m_per_s[1]) +
                   gravity_m_s2 * (1.0 + glm::dot(state.places_m[1], up));
        }
        return sum / samples;
    };
    const double first = mean_energy();
    const double second = mean_energy();
    EXPECT_NEAR(first, gravity_m_s2 * (1.0 - std::cos(0.5)), 0.02 * first);
    EXPECT_LE(second, first);
    EXPECT_GE(second, 0.99 * first);
}

TEST(ClothLaws, HoursLeaveItAsItWas)
{
    // A flag in a gusty wind: a minute, or two hours with ESTAMPE_LONG.
    Sheet sheet = hanging_square(8);
    for (size_t i = 0; i < 8; ++i) {
        sheet.held[8 * i] = 1.0F;
    }
    Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    lab.air.wind = {.speed_m_per_s = 9.0F, .towards_deg = 70.0F};
    const int minutes = std::getenv("ESTAMPE_LONG") != nullptr ? 120 : 1;
    for (int minute = 0; minute < minutes; ++minute) {
        const State state = lab.run(60.0);
        for (size_t i = 0; i < state.places_m.size(); ++i) {
            ASSERT_LE(glm::distance(state.places_m[i], glm::dvec3(0.0)), 1.5) << minute; // fails for NaN, too
            ASSERT_LE(glm::length(state.speeds_m_per_s[i]), 30.0) << minute;
        }
        ASSERT_LE(strains(sheet, state).back(), 0.25) << minute; // a gale stretches so coarse a sheet
    }
}

TEST(ClothLaws, FallingSheetReachesItsTerminalSpeed)
{
    for (const bool is_grid : {true, false}) {
        Sheet sheet = lying_square(9, 0.0F, {.drag = 1.3F, .lift = 0.0F, .damping_per_s = 0.0F});
        if (!is_grid) {
            for (glm::vec3& place : sheet.rest_m) { // makes it no grid, but leaves it flat
                place.x += 0.02F * std::sin(9.0F * place.z);
            }
        }
        Lab lab(sheet);
        lab.air.air_kg_m3 = 1.2F;
        const State state = lab.run(3.0);
        const double exact_m_per_s = std::sqrt(2.0 * 0.15 * gravity_m_s2 / (1.2 * 1.3));
        double mean_m_per_s = 0.0;
        for (const glm::dvec3& speed : state.speeds_m_per_s) {
            mean_m_per_s -= speed.y / static_cast<double>(state.speeds_m_per_s.size());
        }
        EXPECT_NEAR(mean_m_per_s, exact_m_per_s, 0.02 * exact_m_per_s) << is_grid;
    }
}

TEST(ClothLaws, BothFormsBendAlike)
{
    // A strip, clamped at one end, droops equally as a grid and with lists of links.
    std::array<double, 2> droop_m{};
    for (const bool is_grid : {true, false}) {
        Sheet sheet = grid_sheet({25, 7}, {0.0F, 0.0F, 0.0F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.1F},
                                 {.bending_n_m = 5e-3F, .damping_per_s = 8.0F});
        sheet.held.assign(sheet.rest_m.size(), 0.0F);
        for (size_t i = 0; i < sheet.rest_m.size(); ++i) {
            sheet.held[i] = i % 25 < 2 ? 1.0F : 0.0F;
            if (!is_grid) {
                sheet.rest_m[i].z += 1e-3F * std::sin(40.0F * sheet.rest_m[i].x);
            }
        }
        Lab lab(sheet);
        lab.air.effort = 2.0F;
        const State state = lab.run(4.0);
        droop_m.at(is_grid ? 0 : 1) = -state.places_m[25 * 3 + 24].y;
    }
    // Tip deflection of a beam of length l under the uniform load q: q l^4 / (8 D).
    const double length_m = 0.4 * 23.0 / 24.0;
    const double small_m = 0.15 * gravity_m_s2 * std::pow(length_m, 4.0) / (8.0 * 5e-3);
    EXPECT_LT(droop_m[0], small_m);
    EXPECT_GT(droop_m[0], 0.3 * small_m);
    EXPECT_NEAR(droop_m[1], droop_m[0], 0.12 * droop_m[0]);
}

} // namespace
} // namespace estampe::cloth
