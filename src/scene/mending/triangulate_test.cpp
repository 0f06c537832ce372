// SPDX-License-Identifier: MIT
#include "scene/mending/triangulate.hpp"

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace estampe {
namespace {

using Polygon = std::vector<glm::dvec3>;

glm::dvec3 area_of(const Polygon& corners)
{
    glm::dvec3 area(0.0);
    for (size_t i = 1; i + 1 < corners.size(); ++i)
        area += 0.5 * glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return area;
}

/// The triangles cover the polygon exactly once if all have its orientation and their areas add up to its
/// area.
void expect_covered(const Polygon& corners, size_t triangles)
{
    Triangulation triangulation;
    std::vector<uint32_t> cut;
    triangulation.cut(corners, cut);
    EXPECT_EQ(triangulation.unclean(), 0U);
    EXPECT_EQ(cut.size(), 3 * triangles);
    const glm::dvec3 whole = area_of(corners);
    double sum = 0.0;
    for (size_t i = 0; i + 2 < cut.size(); i += 3) {
        const glm::dvec3 area = area_of({corners[cut[i]], corners[cut[i + 1]], corners[cut[i + 2]]});
        EXPECT_GE(glm::dot(area, whole), -1e-9 * glm::dot(whole, whole));
        sum += glm::length(area);
    }
    EXPECT_NEAR(sum, glm::length(whole), 1e-9 * glm::length(whole));
}

Polygon turned(const Polygon& flat, const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& at)
{
    Polygon polygon;
    for (const glm::dvec3& corner : flat)
        polygon.push_back(at + corner.x * u + corner.y * v);
    return polygon;
}

void expect_covered_everywhere(const Polygon& flat, size_t triangles)
{
    for (size_t start = 0; start < flat.size(); ++start) {
        Polygon polygon = flat;
        std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(start), polygon.end());
        expect_covered(polygon, triangles);
        expect_covered(turned(polygon, {0, 0, 1}, {1, 0, 0}, {5e6, 4e6, 3}), triangles);
        expect_covered(turned(polygon, {0.6, 0.8, 0}, {0.48, -0.36, 0.8}, {-1, 2, 0}), triangles);
        std::reverse(polygon.begin(), polygon.end());
        expect_covered(polygon, triangles);
    }
}

TEST(Triangulate, HollowQuadsAndPolygons)
{
    expect_covered_everywhere({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 2);
    expect_covered_everywhere({{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}}, 2);
    expect_covered_everywhere({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {0, 1, 0}}, 4);
    expect_covered_everywhere({{0, 0, 0},
                               {5, 0, 0},
                               {5, 3, 0},
                               {4, 3, 0},
                               {4, 1, 0},
                               {3, 1, 0},
                               {3, 3, 0},
                               {2, 3, 0},
                               {2, 1, 0},
                               {1, 1, 0},
                               {1, 3, 0},
                               {0, 3, 0}},
                              10);
}

TEST(Triangulate, ConvexPolygonsAreFansFromTheirFirstCorner)
{
    Triangulation triangulation;
    std::vector<uint32_t> cut;
    triangulation.cut(Polygon{{0, 0, 0}, {1, 0, 0}, {1.5, 1, 0}, {1, 2, 0}, {0, 2, 0}}, cut);
    EXPECT_EQ(cut, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4}));
}

TEST(Triangulate, AHoleThatIsJoinedToTheOutlineStaysOpen)
{
    expect_covered({{0, 0, 0},
                    {4, 0, 0},
                    {4, 4, 0},
                    {0, 4, 0},
                    {0, 0, 0},
                    {1, 1, 0},
                    {1, 3, 0},
                    {3, 3, 0},
                    {3, 1, 0},
                    {1, 1, 0}},
                   8);
}

TEST(Triangulate, RepeatedCornersAreLeftOut)
{
    expect_covered({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1);
    expect_covered({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, 2);
    Triangulation triangulation;
    std::vector<uint32_t> cut;
    triangulation.cut(Polygon{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, cut);
    triangulation.cut(Polygon{}, cut);
    EXPECT_TRUE(cut.empty());
}

TEST(Triangulate, AStarOfManyCorners)
{
    Polygon star;
    for (int i = 0; i < 2000; ++i) {
        const double angle = i * std::numbers::pi / 1000.0;
        const double radius = i % 2 == 0 ? 1.0 : 0.5;
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    expect_covered(star, 1998);
}

TEST(Triangulate, NonsenseEndsSoonAndInRange)
{
    std::mt19937 random(7);
    Polygon noise(60000);
    for (glm::dvec3& corner : noise)
        corner = {random() % 1000, random() % 1000, random() % 1000};
    noise[7].x = std::numeric_limits<double>::quiet_NaN();
    const auto begun = std::chrono::steady_clock::now();
    Triangulation triangulation;
    std::vector<uint32_t> cut;
    triangulation.cut(noise, cut);
    triangulation.cut(noise, cut);
    for (const uint32_t corner : cut)
        ASSERT_LT(corner, noise.size());
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
    EXPECT_LT(passed.count(), 20.0);
}

} // namespace
} // namespace estampe
