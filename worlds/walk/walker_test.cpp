// SPDX-License-Identifier: MIT
// A body among walls with known answers, and the bounding volume hierarchy against a search through every
// triangle.
#include "walk/walker.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "walk/chart.hpp"

namespace walk {
namespace {

/// Adds an axis-aligned block.
void add_block(std::vector<Triangle>& triangles, const glm::vec3& low, const glm::vec3& high)
{
    const auto corner = [&](int k) {
        return glm::vec3((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                         (k & 4) != 0 ? high.z : low.z);
    };
    // Counter-clockwise from outside.
    constexpr int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& face : faces) {
        triangles.push_back({corner(face[0]), corner(face[1]), corner(face[2])});
        triangles.push_back({corner(face[0]), corner(face[2]), corner(face[3])});
    }
}

SandAt slope_of(double rise)
{
    return [=](const glm::dvec2& place) { return Sand{rise * place.x, {rise, 0.0}}; };
}

/// A body among blocks on sand that rises along x.
struct Yard {
    explicit Yard(const std::vector<Triangle>& triangles = {}, double rise = 0.0,
                  const glm::dvec3& feet_m = glm::dvec3(0.0))
        : solids(triangles), walker(Place(solids, slope_of(rise)), {}, feet_m)
    {
    }

    void go(const glm::dvec2& way, double seconds, bool runs = false)
    {
        for (int i = 0; i < static_cast<int>(std::lround(seconds / Walker::step_s)); ++i) {
            walker.step({.way = way, .runs = runs});
        }
    }

    Solids solids;
    Walker walker;
};

std::vector<Triangle> chance_triangles(std::mt19937& random, int count)
{
    std::uniform_real_distribution<float> place(-5.0F, 5.0F);
    std::uniform_real_distribution<float> side(-1.0F, 1.0F);
    std::vector<Triangle> triangles;
    for (int i = 0; i < count; ++i) {
        const auto off = [&] { return glm::vec3(side(random), side(random), side(random)); };
        const glm::vec3 at(place(random), place(random), place(random));
        triangles.push_back({at + off(), at + off(), at + off()});
    }
    return triangles;
}

TEST(WalkSolids, NearestIsNoFartherThanAnyPairOfPlaces)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    std::uniform_real_distribution<float> place(-2.0F, 2.0F);
    for (const Triangle& triangle : chance_triangles(random, 300)) {
        const glm::vec3 middle = (triangle.a + triangle.b + triangle.c) / 3.0F;
        const glm::vec3 from = middle + glm::vec3(place(random), place(random), place(random));
        const glm::vec3 to = middle + glm::vec3(place(random), place(random), place(random));
        const Nearest pair = nearest(from, to, triangle);
        const float found = glm::distance(pair.on_segment, pair.on_triangle);
        float least = 1e9F;
        for (int i = 0; i < 2000; ++i) {
            float u = share(random);
            float v = share(random);
            if (u + v > 1.0F) {
                u = 1.0F - u;
                v = 1.0F - v;
            }
            const glm::vec3 on = triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
            least = std::min(least, glm::distance(glm::mix(from, to, share(random)), on));
        }
        ASSERT_LE(found, least + 1e-4F);
        ASSERT_GE(found, least - 0.25F); // the precision of the random samples
        // Both points lie where the result says.
        const glm::vec3 normal = glm::normalize(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a));
        ASSERT_NEAR(glm::dot(pair.on_triangle - triangle.a, normal), 0.0F, 1e-3F);
        const float along = glm::length(to - from);
        ASSERT_NEAR(glm::distance(pair.on_segment, from) + glm::distance(pair.on_segment, to), along, 1e-3F);
    }
}

TEST(WalkSolids, AnswersAsAskingEveryTriangleDoes)
{
    std::mt19937 random(5);
    const std::vector<Triangle> triangles = chance_triangles(random, 900);
    const Solids solids(triangles);
    std::vector<Solids> alone;
    for (const Triangle& triangle : triangles) {
        alone.emplace_back(std::vector<Triangle>{triangle});
    }
    std::uniform_real_distribution<float> place(-6.0F, 6.0F);
    const auto anywhere = [&] { return glm::vec3(place(random), place(random), place(random)); };
    size_t met = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 from = anywhere();
        const glm::vec3 to = anywhere();
        std::vector<Triangle> found;
        solids.find(glm::min(from, to), glm::max(from, to), found);
        size_t counted = 0;
        bool is_blocked = false;
        std::optional<float> highest;
        for (const Solids& one : alone) {
            std::vector<Triangle> own;
            one.find(glm::min(from, to), glm::max(from, to), own);
            counted += own.size();
            is_blocked = is_blocked || one.blocks(from, to);
            if (const std::optional<Support> under = one.below(from, 4.0F)) {
                highest = std::max(highest.value_or(-1e9F), under->height_m);
            }
        }
        ASSERT_EQ(found.size(), counted);
        ASSERT_EQ(solids.blocks(from, to), is_blocked);
        const std::optional<Support> under = solids.below(from, 4.0F);
        ASSERT_EQ(under.has_value(), highest.has_value());
        if (under) {
            ASSERT_EQ(under->height_m, *highest);
            ASSERT_GT(under->normal.y, 0.0F);
        }
        met += is_blocked ? 1 : 0;
    }
    EXPECT_GT(met, 20U);
}

TEST(Walker, FallsAsGravitySays)
{
    Yard yard({}, 0.0, {0.0, 5.0, 0.0});
    int steps = 0;
    while (!yard.walker.is_on_ground()) {
        yard.walker.step({});
        ++steps;
    }
    EXPECT_NEAR(steps * Walker::step_s, std::sqrt(2.0 * 5.0 / 9.81), 0.02);
    EXPECT_EQ(yard.walker.feet_m().y, 0.0);
}

TEST(Walker, GoesAsFastAsItIsSaidTo)
{
    Yard yard;
    yard.go({0.0, 1.0}, 1.0);
    const double before_m = yard.walker.feet_m().z;
    yard.go({0.0, 1.0}, 2.0);
    EXPECT_NEAR(yard.walker.feet_m().z - before_m, 2.0 * 1.7, 1e-3);
    yard.go({0.0, 9.0}, 1.0, true);
    EXPECT_NEAR(glm::length(yard.walker.velocity_m_per_s()), 4.6, 1e-3)
        << "more than all is no more than all";
    yard.go({}, 1.0);
    EXPECT_EQ(yard.walker.velocity_m_per_s(), glm::dvec3(0.0));
}

TEST(Walker, TakesStairsAndNoTable)
{
    std::vector<Triangle> stairs;
    for (int i = 0; i < 6; ++i) {
        const auto k = static_cast<float>(i);
        add_block(stairs, {2.0F + 0.44F * k, -1.0F, -2.0F}, {9.0F, 0.2F * (k + 1.0F), 2.0F});
    }
    Yard up(stairs);
    double last_m = 0.0;
    for (int i = 0; i < 500; ++i) {
        const double eye_m = up.walker.eye_m().y;
        up.walker.step({.way = {1.0, 0.0}});
        ASSERT_LT(std::abs(up.walker.eye_m().y - eye_m), 0.025) << "the eye is not shaken";
        ASSERT_GE(up.walker.feet_m().y, last_m - 1e-5);
        last_m = up.walker.feet_m().y;
    }
    EXPECT_NEAR(up.walker.feet_m().y, 1.2, 1e-5);
    up.go({-1.0, 0.0}, 4.0);
    EXPECT_TRUE(up.walker.is_on_ground());
    EXPECT_EQ(up.walker.feet_m().y, 0.0);

    std::vector<Triangle> table;
    add_block(table, {2.0F, -1.0F, -2.0F}, {9.0F, 0.6F, 2.0F});
    Yard before(table);
    before.go({1.0, 0.0}, 4.0);
    EXPECT_LT(before.walker.feet_m().x, 2.0);
    EXPECT_EQ(before.walker.feet_m().y, 0.0);
    // A jump leads over it.
    before.walker.step({.way = {1.0, 0.0}, .jumps = true});
    before.go({1.0, 0.0}, 2.0);
    EXPECT_NEAR(before.walker.feet_m().y, 0.6, 1e-5);
}

TEST(Walker, StandsOnSandUpToItsReposeAndSlidesBeyond)
{
    Yard gentle({}, std::tan(glm::radians(27.0)));
    gentle.go({}, 3.0);
    EXPECT_EQ(gentle.walker.feet_m().x, 0.0);
    gentle.go({1.0, 0.0}, 3.0);
    EXPECT_GT(gentle.walker.feet_m().x, 1.5) << "uphill, if slowly";
    EXPECT_LT(gentle.walker.feet_m().x, 0.75 * 3.0 * 1.7);

    Yard steep({}, std::tan(glm::radians(36.0)));
    steep.go({}, 3.0);
    EXPECT_TRUE(steep.walker.is_sliding());
    EXPECT_LT(steep.walker.feet_m().x, -1.0);
    const double before_m = steep.walker.feet_m().x;
    steep.go({1.0, 0.0}, 4.0, true);
    EXPECT_LT(steep.walker.feet_m().x, before_m) << "nobody runs up a slip face";
    EXPECT_LT(glm::length(steep.walker.velocity_m_per_s()), 6.0) << "sand drags";
    const double across_m = steep.walker.feet_m().z;
    steep.go({0.0, 1.0}, 2.0);
    EXPECT_GT(steep.walker.feet_m().z, across_m + 0.8);
}

TEST(Walker, GoesAlongWallsAndNotThrough)
{
    std::vector<Triangle> wall;
    add_block(wall, {3.0F, -1.0F, -50.0F}, {3.4F, 4.0F, 50.0F});
    for (const bool runs : {false, true}) {
        Yard yard(wall);
        const glm::dvec2 way = glm::normalize(glm::dvec2(1.0, 1.0));
        for (int i = 0; i < 600; ++i) {
            yard.walker.step({.way = way, .runs = runs});
            ASSERT_LE(yard.walker.feet_m().x, 3.0 - 0.3 + 1e-3);
        }
        const double along_m = yard.walker.feet_m().z;
        EXPECT_GT(along_m, 0.6 * 5.0 * (runs ? 4.6 : 1.7));
        yard.go({-1.0, 0.0}, 1.0);
        EXPECT_LT(yard.walker.feet_m().x, 2.0) << "and off again";
    }
}

TEST(Walker, FitsThroughDoorsThatArePeopleSized)
{
    const auto door = [](float half_m, float lintel_m) {
        std::vector<Triangle> wall;
        add_block(wall, {2.0F, -1.0F, -9.0F}, {2.8F, 4.0F, -half_m});
        add_block(wall, {2.0F, -1.0F, half_m}, {2.8F, 4.0F, 9.0F});
        add_block(wall, {2.0F, lintel_m, -half_m}, {2.8F, 4.0F, half_m});
        return wall;
    };
    const auto x_behind = [](const std::vector<Triangle>& wall, double z) {
        Yard yard(wall, 0.0, {0.0, 0.0, z});
        yard.go({1.0, 0.0}, 4.0);
        return yard.walker.feet_m().x;
    };
    EXPECT_GT(x_behind(door(0.75F, 2.2F), 0.0), 4.0);
    EXPECT_GT(x_behind(door(0.34F, 1.85F), 0.0), 4.0);
    EXPECT_LT(x_behind(door(0.28F, 2.2F), 0.0), 2.0);
    EXPECT_LT(x_behind(door(0.75F, 1.7F), 0.0), 2.0) << "it does not stoop";
    EXPECT_LT(x_behind(door(0.75F, 2.2F), 1.2), 2.0);
}

TEST(Walker, CannotJumpThroughACeiling)
{
    std::vector<Triangle> ceiling;
    add_block(ceiling, {-3.0F, 2.0F, -3.0F}, {3.0F, 2.3F, 3.0F});
    Yard yard(ceiling);
    double highest_m = 0.0;
    yard.walker.step({.jumps = true});
    for (int i = 0; i < 200; ++i) {
        yard.walker.step({});
        highest_m = std::max(highest_m, yard.walker.feet_m().y);
    }
    EXPECT_LT(highest_m, 0.21);
    EXPECT_GT(highest_m, 0.1);
    EXPECT_EQ(yard.walker.feet_m().y, 0.0);
}

TEST(Walker, GoesTheSameWayHoweverTheClockTicks)
{
    std::vector<Triangle> blocks;
    add_block(blocks, {2.0F, -1.0F, -1.0F}, {3.0F, 3.0F, 0.3F});
    add_block(blocks, {4.0F, -1.0F, 0.0F}, {5.0F, 0.3F, 2.0F});
    Yard smooth(blocks, 0.1);
    Yard jerky(blocks, 0.1);
    for (int i = 0; i < 480; ++i) {
        smooth.walker.advance({.way = {1.0, 0.1}}, 1.0 / 120.0);
    }
    for (int i = 0; i < 16; ++i) {
        jerky.walker.advance({.way = {1.0, 0.1}}, 0.25);
    }
    EXPECT_NEAR(glm::distance(smooth.walker.feet_m(), jerky.walker.feet_m()), 0.0, 0.02); // one step
    EXPECT_GT(smooth.walker.feet_m().x, 3.3) << "round the block";
}

TEST(Walker, LeavesAPrintForEachStepOnSandAlone)
{
    std::vector<Triangle> floor;
    add_block(floor, {-1.0F, -1.0F, 10.0F}, {1.0F, 0.1F, 20.0F});
    Yard yard(floor);
    yard.go({0.0, 1.0}, 5.0);
    const std::vector<estampe::TrailStamp> prints = yard.walker.take_prints();
    const double gone_m = yard.walker.feet_m().z;
    EXPECT_NEAR(static_cast<double>(prints.size()), gone_m / 0.68, 1.5);
    for (size_t i = 0; i + 1 < prints.size(); ++i) {
        const auto aside = [&](size_t k) { return prints[k].from_m.x + prints[k].to_m.x; };
        EXPECT_LT(aside(i) * aside(i + 1), 0.0) << "left and right";
    }
    EXPECT_TRUE(yard.walker.take_prints().empty());
    yard.go({0.0, 1.0}, 1.0);
    static_cast<void>(yard.walker.take_prints());
    yard.go({0.0, 1.0}, 3.0);
    EXPECT_FALSE(yard.walker.is_on_sand());
    EXPECT_TRUE(yard.walker.take_prints().empty()) << "stone keeps none";
}

TEST(WalkChart, FindsTheDoorAndNothingElse)
{
    for (const bool is_open : {true, false}) {
        std::vector<Triangle> wall;
        add_block(wall, {0.0F, -1.0F, -9.0F}, {0.6F, 3.0F, 4.0F});
        add_block(wall, {0.0F, -1.0F, is_open ? 5.4F : 4.0F}, {0.6F, 3.0F, 9.0F});
        const Solids solids(wall);
        const Place place(solids, slope_of(0.0));
        const Chart chart(place, {}, {-4.0, 0.0, 0.0},
                          {.low_m = glm::dvec2(-6.0), .high_m = glm::dvec2(6.0)});
        EXPECT_TRUE(chart.reaches({-2.0, 3.0}));
        EXPECT_FALSE(chart.reaches({0.3, 0.0}));
        const std::vector<glm::dvec3> way = chart.way({-4.0, 0.0}, {4.0, 0.0});
        EXPECT_EQ(way.empty(), !is_open);
        for (size_t i = 0; i + 1 < way.size(); ++i) {
            EXPECT_LT(glm::distance(way[i], way[i + 1]), 0.43);
            EXPECT_FALSE(solids.blocks(glm::vec3(way[i]) + glm::vec3(0.0F, 1.0F, 0.0F),
                                       glm::vec3(way[i + 1]) + glm::vec3(0.0F, 1.0F, 0.0F)));
        }
        if (is_open) {
            EXPECT_LT(glm::distance(glm::dvec2(way.front().x, way.front().z), glm::dvec2(-4.0, 0.0)), 0.3);
            EXPECT_LT(glm::distance(glm::dvec2(way.back().x, way.back().z), glm::dvec2(4.0, 0.0)), 0.3);
            EXPECT_GT(chart.room_m({-2.0, 0.0}), 1.5);
        }
    }
    const Solids nothing;
    const Chart steep(Place(nothing, slope_of(std::tan(glm::radians(40.0)))), {}, {-4.0, -3.4, 0.0},
                      {.low_m = glm::dvec2(-6.0), .high_m = glm::dvec2(6.0)});
    EXPECT_FALSE(steep.reaches({-4.0, 0.0})) << "where sand slides nobody stands";
}

} // namespace
} // namespace walk
