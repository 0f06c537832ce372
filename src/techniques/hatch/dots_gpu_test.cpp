// SPDX-License-Identifier: MIT
// Screentones: mean ink of dots, and the object that they move with.
#include "techniques/hatch/hatch.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "shaders/scene.glsl.h"
#include "support/gpu_device.hpp"
#include "techniques/hatch/hatch_test_canvas.hpp"

namespace estampe {
namespace {

constexpr glm::uvec2 dots_px(192, 96);
constexpr float pixels_per_mm = 4.0F;

/// Ink of a page of one darkness; its object is seen at `object_px`.
std::vector<float> dots_ink(const hatch::HatchStyle& style, const test::Painter<float>& dark,
                            const glm::vec2& object_px)
{
    shared::FrameGlobals globals = features::frame_globals({}, {}, glm::dvec3(0.0), {.size_px = dots_px});
    globals.clip_from_anchor = glm::mat4(1.0F);
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    const glm::vec2 ndc = 2.0F * object_px / glm::vec2(dots_px) - 1.0F;
    shared::DrawRecord draw{};
    draw.anchor_from_object = glm::translate(glm::mat4(1.0F), glm::vec3(ndc, 0.5F));
    gpu::Buffer draws = gpu::upload_buffer(test::shared_device(), "draws", std::vector{draw});
    auto seen = test::Layer::words(dots_px, [](glm::uvec2) { return 1U; });
    auto unread = test::Layer::words(glm::uvec2(1), [](glm::uvec2) { return 1U; });
    auto darkness = test::Layer::coverage(dots_px, dark);
    test::PaperToInk paper(dots_px);
    gpu::Graph graph;
    const gpu::ImageId none = unread.in(graph);
    const hatch::HatchInputs in{.frame = gpu::import_whole(graph, "frame", frame),
                                .draw = seen.in(graph),
                                .depth = none,
                                .normal = none,
                                .color = none,
                                .coordinate = none,
                                .footprint = none,
                                .light = none,
                                .screen = none,
                                .pixels_per_mm = pixels_per_mm,
                                .size_px = dots_px,
                                .draws = gpu::import_whole(graph, "draws", draws)};
    return test::run_and_read_coverage(
        graph, hatch::add_dots(graph, in, paper.in(graph, darkness.in(graph)), style));
}

double mean_of(const std::vector<float>& ink)
{
    double sum = 0.0;
    for (const float pixel : ink) {
        sum += pixel;
    }
    return sum / static_cast<double>(ink.size());
}

hatch::HatchStyle dots(float pitch_mm, int tones)
{
    hatch::HatchStyle style;
    style.strokes = hatch::Strokes::dots;
    style.dots_mm = pitch_mm;
    style.dots_tones = tones;
    style.black_above = 2.0F;
    return style;
}

TEST(HatchDots, InkIsTheDarknessAtEveryPitchAndTurn)
{
    for (const float pitch_mm : {0.7F, 1.0F, 2.5F}) {
        for (const float turn_deg : {0.0F, 15.0F, 45.0F}) {
            hatch::HatchStyle style = dots(pitch_mm, 0);
            style.dots_deg = turn_deg;
            for (const float dark : {0.05F, 0.2F, 0.4F, 0.6F, 0.75F, 0.85F, 0.95F}) {
                if (dark > 0.9F && pitch_mm < 1.0F) {
                    continue; // gaps would be narrower than half a pixel
                }
                const double mean =
                    mean_of(dots_ink(style, [&](glm::uvec2) { return dark; }, {40.3F, 20.7F}));
                EXPECT_NEAR(mean, dark, 0.025) << pitch_mm << " mm, " << turn_deg << " deg";
            }
        }
    }
}

TEST(HatchDots, AreCutFromAFewSheets)
{
    const hatch::HatchStyle style = dots(1.0F, 4);
    const auto mean = [&](float dark) {
        return mean_of(dots_ink(style, [&](glm::uvec2) { return dark; }, {40.0F, 20.0F}));
    };
    EXPECT_EQ(mean(0.12F), 0.0);
    EXPECT_EQ(mean(0.13F), mean(0.37F));
    EXPECT_NEAR(mean(0.3F), 0.25, 0.025);
    EXPECT_LT(mean(0.37F), mean(0.38F));
    EXPECT_EQ(mean(0.9F), 1.0);
}

TEST(HatchDots, GoAlongWithTheirObject)
{
    const hatch::HatchStyle style = dots(1.7F, 0);
    const auto dark = [](glm::uvec2) { return 0.4F; };
    const std::vector<float> ink = dots_ink(style, dark, {40.0F, 20.0F});
    const std::vector<float> moved = dots_ink(style, dark, {47.0F, 25.0F});
    for (uint32_t y = 5; y < dots_px.y; ++y) {
        for (uint32_t x = 7; x < dots_px.x; ++x) {
            ASSERT_NEAR(moved[y * dots_px.x + x], ink[(y - 5) * dots_px.x + x - 7], 0.01F) << x << ' ' << y;
        }
    }
}

TEST(HatchDots, LeaveWhatIsPaleAndCoverWhatIsBlack)
{
    hatch::HatchStyle style = dots(1.0F, 0);
    style.black_above = 0.7F;
    const auto ink = dots_ink(style, [](glm::uvec2 pixel) { return pixel.x < dots_px.x / 2 ? 0.0F : 0.75F; },
                              {40.0F, 20.0F});
    for (uint32_t i = 0; i < ink.size(); ++i) {
        ASSERT_EQ(ink[i], i % dots_px.x < dots_px.x / 2 ? 0.0F : 1.0F) << i;
    }
}

} // namespace
} // namespace estampe
