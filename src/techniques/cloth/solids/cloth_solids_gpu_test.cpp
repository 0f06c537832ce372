// SPDX-License-Identifier: MIT
// Solids given by numbers on grids, and the self-collision of sheets.
#include <gtest/gtest.h>

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

double dune_m(double x_m, double z_m)
{
    return 0.25 * std::sin(2.0 * x_m) * std::cos(1.5 * z_m + 0.4) - 0.1 * x_m;
}

TEST(ClothSolids, HeightsAreLainOnAndNotPassedThrough)
{
    const SolidGrid grid = grid_of_heights({65, 65}, {0.1F, 0.2F, 0.0F}, {2.0F, 2.0F}, dune_m);
    Lab lab(lying_square(20, 5.4F, {.damping_per_s = 0.0F, .friction = 0.8F})); // falls at 10 m/s on arrival
    lab.cloths().set_grids(test::shared_device(), {&grid, 1});
    lab.cloths().set_solids(test::shared_device(), std::array{solid_of_grid(SolidKind::heights, grid, 0)});
    double deepest_m = 0.0;
    State state;
    for (int i = 0; i < 40; ++i) {
        state = lab.run(0.05);
        for (const glm::dvec3& place : state.places_m) {
            deepest_m = std::max(deepest_m, dune_m(place.x, place.z) - place.y);
        }
    }
    EXPECT_LE(deepest_m, 0.0);
    double nearest_m = 1.0;
    size_t lying = 0;
    for (const glm::dvec3& place : state.places_m) {
        const double above_m = place.y - dune_m(place.x, place.z);
        nearest_m = std::min(nearest_m, above_m);
        lying += above_m < 0.02 ? 1 : 0;
    }
    EXPECT_LE(nearest_m, 0.009);
    EXPECT_GE(lying, state.places_m.size() / 4);
}

/// A ball passes a hanging sheet, and other balls are far away.
TEST(ClothSolids, WhatIsOutOfReachChangesNothing)
{
    const auto places_with = [](std::vector<SheetReach> reach, float other_x_m) {
        Sheet sheet = lying_square(16, 1.0F);
        sheet.held.assign(sheet.rest_m.size(), 0.0F);
        sheet.held.front() = 1.0F;
        Lab lab(sheet);
        lab.cloths().set_reach(std::move(reach));
        State state;
        for (int i = 0; i < 20; ++i) {
            const float x_m = -1.5F + 0.15F * static_cast<float>(i);
            lab.cloths().set_solids(test::shared_device(),
                                    std::array{ball({30.0F, 0.0F, 0.0F}, 2.0F), ball({x_m, 0.4F, 0.0F}, 0.3F),
                                               ball({other_x_m, 0.6F, 0.1F}, 0.2F)});
            state = lab.run(0.05);
        }
        return state.places_m;
    };
    const std::vector<SheetReach> about{{{-2.0F, -2.0F, -2.0F}, {2.0F, 3.0F, 2.0F}}};
    const auto all = places_with({}, 0.3F);
    EXPECT_TRUE(places_with(about, 0.3F) == all);
    EXPECT_FALSE(places_with({{{8.0F, 8.0F, 8.0F}, {9.0F, 9.0F, 9.0F}}}, 0.3F) == all) << "the balls count";
}

/// One sheet for each way to find near solids: small sheets, squares of large ones, lists.
std::vector<Sheet> sheets_of_all_ways()
{
    return {hanging_square(11), hanging_square(34), out_of_rank(hanging_square(34), 1e-3F)};
}

TEST(ClothSolids, SolidsFarAwayChangeNoByte)
{
    for (Sheet& sheet : sheets_of_all_ways()) {
        sheet.held.front() = 1.0F;
        const auto places_among = [&](size_t others) {
            Lab lab(sheet);
            State state;
            for (int i = 0; i < 4; ++i) {
                std::vector<Solid> solids(others, ball({9.0F, 0.0F, 0.0F}, 0.5F));
                const float x_m = 0.9F - 0.08F * static_cast<float>(i);
                solids.push_back(ball({x_m, -0.6F, 0.05F}, 0.2F));
                solids.push_back(below({0.0F, -1.1F, 0.0F}, {0.0F, 1.0F, 0.0F}));
                lab.cloths().set_solids(test::shared_device(), solids);
                state = lab.run(0.05);
            }
            return state.places_m;
        };
        const auto alone = places_among(0);
        for (const size_t others : {size_t{31}, size_t{70}, size_t{1030}}) {
            EXPECT_TRUE(places_among(others) == alone) << sheet.rest_m.size() << ' ' << others;
        }
    }
}

TEST(ClothSolids, WhatIsThrownFartherThanForeseenIsStoppedToo)
{
    // A board at 12 m/s drives a resting sheet into a ball 5 cm away, at 10 cm per step.
    constexpr float radius_m = 0.045F;
    const glm::vec3 centre(0.5F, -0.6F, 0.1F);
    for (Sheet& sheet : sheets_of_all_ways()) {
        std::fill_n(sheet.held.begin(), 8, 1.0F);
        Lab lab(sheet);
        lab.run(0.1);
        const auto place_board = [&](float z_m) {
            const Solid board{
                .kind = SolidKind::box, .half_m = {0.6F, 0.3F, 0.02F}, .centre_m = {0.5F, -0.6F, z_m}};
            lab.cloths().set_solids(test::shared_device(), std::array{board, ball(centre, radius_m)});
        };
        place_board(-0.04F);
        lab.run(1.0 / 120.0);
        place_board(0.06F);
        double nearest_m = 1.0;
        for (const glm::dvec3& place : lab.run(1.0 / 120.0).places_m) {
            nearest_m = std::min(nearest_m, glm::distance(place, glm::dvec3(centre)));
        }
        EXPECT_GE(nearest_m, radius_m - 1e-3) << sheet.rest_m.size();
        EXPECT_LE(nearest_m, radius_m + 0.02) << sheet.rest_m.size();
    }
}

TEST(ClothSolids, HeightsFarBelowAreLeftOutToTheBit)
{
    // What comes after so many others is asked always, without being told whether it is near. Ground begins
    // and ends under the sheets: nobody comes down to where it drops.
    const auto ground_m = [](double x_m, double z_m) { return x_m > 1.4 ? -1e4 : dune_m(x_m, z_m); };
    const SolidGrid grid = grid_of_heights({33, 25}, {0.1F, -1.3F, 0.0F}, {2.0F, 1.5F},
                                           [&](double x_m, double z_m) { return ground_m(x_m, z_m) - 1.3; });
    Solid ground = solid_of_grid(SolidKind::heights, grid, 0);
    ground.rotation = glm::angleAxis(0.2F, glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F)));
    for (Sheet& sheet : sheets_of_all_ways()) {
        sheet.held.front() = 1.0F;
        const auto states_among = [&](size_t others, bool is_wide) {
            Lab lab(sheet);
            lab.cloths().set_wide(test::shared_device(), is_wide);
            lab.cloths().set_grids(test::shared_device(), {&grid, 1});
            lab.air.air_kg_m3 = 1.2F;
            lab.air.wind = {.speed_m_per_s = 3.0F, .towards_deg = 20.0F};
            std::vector<std::vector<glm::dvec3>> places;
            for (int i = 0; i < 5; ++i) {
                std::vector<Solid> solids(others, ball({90.0F, 0.0F, 0.0F}, 0.5F));
                solids.push_back(ground);
                lab.cloths().set_solids(test::shared_device(), solids);
                places.push_back(lab.run(0.1).places_m);
            }
            return places;
        };
        const bool is_small = sheet.rest_m.size() <= shared::cloth_small_sheet;
        for (const bool is_wide : {false, true}) {
            if (is_small || !is_wide) {
                EXPECT_TRUE(states_among(0, is_wide) == states_among(is_small ? 64 : 1024, is_wide))
                    << sheet.rest_m.size() << ' ' << is_wide;
            }
        }
    }
}

/// A ring around the y axis.
double to_ring_m(const glm::dvec3& place)
{
    return std::hypot(std::hypot(place.x, place.z) - 0.35, place.y) - 0.15;
}

SolidGrid grid_of_ring()
{
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    constexpr uint32_t around = 48;
    constexpr uint32_t about = 24;
    const auto number = [](uint32_t i, uint32_t k) { return (i % around) * about + k % about; };
    for (uint32_t i = 0; i < around; ++i) {
        for (uint32_t k = 0; k < about; ++k) {
            const float u = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / around;
            const float v = 2.0F * std::numbers::pi_v<float> * static_cast<float>(k) / about;
            const float off_axis = 0.35F + 0.15F * std::cos(v);
            positions.emplace_back(off_axis * std::cos(u), 0.15F * std::sin(v), off_axis * std::sin(u));
            triangles.emplace_back(number(i, k), number(i, k + 1), number(i + 1, k));
            triangles.emplace_back(number(i + 1, k), number(i, k + 1), number(i + 1, k + 1));
        }
    }
    return grid_of_distances(positions, triangles, 40);
}

TEST(ClothSolids, MeshesAreLainOnAsTheyStand)
{
    const SolidGrid grid = grid_of_ring();
    const glm::dmat4 place =
        glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), {0.1, 0.3, -0.2}), 0.5, glm::dvec3(0, 0, 1)),
                   glm::dvec3(1.3));
    const Solid ring = placed(solid_of_grid(SolidKind::distances, grid, 0), place);
    Lab lab(lying_square(24, 1.2F));
    lab.cloths().set_grids(test::shared_device(), {&grid, 1});
    lab.cloths().set_solids(test::shared_device(), std::array{ring, below({0.0F, -1.0F, 0.0F}, {0, 1, 0})});
    const glm::dmat4 back = glm::inverse(place);
    double deepest_m = 0.0;
    double nearest_m = 1.0;
    for (int i = 0; i < 20; ++i) {
        for (const glm::dvec3& particle : lab.run(0.1).places_m) {
            const double away_m = 1.3 * to_ring_m(glm::dvec3(back * glm::dvec4(particle, 1.0)));
            deepest_m = std::max(deepest_m, -away_m);
            nearest_m = std::min(nearest_m, away_m);
        }
    }
    EXPECT_LE(deepest_m, 1e-3);
    EXPECT_GE(nearest_m, 0.0);
    EXPECT_LE(nearest_m, 0.012);
}

TEST(ClothSolids, MovedMeshesPushTheSheet)
{
    const SolidGrid grid = grid_of_ring();
    Sheet sheet = hanging_square(20);
    for (size_t i = 0; i < 20; ++i) {
        sheet.held[i] = 1.0F;
    }
    Lab lab(sheet);
    lab.cloths().set_grids(test::shared_device(), {&grid, 1});
    double deepest_m = 0.0;
    for (int step = 0; step <= 60; ++step) {
        const glm::dvec3 centre(0.5, -0.6, -0.5 + 0.6 * step / 60.0);
        const glm::dmat4 place =
            glm::rotate(glm::translate(glm::dmat4(1.0), centre), 1.3, glm::dvec3(1.0, 0.0, 0.0));
        lab.cloths().set_solids(test::shared_device(),
                                std::array{placed(solid_of_grid(SolidKind::distances, grid, 0), place)});
        const glm::dmat4 back = glm::inverse(place);
        for (const glm::dvec3& particle : lab.run(1.0 / 60.0).places_m) {
            deepest_m = std::max(deepest_m, -to_ring_m(glm::dvec3(back * glm::dvec4(particle, 1.0))));
        }
    }
    EXPECT_LE(deepest_m, 1e-3);
}

TEST(ClothSolids, LimbsThatSwingThroughStraightDownTouchNothingElse)
{
    Sheet sheet = hanging_square(16);
    for (size_t i = 0; i < 16; ++i) {
        sheet.held[i] = 1.0F;
    }
    Lab lab(sheet);
    double quickest_m_per_s = 0.0;
    for (int i = 0; i < 20; ++i) {
        const float angle = 0.4F * static_cast<float>(i);
        const glm::vec3 end(0.5F + 0.1F * std::sin(angle), -0.8F, 0.25F + 0.1F * std::cos(1.3F * angle));
        lab.cloths().set_solids(test::shared_device(),
                                std::array{capsule_between({0.5F, -0.1F, 0.25F}, end, 0.05F)});
        for (const glm::dvec3& speed : lab.run(1.0 / 30.0).speeds_m_per_s) {
            quickest_m_per_s = std::max(quickest_m_per_s, glm::length(speed));
        }
    }
    EXPECT_LE(quickest_m_per_s, 0.05);
}

/// How near two particles come that are not near at rest, when a strip falls on its edge and heaps up.
double least_gap_m(float self_m)
{
    Sheet sheet = grid_sheet({9, 49}, {0.0F, 0.85F, 0.0F}, {0.12F, 0.0F, 0.0F}, {0.0F, -0.8F, 0.0F},
                             {.friction = 0.6F, .self_m = self_m});
    Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    lab.air.wind = {.speed_m_per_s = 0.3F, .towards_deg = 0.0F, .gustiness = 0.0F, .turbulence = 0.0F};
    lab.cloths().set_solids(test::shared_device(), std::array{below({}, {0.0F, 1.0F, 0.0F})});
    const State state = lab.run(1.5);
    double least_m = 1.0;
    for (size_t i = 0; i < state.places_m.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
            if (glm::distance(sheet.rest_m[i], sheet.rest_m[k]) > 0.05F) {
                least_m = std::min(least_m, glm::distance(state.places_m[i], state.places_m[k]));
            }
        }
    }
    return least_m;
}

TEST(ClothSelf, HeapsKeepTheirLayersApart)
{
    constexpr float self_m = 0.02F;
    EXPECT_LT(least_gap_m(0.0F), 0.25 * self_m);
    EXPECT_GT(least_gap_m(self_m), 0.7 * self_m);
}

} // namespace
} // namespace estampe::cloth
