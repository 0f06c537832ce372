// SPDX-License-Identifier: MIT
// Focus lines as drawn by the shader.
#include "techniques/focus/focus.hpp"

#include <algorithm>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::focus {
namespace {

constexpr glm::uvec2 size_px(160, 120);
const Window window{.min_px = {0.0F, 0.0F}, .max_px = glm::vec2(size_px)};
constexpr float pixels_per_mm = 2.0F;

/// Draws focus lines over a layer that is filled with `before`.
std::vector<glm::vec4> inked(const FocusStyle& style, const glm::vec4& before)
{
    const std::vector<shared::FocusLine> lines = focus_lines(style, window, pixels_per_mm, 0.0);
    gpu::Buffer buffer = gpu::upload_buffer(test::shared_device(), "lines", lines);
    auto layer = test::Layer::root_color(size_px, [&](glm::uvec2) { return before; });
    gpu::Graph graph;
    const gpu::ImageId ink = add_focus(graph,
                                       {.lines = gpu::import_whole(graph, "lines", buffer),
                                        .line_count = static_cast<uint32_t>(lines.size()),
                                        .middle_px = middle_px(style, window),
                                        .size_px = size_px},
                                       style, layer.in(graph));
    std::vector<glm::vec4> pixels;
    for (const uint32_t packed : test::run_and_read_as<uint32_t>(graph, ink)) {
        pixels.push_back(glm::unpackUnorm4x8(packed));
    }
    return pixels;
}

/// Share of a pixel that the lines cover, by supersampling.
float covered(const std::vector<shared::FocusLine>& lines, const glm::vec2& middle, glm::uvec2 pixel)
{
    constexpr int side = 8;
    int hits = 0;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 place =
            glm::vec2(pixel) +
            (glm::vec2(static_cast<float>(i % side), static_cast<float>(i / side)) + 0.5F) /
                static_cast<float>(side);
        const glm::vec2 from = place - middle;
        hits += std::ranges::any_of(lines, [&](const shared::FocusLine& line) {
            const float along = glm::dot(from, line.outwards);
            const float aside = std::abs(line.outwards.x * from.y - line.outwards.y * from.x);
            return along > line.tip_px &&
                   aside < line.half_width_px * (along - line.tip_px) / (line.end_px - line.tip_px);
        });
    }
    return static_cast<float>(hits) / static_cast<float>(side * side);
}

TEST(Focus, InkIsTheAreaOfAllWedges)
{
    FocusStyle style;
    style.enabled = true;
    style.clear = 0.3F;
    const auto lines = focus_lines(style, window, pixels_per_mm, 0.0);
    const auto ink = inked(style, glm::vec4(0.0F));
    double drawn = 0.0;
    double wanted = 0.0;
    double worst = 0.0;
    for (uint32_t i = 0; i < ink.size(); ++i) {
        const float share = covered(lines, middle_px(style, window), {i % size_px.x, i / size_px.x});
        drawn += ink[i].w;
        wanted += share;
        worst = std::max(worst, static_cast<double>(std::abs(ink[i].w - share)));
    }
    ASSERT_GT(wanted, 500.0);
    EXPECT_NEAR(drawn / wanted, 1.0, 0.06);
    EXPECT_LT(worst, 0.6);
}

TEST(Focus, TheDarkerInkStands)
{
    FocusStyle style;
    style.enabled = true;
    style.ink = {1.0F, 0.0F, 0.0F};
    const glm::vec4 before(0.0F, 1.0F, 0.0F, 0.6F);
    size_t red = 0;
    size_t green = 0;
    for (const glm::vec4& pixel : inked(style, before)) {
        EXPECT_GE(pixel.w, 0.59F);
        red += pixel.x > 0.9F && pixel.y < 0.1F ? 1 : 0;
        green += pixel.y > 0.9F && pixel.x < 0.1F ? 1 : 0;
    }
    EXPECT_EQ(red + green, size_t{size_px.x} * size_px.y);
    EXPECT_GT(red, 100U);
    EXPECT_GT(green, 100U);
}

} // namespace
} // namespace estampe::focus
