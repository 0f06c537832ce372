// SPDX-License-Identifier: MIT
// Effects of the hand on lines: widths, corners, retraced strokes, and hidden lines.
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

constexpr glm::uvec2 hand_page_px{400, 300};
constexpr double hand_fov_rad = 0.8;

double sum_of(const std::vector<float>& ink)
{
    return std::accumulate(ink.begin(), ink.end(), 0.0);
}

/// Width of the outline of a unit sphere, to the right of its centre.
double outline_px(double distance_m, const ContourStyle& style)
{
    test::Drawing drawing(test::scene_of(shapes::sphere(1.0F, 96, 48)),
                          test::front_camera(distance_m, hand_fov_rad), hand_page_px);
    const std::vector<float> ink = drawing.lines(style, 1.0F);
    const auto row = ink.begin() + std::ptrdiff_t{hand_page_px.y / 2} * hand_page_px.x;
    return std::accumulate(row + hand_page_px.x / 2, row + hand_page_px.x, 0.0);
}

TEST(LineHand, WidthsOfTheSceneHalveWhenTheDistanceDoubles)
{
    ContourStyle style = even_lines(1.0F);
    style.outline.width_m = 0.12F;
    style.distance_thinning = 0.7F; // must not affect widths in metres
    std::vector<double> widths_px;
    for (const double distance_m : {4.0, 8.0}) {
        widths_px.push_back(outline_px(distance_m, style));
        const double away_m = distance_m - 1.0 / distance_m; // distance of the circle that is the outline
        const double pixel_m = 2.0 * away_m * std::tan(0.5 * hand_fov_rad) / hand_page_px.y;
        EXPECT_NEAR(widths_px.back(), 0.12 / pixel_m, 0.3) << distance_m;
    }
    EXPECT_NEAR(widths_px[0] / widths_px[1], 2.1, 0.1);
    style.outline.width_m = 0.0F;
    style.distance_thinning = 0.0F;
    EXPECT_NEAR(outline_px(4.0, style), outline_px(8.0, style), 0.2);
}

TEST(LineHand, LinesDoNotDependOnHowADeviceWorks)
{
    test::Drawing drawing(test::scene_of(shapes::torus(1.0F, 0.4F)), test::front_camera(4.0, hand_fov_rad),
                          hand_page_px);
    const ContourStyle style = even_lines(3.0F);
    drawing.line_execution = gpu::ExecutionProfile{.is_processor = true};
    const std::vector<float> by_processor = drawing.lines(style, 1.0F);
    EXPECT_GT(sum_of(by_processor), 1000.0);
    drawing.line_execution = gpu::ExecutionProfile{.is_processor = false};
    const double wider = sum_of(drawing.lines(even_lines(9.0F), 1.0F)); // leaves wider lines in memory
    EXPECT_GT(wider, 2.0 * sum_of(by_processor));
    EXPECT_EQ(drawing.lines(style, 1.0F), by_processor);
}

/// A sheet 2 m wide and high whose vertical middle line, at the anchor, is nearest to +z: a fold between two
/// flat halves, or the crest of a wave.
Primitive folded_sheet(bool is_round)
{
    constexpr float pi = std::numbers::pi_v<float>;
    const uint32_t columns = is_round ? 64 : 2;
    const uint32_t rows = is_round ? 32 : 1;
    Primitive sheet;
    const auto add = [&](uint32_t column, uint32_t row, bool is_left_half) {
        const float x = 2.0F * static_cast<float>(column) / static_cast<float>(columns) - 1.0F;
        const float y = 2.0F * static_cast<float>(row) / static_cast<float>(rows) - 1.0F;
        const float z = is_round ? 0.25F * (std::cos(pi * x) - 1.0F) : -0.8F * std::abs(x);
        const float flat_slope = is_left_half ? -0.8F : 0.8F;
        sheet.positions.emplace_back(x, y, z);
        sheet.normals.push_back(
            glm::normalize(glm::vec3(is_round ? 0.25F * pi * std::sin(pi * x) : flat_slope, 0.0F, 1.0F)));
    };
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const auto first = static_cast<uint32_t>(sheet.positions.size());
            const bool is_left_half = 2 * column < columns;
            add(column, row, is_left_half);
            add(column + 1, row, is_left_half);
            add(column + 1, row + 1, is_left_half);
            add(column, row + 1, is_left_half);
            sheet.indices.insert(sheet.indices.end(),
                                 {first, first + 1, first + 2, first, first + 2, first + 3});
        }
    }
    return sheet;
}

/// Width of the line along the middle of a sheet.
double middle_px(const Primitive& sheet, double distance_m, const ContourStyle& style)
{
    test::Drawing drawing(test::scene_of(sheet), test::front_camera(distance_m, hand_fov_rad), hand_page_px);
    const std::vector<float> ink = drawing.lines(style, 1.0F);
    const auto middle =
        ink.begin() + std::ptrdiff_t{hand_page_px.y / 2} * hand_page_px.x + hand_page_px.x / 2;
    return std::accumulate(middle - 25, middle + 25, 0.0);
}

TEST(LineHand, WidthsOfTheSceneAreThoseOfEachKind)
{
    ContourStyle style = even_lines(1.0F);
    style.distance_thinning = 0.7F;
    style.ridge_deg = 2.0F;
    const Primitive fold = folded_sheet(false);
    Primitive marked_fold = fold;
    marked_fold.edge_marks = {2, 0, 0, 0};
    const Primitive wave = folded_sheet(true);
    const auto expect_width = [&](const Primitive& sheet, LineStyle ContourStyle::*line, const char* name) {
        ContourStyle wide = style;
        (wide.*line).enabled = true;
        (wide.*line).width_m = 0.12F;
        for (const double distance_m : {4.0, 6.0}) {
            const double pixel_m = 2.0 * distance_m * std::tan(0.5 * hand_fov_rad) / hand_page_px.y;
            EXPECT_NEAR(middle_px(sheet, distance_m, wide), 0.12 / pixel_m, 0.3)
                << name << ", " << distance_m;
        }
    };
    expect_width(fold, &ContourStyle::crease, "crease");
    expect_width(marked_fold, &ContourStyle::marked, "marked");
    expect_width(wave, &ContourStyle::ridge, "ridge");
    // Widths of other kinds have no effect.
    style.crease.width_m = 0.12F;
    style.valley = style.suggestive = {.width_m = 0.12F};
    style.marked.width_mm = 1.0F;
    EXPECT_NEAR(middle_px(marked_fold, 4.0, style), 1.0, 0.3);
    EXPECT_NEAR(middle_px(wave, 4.0, style), 0.0, 0.01);
}

/// A corner of a flat triangle with angles of 90, 20 and 70 degrees, seen from its front.
struct Corner {
    glm::dvec2 page_px;
    glm::dvec2 out; ///< away from the middle of the corner
    double half_angle_rad;
};

Primitive sharp_triangle()
{
    Primitive triangle;
    triangle.positions = {{-1.3F, -0.5F, 0.0F}, {1.3F, -0.5F, 0.0F}, {-1.3F, 0.4463F, 0.0F}};
    triangle.normals.assign(3, {0.0F, 0.0F, 1.0F});
    triangle.indices = {0, 1, 2};
    return triangle;
}

std::vector<Corner> corners_of(const Primitive& triangle, double distance_m)
{
    const double px_per_m = 0.5 * hand_page_px.y / (distance_m * std::tan(0.5 * hand_fov_rad));
    std::vector<Corner> corners;
    for (size_t i = 0; i < 3; ++i) {
        const auto page = [&](size_t k) {
            const glm::dvec2 place(triangle.positions[k % 3]);
            return 0.5 * glm::dvec2(hand_page_px) + px_per_m * glm::dvec2(place.x, -place.y);
        };
        const glm::dvec2 a = glm::normalize(page(i + 1) - page(i));
        const glm::dvec2 b = glm::normalize(page(i + 2) - page(i));
        corners.push_back({page(i), -glm::normalize(a + b), 0.5 * std::acos(glm::dot(a, b))});
    }
    return corners;
}

TEST(LineHand, CornersAreMitredUpToALimitAndElseRound)
{
    constexpr double half_px = 8.0;
    ContourStyle style = even_lines(16.0F);
    const Primitive triangle = sharp_triangle();
    test::Drawing drawing(test::scene_of(triangle), test::front_camera(2.6, hand_fov_rad), hand_page_px);
    const std::vector<float> round = drawing.lines(style, 1.0F);
    style.joints = Joints::mitre;
    const std::vector<float> mitred = drawing.lines(style, 1.0F);
    for (const Corner& corner : corners_of(triangle, 2.6)) {
        const auto beyond = [&](double distance_px) { return corner.page_px + distance_px * corner.out; };
        const double tip_px = half_px / std::sin(corner.half_angle_rad);
        const bool is_too_sharp = tip_px > 4.0 * half_px;
        EXPECT_GT(ink_at(round, hand_page_px.x, beyond(half_px - 2.0)), 0.95F);
        EXPECT_LT(ink_at(round, hand_page_px.x, beyond(half_px + 2.0)), 0.05F);
        EXPECT_GT(ink_at(mitred, hand_page_px.x, beyond(half_px - 2.0)), 0.95F);
        EXPECT_LT(ink_at(mitred, hand_page_px.x, beyond(tip_px + 2.0)), 0.05F);
        if (is_too_sharp) {
            EXPECT_LT(ink_at(mitred, hand_page_px.x, beyond(half_px + 2.0)), 0.05F) << corner.half_angle_rad;
        } else {
            EXPECT_GT(ink_at(mitred, hand_page_px.x, beyond(tip_px - 3.0)), 0.9F) << corner.half_angle_rad;
        }
    }
    // Mitring only adds ink, and leaves no gap.
    for (size_t i = 0; i < round.size(); ++i) {
        EXPECT_GE(mitred[i], round[i]);
    }
}

TEST(LineHand, StrokesDrawnAgainLieOverTheFirstAndDependOnTheSeed)
{
    ContourStyle style = even_lines(1.5F);
    test::Drawing drawing(shapes_scene(), view_from_above(), hand_page_px);
    const std::vector<float> once = drawing.lines(style, 1.0F);
    style.strokes = 2;
    style.retrace_mm = 4.0F;
    const std::vector<float> twice = drawing.lines(style, 1.0F);
    for (size_t i = 0; i < once.size(); ++i) {
        ASSERT_GE(twice[i], once[i]);
    }
    EXPECT_GT(sum_of(twice), 1.25 * sum_of(once));
    EXPECT_LT(sum_of(twice), 2.0 * sum_of(once));
    EXPECT_EQ(drawing.lines(style, 1.0F), twice);
    style.seed = 2;
    EXPECT_NE(drawing.lines(style, 1.0F), twice);
}

TEST(LineHand, JitterMovesEndsPlaceAndWidthAsFarAsItSays)
{
    ContourStyle style = even_lines(4.0F);
    style.crease.enabled = false;
    test::Drawing drawing(test::scene_of(shapes::sphere(1.0F, 96, 48)), test::front_camera(3.0, hand_fov_rad),
                          hand_page_px);
    const std::vector<float> plain = drawing.lines(style, 1.0F);
    style.jitter_width = 0.5F;
    const double varied = sum_of(drawing.lines(style, 1.0F)) / sum_of(plain);
    EXPECT_GT(varied, 0.6);
    EXPECT_LT(varied, 1.4);
    EXPECT_GT(std::abs(varied - 1.0), 1e-4);
    style.jitter_width = 0.0F;
    style.jitter_offset_mm = 3.0F;
    const std::vector<float> moved = drawing.lines(style, 1.0F);
    EXPECT_NE(moved, plain);
    const glm::dvec2 middle = 0.5 * glm::dvec2(hand_page_px);
    const double radius_px =
        0.5 * hand_page_px.y * std::tan(std::asin(1.0 / 3.0)) / std::tan(0.5 * hand_fov_rad);
    for (uint32_t y = 0; y < hand_page_px.y; ++y) {
        for (uint32_t x = 0; x < hand_page_px.x; ++x) {
            const glm::dvec2 place(x + 0.5, y + 0.5);
            if (std::abs(glm::distance(place, middle) - radius_px) > 3.0 * 1.42 + 2.0 + 1.5) {
                ASSERT_EQ(ink_at(moved, hand_page_px.x, place), 0.0F) << x << ", " << y;
            }
        }
    }
}

TEST(LineHand, PressureFromTurnsSwellsWhereALineBends)
{
    ContourStyle style = even_lines(2.0F);
    style.pressure = 1.0F;
    // In full light only turns increase the width, by 5 over the radius, of which 0.75 counts. A pixel is a
    // millimetre.
    for (const double distance_m : {30.0, 12.0, 2.6}) {
        style.pressure_from = PressureFrom::light;
        const double even_px = outline_px(distance_m, style);
        style.pressure_from = PressureFrom::turn;
        const double radius_px =
            0.5 * hand_page_px.y * std::tan(std::asin(1.0 / distance_m)) / std::tan(0.5 * hand_fov_rad);
        EXPECT_NEAR(outline_px(distance_m, style) - even_px, 2.0 * 0.75 * 5.0 / radius_px, 0.12)
            << distance_m;
    }
}

TEST(LineHand, HiddenLinesAreDashedAndNowhereElse)
{
    ContourStyle style = even_lines(3.0F);
    style.hidden.width_mm = 4.0F;
    style.hidden.dash_mm = 12.0F;
    style.hidden.gap_mm = 8.0F;
    test::Drawing drawing(test::scene_of(shapes::box({1.6F, 1.6F, 1.6F})),
                          {.eye = {2.2, 2.7, 3.1}, .target = {0.0, 0.75, 0.0}}, hand_page_px);
    const std::vector<float> seen = drawing.lines(style, 1.0F);
    style.hidden.enabled = true;
    const std::vector<float> all = drawing.lines(style, 1.0F);
    const test::ChainLists hidden = drawing.chains(style, LineClass::hidden);
    double ink = 0.0;
    size_t count = 0;
    size_t changes = 0;
    bool was_ink = false;
    for (const shared::Stroke& stroke : hidden.strokes) {
        for (uint32_t i = stroke.first + 3; i + 3 <= stroke.last; ++i) {
            const float here = ink_at(all, hand_page_px.x, hidden.samples[i].page_px);
            if (ink_at(seen, hand_page_px.x, hidden.samples[i].page_px) > 0.0F) {
                continue; // a line in front crosses here
            }
            ink += static_cast<double>(here);
            ++count;
            changes += (here > 0.5F) != was_ink ? 1U : 0U;
            was_ink = here > 0.5F;
        }
    }
    EXPECT_EQ(hidden.strokes.size(), 3U); // strokes of the corner behind
    EXPECT_GT(count, 60U);
    EXPECT_NEAR(ink / static_cast<double>(count), 0.6, 0.12);
    EXPECT_GT(changes, 12U);
    for (size_t i = 0; i < all.size(); ++i) {
        ASSERT_GE(all[i], seen[i]);
    }
}

} // namespace
} // namespace estampe::contour
