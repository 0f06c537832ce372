// SPDX-License-Identifier: MIT
// The promises of the lines, on surfaces that the test paints itself: exact tone at every zoom, on planes in
// perspective and on spheres, and strokes of one width.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shaders/stroke_kind.glsl.h"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/hatch/hatch.hpp"

namespace estampe {
namespace {

/// What is seen at a pixel: the coordinate that strokes follow, and its change to the right and down.
struct Patch {
    glm::vec3 coordinate{0.0F};
    glm::vec3 dx{0.0F};
    glm::vec3 dy{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    bool seen = true;
};

using Surface = std::function<Patch(glm::dvec2 position_px)>;

/// The ink of lines over a surface, the darkness given pixel by pixel.
std::vector<float> ink_of(glm::uvec2 size_px, uint32_t kind, const Surface& surface,
                          const test::Painter<float>& darkness, const hatch::HatchStyle& style)
{
    const auto at = [&](glm::uvec2 pixel) { return surface(glm::dvec2(pixel) + 0.5); };
    test::Layer dark = test::Layer::coverage(
        size_px, [&](glm::uvec2 pixel) { return at(pixel).seen ? darkness(pixel) : 0.0F; });
    test::Layer draw = test::Layer::words(size_px, [&](glm::uvec2) { return kind << 26U | 1U; });
    test::Layer normal = test::Layer::normals(size_px, [&](glm::uvec2 pixel) { return at(pixel).normal; });
    test::Layer coordinate =
        test::Layer::places(size_px, [&](glm::uvec2 pixel) { return glm::vec4(at(pixel).coordinate, 0.0F); });
    test::Layer footprint = test::Layer::footprints(size_px, [&](glm::uvec2 pixel) {
        const Patch patch = at(pixel);
        return std::pair(patch.dx, patch.dy);
    });
    gpu::Graph graph;
    hatch::HatchInputs in{};
    in.draw = draw.in(graph);
    in.normal = normal.in(graph);
    in.coordinate = coordinate.in(graph);
    in.footprint = footprint.in(graph);
    in.pixels_per_mm = 1.0F;
    in.size_px = size_px;
    return test::run_and_read_coverage(graph, hatch::add_lines(graph, in, dark.in(graph), style));
}

/// A pen of 1.6 pixels with all the habits of the default one.
hatch::HatchStyle pen()
{
    return {.width_mm = 1.6F,
            .wobble_mm = 1.0F,
            .gap_mm = 3.0F,
            .taper_mm = 12.0F,
            .length_mm = 70.0F,
            .black_above = 2.0F};
}

Surface flat_patch(double unit_per_px)
{
    return [=](glm::dvec2 p) {
        const auto g = static_cast<float>(unit_per_px);
        return Patch{.coordinate = glm::vec3(p * unit_per_px, 0.0), .dx = {g, 0, 0}, .dy = {0, g, 0}};
    };
}

constexpr uint32_t tone_count = 19;
constexpr uint32_t patch_px = 256;

/// Mean ink of 19 patches, each of one darkness from 0.05 to 0.95, in one picture.
std::array<double, tone_count> ink_of_tones(uint32_t kind, double unit_per_px, const hatch::HatchStyle& style)
{
    const glm::uvec2 size_px(5 * patch_px, 4 * patch_px);
    const auto tone_at = [](glm::uvec2 pixel) { return pixel.x / patch_px + 5 * (pixel.y / patch_px); };
    const std::vector<float> ink = ink_of(
        size_px, kind, flat_patch(unit_per_px),
        [&](glm::uvec2 pixel) { return 0.05F * static_cast<float>(tone_at(pixel) + 1); }, style);
    std::array<double, tone_count + 1> sums{};
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < size_px.x; ++x) {
            sums.at(tone_at({x, y})) += ink[static_cast<size_t>(y) * size_px.x + x];
        }
    }
    std::array<double, tone_count> means{};
    for (uint32_t i = 0; i < tone_count; ++i) {
        means.at(i) = sums.at(i) / (patch_px * patch_px);
    }
    return means;
}

TEST(HatchLines, InkIsTheDarknessAtEveryZoom)
{
    double worst = 0.0;
    double worst_of_mean = 0.0;
    std::array<double, tone_count> over_zooms{};
    constexpr int zooms = 64;
    for (int zoom = 0; zoom < zooms; ++zoom) {
        const auto ink = ink_of_tones(shared::strokes_uv, 0.01 * std::exp2(zoom / 8.0), pen());
        for (uint32_t i = 0; i < tone_count; ++i) {
            worst = std::max(worst, std::abs(ink.at(i) - 0.05 * (i + 1)));
            over_zooms.at(i) += ink.at(i) / zooms;
        }
    }
    for (uint32_t i = 0; i < tone_count; ++i) {
        fmt::print("tone {:.2f}: {:+.4f}\n", 0.05 * (i + 1), over_zooms.at(i) - 0.05 * (i + 1));
        worst_of_mean = std::max(worst_of_mean, std::abs(over_zooms.at(i) - 0.05 * (i + 1)));
    }
    fmt::print("worst patch {:.4f}, worst mean over zooms {:.4f}\n", worst, worst_of_mean);
    EXPECT_LE(worst_of_mean, 0.005);
}

} // namespace
} // namespace estampe
