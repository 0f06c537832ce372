// SPDX-License-Identifier: MIT
#include "techniques/cloth/solids/solids.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace estampe::cloth {
namespace {

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

Soup ball_of_triangles(float radius_m, uint32_t rings)
{
    Soup soup;
    const uint32_t segments = 2 * rings;
    for (uint32_t i = 0; i <= rings; ++i) {
        for (uint32_t k = 0; k <= segments; ++k) {
            const float polar = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(rings);
            const float angle =
                std::numbers::pi_v<float> * static_cast<float>(k % segments) / static_cast<float>(rings);
            soup.positions.push_back(radius_m * glm::vec3(std::sin(polar) * std::cos(angle), std::cos(polar),
                                                          std::sin(polar) * std::sin(angle)));
            if (i < rings && k < segments) {
                const auto a = static_cast<uint32_t>(soup.positions.size()) - 1;
                const uint32_t b = a + segments + 1;
                soup.triangles.insert(soup.triangles.end(), {{a, a + 1, b}, {a + 1, b + 1, b}});
            }
        }
    }
    return soup;
}

/// Calls a function for each node with the node's position.
void for_nodes(const SolidGrid& grid, const std::function<void(glm::vec3 place_m, float value_m)>& act)
{
    size_t next = 0;
    for (uint32_t z = 0; z < grid.nodes.z; ++z) {
        for (uint32_t y = 0; y < grid.nodes.y; ++y) {
            for (uint32_t x = 0; x < grid.nodes.x; ++x) {
                const glm::vec3 last(glm::max(grid.nodes - 1U, 1U));
                const glm::vec3 share = 2.0F * glm::vec3(x, y, z) / last - 1.0F;
                act(grid.centre_m + share * grid.half_m, grid.values_m.at(next++));
            }
        }
    }
    EXPECT_EQ(next, grid.values_m.size());
}

TEST(ClothGrids, DistancesToABallAreThoseOfABall)
{
    Soup soup = ball_of_triangles(0.5F, 24);
    for (glm::vec3& place : soup.positions) {
        place += glm::vec3(3.0F, -1.0F, 2.0F);
    }
    const SolidGrid grid = grid_of_distances(soup.positions, soup.triangles, 20);
    EXPECT_GE(grid.half_m.x, 0.5F);
    size_t within = 0;
    for_nodes(grid, [&](glm::vec3 place_m, float value_m) {
        const float exact_m = glm::distance(place_m, glm::vec3(3.0F, -1.0F, 2.0F)) - 0.5F;
        ASSERT_NEAR(value_m, exact_m, 0.006F); // facets are this far inside the sphere
        within += value_m < 0.0F ? 1 : 0;
    });
    const double cell_m = 1.0 / 20.0;
    const double volume_m3 = static_cast<double>(within) * cell_m * cell_m * cell_m;
    EXPECT_NEAR(volume_m3, std::numbers::pi / 6.0, 0.03);
}

TEST(ClothGrids, SmallHolesDoNoHarm)
{
    Soup soup = ball_of_triangles(0.5F, 24);
    soup.triangles.erase(soup.triangles.begin() + 500, soup.triangles.begin() + 520);
    const SolidGrid grid = grid_of_distances(soup.positions, soup.triangles, 20);
    for_nodes(grid, [&](glm::vec3 place_m, float value_m) {
        const float exact_m = glm::length(place_m) - 0.5F;
        if (std::abs(exact_m) > 0.05F) {
            ASSERT_EQ(value_m < 0.0F, exact_m < 0.0F) << place_m.x << " " << place_m.y << " " << place_m.z;
        }
    });
}

TEST(ClothGrids, DistancesAreThoseOfBruteForce)
{
    // Many triangles in no order, far from each other: whoever takes over a neighbour's may miss the nearest.
    Soup soup;
    for (uint32_t i = 0; i < 40; ++i) {
        const auto n = static_cast<float>(i);
        const glm::vec3 middle(std::sin(2.1F * n), std::sin(3.7F * n + 1.0F), std::sin(5.3F * n + 2.0F));
        for (uint32_t k = 0; k < 3; ++k) {
            const float m = n + 40.0F * static_cast<float>(k);
            soup.positions.push_back(
                middle + 0.1F * glm::vec3(std::cos(1.3F * m), std::cos(2.9F * m), std::cos(4.1F * m)));
        }
        soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    const SolidGrid grid = grid_of_distances(soup.positions, soup.triangles, 24);
    constexpr uint32_t steps = 60; // points per side of a triangle
    size_t off = 0;
    size_t count = 0;
    size_t visited = 0;
    for_nodes(grid, [&](glm::vec3 place_m, float value_m) {
        if (visited++ % 37 != 0) {
            return;
        }
        float least_m = 1e9F;
        for (const glm::uvec3& triangle : soup.triangles) {
            for (uint32_t i = 0; i <= steps; ++i) {
                for (uint32_t k = 0; k + i <= steps; ++k) {
                    const glm::vec2 share = glm::vec2(i, k) / static_cast<float>(steps);
                    const glm::vec3 at = soup.positions[triangle.x] * (1.0F - share.x - share.y) +
                                         soup.positions[triangle.y] * share.x +
                                         soup.positions[triangle.z] * share.y;
                    least_m = std::min(least_m, glm::distance(place_m, at));
                }
            }
        }
        ++count;
        ASSERT_GE(std::abs(value_m), least_m - 0.005F);
        off += std::abs(value_m) > least_m + 0.005F ? 1 : 0;
    });
    EXPECT_LE(off, count / 100);
}

TEST(ClothGrids, NothingHasNoGrid)
{
    EXPECT_TRUE(grid_of_distances({}, {}, 20).values_m.empty());
    const std::vector<glm::vec3> nowhere(3, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    const std::vector<glm::uvec3> one{{0, 1, 2}};
    EXPECT_TRUE(grid_of_distances(nowhere, one, 20).values_m.empty());
}

TEST(ClothGrids, HeightsCountFromTheMiddle)
{
    for (const uint32_t rows : {4U, 97U}) { // computed by one thread, and by several
        const SolidGrid grid = grid_of_heights({5, rows}, {10.0F, 2.0F, -3.0F}, {2.0F, 1.5F},
                                               [](double x, double z) { return 2.0 * x + z; });
        ASSERT_EQ(grid.values_m.size(), 5U * rows);
        for_nodes(grid, [](glm::vec3 place_m, float value_m) {
            EXPECT_NEAR(value_m + 2.0F, 2.0F * place_m.x + place_m.z, 1e-4F);
        });
    }
}

} // namespace
} // namespace estampe::cloth
