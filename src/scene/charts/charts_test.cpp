// SPDX-License-Identifier: MIT
#include "scene/charts/charts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

namespace estampe::charts {
namespace {

std::vector<glm::vec3> corners_of(const Primitive& primitive)
{
    std::vector<glm::vec3> corners;
    for (const uint32_t index : primitive.indices) {
        corners.push_back(primitive.positions[index]);
    }
    return corners;
}

/// A ribbon that winds twice around and above itself, nearly level everywhere: projected as one chart it
/// would overlap.
Primitive ramp()
{
    Primitive primitive;
    constexpr int steps = 96;
    for (int i = 0; i <= steps; ++i) {
        const float angle = 4.0F * 3.1415927F * static_cast<float>(i) / steps;
        for (const float radius : {1.0F, 2.0F}) {
            primitive.positions.emplace_back(radius * std::cos(angle), 0.1F * angle,
                                             radius * std::sin(angle));
            primitive.normals.emplace_back(0.0F, 1.0F, 0.0F);
        }
    }
    for (uint32_t i = 0; i < steps; ++i) {
        for (const uint32_t k : {0U, 2U, 1U, 1U, 2U, 3U}) {
            primitive.indices.push_back(2 * i + k);
        }
    }
    return primitive;
}

float area(const glm::vec3* corner)
{
    return 0.5F * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
}

FlatTriangle flat(const Atlas& atlas, uint32_t triangle)
{
    const glm::vec2* corner = &atlas.corners[3 * static_cast<size_t>(triangle)];
    return {corner[0], corner[1], corner[2]};
}

/// A slightly smaller triangle, because rounding to texels moves corners by some hundred-thousandths of one.
FlatTriangle shrunk(FlatTriangle t)
{
    const glm::vec2 middle = (t[0] + t[1] + t[2]) / 3.0F;
    for (glm::vec2& corner : t) {
        corner = glm::mix(corner, middle, 0.002F);
    }
    return t;
}

float flat_area(const FlatTriangle& t)
{
    const glm::vec2 a = t[1] - t[0];
    const glm::vec2 b = t[2] - t[0];
    return 0.5F * std::abs(a.x * b.y - a.y * b.x);
}

/// Largest and smallest stretch of a triangle when it is mapped to the atlas, as singular values. Computed in
/// doubles, because the height of a sliver is a small difference of large numbers.
glm::vec2 stretch(const glm::vec3* corner, const FlatTriangle& t)
{
    const glm::dvec3 ab = glm::dvec3(corner[1]) - glm::dvec3(corner[0]);
    const glm::dvec3 ac = glm::dvec3(corner[2]) - glm::dvec3(corner[0]);
    const glm::dvec3 x = glm::normalize(ab);
    const glm::dmat2 solid(glm::dvec2(glm::length(ab), 0.0),
                           glm::dvec2(glm::dot(ac, x), glm::length(glm::cross(x, ac))));
    const glm::dmat2 flat(glm::dvec2(t[1]) - glm::dvec2(t[0]), glm::dvec2(t[2]) - glm::dvec2(t[0]));
    const glm::dmat2 m = flat * glm::inverse(solid);
    const double half = 0.5 * (glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]));
    const double det = glm::determinant(m);
    const double root = std::sqrt(std::max(half * half - det * det, 0.0));
    return glm::vec2(std::sqrt(half + root), std::sqrt(std::max(half - root, 0.0)));
}

class ChartsOf : public ::testing::TestWithParam<int> {
protected:
    static Primitive shape(int number)
    {
        switch (number) {
        case 0:
            return shapes::box({2.0F, 1.0F, 3.0F});
        case 1:
            return shapes::sphere(1.0F, 40, 24);
        case 2:
            return shapes::torus(2.0F, 0.7F);
        case 3:
            return shapes::fluted_column({});
        case 4:
            return shapes::arch_wall({});
        default:
            return ramp();
        }
    }
};

TEST_P(ChartsOf, ShapesNeitherOverlapNorStretch)
{
    const std::vector<glm::vec3> corners = corners_of(shape(GetParam()));
    const Atlas atlas = pack_charts(cut_charts(corners), corners.size() / 3, 512);
    std::set<uint32_t> seen(atlas.triangles.begin(), atlas.triangles.end());
    EXPECT_EQ(seen.size(), atlas.triangles.size());
    for (uint32_t i = 0; i < corners.size() / 3; ++i) {
        const float own = area(&corners[3 * static_cast<size_t>(i)]);
        ASSERT_EQ(seen.contains(i), own > 0.0F) << i;
        if (own <= 0.0F) {
            continue;
        }
        const FlatTriangle t = flat(atlas, i);
        const glm::vec2 stretched = stretch(&corners[3 * static_cast<size_t>(i)], t) / atlas.texels_per_m;
        EXPECT_LE(stretched.x, 1.01F) << i;
        EXPECT_GE(stretched.y, 0.99F * std::cos(steepest_lean_rad)) << i;
        for (const glm::vec2& corner : t) {
            EXPECT_GE(std::min(corner.x, corner.y), static_cast<float>(gutter));
            EXPECT_LE(std::max(corner.x, corner.y), 512.0F - static_cast<float>(gutter));
        }
        for (const uint32_t other : atlas.triangles) {
            ASSERT_FALSE(other < i && overlap(shrunk(t), shrunk(flat(atlas, other))))
                << i << " and " << other;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bake, ChartsOf, ::testing::Range(0, 6));

TEST(BakeCharts, ABoxHasSixAndFillsMostOfTheMap)
{
    const std::vector<glm::vec3> corners = corners_of(shapes::box({1.0F, 1.0F, 1.0F}));
    const std::vector<Chart> charts = cut_charts(corners);
    EXPECT_EQ(charts.size(), 6U);
    const Atlas atlas = pack_charts(charts, corners.size() / 3, 256);
    float used = 0.0F;
    for (const uint32_t triangle : atlas.triangles) {
        used += flat_area(flat(atlas, triangle));
    }
    EXPECT_GT(used, 0.55F * 256.0F * 256.0F); // six squares, packed three by three
}

TEST(BakeCharts, GuttersOfTwoChartsDoNotTouch)
{
    const std::vector<glm::vec3> corners = corners_of(shapes::sphere(1.0F, 24, 12));
    const std::vector<Chart> charts = cut_charts(corners);
    const Atlas atlas = pack_charts(charts, corners.size() / 3, 128);
    std::map<uint32_t, size_t> chart_of;
    for (size_t i = 0; i < charts.size(); ++i) {
        for (const uint32_t triangle : charts[i].triangles) {
            chart_of[triangle] = i;
        }
    }
    const std::vector<Texel> texels = covered_texels(atlas);
    std::map<uint32_t, size_t> chart_at;
    for (const Texel& texel : texels) {
        chart_at[texel.place] = chart_of[texel.triangle];
    }
    for (const Texel& texel : texels) {
        for (int step = 0; step < 25; ++step) {
            const int place = static_cast<int>(texel.place) + step % 5 - 2 + 128 * (step / 5 - 2);
            const auto other = chart_at.find(static_cast<uint32_t>(place));
            ASSERT_TRUE(other == chart_at.end() || other->second == chart_of[texel.triangle]);
        }
    }
}

TEST(BakeCharts, OverlapIsSeenAndTouchingIsNone)
{
    const FlatTriangle a{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)};
    EXPECT_TRUE(overlap(a, a));
    EXPECT_TRUE(overlap(a, {glm::vec2(0.2, 0.2), glm::vec2(0.3, 0.2), glm::vec2(0.2, 0.3)}));
    EXPECT_TRUE(overlap(a, {glm::vec2(-1, 0.3), glm::vec2(2, 0.3), glm::vec2(2, 0.4)}));
    EXPECT_FALSE(overlap(a, {glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}));
    EXPECT_FALSE(overlap(a, {glm::vec2(2, 0), glm::vec2(3, 0), glm::vec2(2, 1)}));
}

TEST(BakeCharts, CoordinatesOfTheFileAreKeptWhereTheyServe)
{
    const Primitive plane = shapes::plane(2.0F, 2.0F, 4);
    const std::vector<glm::vec3> corners = corners_of(plane);
    std::vector<glm::vec2> uvs;
    for (const glm::vec3& corner : corners) {
        uvs.emplace_back(0.3F * corner.x, 0.3F * corner.z);
    }
    const std::optional<Chart> own = own_chart(corners, uvs);
    ASSERT_TRUE(own.has_value());
    EXPECT_EQ(own->triangles.size(), corners.size() / 3);
    EXPECT_NEAR(own->size_m.x, 2.0F, 1e-3F);
    for (glm::vec2& uv : uvs) {
        uv = glm::abs(uv); // folded into a quarter
    }
    EXPECT_FALSE(own_chart(corners, uvs).has_value());
    EXPECT_FALSE(own_chart(corners, std::vector<glm::vec2>(corners.size(), glm::vec2(0.0F))).has_value());
}

TEST(BakeCharts, TooManyChartsForTheMapAreAnError)
{
    std::vector<Chart> charts(100);
    for (Chart& chart : charts) {
        chart = {.triangles = {0}, .corners_m = {{0, 0}, {1, 0}, {0, 1}}, .size_m = {1, 1}};
    }
    EXPECT_THROW(static_cast<void>(pack_charts(charts, 1, 32)), Error);
}

TEST(OverlapGrid, FindsNeedlesThatCrossAnyNumberOfCells)
{
    OverlapGrid grid(1e-6F);
    const FlatTriangle small{glm::vec2(0.5F, 0.2F), glm::vec2(0.500002F, 0.2F), glm::vec2(0.5F, 0.200002F)};
    const FlatTriangle needle{glm::vec2(-1e9F, 1.0F), glm::vec2(1e9F, 1.0F), glm::vec2(1e9F, 1.1F)};
    const FlatTriangle cover{glm::vec2(0.0F), glm::vec2(1.0F, 0.0F), glm::vec2(0.0F, 0.9F)};
    const FlatTriangle inside{glm::vec2(0.3F, 0.3F), glm::vec2(0.300002F, 0.3F), glm::vec2(0.3F, 0.300002F)};
    EXPECT_TRUE(grid.add(small));
    EXPECT_TRUE(grid.add(needle));
    EXPECT_FALSE(grid.add(needle));
    EXPECT_FALSE(grid.add(cover)) << "the small one is below it";
    OverlapGrid other(1e-6F);
    EXPECT_TRUE(other.add(cover));
    EXPECT_FALSE(other.add(inside));
    EXPECT_TRUE(other.add(needle));
}

} // namespace
} // namespace estampe::charts
