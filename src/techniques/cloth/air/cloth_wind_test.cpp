// SPDX-License-Identifier: MIT
// The wind's eddies and the force of air on a face, as the shaders compute them.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/glsl.hpp"
#include "techniques/cloth/cloth.glsl.h"

namespace estampe::cloth {
namespace air {

using namespace test::glsl;
using namespace shared; // NOLINT(google-build-using-namespace): as the shader has it

uint variant = cloth_bit_gusts;
ClothRun run;
ClothSheet sheet;

#include "techniques/cloth/air/cloth_wind.glsl"

} // namespace air

namespace {

TEST(ClothAir, LiftIsAcrossTheFlow)
{
    air::run.air_kg_m3 = 1.2F;
    air::sheet.drag = 0.0F;
    air::sheet.lift = 0.8F;
    for (int i = 0; i < 64; ++i) {
        const float turn = 0.37F * static_cast<float>(i);
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(std::sin(turn), std::cos(1.7F * turn), std::cos(turn)));
        const glm::dvec3 flow = 5.0 * glm::dvec3(std::cos(2.3F * turn), 0.4, std::sin(0.9F * turn));
        const double area_m2 = 0.02;
        const glm::dvec3 force(air::force_on(glm::vec3(area_m2 * normal), glm::vec3(flow)));
        const double speed = glm::length(flow);
        const double across = glm::dot(flow, normal);
        const glm::dvec3 expected =
            0.5 * 1.2 * area_m2 * 0.8 * across * (speed * normal - across * flow / speed);
        const double most_n = 0.5 * 1.2 * area_m2 * 0.8 * speed * speed;
        EXPECT_LE(glm::length(force - expected), 1e-3 * most_n);
        EXPECT_LE(std::abs(glm::dot(force, flow)), 1e-3 * most_n * speed);
        EXPECT_GE(glm::dot(force, normal) * across, 0.0); // to the side that the air flows to
        const glm::dvec3 turned_over(air::force_on(glm::vec3(-area_m2 * normal), glm::vec3(flow)));
        EXPECT_LE(glm::length(force - turned_over), 1e-6 * most_n); // both sides feel equal forces
    }
}

TEST(ClothAir, EddiesHaveNoSourcesAndNoDrift)
{
    air::run = {.wind_m_per_s = {4.0F, 0.0F, 3.0F}, .gust_m = 6.0F, .turbulence = 1.0F, .eddy_m = 1.2F};
    const auto eddy_at = [](const glm::dvec3& place) {
        return glm::dvec3(air::open_wind_at(glm::vec3(place), 0.3F) - air::run.wind_m_per_s);
    };
    constexpr double off_m = 0.01;
    double divergence2 = 0.0;
    double gradient2 = 0.0;
    glm::dvec3 sum(0.0);
    double squares = 0.0;
    double fastest_m_per_s = 0.0;
    constexpr int side = 32; // samples along each axis, a third of an eddy apart
    for (int i = 0; i < side * side * side; ++i) {
        const glm::dvec3 place = 0.41 * glm::dvec3(i % side, i / side % side, i / side / side);
        double divergence = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 off(0.0);
            off[axis] = off_m;
            const glm::dvec3 slope = (eddy_at(place + off) - eddy_at(place - off)) / (2.0 * off_m);
            divergence += slope[axis];
            gradient2 += glm::dot(slope, slope);
        }
        divergence2 += divergence * divergence;
        const glm::dvec3 eddy = eddy_at(place);
        sum += eddy;
        squares += glm::dot(eddy, eddy);
        fastest_m_per_s = std::max(fastest_m_per_s, glm::length(eddy));
    }
    constexpr double count = side * side * side;
    EXPECT_LE(std::sqrt(divergence2 / gradient2), 0.01);
    EXPECT_LE(glm::length(sum) / count, 0.05 * std::sqrt(squares / count));
    EXPECT_GT(std::sqrt(squares / count), 0.5);
    EXPECT_LE(fastest_m_per_s, 4.0 * 5.0); // of wind
}

} // namespace
} // namespace estampe::cloth
