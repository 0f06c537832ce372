// SPDX-License-Identifier: MIT
// Ink bleed between strokes and lines that the tests paint.
#include "techniques/bleed/bleed.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::bleed {
namespace {

constexpr glm::uvec2 size_px(96, 64);
constexpr float pixels_per_mm = 5.0F;
constexpr float half_step = 1e-3F; // twice the rounding step of a half float below one

struct Page {
    test::Painter<float> hatch = [](glm::uvec2) { return 0.0F; };
    test::Painter<float> lines = [](glm::uvec2) { return 0.0F; };
    bool strokes_run = true;
};

/// Total ink per pixel, with the lines composited over the result.
std::vector<float> ink_on(const Page& page, const BleedStyle& style)
{
    auto hatch = test::Layer::coverage(size_px, page.hatch);
    auto lines = test::Layer::root_color(
        size_px, [&](glm::uvec2 pixel) { return glm::vec4(0.2F, 0.1F, 0.1F, page.lines(pixel)); });
    gpu::Graph graph;
    const auto ink = add_bleed(graph,
                               {.hatch = hatch.in(graph),
                                .lines = lines.in(graph),
                                .strokes_run = page.strokes_run,
                                .pixels_per_mm = pixels_per_mm,
                                .size_px = size_px},
                               style);
    std::vector<float> total = test::run_and_read_coverage(graph, ink);
    for (uint32_t i = 0; i < total.size(); ++i) {
        const float line = std::round(255.0F * page.lines({i % size_px.x, i / size_px.x})) / 255.0F;
        total[i] = 1.0F - (1.0F - total[i]) * (1.0F - line);
    }
    return total;
}

float at(const std::vector<float>& ink, uint32_t x, uint32_t y)
{
    return ink[y * size_px.x + x];
}

/// Coverage of a vertical bar from pixel `from` up to `to`.
test::Painter<float> bar(float from, float to)
{
    return [=](glm::uvec2 pixel) {
        const auto x = static_cast<float>(pixel.x);
        return std::clamp(std::min(x + 1.0F, to) - std::max(x, from), 0.0F, 1.0F);
    };
}

/// Coverage of a stroke that starts at `vertex`, at `degrees` to the page's right.
test::Painter<float> ray(glm::vec2 vertex, float degrees, float half_width_px)
{
    const glm::vec2 along(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
    return [=](glm::uvec2 pixel) {
        const glm::vec2 from = glm::vec2(pixel) + 0.5F - vertex;
        const float off = glm::length(from - along * std::max(glm::dot(from, along), 0.0F));
        return std::clamp(half_width_px - off + 0.5F, 0.0F, 1.0F);
    };
}

TEST(Bleed, OfNoWidthDeclaresNothing)
{
    auto hatch = test::Layer::coverage(size_px, bar(10.0F, 20.0F));
    gpu::Graph graph;
    const auto before = hatch.in(graph);
    EXPECT_EQ(add_bleed(graph, {.hatch = before, .lines = before, .size_px = size_px}, {}), before);
    EXPECT_TRUE(graph.passes().empty());
}

TEST(Bleed, LeavesBarePaperBareAndFullInkFull)
{
    Page full;
    full.hatch = [](glm::uvec2) { return 1.0F; };
    for (const float contrast : {1.0F, 6.0F, 20.0F}) {
        for (const float level : {0.1F, 0.45F, 0.9F}) {
            const BleedStyle style{.enabled = true, .width_mm = 1.0F, .contrast = contrast, .level = level};
            EXPECT_EQ(std::ranges::max(ink_on({}, style)), 0.0F);
            EXPECT_EQ(std::ranges::min(ink_on(full, style)), 1.0F);
        }
    }
    Page lines;
    lines.lines = full.hatch;
    EXPECT_EQ(std::ranges::min(ink_on(lines, {.enabled = true, .width_mm = 1.0F})), 1.0F);
}

TEST(Bleed, LeavesTheDotsOfAScreentoneAlone)
{
    // Squares of 5 pixels, one pixel apart, which would run together as strokes do.
    Page dots;
    dots.hatch = [](glm::uvec2 pixel) { return pixel.x % 6 < 5 && pixel.y % 6 < 5 ? 1.0F : 0.0F; };
    const BleedStyle style{.enabled = true, .width_mm = 1.5F};
    EXPECT_GT(at(ink_on(dots, style), 47, 33), 0.9F);
    dots.strokes_run = false;
    const std::vector<float> kept = ink_on(dots, style);
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < size_px.x; ++x) {
            ASSERT_EQ(at(kept, x, y), dots.hatch({x, y})) << x << ", " << y;
        }
    }
    dots.lines = bar(20.0F, 30.0F);
    EXPECT_GT(at(ink_on(dots, style), 30, 33), 0.4F) << "the ink of a line still runs";
}

TEST(Bleed, FadesOutBelowAPixel)
{
    Page tone; // a tone of strokes finer than pixels
    tone.hatch = [](glm::uvec2) { return 0.6F; };
    const auto ink = [&](float width_px) {
        return at(ink_on(tone, {.enabled = true, .width_mm = width_px / pixels_per_mm}), 40, 30);
    };
    EXPECT_NEAR(ink(0.1F), 0.6F, half_step);
    EXPECT_NEAR(ink(1.0F), 0.6F, half_step);
    EXPECT_NEAR(ink(1.6F), 0.8F, half_step);
    EXPECT_EQ(ink(2.0F), 1.0F);
}

TEST(Bleed, KeepsALoneHairlineAsItIs)
{
    Page strokes;
    strokes.hatch = ray({-5.0F, 20.0F}, 20.0F, 0.4F);
    Page lines;
    lines.lines = strokes.hatch;
    for (const Page& page : {strokes, lines}) {
        const auto before = ink_on(page, {});
        const auto after = ink_on(page, {.enabled = true, .width_mm = 1.0F});
        EXPECT_GT(std::ranges::max(before), 0.7F);
        for (size_t i = 0; i < before.size(); ++i) {
            EXPECT_NEAR(after[i], before[i], half_step);
        }
    }
}

TEST(Bleed, ClosesNarrowGapsAndLeavesWideOnes)
{
    // Two bars, one a stroke and one a line, as wide as the bleed: ten pixels.
    const auto ink_between = [](float gap_px) {
        Page page;
        page.hatch = bar(48.0F - 0.5F * gap_px - 10.0F, 48.0F - 0.5F * gap_px);
        page.lines = bar(48.0F + 0.5F * gap_px, 48.0F + 0.5F * gap_px + 10.0F);
        return at(ink_on(page, {.enabled = true, .width_mm = 2.0F}), 47, 32);
    };
    EXPECT_EQ(ink_between(4.0F), 1.0F);
    EXPECT_GT(ink_between(6.0F), 0.5F);
    EXPECT_LT(ink_between(10.0F), 0.05F);
    EXPECT_EQ(ink_between(16.0F), 0.0F);
}

TEST(Bleed, IsBlurAndContrastByTheFormula)
{
    // The exact blur across the edge of a half-plane of ink is the Gaussian error function.
    Page page;
    page.hatch = bar(-1.0F, 48.0F);
    const BleedStyle style{.enabled = true, .width_mm = 2.0F, .contrast = 1.5F, .level = 0.4F};
    const auto ink = ink_on(page, style);
    for (uint32_t x = 48; x < 72; ++x) {
        const double sigmas = (x + 0.5 - 48.0) / 5.0;
        const double blurred = 0.5 * std::erfc(sigmas / std::sqrt(2.0));
        EXPECT_NEAR(at(ink, x, 30), std::clamp((blurred - 0.4) * 1.5 + 0.5, 0.0, 1.0), 0.02) << x;
    }
}

TEST(Bleed, RoundsOffAcuteCornersTheMoreTheWiderItRuns)
{
    // Strokes two millimetres wide, which stay dark when blurred.
    const glm::vec2 vertex(6.0F, 32.0F);
    Page page;
    page.hatch = ray(vertex, -20.0F, 5.0F);
    page.lines = ray(vertex, 20.0F, 5.0F);
    const auto paper_across = [](const std::vector<float>& ink, uint32_t x) {
        uint32_t count = 0;
        for (uint32_t y = 31; y > 0 && at(ink, x, y) < 0.5F; --y) {
            ++count;
        }
        return count;
    };
    const auto tip = [&](const std::vector<float>& ink) { // where paper begins between the strokes
        uint32_t x = 8;
        while (x < size_px.x && paper_across(ink, x) == 0) {
            ++x;
        }
        return x;
    };
    const auto sharp = ink_on(page, {});
    uint32_t last_tip = tip(sharp);
    uint32_t last_blunt = paper_across(sharp, last_tip + 2);
    for (const float width_mm : {0.8F, 1.6F, 3.0F}) {
        const auto filled = ink_on(page, {.enabled = true, .width_mm = width_mm});
        const uint32_t here = tip(filled);
        EXPECT_GE(here, last_tip + 1) << width_mm;
        EXPECT_LT(here, 40U) << "the corner alone";
        EXPECT_GE(paper_across(filled, here + 2), last_blunt) << "blunter";
        last_tip = here;
        last_blunt = paper_across(filled, here + 2);
        EXPECT_EQ(at(filled, 90, 32), 0.0F) << "where they are far apart";
    }
    EXPECT_GT(last_blunt, paper_across(sharp, tip(sharp) + 2));
}

TEST(Bleed, RunsFartherFromThinStrokesAtALowerLevel)
{
    Page page;
    page.hatch = ray({6.0F, 32.0F}, -20.0F, 1.5F);
    page.lines = ray({6.0F, 32.0F}, 20.0F, 1.5F);
    const auto inked = [&](float level) {
        double sum = 0.0;
        for (const float ink : ink_on(page, {.enabled = true, .width_mm = 1.2F, .level = level})) {
            sum += ink;
        }
        return sum;
    };
    EXPECT_GT(inked(0.45F), inked(0.9F));
    EXPECT_GT(inked(0.35F), inked(0.45F) + 5.0);
}

TEST(Bleed, MirrorsWithThePageAndTakesNoInkAway)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    for (int round = 0; round < 4; ++round) {
        std::vector<float> hatch(size_px.x * size_px.y);
        std::vector<float> lines(hatch.size());
        for (size_t i = 0; i < hatch.size(); ++i) {
            hatch[i] = share(random) < 0.3F ? share(random) : 0.0F;
            lines[i] = share(random) < 0.2F ? share(random) : 0.0F;
        }
        const auto painter = [&](const std::vector<float>& of, bool turned) {
            return [&of, turned](glm::uvec2 pixel) {
                const glm::uvec2 from = turned ? size_px - 1U - pixel : pixel;
                return of[from.y * size_px.x + from.x];
            };
        };
        const BleedStyle style{.enabled = true, .width_mm = 0.1F + 2.5F * share(random), .level = 0.2F};
        const auto before = ink_on({painter(hatch, false), painter(lines, false)}, {});
        const auto after = ink_on({painter(hatch, false), painter(lines, false)}, style);
        const auto turned = ink_on({painter(hatch, true), painter(lines, true)}, style);
        for (size_t i = 0; i < after.size(); ++i) {
            EXPECT_GE(after[i], before[i]);
            EXPECT_LE(after[i], 1.0F);
            EXPECT_EQ(turned[after.size() - 1 - i], after[i]);
        }
    }
}

} // namespace
} // namespace estampe::bleed
