// SPDX-License-Identifier: MIT
// Pigment of strokes, lines and paint on pages that the tests fill.
#include "techniques/pigment/pigment.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::pigment {
namespace {

constexpr glm::uvec2 size_px(160, 96);
constexpr float pixels_per_mm = 5.0F;
constexpr float half_step = 1e-3F; // twice the rounding step of a half float below one

struct Page {
    test::Painter<glm::vec4> wash = [](glm::uvec2) { return glm::vec4(1.0F); };
    test::Painter<float> hatch = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> lines = [](glm::uvec2) { return glm::vec4(0.0F); };
    glm::uvec2 size_px = pigment::size_px;
    glm::uvec2 from_px{0};
};

/// Runs add_pigment() with black ink, and reads one of the layers as `Read` does.
template <class Read>
auto moved(const Page& page, const PigmentStyle& style, const Read& read)
{
    auto wash = test::Layer::color(page.size_px, page.wash);
    auto hatch = test::Layer::coverage(page.size_px, page.hatch);
    auto lines = test::Layer::root_color(page.size_px, page.lines);
    gpu::Graph graph;
    const PigmentLayers layers =
        add_pigment(graph, {.pixels_per_mm = pixels_per_mm, .size_px = page.size_px, .from_px = page.from_px},
                    style, {.wash = wash.in(graph), .hatch = hatch.in(graph), .lines = lines.in(graph)});
    return read(graph, layers);
}

/// Ink of the strokes after their pigment moved.
std::vector<float> strokes_of(const Page& page, const PigmentStyle& style)
{
    return moved(page, style, [](gpu::Graph& graph, const PigmentLayers& layers) {
        return test::run_and_read_coverage(graph, layers.hatch);
    });
}

std::vector<glm::vec4> wash_of(const Page& page, const PigmentStyle& style)
{
    return moved(page, style, [](gpu::Graph& graph, const PigmentLayers& layers) {
        return test::run_and_read_colors(graph, layers.wash);
    });
}

/// Ink that was rubbed into a white wash.
std::vector<float> rubbed_of(const Page& page, const PigmentStyle& style)
{
    std::vector<float> rubbed;
    for (const glm::vec4& color : wash_of(page, style)) {
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

TEST(Pigment, OfNothingDeclaresNothing)
{
    auto layer = test::Layer::coverage(size_px, [](glm::uvec2) { return 0.5F; });
    gpu::Graph graph;
    const auto before = layer.in(graph);
    const PigmentLayers after =
        add_pigment(graph, {.size_px = size_px}, {}, {.wash = before, .hatch = before, .lines = before});
    EXPECT_EQ(after.wash, before);
    EXPECT_EQ(after.hatch, before);
    EXPECT_EQ(after.lines, before);
    EXPECT_TRUE(graph.passes().empty());
    EXPECT_EQ(reach_px({}, pixels_per_mm), 0U);
}

TEST(Pigment, SoftEdgesAreABlurOfHalfTheirWidth)
{
    const PigmentStyle style{.soft_mm = 1.6F}; // a standard deviation of four pixels
    const auto strokes = strokes_of(half_plane(), style);
    const auto lines = moved(half_plane(), style, [](gpu::Graph& graph, const PigmentLayers& layers) {
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

TEST(Pigment, RubbedInkSpreadsByHalfTheWidth)
{
    const PigmentStyle style{.rub = 0.6F, .rub_mm = 4.0F}; // a standard deviation of ten pixels
    const auto rubbed = rubbed_of(half_plane(), style);
    for (uint32_t x = 40; x < 120; ++x) {
        EXPECT_NEAR(at(rubbed, x, 50), 0.6 * blurred_half(x, 10.0), 0.006) << x;
    }
}

TEST(Pigment, AnEvenToneStaysAsDark)
{
    // Strokes 2 pixels wide, every 5 pixels.
    Page page;
    page.hatch = [](glm::uvec2 pixel) { return (pixel.x + pixel.y) % 5 < 2 ? 1.0F : 0.0F; };
    for (const float rub : {0.2F, 0.5F, 0.9F}) {
        const PigmentStyle style{.soft_mm = 0.2F, .rub = rub, .rub_mm = 2.0F};
        const auto strokes = strokes_of(page, style);
        const auto rubbed = rubbed_of(page, style);
        double sum = 0.0;
        for (size_t i = 0; i < strokes.size(); ++i) {
            sum += 1.0 - (1.0 - static_cast<double>(strokes[i])) * (1.0 - static_cast<double>(rubbed[i]));
        }
        EXPECT_NEAR(sum / static_cast<double>(strokes.size()), 0.4, 0.004) << rub;
        EXPECT_NEAR(at(rubbed, 80, 50), 0.4F * rub, 0.02F);
    }
}

TEST(Pigment, LeavesBarePaperBareAndFullInkFull)
{
    Page full;
    full.hatch = [](glm::uvec2) { return 1.0F; };
    for (const float rub : {0.0F, 0.5F, 1.0F}) {
        const PigmentStyle style{.soft_mm = 0.5F, .rub = rub};
        EXPECT_EQ(std::ranges::max(strokes_of({}, style)), 0.0F);
        EXPECT_EQ(std::ranges::max(rubbed_of({}, style)), 0.0F);
        if (rub < 1.0F) {
            EXPECT_NEAR(std::ranges::min(strokes_of(full, style)), 1.0F, half_step);
        }
    }
}

TEST(Pigment, TilesOfAPageFitTogether)
{
    const auto blot = [](glm::uvec2 pixel) { return (pixel.x / 7 * 5 + pixel.y / 3) % 4 == 0 ? 1.0F : 0.0F; };
    const auto paint = [](glm::uvec2 pixel) {
        return glm::vec4(glm::vec3((pixel.x / 16 + pixel.y / 11) % 2 == 0 ? 0.4F : 0.9F), 1.0F);
    };
    const PigmentStyle style{
        .soft_mm = 0.4F, .rub = 0.7F, .rub_mm = 2.4F, .pool = 0.5F, .pool_mm = 1.0F, .stray_mm = 0.4F};
    const uint32_t reach = reach_px(style, pixels_per_mm);
    Page page;
    page.hatch = blot;
    page.wash = paint;
    const auto whole_strokes = strokes_of(page, style);
    const auto whole_wash = wash_of(page, style);
    Page tile{.size_px = {110, 90}, .from_px = {37, 5}};
    tile.hatch = [&](glm::uvec2 pixel) { return blot(pixel + tile.from_px); };
    tile.wash = [&](glm::uvec2 pixel) { return paint(pixel + tile.from_px); };
    const auto strokes = strokes_of(tile, style);
    const auto wash = wash_of(tile, style);
    ASSERT_LT(2 * reach, tile.size_px.y);
    for (uint32_t y = reach; y + reach < tile.size_px.y; ++y) {
        for (uint32_t x = reach; x + reach < tile.size_px.x; ++x) {
            const size_t i = y * tile.size_px.x + x;
            const glm::uvec2 place = tile.from_px + glm::uvec2(x, y);
            ASSERT_NEAR(strokes[i], at(whole_strokes, place.x, place.y), half_step) << x << ", " << y;
            ASSERT_NEAR(wash[i].y, whole_wash[place.y * size_px.x + place.x].y, half_step) << x << ", " << y;
        }
    }
}

/// A page whose left half is an object in one colour; its right half is bare paper, with alpha 0.
Page painted_half(const glm::vec3& paint)
{
    Page page;
    page.wash = [=](glm::uvec2 pixel) {
        return pixel.x < size_px.x / 2 ? glm::vec4(paint, 1.0F) : glm::vec4(1.0F, 1.0F, 1.0F, 0.0F);
    };
    return page;
}

TEST(Pigment, PaintPoolsAtTheInnerSideOfItsEdge)
{
    const glm::vec3 paint(0.6F, 0.5F, 0.4F);
    const PigmentStyle style{.pool = 0.8F, .pool_mm = 4.0F}; // a standard deviation of ten pixels
    const auto wash = wash_of(painted_half(paint), style);
    for (uint32_t x = 40; x < 120; ++x) {
        const glm::vec4 color = wash[50 * size_px.x + x];
        const double pooled = x < 80 ? 1.0 + 0.8 * (1.0 - blurred_half(x, 10.0)) : 0.0;
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(color[i], std::pow(static_cast<double>(paint[i]), pooled), 0.003) << x;
        }
        EXPECT_EQ(color.w, x < 80 ? 1.0F : 0.0F) << "coverage stays";
    }
    EXPECT_NEAR(wash[50 * size_px.x + 20].y, 0.5F, 0.002F) << "far from the edge";
}

TEST(Pigment, PaintRunsOutSoftlyAtWetPlacesAlone)
{
    const PigmentStyle style{.pool_mm = 4.0F, .wet = 1.0F}; // a standard deviation of ten pixels
    Page page = painted_half(glm::vec3(std::exp(-1.0F)));   // density 1
    page.size_px.y = 1000;                                  // 200 mm of paper
    const auto wash = wash_of(page, style);
    uint32_t dry = 0;
    uint32_t wet = 0;
    for (uint32_t y = 0; y < page.size_px.y; ++y) {
        const double beyond = -std::log(static_cast<double>(wash[y * size_px.x + 85].x));
        EXPECT_LE(beyond, blurred_half(85, 10.0) + 0.01) << y;
        dry += beyond < 0.01 ? 1 : 0;
        wet += beyond > blurred_half(85, 10.0) - 0.01 ? 1 : 0;
    }
    EXPECT_GT(dry, 300U);
    EXPECT_GT(wet, 100U);
}

TEST(Pigment, PaintStraysAtItsEdgesNoFartherThanAsked)
{
    const auto edge_of = [](const std::vector<glm::vec4>& wash, uint32_t y) {
        uint32_t x = 0;
        while (wash[y * size_px.x + x].x < 0.75F) {
            ++x;
        }
        return static_cast<int>(x) - static_cast<int>(size_px.x / 2);
    };
    const Page page = painted_half(glm::vec3(0.5F));
    std::vector<std::vector<int>> edges;
    for (const int seed : {1, 2}) {
        const auto wash = wash_of(page, {.stray_mm = 1.6F, .seed = seed}); // eight pixels
        std::vector<int> edge;
        for (uint32_t y = 0; y < size_px.y; ++y) {
            edge.push_back(edge_of(wash, y));
            EXPECT_LE(std::abs(edge.back()), 8) << y;
            EXPECT_LE(y == 0 ? 0 : std::abs(edge[y] - edge[y - 1]), 3) << "one whole edge at " << y;
            EXPECT_EQ(wash[y * size_px.x + 79].w, 1.0F) << "coverage does not stray";
        }
        const auto [least, most] = std::ranges::minmax(edge);
        EXPECT_GE(most - least, 4);
        edges.push_back(edge);
    }
    EXPECT_NE(edges[0], edges[1]);
}

TEST(Pigment, AnEvenWashAndBarePaperKeepTheirColour)
{
    const PigmentStyle style{.pool = 2.0F, .pool_mm = 3.0F, .wet = 1.0F, .stray_mm = 2.0F};
    for (const glm::vec3& paint : {glm::vec3(1.0F), glm::vec3(0.7F, 0.4F, 0.2F), glm::vec3(0.0F)}) {
        Page page;
        page.wash = [&](glm::uvec2) { return glm::vec4(paint, 1.0F); };
        for (const glm::vec4& color : wash_of(page, style)) {
            for (int i = 0; i < 3; ++i) {
                ASSERT_NEAR(color[i], paint[i], 0.002F);
            }
        }
    }
}

TEST(Pigment, WetStylesLeaveStrokesAndLinesAlone)
{
    auto layer = test::Layer::color(size_px, [](glm::uvec2) { return glm::vec4(0.5F); });
    gpu::Graph graph;
    const auto before = layer.in(graph);
    const PigmentLayers after =
        add_pigment(graph, {.pixels_per_mm = pixels_per_mm, .size_px = size_px},
                    {.pool = 1.0F, .stray_mm = 1.0F}, {.wash = before, .hatch = before, .lines = before});
    EXPECT_NE(after.wash, before);
    EXPECT_EQ(after.hatch, before);
    EXPECT_EQ(after.lines, before);
}

} // namespace
} // namespace estampe::pigment
