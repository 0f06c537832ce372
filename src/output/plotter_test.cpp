// SPDX-License-Identifier: MIT
#include <estampe/vector_drawing.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

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
    const auto order = output::shortest_order(rows, glm::vec2(0.0F), 1'000'000);
    EXPECT_DOUBLE_EQ(output::travel_mm(rows, order, glm::vec2(0.0F)), 4.0);
}

TEST(Plotter, EveryStrokeOnceAndTheWayIsShort)
{
    VectorDrawing drawing = random_page(500);
    const PlotterWork before = plotter_work(drawing);
    std::vector<output::PenStroke> ends;
    ends.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        ends.push_back({stroke.points.front().page_mm, stroke.points.back().page_mm});
    }
    const auto greedy = output::shortest_order(ends, glm::vec2(0.0F), 0);
    const auto turned = output::shortest_order(ends, glm::vec2(0.0F), 10'000'000);
    std::vector<uint32_t> seen;
    seen.reserve(turned.size());
    for (const output::PenStep& step : turned) {
        seen.push_back(step.stroke);
    }
    std::ranges::sort(seen);
    for (uint32_t i = 0; i < ends.size(); ++i) {
        EXPECT_EQ(seen.at(i), i);
    }
    const double greedy_mm = output::travel_mm(ends, greedy, glm::vec2(0.0F));
    const double turned_mm = output::travel_mm(ends, turned, glm::vec2(0.0F));
    EXPECT_LT(greedy_mm, 0.12 * before.lifted_mm);
    EXPECT_LT(turned_mm, 0.92 * greedy_mm);
    prepare_for_plotter(drawing);
    EXPECT_LE(plotter_work(drawing).lifted_mm, 1.02 * turned_mm);
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
