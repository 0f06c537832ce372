// SPDX-License-Identifier: MIT
// Properties of lines, on surfaces that the test sets pixel by pixel: exact tone at every zoom, on planes in
// perspective and on spheres, and strokes of one width.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch_test_canvas.hpp"

namespace estampe {
namespace {

using test::Canvas;
using test::flat_patch;
using test::Patch;
using test::pen;
using test::Surface;

constexpr uint32_t line_tones = 19;

/// Darkness of the i-th tone.
double tone_of(uint32_t i)
{
    return 0.05 * (i + 1);
}

/// 19 patches in one picture, each of one darkness from 0.05 to 0.95.
class ToneSheet {
public:
    ToneSheet(uint32_t kind, uint32_t patch_px) : patch_px_(patch_px), canvas_(size_px(), kind)
    {
        canvas_.paint_darkness(
            [this](glm::uvec2 pixel) { return static_cast<float>(tone_of(patch_at(pixel))); });
    }

    /// Mean ink of each patch.
    std::array<double, line_tones> ink(double unit_per_px, const hatch::HatchStyle& style)
    {
        canvas_.paint_surface(flat_patch(unit_per_px));
        const std::vector<float> ink = canvas_.ink(style);
        std::array<double, line_tones + 1> sums{};
        for (uint32_t i = 0; i < ink.size(); ++i) {
            sums.at(patch_at({i % size_px().x, i / size_px().x})) += ink[i];
        }
        std::array<double, line_tones> means{};
        for (uint32_t i = 0; i < line_tones; ++i) {
            means.at(i) = sums.at(i) / (patch_px_ * patch_px_);
        }
        return means;
    }

private:
    [[nodiscard]] glm::uvec2 size_px() const { return {5 * patch_px_, 4 * patch_px_}; }

    [[nodiscard]] uint32_t patch_at(glm::uvec2 pixel) const
    {
        return pixel.x / patch_px_ + 5 * (pixel.y / patch_px_);
    }

    uint32_t patch_px_;
    Canvas canvas_;
};

/// Worst error of the mean ink over `zooms` zooms in eight octaves: of a single patch, and of a tone over all
/// zooms. Lines repeat with each octave, so an odd number of zooms samples that many different phases.
std::pair<double, double> worst_errors(ToneSheet& sheet, const hatch::HatchStyle& style, int zooms)
{
    double worst_patch = 0.0;
    std::array<double, line_tones> means{};
    for (int zoom = 0; zoom < zooms; ++zoom) {
        const auto ink = sheet.ink(0.01 * std::exp2(8.0 * zoom / zooms), style);
        for (uint32_t i = 0; i < line_tones; ++i) {
            worst_patch = std::max(worst_patch, std::abs(ink.at(i) - tone_of(i)));
            means.at(i) += ink.at(i) / zooms;
            EXPECT_TRUE(i == 0 || ink.at(i) > ink.at(i - 1)) << "tone " << tone_of(i) << ", zoom " << zoom;
        }
    }
    double worst_tone = 0.0;
    for (uint32_t i = 0; i < line_tones; ++i) {
        worst_tone = std::max(worst_tone, std::abs(means.at(i) - tone_of(i)));
    }
    fmt::print("worst patch {:.4f}, worst tone over all zooms {:.4f}\n", worst_patch, worst_tone);
    return {worst_patch, worst_tone};
}

TEST(HatchLines, RuledLinesAreExactAtEveryZoom)
{
    ToneSheet sheet(shared::strokes_uv, 160);
    hatch::HatchStyle ruled = pen();
    ruled.wobble_mm = ruled.gap_mm = ruled.taper_mm = ruled.pressure = 0.0F;
    ruled.layers = 1;
    EXPECT_LE(worst_errors(sheet, ruled, 29).first, 0.005);
}

TEST(HatchLines, DrawnLinesKeepTheToneAtEveryZoom)
{
    ToneSheet sheet(shared::strokes_uv, 256);
    const auto [patch, tone_of] = worst_errors(sheet, pen(), 29);
    EXPECT_LE(tone_of, 0.003);
    EXPECT_LE(patch, 0.012); // a patch holds few strokes with random ends and pressure
}

TEST(HatchLines, DrawnLinesKeepTheToneOfEveryPatchThatHoldsEnoughStrokes)
{
    // Errors of single strokes are random: the mean error halves as the side doubles.
    ToneSheet sheet(shared::strokes_uv, 512);
    EXPECT_LE(worst_errors(sheet, pen(), 7).first, 0.005);
}

TEST(HatchLines, ShortStrokesKeepTheToneAtEveryZoom)
{
    ToneSheet sheet(shared::strokes_uv, 256);
    hatch::HatchStyle style = pen();
    style.growth = 1.0F;
    const auto [patch, tone_of] = worst_errors(sheet, style, 15);
    EXPECT_LE(tone_of, 0.005);
    EXPECT_LE(patch, 0.03);
}

/// Mean and largest difference of ink and darkness over all fully visible windows of 64 pixels.
std::pair<double, double> window_errors(const std::vector<float>& ink, const test::Painter<float>& darkness,
                                        const Surface& surface, glm::uvec2 size_px)
{
    constexpr uint32_t window_px = 64;
    double sum = 0.0;
    double worst = 0.0;
    int windows = 0;
    for (uint32_t y = 0; y + window_px <= size_px.y; y += window_px / 2) {
        for (uint32_t x = 0; x + window_px <= size_px.x; x += window_px / 2) {
            double difference = 0.0;
            bool seen = true;
            for (uint32_t i = 0; i < window_px * window_px; ++i) {
                const glm::uvec2 pixel(x + i % window_px, y + i / window_px);
                seen = seen && surface(glm::dvec2(pixel) + 0.5).seen;
                difference += ink[static_cast<size_t>(pixel.y) * size_px.x + pixel.x] - darkness(pixel);
            }
            if (seen) {
                const double error = std::abs(difference) / (window_px * window_px);
                sum += error;
                worst = std::max(worst, error);
                ++windows;
            }
        }
    }
    return {sum / std::max(windows, 1), worst};
}

constexpr glm::uvec2 lines_page_px{640, 480};

/// A floor up to the horizon, seen from 1.6 m above.
Patch floor_at(glm::dvec2 p)
{
    const auto hit = [](glm::dvec2 q) {
        const double t = 1.6 / ((q.y + 60.0) / 500.0);
        return glm::dvec3((q.x - 320.0) / 500.0 * t, 0.0, t);
    };
    const glm::dvec3 here = hit(p);
    return {.coordinate = here,
            .dx = hit(p + glm::dvec2(0.5, 0.0)) - hit(p - glm::dvec2(0.5, 0.0)),
            .dy = hit(p + glm::dvec2(0.0, 0.5)) - hit(p - glm::dvec2(0.0, 0.5)),
            .normal = {0.0F, 1.0F, 0.0F}};
}

/// A sphere of 230 pixels with coordinates in radii.
Patch ball_at(glm::dvec2 p)
{
    const glm::dvec2 q = (p - glm::dvec2(320.0, 240.0)) / 230.0;
    const double z = std::sqrt(std::max(1.0 - glm::dot(q, q), 1e-3));
    return {.coordinate = glm::vec3(q, z),
            .dx = glm::dvec3(1.0, 0.0, -q.x / z) / 230.0,
            .dy = glm::dvec3(0.0, 1.0, -q.y / z) / 230.0,
            .normal = glm::vec3(q, z),
            .seen = glm::dot(q, q) < 0.9};
}

void expect_tone_in_windows(const Surface& surface, uint32_t kind)
{
    const auto darkness = [&](glm::uvec2 pixel) {
        const bool seen = surface(glm::dvec2(pixel) + 0.5).seen;
        return seen ? 0.1F + 0.8F * static_cast<float>(pixel.x) / static_cast<float>(lines_page_px.x) : 0.0F;
    };
    Canvas canvas(lines_page_px, kind);
    canvas.paint_darkness(darkness);
    canvas.paint_surface(surface);
    canvas.paint_normals([&](glm::uvec2 pixel) { return surface(glm::dvec2(pixel) + 0.5).normal; });
    const auto [mean, worst] = window_errors(canvas.ink(pen()), darkness, surface, lines_page_px);
    fmt::print("windows of 64 pixels: mean error {:.4f}, worst {:.4f}\n", mean, worst);
    EXPECT_LE(mean, 0.01);
    EXPECT_LE(worst, 0.05);
}

TEST(HatchLines, AFloorInPerspectiveKeepsItsTone)
{
    expect_tone_in_windows(floor_at, shared::strokes_solid);
}

TEST(HatchLines, ABallKeepsItsTone)
{
    expect_tone_in_windows(ball_at, shared::strokes_solid);
}

TEST(HatchLines, StrokesHaveOneWidthAtEveryDistance)
{
    // Vertical lines, every other one as thin as possible: runs of ink along a row are the widths.
    hatch::HatchStyle style = pen();
    style.wobble_mm = style.gap_mm = style.taper_mm = style.pressure = 0.0F;
    style.slant_deg = 90.0F;
    style.layers = 1;
    style.width_mm = 3.0F;
    constexpr glm::uvec2 size_px{2048, 16};
    Canvas canvas(size_px, shared::strokes_uv);
    canvas.paint_darkness([](glm::uvec2) { return 0.2F; });
    for (int step = 0; step < 24; ++step) { // six octaves
        canvas.paint_surface(flat_patch(0.01 * std::exp2(step / 4.0)));
        const std::vector<float> ink = canvas.ink(style);
        std::vector<float> widths;
        float width = 0.0F;
        for (uint32_t x = 0; x < size_px.x; ++x) {
            if (ink[x] > 0.0F) {
                width += ink[x];
            } else if (width > 0.0F) {
                widths.push_back(width);
                width = 0.0F;
            }
        }
        // The most frequent width of lines that are not newborn, in bins of a tenth of a pixel.
        std::array<int, 64> classes{};
        for (const float w : widths) {
            classes.at(std::min<size_t>(static_cast<size_t>(std::lround(10.0F * w)), 63U)) +=
                w > 2.0F ? 1 : 0;
        }
        const auto mode = std::max_element(classes.begin(), classes.end()) - classes.begin();
        EXPECT_NEAR(0.1 * static_cast<double>(mode), 3.0, 0.25) << "step " << step;
    }
}

} // namespace
} // namespace estampe
