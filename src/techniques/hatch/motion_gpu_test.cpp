// SPDX-License-Identifier: MIT
// Strokes stay still on their surface while the view zooms. The same points of a wall are sampled in every
// frame, so that all changes come from the strokes and none from resampling.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "features/hatching/hatching.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch_test_canvas.hpp"

namespace estampe {
namespace {

using test::Canvas;
using test::Patch;
using test::pen;
using test::Surface;

constexpr glm::uvec2 moving_page_px{320, 240};
constexpr int frames = 71; // an octave of zoom, 1 % per frame

struct StrokeMotion {
    double mean_change = 0.0;
    double jumps = 0.0; ///< share of pixels that change by more than a half, over all frames
    double worst_frame = 0.0;
    double median_frame = 0.0;
};

/// Ink of one frame; `unit_per_px` is the size of a pixel on the wall.
using Frame = std::function<std::vector<float>(double unit_per_px)>;

StrokeMotion measure(const Frame& ink_at)
{
    std::vector<double> jumps;
    std::vector<float> before;
    StrokeMotion motion;
    double unit_per_px = 0.013;
    for (int frame = 0; frame < frames; ++frame, unit_per_px /= 1.01) {
        std::vector<float> now = ink_at(unit_per_px);
        if (!before.empty()) {
            double change = 0.0;
            double jumped = 0.0;
            for (size_t i = 0; i < now.size(); ++i) {
                const double difference =
                    std::abs(static_cast<double>(now[i]) - static_cast<double>(before[i]));
                change += difference;
                jumped += difference > 0.5 ? 1.0 : 0.0;
            }
            motion.mean_change += change / static_cast<double>(now.size()) / (frames - 1);
            jumps.push_back(jumped / static_cast<double>(now.size()));
        }
        before = std::move(now);
    }
    motion.jumps = std::accumulate(jumps.begin(), jumps.end(), 0.0) / static_cast<double>(jumps.size());
    std::sort(jumps.begin(), jumps.end());
    motion.worst_frame = jumps.back();
    motion.median_frame = jumps[jumps.size() / 2];
    return motion;
}

void report(const char* name, const StrokeMotion& motion)
{
    fmt::print("{:28} warp error {:.4f}; jumps {:.4f} %, worst frame {:.4f} %, median {:.4f} %\n", name,
               motion.mean_change, 100.0 * motion.jumps, 100.0 * motion.worst_frame,
               100.0 * motion.median_frame);
}

/// The wall's points in the first frame, with coordinates for another pixel size.
Surface same_points(double unit_per_px)
{
    return [=](glm::dvec2 p) {
        const auto g = static_cast<float>(unit_per_px);
        return Patch{.coordinate = glm::vec3(p * 0.013, 0.0), .dx = {g, 0, 0}, .dy = {0, g, 0}};
    };
}

float darkness_at(glm::uvec2 pixel)
{
    return 0.1F + 0.8F * static_cast<float>(pixel.x) / static_cast<float>(moving_page_px.x);
}

class HatchMotion : public testing::Test {
protected:
    StrokeMotion of_lines(const hatch::HatchStyle& style)
    {
        return measure([&](double unit_per_px) {
            canvas_.paint_surface(same_points(unit_per_px));
            return canvas_.ink(style);
        });
    }

    StrokeMotion of_map(const hatch::HatchStyle& style)
    {
        const features::StyleTables tables;
        hatch::MapImages map =
            hatch::upload_map(test::shared_device(), features::load_map(features::map_choice(tables)),
                              style.map_tone, style.map_contrast);
        return measure([&](double unit_per_px) {
            canvas_.paint_surface(same_points(unit_per_px));
            return canvas_.ink(style, &map);
        });
    }

    void SetUp() override { canvas_.paint_darkness(darkness_at); }

    Canvas canvas_{moving_page_px, shared::strokes_uv};
};

TEST_F(HatchMotion, LinesHoldStill)
{
    const StrokeMotion lines = of_lines(pen());
    report("lines", lines);
    EXPECT_LE(lines.mean_change, 0.02);
    EXPECT_LE(lines.jumps, 0.001);
    EXPECT_LE(lines.worst_frame, 3.0 * lines.median_frame + 0.001);
}

TEST_F(HatchMotion, MapsHoldStill)
{
    hatch::HatchStyle style;
    style.map_texel_mm = 1.0F;
    const StrokeMotion ordered = of_map(style);
    report("map, stroke by stroke", ordered);
    style.map_tone = hatch::MapTone::blend;
    style.map_contrast = 1.0F;
    report("map, blended and filtered", of_map(style));
    EXPECT_LE(ordered.mean_change, 0.02);
    EXPECT_LE(ordered.jumps, 0.001);
    EXPECT_LE(ordered.worst_frame, 3.0 * ordered.median_frame + 0.001);
}

TEST_F(HatchMotion, LinesThatAreLockedToThePageDoNot)
{
    // Checks the measure itself: it detects strokes that are fixed to the page (the shower-door effect).
    const hatch::HatchStyle style = pen();
    const StrokeMotion page = measure([&](double unit_per_px) {
        const double zoom = 0.013 / unit_per_px;
        canvas_.paint_surface([=](glm::dvec2 p) {
            return Patch{
                .coordinate = glm::vec3(p * zoom * 0.013, 0.0), .dx = {0.013F, 0, 0}, .dy = {0, 0.013F, 0}};
        });
        return canvas_.ink(style);
    });
    report("locked to the page", page);
    EXPECT_GT(page.mean_change, 0.1);
    EXPECT_GT(page.jumps, 0.01);
}

} // namespace
} // namespace estampe
