// SPDX-License-Identifier: MIT
// Loose strokes end at random before or beyond the edge of a tone.
#include <gtest/gtest.h>

#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch_test_canvas.hpp"

namespace estampe {
namespace {

using test::Canvas;

constexpr glm::uvec2 loose_page_px{256, 256};
constexpr uint32_t tone_edge_px = 128; // the tone ends here
constexpr float loose_px = 30.0F;

/// A page whose level strokes are of the darkness `dark` up to the edge, and of the darkness `beyond` past
/// it.
Canvas two_tones(
    float dark, float beyond, const test::Painter<bool>& seen = [](glm::uvec2) { return true; })
{
    Canvas canvas(loose_page_px, shared::strokes_uv);
    canvas.paint_seen(seen);
    canvas.paint_darkness([=](glm::uvec2 p) { return !seen(p) ? 0.0F : p.x < tone_edge_px ? dark : beyond; });
    canvas.paint_surface(test::flat_patch(1.0 / 64.0));
    return canvas;
}

/// Lines without gaps that run to the right.
hatch::HatchStyle level_pen(float loose_mm)
{
    hatch::HatchStyle style = test::pen();
    style.slant_deg = 0.0F;
    style.gap_mm = style.wobble_mm = style.pressure = 0.0F;
    style.layers = 1;
    style.loose_mm = loose_mm;
    return style;
}

/// Distances from the edge of the tone at which the strokes of a page end, one for each row with a stroke.
std::vector<double> ends_px(const std::vector<float>& ink)
{
    std::vector<double> ends;
    for (uint32_t y = 0; y < loose_page_px.y; ++y) {
        const float* const row = &ink[size_t{y} * loose_page_px.x];
        if (row[40] < 0.7F) {
            continue;
        }
        uint32_t end = 40;
        while (end < loose_page_px.x && row[end] > 0.35F) {
            ++end;
        }
        ends.push_back(static_cast<double>(end) - tone_edge_px);
    }
    return ends;
}

TEST(HatchLoose, AnEvenToneKeepsItsStrokes)
{
    Canvas canvas = two_tones(0.4F, 0.4F);
    EXPECT_EQ(canvas.ink(level_pen(loose_px)), canvas.ink(level_pen(0.0F)));
}

TEST(HatchLoose, StrokesEndOnBothSidesOfTheEdgeWithinTheDistance)
{
    Canvas canvas = two_tones(0.4F, 0.0F);
    for (const double end_px : ends_px(canvas.ink(level_pen(0.0F)))) {
        EXPECT_NEAR(end_px, 0.0, 1.0);
    }
    const std::vector<double> ends = ends_px(canvas.ink(level_pen(loose_px)));
    ASSERT_GT(ends.size(), 40U);
    double sum = 0.0;
    double squares = 0.0;
    for (const double end_px : ends) {
        EXPECT_LE(std::abs(end_px), loose_px + 1.0);
        sum += end_px;
        squares += end_px * end_px;
    }
    const double mean_px = sum / static_cast<double>(ends.size());
    const double spread_px = std::sqrt(squares / static_cast<double>(ends.size()));
    EXPECT_NEAR(mean_px, 0.0, 0.25 * loose_px);
    // An even spread over [-1, 1] is 0.58; the blend of strips of two widths narrows it.
    EXPECT_GT(spread_px, 0.25 * loose_px);
    EXPECT_LT(spread_px, 0.6 * loose_px);
}

TEST(HatchLoose, TheInkOfBothTonesIsThatOfTheTones)
{
    Canvas canvas = two_tones(0.4F, 0.1F);
    const std::vector<float> ink = canvas.ink(level_pen(loose_px));
    double sum = 0.0;
    for (const float value : ink) {
        sum += value;
    }
    EXPECT_NEAR(sum / static_cast<double>(ink.size()), 0.25, 0.02);
}

TEST(HatchLoose, StrokesStopWhereTheSurfaceEnds)
{
    const auto seen = [](glm::uvec2 p) { return p.x < tone_edge_px; };
    Canvas canvas = two_tones(0.4F, 0.0F, seen);
    const std::vector<float> ink = canvas.ink(level_pen(loose_px));
    EXPECT_EQ(ink, canvas.ink(level_pen(0.0F)));
}

} // namespace
} // namespace estampe
