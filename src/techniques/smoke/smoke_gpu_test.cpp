// SPDX-License-Identifier: MIT
// Smoke in grids that tests fill, against analytic results.
#include "techniques/smoke/smoke.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "techniques/smoke/smoke_test_support.hpp"

namespace estampe::smoke {
namespace {

TEST(Smoke, SlabLetsThroughWhatBeerAndLambertSay)
{
    constexpr double extinction_per_m = 3.0;
    for (const float step : {0.3F, 0.7F, 3.0F}) {
        for (const Camera& camera : cameras()) {
            const Drawn drawn = draw([](glm::vec3) { return 0.75F; },
                                     plain(extinction_per_m, Sampling::rays, step), {.camera = camera});
            for (size_t i = 0; i < drawn.marched.size(); ++i) {
                const double way_m = way_through_box(ray_of(drawn, camera, i));
                EXPECT_NEAR(drawn.marched[i].x, 1.0 - std::exp(-0.75 * extinction_per_m * way_m), 1e-4) << i;
            }
        }
    }
}

TEST(Smoke, EndsWhereTheSceneBegins)
{
    constexpr double wall_m = 2.1; // distance from the eye
    const Seen seen{.depth = [](glm::uvec2 pixel) {
        return pixel.x < size_px.x / 2 ? static_cast<float>(near_m / wall_m) : 0.0F;
    }};
    const Drawn drawn = draw([](glm::vec3) { return 1.0F; }, plain(2.0F), seen);
    const glm::dvec3 forward = glm::normalize(seen.camera.target - seen.camera.eye);
    const glm::dmat4 box_from_anchor = glm::inverse(Turned().anchor_from_box);
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_of(drawn, seen.camera, i);
        const double along = glm::dot(ray.direction, glm::dmat3(box_from_anchor) * forward);
        const double most_m = i % size_px.x < size_px.x / 2 ? wall_m / along : 1e9;
        EXPECT_NEAR(drawn.marched[i].x, 1.0 - std::exp(-2.0 * way_through_box(ray, most_m)), 2e-4) << i;
    }
}

TEST(Smoke, WhiteFurnaceStaysWhite)
{
    std::mt19937 random(3);
    for (const Sampling sampling : {Sampling::rays, Sampling::axis, Sampling::view}) {
        for (const float step : {0.3F, 3.0F}) {
            const Drawn drawn = draw([&](glm::vec3) { return static_cast<float>(random() % 1000) * 0.002F; },
                                     plain(8.0F, sampling, step));
            double most = 0.0;
            for (const glm::vec4& pixel : drawn.marched) {
                most = std::max(most, static_cast<double>(pixel.x));
                // Light is 1 everywhere, also behind the smoke, so the smoke adds exactly the light that it
                // absorbs.
                EXPECT_NEAR(pixel.x * pixel.y + (1.0F - pixel.x), 1.0F, 0.02F);
            }
            EXPECT_GT(most, 0.95);
        }
    }
}

TEST(Smoke, ThreeWaysOfLookingUpAgreeWithABallsChord)
{
    constexpr double radius = 0.45;
    constexpr double extinction_per_m = 6.0;
    const Density ball = [](glm::vec3 place) {
        const double off = glm::length(glm::dvec3(place) - 0.5) / radius;
        return static_cast<float>(off < 1.0 ? (1.0 - off * off) * (1.0 - off * off) : 0.0);
    };
    for (const Sampling sampling : {Sampling::rays, Sampling::axis, Sampling::view}) {
        const Drawn drawn = draw(ball, plain(extinction_per_m, sampling));
        for (size_t i = 0; i < drawn.marched.size(); ++i) {
            const Ray ray = ray_of(drawn, Seen().camera, i);
            const glm::dvec3 to_middle = glm::dvec3(0.5) - ray.origin;
            const double aside = glm::length(glm::cross(ray.direction, to_middle)) / radius;
            const double inside = std::max(1.0 - aside * aside, 0.0);
            const double depth = extinction_per_m * radius * 16.0 / 15.0 * std::pow(inside, 2.5);
            EXPECT_NEAR(drawn.marched[i].x, 1.0 - std::exp(-depth), 0.01) << i;
        }
    }
}

TEST(Smoke, PlanesOfTheGridStandFast)
{
    // The smoke is between planes that are four cells apart, so no plane samples it at any slant.
    const Density between = [](glm::vec3 place) {
        const auto layer = static_cast<uint32_t>(place.z / cell_m) % 4;
        return layer == 1 || layer == 2 ? 1.0F : 0.0F;
    };
    const auto most = [&](Sampling sampling) {
        const Drawn drawn = draw(between, plain(8.0F, sampling, 4.0F));
        return std::ranges::max(drawn.marched, {}, &glm::vec4::x).x;
    };
    EXPECT_EQ(most(Sampling::axis), 0.0F);
    EXPECT_GT(most(Sampling::rays), 0.5F);
}

TEST(Smoke, LightIsWeakenedOnItsWayIn)
{
    constexpr double extinction_per_m = 2.0;
    const glm::dmat3 turn(Turned().anchor_from_box);
    Camera camera{
        .eye = turn * glm::dvec3(0.0, 0.0, 2.0), .target = {0.0, 0.0, 0.0}, .up = turn[1], .near_m = near_m};
    camera.orthographic_half_height_m = 0.6;
    const Seen seen{
        .camera = camera, .lamps = {{.place = glm::vec3(turn[1]), .luminance = 0.75F}}, .ambient = 0.25F};
    const Drawn drawn = draw([](glm::vec3) { return 1.0F; }, plain(extinction_per_m), seen);
    size_t count = 0;
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_of(drawn, camera, i);
        if (ray.origin.y > 0.1 && ray.origin.y < 0.9 && way_through_box(ray) > 0.0) {
            // The box's top is at 1, and each ray keeps its height.
            EXPECT_NEAR(drawn.marched[i].y, 0.25 + 0.75 * std::exp(-extinction_per_m * (1.0 - ray.origin.y)),
                        0.01);
            ++count;
        }
    }
    EXPECT_GT(count, 500U);
}

TEST(Smoke, NothingIsDrawnWhereThereIsNone)
{
    const Camera away{.eye = {0.4, 0.3, 2.2}, .target = {0.0, 0.3, 5.0}, .near_m = near_m};
    for (const Drawn& drawn : {draw([](glm::vec3) { return 0.0F; }, {.enabled = true}),
                               draw([](glm::vec3) { return 1.0F; }, {.enabled = true}, {.camera = away})}) {
        for (size_t i = 0; i < drawn.marched.size(); ++i) {
            EXPECT_EQ(drawn.marched[i].x, 0.0F);
            EXPECT_EQ(drawn.cover(i), 0.0F);
            EXPECT_EQ(drawn.ink[i], 0.0F);
        }
    }
}

TEST(Smoke, ALineGoesAroundIt)
{
    const Density ball = [](glm::vec3 place) { return glm::length(place - 0.5F) < 0.35F ? 1.0F : 0.0F; };
    SmokeStyle style = plain(100.0F);
    style.medium = Medium::wash;
    style.line_mm = 0.5F; // width of two pixels
    const Drawn drawn = draw(ball, style);
    const auto covers = [&](int x, int y) {
        return drawn.cover(static_cast<size_t>(y) * size_px.x + static_cast<size_t>(x)) > 0.5F;
    };
    size_t on_edge = 0;
    for (int y = 5; y < static_cast<int>(size_px.y) - 5; ++y) {
        for (int x = 5; x < static_cast<int>(size_px.x) - 5; ++x) {
            const float ink = drawn.ink[static_cast<size_t>(y) * size_px.x + static_cast<size_t>(x)];
            const bool is_edge = covers(x, y) && !(covers(x - 1, y) && covers(x + 1, y) && covers(x, y - 1) &&
                                                   covers(x, y + 1));
            bool is_near_end = false;
            for (int i = 0; i < 121; ++i) {
                is_near_end = is_near_end || !covers(x + i % 11 - 5, y + i / 11 - 5);
            }
            on_edge += is_edge ? 1 : 0;
            EXPECT_TRUE(!is_edge || ink > 0.4F) << x << ", " << y;
            EXPECT_TRUE(is_near_end || ink == 0.0F) << x << ", " << y;
        }
    }
    EXPECT_GT(on_edge, 20U);
}

TEST(Smoke, LinesOfWhatStandsBeforeItStay)
{
    // An object in front of the smoke ends in the middle of the page; its outline reaches beyond the edge.
    const Seen seen{
        .depth = [](glm::uvec2 pixel) { return pixel.x < 24 ? static_cast<float>(near_m / 1.0) : 0.0F; },
        .lines = [](glm::uvec2 pixel) { return glm::vec4(0.0F, 0.0F, 0.0F, pixel.x == 24 ? 1.0F : 0.0F); }};
    const Drawn drawn = draw([](glm::vec3) { return 1.0F; }, plain(100.0F), seen);
    const size_t row = size_t{20} * size_px.x;
    EXPECT_EQ(drawn.cover(row + 20), 0.0F);
    EXPECT_EQ(drawn.cover(row + 24), 0.0F) << "the line's";
    EXPECT_GT(drawn.cover(row + 28), 0.9F);
}

TEST(Smoke, PuffsAreRoundAndOnlyWhereItIsDense)
{
    const Density half = [](glm::vec3 place) { return place.x < 0.5F ? 1.0F : 0.0F; };
    SmokeStyle style{.enabled = true};
    style.puff = 0.2F;
    const Drawn drawn = draw(half, style);
    size_t drawn_far = 0;
    size_t drawn_dense = 0;
    size_t dense = 0;
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_of(drawn, Seen().camera, i);
        Ray in_half = ray; // the dense half as a box of its own
        in_half.origin.x *= 2.0;
        in_half.direction.x *= 2.0;
        dense += way_through_box(in_half) > 0.3 ? 1 : 0;
        drawn_dense += way_through_box(in_half) > 0.3 && drawn.cover(i) > 0.5F ? 1 : 0;
        Ray in_rest = ray; // farther away than a puff's diameter
        in_rest.origin.x = (ray.origin.x - 0.7) / 0.3;
        in_rest.direction.x /= 0.3;
        drawn_far += way_through_box(in_rest) > 0.0 && way_through_box(in_half) == 0.0 &&
                             drawn.marched[i].z > 0.0F &&
                             (ray.origin + static_cast<double>(drawn.marched[i].z) * ray.direction).x > 0.75
                         ? 1
                         : 0;
    }
    EXPECT_GT(static_cast<double>(drawn_dense), 0.9 * static_cast<double>(dense));
    EXPECT_EQ(drawn_far, 0U);
}

TEST(Smoke, ThrowsTheShadowThatBeerAndLambertSay)
{
    // The shadow falls on a wall behind the box, at a right angle to the view, under a sun from the upper
    // left front.
    constexpr double extinction_per_m = 3.0;
    constexpr double wall_m = 3.2;
    Seen seen{.depth = [](glm::uvec2) { return static_cast<float>(near_m / wall_m); }};
    seen.towards_sun = glm::normalize(glm::vec3(-0.35F, 0.4F, 1.0F));
    SmokeStyle style = plain(extinction_per_m);
    for (const float strength : {1.0F, 0.25F}) {
        style.shadow = strength;
        const Drawn drawn = draw([](glm::vec3) { return 0.75F; }, style, seen);
        const glm::dvec3 forward = glm::normalize(seen.camera.target - seen.camera.eye);
        size_t shaded = 0;
        for (size_t i = 0; i < drawn.share.size(); ++i) {
            const Ray ray = ray_through(drawn, seen.camera, i);
            const glm::dvec3 point = ray.origin + wall_m / glm::dot(ray.direction, forward) * ray.direction;
            const double way_m =
                way_through_box(in_sides(Turned().box(), {point, glm::dvec3(*seen.towards_sun)}));
            const double left = std::exp(-0.75 * extinction_per_m * way_m);
            // The input share already removes half of the light.
            EXPECT_NEAR(drawn.share[i], 0.5 * glm::mix(1.0, left, static_cast<double>(strength)), 1e-3) << i;
            shaded += way_m > 0.0 ? 1 : 0;
        }
        EXPECT_GT(shaded, 100U);
        EXPECT_LT(shaded, drawn.share.size() - 100U);
    }
}

TEST(Smoke, FadesIntoTheSkyByHowFarItIs)
{
    SmokeStyle style = plain(2000.0F);
    style.medium = Medium::wash;
    style.line_mm = 0.0F;
    style.color = style.shade_color = style.deep_color = glm::vec3(1.0F, 0.0F, 0.0F);
    Seen seen;
    seen.haze_reach_m = 0.6F;
    const Drawn drawn = draw([](glm::vec3) { return 1.0F; }, style, seen);
    size_t count = 0;
    for (size_t i = 0; i < drawn.paint.size(); ++i) {
        if (drawn.cover(i) > 0.99F) {
            const double left = std::exp2(-(static_cast<double>(drawn.marched[i].z) - 0.5) / 0.6);
            const auto root = [&](uint32_t channel) {
                return static_cast<double>((drawn.paint[i] >> (8 * channel)) & 255U) / 255.0;
            };
            EXPECT_NEAR(root(0) * root(0), left, 0.01);
            EXPECT_NEAR(root(1) * root(1), 1.0 - left, 0.01);
            ++count;
        }
    }
    EXPECT_GT(count, 200U);
}

} // namespace
} // namespace estampe::smoke
