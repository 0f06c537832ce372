// SPDX-License-Identifier: MIT
#include "output/stroke_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace estampe::output {
namespace {

using glm::dvec2;

std::vector<dvec2> circle(double radius, int steps)
{
    std::vector<dvec2> points;
    for (int i = 0; i <= steps; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i % steps) / steps;
        points.push_back(radius * dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

double distance_to(const std::vector<Cubic>& curves, const dvec2& point)
{
    double least = 1e9;
    for (const Cubic& curve : curves) {
        for (int i = 0; i <= 400; ++i) {
            least = std::min(least, glm::distance(point, point_on(curve, i / 400.0)));
        }
    }
    return least;
}

void expect_no_gaps(const std::vector<Cubic>& curves)
{
    for (size_t i = 1; i < curves.size(); ++i) {
        EXPECT_EQ(curves[i - 1][3], curves[i][0]);
    }
}

dvec2 unit(const dvec2& v)
{
    return v / glm::length(v);
}

TEST(Curve, PassesByEveryPointOfARandomWalk)
{
    std::mt19937 random(7);
    std::normal_distribution<double> turn(0.0, 0.25);
    for (const double tolerance : {0.002, 0.02, 0.2}) {
        std::vector<dvec2> points{{0.0, 0.0}};
        double angle = 0.0;
        for (int i = 0; i < 300; ++i) {
            angle += turn(random);
            points.push_back(points.back() + 0.3 * dvec2(std::cos(angle), std::sin(angle)));
        }
        const std::vector<Cubic> curves = fit_curve(points, tolerance);
        expect_no_gaps(curves);
        EXPECT_EQ(curves.front()[0], points.front());
        EXPECT_EQ(curves.back()[3], points.back());
        for (const dvec2& point : points) {
            EXPECT_LT(distance_to(curves, point), tolerance * 1.01 + 1e-3);
        }
        EXPECT_LT(curves.size(), points.size());
    }
}

TEST(Curve, ACircleNeedsFewPiecesAndHasNoCornerAtItsSeam)
{
    const std::vector<Cubic> curves = fit_curve(circle(10.0, 120), 0.01, true);
    EXPECT_LE(curves.size(), 12U);
    for (const Cubic& curve : curves) {
        for (int i = 0; i <= 50; ++i) {
            EXPECT_NEAR(glm::length(point_on(curve, i / 50.0)), 10.0, 0.02);
        }
    }
    const dvec2 arriving = unit(curves.back()[3] - curves.back()[2]);
    const dvec2 leaving = unit(curves.front()[1] - curves.front()[0]);
    EXPECT_GT(glm::dot(arriving, leaving), 0.9999);
}

TEST(Curve, CornersStay)
{
    std::vector<dvec2> points;
    for (int i = 0; i <= 10; ++i) {
        points.emplace_back(i, 0.0);
    }
    for (int i = 1; i <= 10; ++i) {
        points.emplace_back(10.0, i);
    }
    EXPECT_EQ(corners_of(points), (std::vector<size_t>{0, 10, 20}));
    const std::vector<Cubic> curves = fit_curve(points, 0.05);
    ASSERT_EQ(curves.size(), 2U);
    EXPECT_EQ(curves[0][3], dvec2(10.0, 0.0));
    EXPECT_NEAR(curves[0][2].y, 0.0, 1e-9);
    EXPECT_NEAR(curves[1][1].x, 10.0, 1e-9);
}

TEST(Curve, OneOfNoLengthIsNone)
{
    EXPECT_TRUE(fit_curve({}, 0.1).empty());
    const std::vector<dvec2> twice{{1.0, 1.0}, {1.0, 1.0}};
    EXPECT_TRUE(fit_curve(twice, 0.1).empty());
}

} // namespace
} // namespace estampe::output
