// SPDX-License-Identifier: MIT
// Several boxes of smoke in one picture, against analytic results.
#include "techniques/smoke/smoke.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "techniques/smoke/smoke_test_support.hpp"

namespace estampe::smoke {
namespace {

/// Boxes that differ from the first in size, cells and rotation. The second box overlaps the first, the third
/// box does not.
Box smaller_box(const glm::dvec3& middle, const glm::uvec3& cells, double box_cell_m, double turn_rad)
{
    glm::dmat4 anchor_from_grid = glm::translate(glm::dmat4(1.0), middle);
    anchor_from_grid = glm::rotate(anchor_from_grid, turn_rad, glm::dvec3(0.0, 1.0, 0.0));
    anchor_from_grid = glm::scale(anchor_from_grid, glm::dvec3(box_cell_m));
    anchor_from_grid = glm::translate(anchor_from_grid, -0.5 * glm::dvec3(cells));
    return {.cells = cells,
            .cell_m = static_cast<float>(box_cell_m),
            .grid_from_anchor = glm::mat4(glm::inverse(anchor_from_grid))};
}

std::vector<Box> three_boxes()
{
    return {Turned().box(), smaller_box({0.3, 0.1, 0.2}, {16, 24, 8}, 0.05, -0.7),
            smaller_box({-0.3, 0.1, 1.0}, {8, 8, 8}, 0.04, 0.2)};
}

std::vector<Filled> filled_boxes(const Density& density)
{
    std::vector<Filled> filled;
    for (const Box& box : three_boxes()) {
        filled.push_back({box, density});
    }
    return filled;
}

TEST(SmokeBoxes, LetThroughTogetherWhatBeerAndLambertSay)
{
    const std::vector<Box> boxes = three_boxes();
    for (const Sampling sampling : {Sampling::rays, Sampling::axis, Sampling::view}) {
        for (const Camera& camera : cameras()) {
            const SmokeStyle style = plain(3.0F, sampling, 0.4F);
            const Drawn drawn =
                draw(filled_boxes([](glm::vec3) { return 0.75F; }), style, {.camera = camera});
            size_t in_several = 0;
            double sum = 0.0; // sum of differences: with slices, single rays hit one plane more or less
            double most = 0.0;
            for (size_t i = 0; i < drawn.marched.size(); ++i) {
                double depth = 0.0;
                size_t through = 0;
                for (const Box& box : boxes) {
                    const double way_m = way_through_box(in_sides(box, ray_through(drawn, camera, i)));
                    // `thickness` is the optical depth of a tenth of a box's width.
                    depth += 0.75 * static_cast<double>(style.thickness) / (0.1 * box.width_m()) * way_m;
                    through += way_m > 0.0 ? 1 : 0;
                }
                in_several += through > 1 ? 1 : 0;
                const double difference = drawn.marched[i].x - (1.0 - std::exp(-depth));
                sum += difference;
                most = std::max(most, std::abs(difference));
            }
            EXPECT_GT(in_several, 100U);
            EXPECT_LT(std::abs(sum) / static_cast<double>(drawn.marched.size()), 0.01);
            if (sampling == Sampling::rays) {
                EXPECT_LT(most, 1e-4);
                RecordProperty("most", fmt::format("{:.2g}", most));
            }
        }
    }
}

TEST(SmokeBoxes, WhiteFurnaceStaysWhiteWhereTheyOverlap)
{
    std::mt19937 random(3);
    for (const Sampling sampling : {Sampling::rays, Sampling::axis, Sampling::view}) {
        const Drawn drawn =
            draw(filled_boxes([&](glm::vec3) { return static_cast<float>(random() % 1000) * 0.002F; }),
                 plain(8.0F, sampling), {});
        for (const glm::vec4& pixel : drawn.marched) {
            EXPECT_NEAR(pixel.x * pixel.y + (1.0F - pixel.x), 1.0F, 0.02F);
        }
    }
}

TEST(SmokeBoxes, ThatAreEmptyChangeNothing)
{
    const Density ball = [](glm::vec3 place) {
        const float off = glm::length(place - 0.5F) / 0.45F;
        return off < 1.0F ? (1.0F - off * off) * (1.0F - off * off) : 0.0F;
    };
    const Seen seen{.lamps = {{.place = glm::vec3(0.6F, 0.8F, 0.0F), .luminance = 1.0F}}, .ambient = 0.2F};
    const Drawn alone = draw(ball, plain(6.0F), seen);
    std::vector<Filled> filled = filled_boxes([](glm::vec3) { return 0.0F; });
    filled.front().density = ball;
    const Drawn among = draw(filled, plain(6.0F), seen);
    for (size_t i = 0; i < alone.marched.size(); ++i) {
        EXPECT_NEAR(alone.marched[i].x, among.marched[i].x, 0.01F) << i;
        EXPECT_NEAR(alone.marched[i].x * alone.marched[i].y, among.marched[i].x * among.marched[i].y, 0.01F);
    }
}

TEST(SmokeBoxes, TheNearerHidesTheFarther)
{
    // The smoke is opaque, so the front of the nearest box is visible.
    const std::vector<Box> boxes = three_boxes();
    const Drawn drawn = draw(filled_boxes([](glm::vec3) { return 1.0F; }), plain(2000.0F), {});
    std::vector<size_t> counts(boxes.size());
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_through(drawn, Seen().camera, i);
        double nearest_m = 1e9;
        size_t nearest = 0;
        for (size_t number = 0; number < boxes.size(); ++number) {
            const glm::dvec2 range = range_in_box(in_sides(boxes[number], ray));
            if (range.x < range.y && range.x < nearest_m) {
                nearest_m = range.x;
                nearest = number;
            }
        }
        EXPECT_EQ(drawn.marched[i].x > 0.5F, nearest_m < 1e9) << i;
        if (nearest_m < 1e9) {
            EXPECT_NEAR(drawn.marched[i].z, nearest_m, 0.01) << i;
            EXPECT_EQ(static_cast<size_t>(0.5F * drawn.marched[i].w), nearest) << i;
            ++counts[nearest];
        }
    }
    for (const size_t count : counts) {
        EXPECT_GT(count, 20U);
    }
}

TEST(SmokeBoxes, ShadeEachOther)
{
    constexpr double extinction_per_m = 2.0;
    // A flat box above the first one shades all of it.
    const glm::dmat3 turn(Turned().anchor_from_box);
    glm::dmat4 anchor_from_grid = Turned().anchor_from_box;
    anchor_from_grid = glm::translate(anchor_from_grid, glm::dvec3(-1.0, 0.8, -1.0));
    anchor_from_grid = glm::scale(anchor_from_grid, glm::dvec3(0.05));
    const Box above{
        .cells = {40, 8, 40}, .cell_m = 0.05F, .grid_from_anchor = glm::mat4(glm::inverse(anchor_from_grid))};
    Camera camera{
        .eye = turn * glm::dvec3(0.0, 0.0, 2.0), .target = {0.0, 0.0, 0.0}, .up = turn[1], .near_m = near_m};
    camera.orthographic_half_height_m = 0.6;
    const Seen seen{
        .camera = camera, .lamps = {{.place = glm::vec3(turn[1]), .luminance = 0.75F}}, .ambient = 0.25F};
    const Density one = [](glm::vec3) { return 1.0F; };
    const Drawn drawn = draw({{Turned().box(), one}, {above, one}}, plain(extinction_per_m), seen);
    // A tenth of each box's width has the same optical depth; the boxes are 1 m and 2 m wide.
    const double passed = std::exp(-0.5 * extinction_per_m * 0.4);
    size_t count = 0;
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_of(drawn, camera, i);
        if (ray.origin.y > 0.1 && ray.origin.y < 0.9 && way_through_box(ray) > 0.0) {
            EXPECT_NEAR(drawn.marched[i].y,
                        0.25 + 0.75 * passed * std::exp(-extinction_per_m * (1.0 - ray.origin.y)), 0.01);
            ++count;
        }
    }
    EXPECT_GT(count, 500U);
}

} // namespace
} // namespace estampe::smoke
