// SPDX-License-Identifier: MIT
#include <estampe/vector_drawing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "output/pen_order.hpp"
#include "output/plotter.hpp"

namespace estampe {
namespace {

VectorStroke even_line(const glm::vec2& from, const glm::vec2& to, float width_mm = 0.3F)
{
    VectorStroke stroke;
    for (int i = 0; i <= 20; ++i) {
        stroke.points.push_back({glm::mix(from, to, static_cast<float>(i) / 20.0F), width_mm});
    }
    return stroke;
}

VectorDrawing page(std::vector<VectorStroke> strokes)
{
    return {.width_mm = 100.0F,
            .height_mm = 100.0F,
            .hatch_width_mm = 0.3F,
            .inks_srgb = {glm::vec3(0.0F)},
            .objects = {"thing"},
            .strokes = std::move(strokes)};
}

VectorDrawing random_page(uint32_t count)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(5.0F, 95.0F);
    std::uniform_real_distribution<float> reach(-3.0F, 3.0F);
    VectorDrawing drawing = page({});
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec2 from(place(random), place(random));
        drawing.strokes.push_back(even_line(from, from + glm::vec2(reach(random), reach(random))));
    }
    return drawing;
}

TEST(Plotter, ARowOfLinesIsDrawnToAndFro)
{
    std::vector<output::PenStroke> rows;
    for (const float y : {3.0F, 1.0F, 4.0F, 2.0F}) {
        rows.push_back({{0.0F, y}, {50.0F, y}});
    }
    const auto order = output::shortest_order(rows, glm::vec2(0.0F));
    EXPECT_DOUBLE_EQ(output::travel_mm(rows, order, glm::vec2(0.0F)), 4.0);
}

std::vector<output::PenStroke> ends_of(const VectorDrawing& drawing)
{
    std::vector<output::PenStroke> ends;
    ends.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        ends.push_back({stroke.points.front().page_mm, stroke.points.back().page_mm});
    }
    return ends;
}

/// Horizontal hatching strokes of 20 mm, `spacing_mm` apart.
VectorDrawing rows(int count, float spacing_mm)
{
    VectorDrawing drawing = page({});
    for (int i = 0; i < count; ++i) {
        const float y = 20.0F + spacing_mm * static_cast<float>(i);
        drawing.strokes.push_back(even_line({10.0F, y}, {30.0F, y}));
        drawing.strokes.back().kind = StrokeKind::hatch;
    }
    return drawing;
}

TEST(Plotter, HatchingThatLeavesNoPaperIsThinned)
{
    VectorDrawing clogged = rows(5, 0.21F); // seven tenths of the pen's width
    output::thin_hatching(clogged);
    ASSERT_EQ(clogged.strokes.size(), 3U);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(clogged.strokes[i].points, rows(5, 0.21F).strokes[2 * i].points) << "every second row";
    }
    VectorDrawing dark = rows(5, 0.3F);
    output::thin_hatching(dark);
    ASSERT_EQ(dark.strokes.size(), 5U);
    for (size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(dark.strokes[i].points, rows(5, 0.3F).strokes[i].points);
    }
}

TEST(Plotter, HatchingInANarrowPlaceGoesAndLinesAndCrossingStrokesStay)
{
    VectorDrawing drawing =
        page({even_line({10.0F, 20.0F}, {30.0F, 20.0F}), even_line({10.0F, 20.4F}, {30.0F, 20.4F}),
              even_line({20.0F, 10.0F}, {20.0F, 30.0F})});
    drawing.strokes.back().kind = StrokeKind::hatch;
    const std::vector<VectorStroke> kept = drawing.strokes;
    VectorStroke between = even_line({15.0F, 20.2F}, {45.0F, 20.2F});
    between.kind = StrokeKind::hatch;
    drawing.strokes.push_back(between);
    output::thin_hatching(drawing);
    ASSERT_EQ(drawing.strokes.size(), 4U);
    for (size_t i = 0; i < kept.size(); ++i) {
        EXPECT_EQ(drawing.strokes[i].points, kept[i].points);
    }
    EXPECT_NEAR(drawing.strokes[3].points.front().page_mm.x, 30.0F, 0.3F) << "beyond the narrow place";
    EXPECT_FLOAT_EQ(drawing.strokes[3].points.back().page_mm.x, 45.0F);
}

TEST(Plotter, EveryStrokeOnceAndTheWayIsShort)
{
    VectorDrawing drawing = random_page(500);
    const PlotterWork before = plotter_work(drawing);
    const std::vector<output::PenStroke> ends = ends_of(drawing);
    const auto greedy = output::greedy_order(ends, glm::vec2(0.0F));
    const auto shortest = output::shortest_order(ends, glm::vec2(0.0F));
    std::vector<uint32_t> seen;
    seen.reserve(shortest.size());
    for (const output::PenStep& step : shortest) {
        seen.push_back(step.stroke);
    }
    std::ranges::sort(seen);
    ASSERT_EQ(seen.size(), ends.size());
    for (uint32_t i = 0; i < ends.size(); ++i) {
        EXPECT_EQ(seen[i], i);
    }
    const double greedy_mm = output::travel_mm(ends, greedy, glm::vec2(0.0F));
    const double shortest_mm = output::travel_mm(ends, shortest, glm::vec2(0.0F));
    EXPECT_LT(greedy_mm, 0.12 * before.lifted_mm);
    EXPECT_LT(shortest_mm, 0.84 * greedy_mm);
    prepare_for_plotter(drawing);
    EXPECT_LE(plotter_work(drawing).lifted_mm, 1.02 * shortest_mm);
}

/// Length of the shortest travel from `from` over all strokes that are not drawn yet, found by trying every
/// order.
double least_travel_mm(const std::vector<output::PenStroke>& strokes, std::vector<bool>& is_drawn,
                       const glm::vec2& from)
{
    double least = std::numeric_limits<double>::max();
    for (size_t i = 0; i < strokes.size(); ++i) {
        if (is_drawn[i]) {
            continue;
        }
        is_drawn[i] = true;
        least = std::min(least, glm::distance(from, strokes[i].start) +
                                    least_travel_mm(strokes, is_drawn, strokes[i].end));
        least = std::min(least, glm::distance(from, strokes[i].end) +
                                    least_travel_mm(strokes, is_drawn, strokes[i].start));
        is_drawn[i] = false;
    }
    return least == std::numeric_limits<double>::max() ? 0.0 : least;
}

TEST(Plotter, TheTravelIsNearlyTheShortest)
{
    double shortest_mm = 0.0;
    double least_mm = 0.0;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(0.0F, 100.0F);
    for (int page = 0; page < 50; ++page) {
        std::vector<output::PenStroke> strokes(6);
        for (output::PenStroke& stroke : strokes) {
            stroke = {{place(random), place(random)}, {place(random), place(random)}};
        }
        std::vector<bool> is_drawn(strokes.size());
        const double least = least_travel_mm(strokes, is_drawn, glm::vec2(0.0F));
        const double found =
            output::travel_mm(strokes, output::shortest_order(strokes, glm::vec2(0.0F)), glm::vec2(0.0F));
        EXPECT_GT(found, least - 0.01);
        least_mm += least;
        shortest_mm += found;
    }
    EXPECT_LT(shortest_mm, 1.05 * least_mm);
}

/// Strokes of no length in one place, and equal strokes, are ordered too.
TEST(Plotter, StrokesInOnePlaceAreOrdered)
{
    const std::vector<output::PenStroke> dots(40, {glm::vec2(7.0F), glm::vec2(7.0F)});
    EXPECT_EQ(output::shortest_order(dots, glm::vec2(0.0F)).size(), dots.size());
    EXPECT_TRUE(output::shortest_order({}, glm::vec2(0.0F)).empty());
}

TEST(Plotter, WhatIsThereTwiceIsDrawnOnce)
{
    const VectorStroke first = even_line({10.0F, 10.0F}, {60.0F, 12.0F});
    VectorStroke again = even_line({60.0F, 12.05F}, {10.0F, 10.05F});
    VectorDrawing drawing = page({first, again, first});
    output::remove_overlaps(drawing);
    ASSERT_EQ(drawing.strokes.size(), 1U);
    EXPECT_EQ(drawing.strokes[0].points, first.points);
}

TEST(Plotter, OnlyTheStretchThatRunsAlongIsLeftOut)
{
    VectorDrawing drawing =
        page({even_line({10.0F, 10.0F}, {50.0F, 10.0F}), even_line({30.0F, 10.0F}, {80.0F, 10.0F})});
    output::remove_overlaps(drawing);
    ASSERT_EQ(drawing.strokes.size(), 2U);
    EXPECT_NEAR(drawing.strokes[1].points.front().page_mm.x, 50.0, 0.5);
    EXPECT_NEAR(drawing.strokes[1].points.back().page_mm.x, 80.0, 1e-3);
}

TEST(Plotter, LinesThatCrossOrLieSideBySideStay)
{
    std::vector<VectorStroke> strokes{even_line({10.0F, 50.0F}, {90.0F, 50.0F}),
                                      even_line({10.0F, 45.0F}, {90.0F, 55.0F}),
                                      even_line({50.0F, 10.0F}, {50.0F, 90.0F})};
    for (int i = 0; i < 10; ++i) {
        const float y = 60.0F + 0.31F * static_cast<float>(i);
        strokes.push_back(even_line({10.0F, y}, {90.0F, y}));
    }
    VectorDrawing drawing = page(strokes);
    output::remove_overlaps(drawing);
    EXPECT_EQ(drawing.strokes.size(), strokes.size());
}

TEST(Plotter, ThinHatchingGoesAndThinLinesStay)
{
    VectorStroke hatch = even_line({10.0F, 10.0F}, {30.0F, 10.0F});
    hatch.kind = StrokeKind::hatch;
    for (size_t i = 8; i <= 12; ++i) {
        hatch.points[i].width_mm = 0.1F;
    }
    VectorDrawing drawing = page({hatch, even_line({10.0F, 20.0F}, {30.0F, 20.0F}, 0.05F)});
    output::remove_thin_hatching(drawing);
    ASSERT_EQ(drawing.strokes.size(), 3U);
    EXPECT_NEAR(drawing.strokes[0].points.back().page_mm.x, 17.0, 1e-3);
    EXPECT_NEAR(drawing.strokes[1].points.front().page_mm.x, 23.0, 1e-3);
}

/// A straight line in pieces, with gaps below the pen's width of 0.3 mm, becomes one stroke; a wider gap
/// stays.
TEST(Plotter, PiecesOfALineBecomeOneStroke)
{
    VectorDrawing drawing =
        page({even_line({50.0F, 10.0F}, {30.2F, 10.0F}), // in reverse
              even_line({10.0F, 10.0F}, {30.0F, 10.0F}), even_line({50.25F, 10.0F}, {70.0F, 10.0F}),
              even_line({70.5F, 10.0F}, {90.0F, 10.0F})});
    output::join_strokes(drawing);
    ASSERT_EQ(drawing.strokes.size(), 2U);
    const std::vector<VectorPoint>& points = drawing.strokes[0].points;
    EXPECT_EQ(points.size(), 63U);
    EXPECT_FLOAT_EQ(std::min(points.front().page_mm.x, points.back().page_mm.x), 10.0F);
    EXPECT_FLOAT_EQ(std::max(points.front().page_mm.x, points.back().page_mm.x), 70.0F);
    EXPECT_TRUE(std::ranges::is_sorted(points, {}, [&](const VectorPoint& point) {
        return points.front().page_mm.x < points.back().page_mm.x ? point.page_mm.x : -point.page_mm.x;
    }));
}

/// Lines that meet at a corner stay apart, unless one is too short to be drawn by itself. Lines side by side,
/// hatching beside a line, and dashes are not joined.
TEST(Plotter, OnlyWhatContinuesIsJoined)
{
    VectorStroke hatch = even_line({60.1F, 40.0F}, {80.0F, 40.0F});
    hatch.kind = StrokeKind::hatch;
    VectorStroke dash = even_line({10.0F, 70.0F}, {20.0F, 70.0F});
    dash.is_hidden = true;
    VectorStroke next_dash = even_line({20.2F, 70.0F}, {30.0F, 70.0F});
    next_dash.is_hidden = true;
    VectorDrawing apart =
        page({even_line({10.0F, 10.0F}, {30.0F, 10.0F}), even_line({30.0F, 10.0F}, {30.0F, 30.0F}),
              even_line({40.0F, 40.0F}, {60.0F, 40.0F}), hatch, even_line({40.0F, 40.2F}, {60.0F, 40.2F}),
              dash, next_dash});
    const size_t count = apart.strokes.size();
    output::join_strokes(apart);
    EXPECT_EQ(apart.strokes.size(), count);
    VectorDrawing step =
        page({even_line({10.0F, 10.0F}, {30.0F, 10.0F}), even_line({30.0F, 10.0F}, {30.0F, 10.8F}),
              even_line({30.0F, 10.8F}, {50.0F, 10.8F})});
    output::join_strokes(step);
    ASSERT_EQ(step.strokes.size(), 1U);
    EXPECT_EQ(step.strokes[0].points.size(), 61U);
}

/// A circle of pieces is joined without an end, and a closed stroke stays as it is.
TEST(Plotter, ALoopOfPiecesBecomesOneOpenStroke)
{
    VectorDrawing drawing = page({});
    for (int i = 0; i < 40; ++i) {
        const auto at = [](int k) {
            const float angle = static_cast<float>(k) * 0.157F;
            return glm::vec2(50.0F) + 10.0F * glm::vec2(std::cos(angle), std::sin(angle));
        };
        drawing.strokes.push_back(even_line(at(i), at(i + 1)));
    }
    VectorStroke closed = even_line({10.0F, 10.0F}, {20.0F, 10.0F});
    closed.points.push_back(closed.points.front());
    closed.is_closed = true;
    drawing.strokes.push_back(closed);
    output::join_strokes(drawing);
    ASSERT_EQ(drawing.strokes.size(), 2U);
    EXPECT_EQ(drawing.strokes[0].points.size(), 801U);
    EXPECT_EQ(drawing.strokes[1].points, closed.points);
    EXPECT_TRUE(drawing.strokes[1].is_closed);
}

/// Of strokes below a millimetre, a line that stands alone is kept.
TEST(Plotter, ScrapsGoAndAnEyeStays)
{
    VectorStroke hatch = even_line({10.0F, 80.0F}, {10.8F, 80.0F});
    hatch.kind = StrokeKind::hatch;
    const VectorStroke eye = even_line({50.0F, 50.0F}, {50.8F, 50.0F});
    VectorDrawing drawing = page(
        {even_line({10.0F, 10.0F}, {30.0F, 10.0F}), even_line({20.0F, 11.0F}, {20.8F, 11.2F}), hatch, eye});
    output::remove_scraps(drawing);
    ASSERT_EQ(drawing.strokes.size(), 2U);
    EXPECT_EQ(drawing.strokes[1].points, eye.points);
}

TEST(Plotter, HiddenLinesBecomeDashes)
{
    VectorStroke hidden = even_line({10.0F, 10.0F}, {31.0F, 10.0F});
    hidden.is_hidden = true;
    VectorDrawing drawing = page({hidden});
    output::cut_dashes(drawing);
    EXPECT_EQ(drawing.strokes.size(), 10U);
    EXPECT_NEAR(plotter_work(drawing).drawn_mm, 12.0, 1.5);
}

TEST(Plotter, TheSameOrderAgain)
{
    VectorDrawing first = random_page(300);
    VectorDrawing second = random_page(300);
    prepare_for_plotter(first);
    prepare_for_plotter(second);
    ASSERT_EQ(first.strokes.size(), second.strokes.size());
    for (size_t i = 0; i < first.strokes.size(); ++i) {
        EXPECT_EQ(first.strokes[i].points, second.strokes[i].points);
    }
}

} // namespace
} // namespace estampe
