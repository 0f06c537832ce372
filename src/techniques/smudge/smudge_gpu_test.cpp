// SPDX-License-Identifier: MIT
// Smudge of strokes and lines that the tests paint.
#include "techniques/smudge/smudge.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::smudge {
namespace {

constexpr glm::uvec2 size_px(160, 96);
constexpr float pixels_per_mm = 5.0F;
constexpr float half_step = 1e-3F; // twice the rounding step of a half float below one

struct Page {
    test::Painter<float> hatch = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> lines = [](glm::uvec2) { return glm::vec4(0.0F); };
    glm::uvec2 size_px = smudge::size_px;
    glm::uvec2 from_px{0};
};

/// Runs add_smudge() with black ink on a white wash, and reads one of the layers as `Read` does.
template <class Read>
auto smudged(const Page& page, const SmudgeStyle& style, const Read& read)
{
    auto wash = test::Layer::color(page.size_px, [](glm::uvec2) { return glm::vec4(1.0F); });
    auto hatch = test::Layer::coverage(page.size_px, page.hatch);
    auto lines = test::Layer::root_color(page.size_px, page.lines);
    gpu::Graph graph;
    const SmudgeLayers layers =
        add_smudge(graph, {.pixels_per_mm = pixels_per_mm, .size_px = page.size_px, .from_px = page.from_px},
                   style, {.wash = wash.in(graph), .hatch = hatch.in(graph), .lines = lines.in(graph)});
    return read(graph, layers);
}

/// Ink of the strokes after smudging.
std::vector<float> strokes_of(const Page& page, const SmudgeStyle& style)
{
    return smudged(page, style, [](gpu::Graph& graph, const SmudgeLayers& layers) {
        return test::run_and_read_coverage(graph, layers.hatch);
    });
}

/// Ink that was rubbed into the wash.
std::vector<float> rubbed_of(const Page& page, const SmudgeStyle& style)
{
    const auto wash = smudged(page, style, [](gpu::Graph& graph, const SmudgeLayers& layers) {
        return test::run_and_read_colors(graph, layers.wash);
    });
    std::vector<float> rubbed;
    for (const glm::vec4& color : wash) {
        EXPECT_EQ(color.w, 1.0F);
        rubbed.push_back(1.0F - color.y);
    }
    return rubbed;
}

float at(const std::vector<float>& ink, uint32_t x, uint32_t y)
{
    return ink[y * size_px.x + x];
}

/// Ink in the left half of the page.
Page half_plane()
{
    Page page;
    page.hatch = [](glm::uvec2 pixel) { return pixel.x < size_px.x / 2 ? 1.0F : 0.0F; };
    page.lines = [](glm::uvec2 pixel) {
        return glm::vec4(0.04F, 0.16F, 0.36F, pixel.x < size_px.x / 2 ? 1.0F : 0.0F);
    };
    return page;
}

/// Exact blur of the half-plane at the middle of a column of pixels.
double blurred_half(uint32_t x, double sigma_px)
{
    return 0.5 * std::erfc((x + 0.5 - size_px.x / 2) / (sigma_px * std::sqrt(2.0)));
}

TEST(Smudge, OfNothingDeclaresNothing)
{
    auto layer = test::Layer::coverage(size_px, [](glm::uvec2) { return 0.5F; });
    gpu::Graph graph;
    const auto before = layer.in(graph);
    const SmudgeLayers after =
        add_smudge(graph, {.size_px = size_px}, {}, {.wash = before, .hatch = before, .lines = before});
    EXPECT_EQ(after.wash, before);
    EXPECT_EQ(after.hatch, before);
    EXPECT_EQ(after.lines, before);
    EXPECT_TRUE(graph.passes().empty());
    EXPECT_EQ(reach_px({}, pixels_per_mm), 0U);
}

TEST(Smudge, SoftEdgesAreABlurOfHalfTheirWidth)
{
    const SmudgeStyle style{.soft_mm = 1.6F}; // a standard deviation of four pixels
    const auto strokes = strokes_of(half_plane(), style);
    const auto lines = smudged(half_plane(), style, [](gpu::Graph& graph, const SmudgeLayers& layers) {
        return test::run_and_read_as<glm::u8vec4>(graph, layers.lines);
    });
    for (uint32_t x = 60; x < 100; ++x) {
        EXPECT_NEAR(at(strokes, x, 50), blurred_half(x, 4.0), 0.01) << x;
        const glm::vec4 line = glm::vec4(lines[50 * size_px.x + x]) / 255.0F;
        EXPECT_NEAR(line.w, blurred_half(x, 4.0), 0.01) << x;
        if (line.w > 0.05F) { // bare paper beside the line does not tint it
            EXPECT_NEAR(line.x, 0.2F, 0.02F) << x;
            EXPECT_NEAR(line.z, 0.6F, 0.02F) << x;
        }
    }
    EXPECT_EQ(std::ranges::max(rubbed_of(half_plane(), style)), 0.0F);
}

TEST(Smudge, RubbedInkSpreadsByHalfTheWidth)
{
    const SmudgeStyle style{.strength = 0.6F, .width_mm = 4.0F}; // a standard deviation of ten pixels
    const auto rubbed = rubbed_of(half_plane(), style);
    for (uint32_t x = 40; x < 120; ++x) {
        EXPECT_NEAR(at(rubbed, x, 50), 0.6 * blurred_half(x, 10.0), 0.006) << x;
    }
}

TEST(Smudge, AnEvenToneStaysAsDark)
{
    // Strokes 2 pixels wide, every 5 pixels.
    Page page;
    page.hatch = [](glm::uvec2 pixel) { return (pixel.x + pixel.y) % 5 < 2 ? 1.0F : 0.0F; };
    for (const float strength : {0.2F, 0.5F, 0.9F}) {
        const SmudgeStyle style{.soft_mm = 0.2F, .strength = strength, .width_mm = 2.0F};
        const auto strokes = strokes_of(page, style);
        const auto rubbed = rubbed_of(page, style);
        double sum = 0.0;
        for (size_t i = 0; i < strokes.size(); ++i) {
            sum += 1.0 - (1.0 - static_cast<double>(strokes[i])) * (1.0 - static_cast<double>(rubbed[i]));
        }
        EXPECT_NEAR(sum / static_cast<double>(strokes.size()), 0.4, 0.004) << strength;
        EXPECT_NEAR(at(rubbed, 80, 50), 0.4F * strength, 0.02F);
    }
}

TEST(Smudge, LeavesBarePaperBareAndFullInkFull)
{
    Page full;
    full.hatch = [](glm::uvec2) { return 1.0F; };
    for (const float strength : {0.0F, 0.5F, 1.0F}) {
        const SmudgeStyle style{.soft_mm = 0.5F, .strength = strength};
        EXPECT_EQ(std::ranges::max(strokes_of({}, style)), 0.0F);
        EXPECT_EQ(std::ranges::max(rubbed_of({}, style)), 0.0F);
        if (strength < 1.0F) {
            EXPECT_NEAR(std::ranges::min(strokes_of(full, style)), 1.0F, half_step);
        }
    }
}

TEST(Smudge, TilesOfAPageFitTogether)
{
    const auto blot = [](glm::uvec2 pixel) { return (pixel.x / 7 * 5 + pixel.y / 3) % 4 == 0 ? 1.0F : 0.0F; };
    const SmudgeStyle style{.soft_mm = 0.4F, .strength = 0.7F, .width_mm = 2.4F};
    const uint32_t reach = reach_px(style, pixels_per_mm);
    Page page;
    page.hatch = blot;
    const auto whole_strokes = strokes_of(page, style);
    const auto whole_rubbed = rubbed_of(page, style);
    Page tile{.size_px = {100, 80}, .from_px = {37, 11}};
    tile.hatch = [&](glm::uvec2 pixel) { return blot(pixel + tile.from_px); };
    const auto strokes = strokes_of(tile, style);
    const auto rubbed = rubbed_of(tile, style);
    ASSERT_LT(2 * reach, tile.size_px.y);
    for (uint32_t y = reach; y + reach < tile.size_px.y; ++y) {
        for (uint32_t x = reach; x + reach < tile.size_px.x; ++x) {
            const size_t i = y * tile.size_px.x + x;
            const glm::uvec2 place = tile.from_px + glm::uvec2(x, y);
            ASSERT_NEAR(strokes[i], at(whole_strokes, place.x, place.y), half_step) << x << ", " << y;
            ASSERT_NEAR(rubbed[i], at(whole_rubbed, place.x, place.y), half_step) << x << ", " << y;
        }
    }
}

} // namespace
} // namespace estampe::smudge
