// SPDX-License-Identifier: MIT
#include "scene/smooth_surface.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

namespace estampe {
namespace {

TEST(Subdivision, QuartersTrianglesAndKeepsASheetFlatWithinItsBorder)
{
    const Primitive sheet = shapes::plane(2.0F, 2.0F, 3);
    const Primitive finer = subdivided(sheet, 2);
    EXPECT_EQ(finer.indices.size(), 16 * sheet.indices.size());
    EXPECT_EQ(finer.positions.size(), 13U * 13U);
    for (const glm::vec3& p : finer.positions) {
        EXPECT_NEAR(p.y, 0.0F, 1e-6F);
        EXPECT_LE(std::max(std::abs(p.x), std::abs(p.z)), 1.0F + 1e-6F);
    }
}

TEST(Subdivision, AnIcosahedronTendsToASphereWithNormalsOutwards)
{
    // Twelve points of valence five; Loop's surface stays within a few percent of a sphere.
    constexpr float g = 1.6180340F;
    Primitive ball;
    ball.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    ball.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                    4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                    6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    const Primitive finer = subdivided(ball, 4);
    EXPECT_EQ(finer.indices.size(), 3U * 20U * 256U);
    EXPECT_EQ(finer.positions.size() + finer.indices.size() / 3, 2 + finer.indices.size() / 2); // Euler
    float least = 1e9F;
    float most = 0.0F;
    for (size_t i = 0; i < finer.positions.size(); ++i) {
        least = std::min(least, glm::length(finer.positions[i]));
        most = std::max(most, glm::length(finer.positions[i]));
        EXPECT_GT(glm::dot(finer.normals[i], glm::normalize(finer.positions[i])), 0.98F);
    }
    EXPECT_LT(most / least, 1.03F);
}

TEST(Subdivision, WeldsSeams)
{
    const Primitive finer = subdivided(shapes::torus(2.0F, 0.5F, 12, 8), 1);
    EXPECT_EQ(finer.positions.size(), 2U * finer.indices.size() / 3U / 4U * 1U); // V = F / 2 on a torus
}

} // namespace
} // namespace estampe
