// SPDX-License-Identifier: MIT
// The thesis's solver, tested against the laws of mechanics.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

/// One sheet solved as a regular grid, and one with lists of links.
std::vector<Sheet> both_forms(const Sheet& sheet)
{
    return {sheet, out_of_rank(sheet, 2e-3F)};
}

TEST(ClothVerlet, FreeSheetFallsAsAParabola)
{
    constexpr double seconds = 1.0;
    for (const Sheet& sheet : both_forms(lying_square(16, 0.0F, {.damping_per_s = 0.0F}))) {
        for (const float step_s : {1.0F / 120.0F, 1.0F / 60.0F}) {
            Lab lab(sheet);
            lab.cloths().set_solver(test::shared_device(), ClothSolver::verlet);
            lab.air.step_s = step_s;
            const State state = lab.run(seconds);
            const double exact_m = 0.5 * gravity_m_s2 * seconds * seconds;
            for (size_t i = 0; i < state.places_m.size(); ++i) {
                ASSERT_NEAR(sheet.rest_m[i].y - state.places_m[i].y, exact_m, 0.03 * exact_m) << step_s;
                ASSERT_NEAR(state.speeds_m_per_s[i].y, -gravity_m_s2 * seconds, 0.01 * gravity_m_s2)
                    << step_s;
            }
        }
    }
}

TEST(ClothVerlet, WhatIsHeldGoesWithTheHand)
{
    for (const Sheet& hung : both_forms(hanging_square(12))) {
        Sheet sheet = hung;
        std::fill_n(sheet.held.begin(), 12, 1.0F);
        Lab lab(sheet);
        lab.cloths().set_solver(test::shared_device(), ClothSolver::verlet);
        const glm::vec3 way_m(0.02F, 0.0F, 0.0F);
        lab.move_to([&](glm::vec3 rest) { return rest + way_m; });
        const State state = lab.run(1.0 / 60.0);
        for (size_t i = 0; i < 12; ++i) {
            ASSERT_LE(glm::distance(state.places_m[i], glm::dvec3(sheet.rest_m[i] + way_m)), 1e-6);
        }
    }
}

TEST(ClothVerlet, HungSheetGainsNoEnergy)
{
    for (const Sheet& lying : both_forms(lying_square(16, 0.0F))) {
        Sheet sheet = lying;
        sheet.held.assign(sheet.rest_m.size(), 0.0F);
        sheet.held[0] = 1.0F;
        sheet.held[15] = 1.0F;
        Lab lab(sheet);
        lab.cloths().set_solver(test::shared_device(), ClothSolver::verlet);
        const auto masses_kg = build_structure(sheet).masses_kg;
        double kinetic_j = 0.0;
        for (int i = 0; i < 60; ++i) {
            const State state = lab.run(0.1);
            kinetic_j = 0.0;
            double potential_j = 0.0; // 0 at the beginning
            for (size_t k = 0; k < masses_kg.size(); ++k) {
                if (sheet.held[k] < 1.0F) {
                    kinetic_j +=
                        0.5 * masses_kg[k] * glm::dot(state.speeds_m_per_s[k], state.speeds_m_per_s[k]);
                    const double risen_m = state.places_m[k].y - static_cast<double>(sheet.rest_m[k].y);
                    potential_j += masses_kg[k] * gravity_m_s2 * risen_m;
                }
            }
            ASSERT_LE(kinetic_j + potential_j, 0.0) << "after " << 0.1 * (i + 1) << " s";
        }
        EXPECT_LE(kinetic_j, 0.03); // of 0.15 kg that have sunk by half a metre: 0.7 J
    }
}

} // namespace
} // namespace estampe::cloth
