// SPDX-License-Identifier: MIT
// Lines found on the page, compared with known results for spheres, boxes and shadows.
#include "techniques/contour/chains/extract/page_cells.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

constexpr glm::vec3 grey(0.5F);

ContourStyle with_intersections()
{
    return {.intersection = {.width_mm = 0.3F}};
}

/// Lines of one kind, in the scene and on the page.
struct Found {
    Found(test::Drawing& drawing, const ContourStyle& style, uint32_t kind)
    {
        const test::ChainLists lists = drawing.chains(style);
        for (const shared::ChainPoint& point : lists.points) {
            if (point.source >> 28U == kind) {
                points.push_back(glm::dvec3(point.anchor) + drawing.layout.anchor);
            }
        }
        for (const shared::Stroke& stroke : lists.strokes) {
            if (lists.samples[stroke.first].source >> 28U == kind) {
                strokes += (stroke.ends & shared::stroke_is_dropped) == 0 ? 1U : 0U;
                for (uint32_t i = stroke.first; i <= stroke.last; ++i) {
                    const shared::LineSample& sample = lists.samples[i];
                    samples_px.emplace_back(sample.page_px);
                    rings += (sample.state & shared::sample_in_ring) != 0 && i == stroke.first ? 1U : 0U;
                }
            }
        }
    }

    /// Whether a place of the page lies near any sample.
    [[nodiscard]] bool is_near(const glm::dvec2& place_px, double most_px) const
    {
        return std::ranges::any_of(samples_px,
                                   [&](const glm::dvec2& p) { return glm::distance(p, place_px) < most_px; });
    }

    std::vector<glm::dvec3> points;
    std::vector<glm::dvec2> samples_px;
    size_t strokes = 0; ///< number of drawn strokes
    size_t rings = 0;
};

glm::dvec2 on_page(const test::Drawing& drawing, const glm::dvec3& place)
{
    const glm::dvec4 clip =
        glm::dmat4(drawing.globals.clip_from_anchor) * glm::dvec4(place - drawing.layout.anchor, 1.0);
    return (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(page_px);
}

/// Size of a pixel at a position.
double pixel_m(const Camera& camera, const glm::dvec3& place)
{
    if (camera.orthographic_half_height_m) {
        return 2.0 * *camera.orthographic_half_height_m / page_px.y;
    }
    const double away = glm::dot(place - camera.eye, glm::normalize(camera.target - camera.eye));
    return 2.0 * away * std::tan(0.5 * camera.vertical_fov_rad) / page_px.y;
}

/// Two spheres of radius 1 whose centres are 2 * `apart` apart along x.
Scene two_balls(double apart)
{
    Scene scene;
    test::add_object(scene, shapes::sphere(1.0F, 128, 64), grey, {-apart, 0.0, 0.0});
    test::add_object(scene, shapes::sphere(1.0F, 128, 64), grey, {apart, 0.0, 0.0});
    return scene;
}

/// Expects the line where two spheres intersect: a circle around the x axis.
void expect_circle(const Camera& camera)
{
    constexpr double apart = 0.6;
    const double radius = std::sqrt(1.0 - apart * apart);
    test::Drawing drawing(two_balls(apart), camera, page_px);
    const Found found(drawing, with_intersections(), shared::line_intersection);
    ASSERT_GT(found.points.size(), 40U);
    for (const glm::dvec3& p : found.points) {
        EXPECT_LT(std::abs(p.x), 0.5 * pixel_m(camera, p)) << p.y << ' ' << p.z;
        EXPECT_LT(std::abs(std::hypot(p.y, p.z) - radius), 0.5 * pixel_m(camera, p));
    }
    size_t seen = 0;
    size_t missing = 0;
    for (int i = 0; i < 720; ++i) {
        const double angle = std::numbers::pi * i / 360.0;
        const glm::dvec3 p(0.0, radius * std::cos(angle), radius * std::sin(angle));
        const glm::dvec3 way =
            glm::normalize(camera.orthographic_half_height_m ? camera.eye - camera.target : camera.eye - p);
        const bool is_seen = glm::dot(p - glm::dvec3(apart, 0, 0), way) > 0.2 &&
                             glm::dot(p + glm::dvec3(apart, 0, 0), way) > 0.2;
        seen += is_seen ? 1U : 0U;
        missing += is_seen && !found.is_near(on_page(drawing, p), 3.5) ? 1U : 0U;
    }
    EXPECT_GT(seen, 200U);
    EXPECT_EQ(missing, 0U);
    EXPECT_EQ(found.strokes, 1U);
}

TEST(ContourIntersections, BallsMeetInACircle)
{
    expect_circle({.eye = {1.1, 1.7, 5.0}});
}

TEST(ContourIntersections, SoTheyDoInParallelProjection)
{
    expect_circle({.eye = {1.1, 1.7, 5.0}, .orthographic_half_height_m = 1.5});
}

TEST(ContourIntersections, ABallThatLooksOutOfAnotherHasARing)
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 128, 64));
    test::add_object(scene, shapes::sphere(0.5F, 64, 32), grey, {0.0, 0.0, 0.6});
    test::Drawing drawing(scene, {.eye = {0.3, 0.4, 5.0}}, page_px);
    const Found found(drawing, with_intersections(), shared::line_intersection);
    EXPECT_EQ(found.strokes, 1U);
    EXPECT_EQ(found.rings, 1U);
}

TEST(ContourIntersections, ShellsOfOneMeshMeet)
{
    Primitive both = shapes::box({1.0F, 1.0F, 1.0F});
    const Primitive post = shapes::box({0.4F, 2.0F, 0.4F});
    const auto first = static_cast<uint32_t>(both.positions.size());
    both.positions.insert(both.positions.end(), post.positions.begin(), post.positions.end());
    both.normals.insert(both.normals.end(), post.normals.begin(), post.normals.end());
    both.tangents.clear();
    both.uvs = {};
    for (const uint32_t index : post.indices) {
        both.indices.push_back(first + index);
    }
    const Camera camera{.eye = {2.0, 4.0, 5.0}, .target = {0.0, 1.0, 0.0}};
    test::Drawing drawing(test::scene_of(both), camera, page_px);
    const Found found(drawing, with_intersections(), shared::line_intersection);
    for (const glm::dvec3& p : found.points) {
        EXPECT_LT(std::abs(p.y - 1.0), 1e-3);
        // At a corner, a pixel further shows another face.
        const bool is_corner = std::min(std::abs(p.x), std::abs(p.z)) > 0.17;
        EXPECT_LT(std::abs(std::max(std::abs(p.x), std::abs(p.z)) - 0.2),
                  (is_corner ? 1.5 : 0.1) * pixel_m(camera, p));
    }
    for (double x = -0.18; x < 0.19; x += 0.01) { // the two visible sides of the post
        EXPECT_TRUE(found.is_near(on_page(drawing, {x, 1.0, 0.2}), 3.5)) << x;
        EXPECT_TRUE(found.is_near(on_page(drawing, {0.2, 1.0, x}), 3.5)) << x;
    }
    EXPECT_GT(found.strokes, 0U);
}

TEST(ContourIntersections, WhatOnlyHidesAnotherHasNone)
{
    Scene scene = test::scene_of(shapes::quad(8.0F, 8.0F));
    test::add_object(scene, shapes::sphere(1.0F, 128, 64), grey, {1.5, 3.0, 1.05});
    test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), grey, {-1.5, 3.0, 0.55});
    test::Drawing drawing(scene, {.eye = {0.5, 4.0, 12.0}, .target = {0.0, 3.5, 0.0}}, page_px);
    const Found found(drawing, with_intersections(), shared::line_intersection);
    EXPECT_EQ(found.strokes, 0U);
}

TEST(ContourIntersections, WhatStandsOnAnotherHasItsOwnEdgeOnly)
{
    Scene scene = test::scene_of(shapes::plane(8.0F, 8.0F));
    test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), grey);
    test::Drawing drawing(scene, {.eye = {3.0, 2.5, 6.0}, .target = {0.0, 0.5, 0.0}}, page_px);
    const Found found(drawing, with_intersections(), shared::line_intersection);
    EXPECT_EQ(found.strokes, 0U);
}

TEST(ContourIntersections, AreNoneUnlessAskedFor)
{
    test::Drawing drawing(two_balls(0.6), {.eye = {1.1, 1.7, 5.0}}, page_px);
    const Found found(drawing, {.intersection = {.enabled = false}}, shared::line_intersection);
    EXPECT_EQ(found.points.size(), 0U);
}

/// A plate above the ground in the sun; its shadow is a rectangle.
class ShadowEdges : public testing::Test {
protected:
    ShadowEdges() : drawing_(scene(), camera_, page_px)
    {
        drawing_.line_light = {.records = {{.direction = glm::normalize(glm::vec3(towards_sun_)),
                                            .color = glm::vec3(1.0F),
                                            .groups = 0xffffU}},
                               .directional_count = 1,
                               .ambient = glm::vec3(0.2F),
                               .shadow_size = 2048,
                               .keeps_sun = true};
    }

    static Scene scene()
    {
        Scene scene = test::scene_of(shapes::plane(10.0F, 10.0F));
        test::add_object(scene, shapes::box({2.0F, 0.02F, 1.0F}), grey, {-0.5, height, 0.0});
        return scene;
    }

    /// Position of the shadow of the plate's corner (`x`, `z`).
    [[nodiscard]] glm::dvec3 shadow_of(double x, double z) const
    {
        return glm::dvec3(x, height, z) - towards_sun_ * (height / towards_sun_.y);
    }

    static constexpr double height = 1.5;
    const glm::dvec3 towards_sun_{-0.5, 1.0, -0.4};
    const Camera camera_{.eye = {1.5, 5.0, 7.0}, .target = {0.3, 0.3, 0.6}, .vertical_fov_rad = 0.7};
    test::Drawing drawing_;
};

TEST_F(ShadowEdges, LieWhereTheShadowEnds)
{
    const Found found(drawing_, {.shadow_edge = {.width_mm = 0.3F}}, shared::line_shadow);
    const glm::dvec3 low = shadow_of(-1.5, -0.5);
    const glm::dvec3 high = shadow_of(0.5, 0.5);
    ASSERT_GT(found.points.size(), 60U);
    double sum_px = 0.0;
    for (const glm::dvec3& p : found.points) {
        const glm::dvec2 outside(std::max(low.x - p.x, p.x - high.x), std::max(low.z - p.z, p.z - high.z));
        const double away_m = std::max(outside.x, outside.y) > 0.0
                                  ? glm::length(glm::max(outside, glm::dvec2(0.0)))
                                  : -std::max(outside.x, outside.y);
        EXPECT_LT(away_m, 2.5 * pixel_m(camera_, p)) << p.x << ' ' << p.z;
        sum_px += away_m / pixel_m(camera_, p);
    }
    EXPECT_LT(sum_px / static_cast<double>(found.points.size()), 0.5);
    for (double share = 0.0; share < 1.0; share += 0.01) {
        for (const glm::dvec3& p :
             {glm::mix(low, {low.x, 0.0, high.z}, share), glm::mix(low, {high.x, 0.0, low.z}, share),
              glm::mix(high, {low.x, 0.0, high.z}, share), glm::mix(high, {high.x, 0.0, low.z}, share)}) {
            const glm::dvec3 way = camera_.eye - p;
            const glm::dvec3 plate = p + way * (height / way.y);
            const bool is_hidden = std::abs(plate.x + 0.5) < 1.1 && std::abs(plate.z) < 0.6;
            EXPECT_TRUE(is_hidden || found.is_near(on_page(drawing_, p), 4.0)) << p.x << ' ' << p.z;
        }
    }
}

TEST_F(ShadowEdges, AreNotWhereLightTurnsAway)
{
    test::Drawing ball(test::scene_of(shapes::sphere(1.0F, 96, 48)), {.eye = {0.0, 0.5, 5.0}}, page_px);
    ball.line_light = drawing_.line_light;
    const Found found(ball, {.shadow_edge = {.width_mm = 0.3F}}, shared::line_shadow);
    EXPECT_EQ(found.strokes, 0U);
}

} // namespace
} // namespace estampe::contour
