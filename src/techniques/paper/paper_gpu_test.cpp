// SPDX-License-Identifier: MIT
// Layers of known coverage on the page against the formula, and statistics of the paper's relief.
#include "techniques/paper/paper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "style/parameter.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/paper/paper_test_page.hpp"

namespace estampe::paper {
namespace {

/// Paper without relief, so that each layer has the same coverage as it was painted.
PaperStyle smooth()
{
    return {.margin_mm = 0.0F, .grain = 0.0F, .granulation = 0.0F, .ink_break = 0.0F};
}

/// How much lighter each pixel is than the paper's colour.
std::vector<double> relief(const PaperStyle& style, glm::uvec2 size_px, float pixels_per_mm)
{
    std::vector<double> heights;
    for (const glm::vec4& color : compose({}, style, size_px, pixels_per_mm)) {
        heights.push_back(static_cast<double>(color.y / style.color.y) - 1.0);
    }
    return heights;
}

double mean(const std::vector<double>& values)
{
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

/// Pearson correlation coefficient.
double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    const double mean_a = mean(a);
    const double mean_b = mean(b);
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return ab / std::sqrt(aa * bb);
}

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance)
{
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
    }
}

constexpr float half_step = 6e-4F; // rounding of a half float near 1, and of the layers

TEST(Compose, NoInkIsThePaperAndFullInkIsTheInk)
{
    const PaperStyle style = smooth();
    const glm::uvec2 size_px(40, 24);
    const auto blank = compose({}, style, size_px);
    expect_near(glm::vec3(blank[0]), style.color, half_step);
    EXPECT_TRUE(std::ranges::all_of(blank, [&](const glm::vec4& color) { return color == blank[0]; }));
    Layers covered;
    covered.wash = [](glm::uvec2) { return glm::vec4(0.3F, 0.6F, 0.2F, 1.0F); };
    covered.hatch = [](glm::uvec2) { return 1.0F; };
    for (const glm::vec4& color : compose(covered, style, size_px)) {
        expect_near(glm::vec3(color), style.ink, half_step);
    }
    covered.lines = [](glm::uvec2) { return glm::vec4(0.64F, 0.04F, 0.25F, 1.0F); };
    for (const glm::vec4& color : compose(covered, style, size_px)) {
        expect_near(glm::vec3(color), {0.64F, 0.04F, 0.25F}, 4e-3F); // 8-bit square roots
    }
}

TEST(Compose, LaysInkOverPaintOverPaper)
{
    constexpr glm::uvec2 size_px(32, 32);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    const auto random_color = [&] { return glm::vec4(share(random), share(random), share(random), 1.0F); };
    std::vector<glm::vec4> wash, lines;
    std::vector<float> hatch, sky;
    for (uint32_t i = 0; i < size_px.x * size_px.y; ++i) {
        wash.push_back(random_color());
        wash.back().w = share(random) < 0.5F ? 0.0F : 1.0F;
        lines.push_back(random_color());
        lines.back().w = share(random);
        hatch.push_back(share(random));
        sky.push_back(share(random));
    }
    const auto at = [](glm::uvec2 pixel) { return size_t{pixel.y} * size_px.x + pixel.x; };
    const Layers layers{.wash = [&](glm::uvec2 pixel) { return wash[at(pixel)]; },
                        .hatch = [&](glm::uvec2 pixel) { return hatch[at(pixel)]; },
                        .lines = [&](glm::uvec2 pixel) { return lines[at(pixel)]; },
                        .sky_ink = [&](glm::uvec2 pixel) { return sky[at(pixel)]; },
                        .sky_size_px = size_px};
    const PaperStyle style = smooth();
    const auto picture = compose(layers, style, size_px);
    for (size_t i = 0; i < picture.size(); ++i) {
        const float ink = wash[i].w > 0.5F ? hatch[i] : std::max(hatch[i], sky[i]);
        const glm::vec3 below = glm::mix(style.color * glm::max(glm::vec3(wash[i]), 1e-3F), style.ink, ink);
        expect_near(glm::vec3(picture[i]), glm::mix(below, glm::vec3(lines[i]), lines[i].w), 5e-3F);
        EXPECT_EQ(picture[i].w, 1.0F);
    }
}

TEST(Compose, EachStageLaysOneLayerMore)
{
    constexpr glm::uvec2 size_px(48, 32);
    PaperStyle style; // with its relief
    const auto wave = [](glm::uvec2 pixel, float turn) {
        return 0.5F + 0.5F * std::sin(0.3F * static_cast<float>(pixel.x + 2 * pixel.y) + turn);
    };
    const Layers layers{
        .wash = [&](glm::uvec2 p) { return glm::vec4(wave(p, 1.0F), 0.8F, wave(p, 2.0F), 1.0F); },
        .hatch = [&](glm::uvec2 p) { return std::max(wave(p, 3.0F) - 0.3F, 0.0F); },
        .lines = [&](glm::uvec2 p) { return glm::vec4(0.5F, 0.2F, 0.1F, p.x < 24 ? 0.0F : wave(p, 4.0F)); }};
    const auto stage = [&](Stage last) { return compose(layers, style, size_px, 3.0F, last); };
    const auto paper = stage(Stage::paper);
    const auto wash = stage(Stage::wash);
    const auto hatch = stage(Stage::hatch);
    const auto lines = stage(Stage::lines);
    const auto blank = compose({}, style, size_px, 3.0F, Stage::lines);
    const auto picture = compose(layers, style, size_px);
    for (size_t i = 0; i < picture.size(); ++i) {
        EXPECT_EQ(paper[i].w, 1.0F);
        EXPECT_EQ(glm::vec3(paper[i]), glm::vec3(blank[i])) << "blank layers leave the paper";
        EXPECT_EQ(blank[i].w, 0.0F);
        EXPECT_EQ(wash[i].w, 1.0F);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_LE(wash[i][channel], paper[i][channel]);
        }
        expect_near(glm::vec3(hatch[i]), glm::mix(glm::vec3(wash[i]), style.ink, hatch[i].w), 1e-6F);
        const glm::vec3 line = glm::vec3(0.5F, 0.2F, 0.1F);
        expect_near(glm::vec3(lines[i]), glm::mix(glm::vec3(hatch[i]), line, lines[i].w),
                    4e-3F); // 8-bit square roots
        expect_near(glm::vec3(lines[i]), glm::vec3(picture[i]), half_step);
    }
}

TEST(Compose, OneTexelOfSkyStandsForThePage)
{
    Layers layers;
    layers.wash = [](glm::uvec2 pixel) { return glm::vec4(1.0F, 1.0F, 1.0F, pixel.x < 8 ? 0.0F : 1.0F); };
    layers.sky_ink = [](glm::uvec2) { return 1.0F; };
    const PaperStyle style = smooth();
    const auto picture = compose(layers, style, {16, 16});
    for (size_t i = 0; i < picture.size(); ++i) {
        expect_near(glm::vec3(picture[i]), i % 16 < 8 ? style.ink : style.color, half_step);
    }
    layers.has_sky = false;
    expect_near(glm::vec3(compose(layers, style, {16, 16})[0]), style.color, half_step);
}

TEST(Compose, LightTintsTheInkByItsColourAlone)
{
    constexpr glm::uvec2 size_px(24, 8);
    PaperStyle style = smooth();
    style.ink = {0.2F, 0.1F, 0.05F};
    // White light, red light, and no light; on a line, on strokes and on bare paper.
    const glm::vec3 red(2.0F, 0.5F, 0.25F);
    Layers layers;
    layers.light = [&](glm::uvec2 pixel) {
        const std::array colors{glm::vec3(0.7F), red, glm::vec3(0.0F)};
        return glm::vec4(colors.at(pixel.x / 8), 1.0F);
    };
    layers.hatch = [](glm::uvec2 pixel) { return pixel.y < 4 ? 1.0F : 0.0F; };
    layers.lines = [](glm::uvec2 pixel) { return glm::vec4(0.0F, 0.0F, 0.0F, pixel.y < 2 ? 1.0F : 0.0F); };
    const glm::vec3 tint = red / red.x;
    const glm::vec3 lit = glm::mix(style.ink * tint, tint, 0.3F * (1.0F - tint.z));
    for (const float share : {0.0F, 0.5F, 1.0F}) {
        style.ink_tint = share;
        const auto picture = compose(layers, style, size_px);
        for (uint32_t x = 0; x < size_px.x; ++x) {
            const glm::vec3 ink = x / 8 == 1 ? glm::mix(style.ink, lit, share) : style.ink;
            expect_near(glm::vec3(picture[x]), glm::vec3(0.0F), half_step);
            expect_near(glm::vec3(picture[3 * size_px.x + x]), ink, 1e-3F);
            expect_near(glm::vec3(picture[5 * size_px.x + x]), style.color, half_step);
        }
    }
}

TEST(Compose, ReliefLeavesThePaperItsColour)
{
    PaperStyle style = smooth();
    style.grain = 1.0F;
    for (const int seed : {1, 2, 77}) {
        style.seed = seed;
        const auto heights = relief(style, {320, 256}, 2.0F);
        EXPECT_NEAR(mean(heights), 0.0, 1e-3) << "seed " << seed;
        const auto [lowest, highest] = std::ranges::minmax(heights);
        EXPECT_LT(lowest, -0.02);
        EXPECT_GT(highest, 0.02);
        EXPECT_GE(lowest, -0.051);
        EXPECT_LE(highest, 0.051);
    }
}

TEST(Compose, ASeedIsASheet)
{
    PaperStyle style = smooth();
    style.grain = 1.0F;
    const auto sheet = relief(style, {200, 150}, 4.0F);
    EXPECT_EQ(sheet, relief(style, {200, 150}, 4.0F));
    for (const int seed : {0, 2, 3, 1000000}) {
        style.seed = seed;
        EXPECT_LT(std::abs(correlation(sheet, relief(style, {200, 150}, 4.0F))), 0.1) << "seed " << seed;
    }
}

TEST(Compose, ReliefDoesNotRepeat)
{
    constexpr uint32_t side = 256;
    PaperStyle style = smooth();
    style.grain = 1.0F;
    const auto heights = relief(style, glm::uvec2(side), 8.0F); // 32 mm of paper
    const auto shifted = [&](uint32_t dx, uint32_t dy) {
        std::vector<double> here, there;
        for (uint32_t y = 0; y + dy < side; ++y) {
            for (uint32_t x = 0; x + dx < side; ++x) {
                here.push_back(heights[size_t{y} * side + x]);
                there.push_back(heights[size_t{y + dy} * side + x + dx]);
            }
        }
        return correlation(here, there);
    };
    EXPECT_GT(shifted(0, 1), 0.3) << "neighbours are alike";
    double worst = 0.0;
    for (uint32_t lag = 32; lag <= 192; ++lag) {
        worst = std::max({worst, std::abs(shifted(lag, 0)), std::abs(shifted(0, lag)),
                          std::abs(shifted(lag * 3 / 4, lag * 3 / 4))});
    }
    EXPECT_LT(worst, 0.2);
}

TEST(Compose, OverprintedInkMixesWithThePaintBelow)
{
    Layers layers;
    layers.wash = [](glm::uvec2) { return glm::vec4(0.9F, 0.3F, 0.2F, 1.0F); };
    layers.hatch = [](glm::uvec2 pixel) { return pixel.x < 16 ? 1.0F : 0.0F; };
    layers.lines = [](glm::uvec2 pixel) { return glm::vec4(0.09F, 0.16F, 0.64F, pixel.x < 8 ? 1.0F : 0.0F); };
    PaperStyle style = smooth();
    style.ink = {0.1F, 0.2F, 0.6F};
    for (const float overprint : {0.0F, 0.5F, 1.0F}) {
        style.overprint = overprint;
        const glm::vec3 below = glm::mix(glm::vec3(1.0F), glm::vec3(0.9F, 0.3F, 0.2F), overprint);
        const auto page = compose(layers, style, {32, 8});
        expect_near(glm::vec3(page[12]), style.ink * below, 1e-3F);
        expect_near(glm::vec3(page[4]), glm::vec3(0.09F, 0.16F, 0.64F) * below, 4e-3F);
        expect_near(glm::vec3(page[24]), style.color * glm::vec3(0.9F, 0.3F, 0.2F), 1e-3F);
    }
}

TEST(Compose, MisprintedPaintLiesBesideItsPlaceAndInkAtItsPlace)
{
    constexpr glm::uvec2 size_px(48, 32);
    Layers layers;
    const auto is_painted = [](glm::ivec2 pixel) {
        return pixel.x >= 16 && pixel.x < 24 && pixel.y >= 8 && pixel.y < 16;
    };
    layers.wash = [&](glm::uvec2 pixel) {
        return is_painted(pixel) ? glm::vec4(0.2F, 0.5F, 0.2F, 1.0F) : glm::vec4(1.0F);
    };
    layers.hatch = [](glm::uvec2 pixel) { return pixel.x == 40 ? 1.0F : 0.0F; };
    PaperStyle style = smooth();
    const auto plain = compose(layers, style, size_px);
    style.height_mm = 32.0F / 3.0F;
    style.misprint_mm = 1.0F; // three pixels
    for (const auto& [degrees, shift] :
         {std::pair{0.0F, glm::ivec2(3, 0)}, {90.0F, {0, 3}}, {180.0F, {-3, 0}}, {45.0F, {2, 2}}}) {
        style.misprint_deg = degrees;
        EXPECT_EQ(paint_shift_px(style, 3.0F), shift);
        EXPECT_GE(reach_px(style, 3.0F), static_cast<uint32_t>(std::max(shift.x, shift.y)));
        const auto page = compose(layers, style, size_px);
        for (int y = 4; y < 28; ++y) {
            for (int x = 4; x < 44; ++x) {
                const bool has_paint = is_painted(glm::ivec2(x, y) - shift);
                const size_t like = x == 40 ? 40 : has_paint ? 10 * 48 + 20 : 0;
                EXPECT_EQ(page[static_cast<size_t>(y * 48 + x)], plain[like]) << x << ", " << y;
            }
        }
    }
}

TEST(Compose, TwiceTheSizeIsTheSameSheet)
{
    PaperStyle style = smooth();
    style.grain = 1.0F;
    const auto small = relief(style, {96, 64}, 12.0F);
    const auto large = relief(style, {192, 128}, 24.0F);
    std::vector<double> reduced;
    for (size_t y = 0; y < 128; y += 2) {
        for (size_t x = 0; x < 192; x += 2) {
            const size_t i = y * 192 + x;
            reduced.push_back((large[i] + large[i + 1] + large[i + 192] + large[i + 193]) / 4.0);
        }
    }
    EXPECT_GT(correlation(small, reduced), 0.98);
}

TEST(Compose, PaintSettlesInTheHollowsAndInkSkipsTheHeights)
{
    constexpr glm::uvec2 size_px(160, 120);
    PaperStyle style = smooth();
    style.grain = 1.0F;
    const auto heights = relief(style, size_px, 4.0F);
    style.grain = 0.0F;
    style.granulation = 1.0F;
    EXPECT_EQ(mean(relief(style, size_px, 4.0F)), relief(style, size_px, 4.0F)[0]) << "no paint, no grain";

    const auto lightness = [&](const Layers& layers) {
        std::vector<double> values;
        for (const glm::vec4& color : compose(layers, style, size_px, 4.0F)) {
            values.push_back(static_cast<double>(color.y));
        }
        return values;
    };
    Layers painted;
    painted.wash = [](glm::uvec2) { return glm::vec4(glm::vec3(0.4F), 1.0F); };
    const auto paint = lightness(painted);
    for (size_t i = 0; i < paint.size(); ++i) {
        // The first page shows 0.1 * relief; the rest of the exponent is the slow pooling.
        const auto pooled = [&](size_t k) {
            const double exponent = std::log(paint[k] / static_cast<double>(style.color.y)) / std::log(0.4);
            return exponent - 1.0 + 7.0 * heights[k];
        };
        EXPECT_LT(std::abs(pooled(i)), 0.16);
        if (i % size_px.x > 0) {
            EXPECT_NEAR(pooled(i), pooled(i - 1), 0.03) << "slow: it flows over centimetres";
        }
    }

    style.granulation = 0.0F;
    style.ink_break = 1.0F;
    Layers inked;
    inked.hatch = [](glm::uvec2) { return 1.0F; };
    const auto broken = lightness(inked);
    for (size_t i = 0; i < broken.size(); ++i) {
        const double height = 10.0 * heights[i];
        const double dry = std::clamp(1.0 - 3.0 * std::max(height - 0.1, 0.0), 0.0, 1.0);
        const auto expected = static_cast<double>(glm::mix(style.color.y, style.ink.y, dry));
        EXPECT_NEAR(broken[i], expected, 0.03);
    }
    EXPECT_GT(*std::ranges::max_element(broken), 0.3) << "somewhere the ink skips";
}

/// A page of 32 mm by 24 mm, fully covered with ink, at 6 pixels per millimetre.
std::vector<glm::vec4> framed(PaperStyle style)
{
    style.height_mm = 24.0F;
    Layers layers;
    layers.wash = [](glm::uvec2) { return glm::vec4(0.3F, 0.6F, 0.2F, 1.0F); };
    layers.hatch = [](glm::uvec2 pixel) { return pixel.y < 72 ? 1.0F : 0.0F; };
    layers.lines = [](glm::uvec2 pixel) { return glm::vec4(0.0F, 0.0F, 0.0F, pixel.y < 40 ? 1.0F : 0.0F); };
    return compose(layers, style, {192, 144}, 6.0F);
}

TEST(Compose, TheMarginIsBarePaper)
{
    PaperStyle style = smooth();
    const auto whole = framed(style);
    style.margin_mm = 4.0F;
    const auto picture = framed(style);
    for (int i = 0; i < static_cast<int>(picture.size()); ++i) {
        const glm::ivec2 pixel(i % 192, i / 192);
        const glm::ivec2 beyond = glm::max(23 - pixel, pixel - glm::ivec2(168, 120));
        const int beyond_px = std::max(beyond.x, beyond.y); // 0 or less: inside
        if (beyond_px > 1) {
            expect_near(glm::vec3(picture[static_cast<size_t>(i)]), style.color, half_step);
        } else if (beyond_px < -1) {
            EXPECT_EQ(picture[static_cast<size_t>(i)], whole[static_cast<size_t>(i)]);
        }
    }
    style.height_mm = 24.0F;
    style.margin_mm = 1000.0F;
    EXPECT_EQ(window_of(style, 32.0F), (Window{glm::vec2(8.0F), glm::vec2(24.0F, 16.0F)}))
        << "a third of the page stays at least";
}

TEST(Compose, TheBorderIsAsWideAsItIsSaidToBe)
{
    PaperStyle style = smooth();
    style.height_mm = 24.0F;
    style.margin_mm = 4.0F;
    style.border_mm = 0.7F;
    const auto picture = compose({}, style, {192, 144}, 6.0F);
    double ink_px = 0.0;
    for (size_t y = 40; y < 104; ++y) {
        for (size_t x = 0; x < 96; ++x) {
            const float cover = (style.color.y - picture[y * 192 + x].y) / (style.color.y - style.ink.y);
            ink_px += static_cast<double>(cover) / 64.0;
            EXPECT_TRUE(cover < 1e-3F || (x >= 20 && x < 28)) << x << ", " << y;
        }
    }
    EXPECT_NEAR(ink_px, 6.0 * 0.7, 0.1);
}

TEST(Compose, DryStrokesCatchOnTheToothAndStayAsDark)
{
    constexpr glm::uvec2 size_px(480, 360);
    PaperStyle style = smooth();
    style.grain = 1.0F;
    const auto heights = relief(style, size_px, 6.0F);
    style.grain = 0.0F;
    const auto cover = [&](float stroke, float grain) {
        Layers inked;
        inked.hatch = [=](glm::uvec2) { return stroke; };
        style.ink_grain = grain;
        std::vector<double> covers;
        for (const glm::vec4& color : compose(inked, style, size_px, 6.0F)) {
            covers.push_back(static_cast<double>((style.color.y - color.y) / (style.color.y - style.ink.y)));
        }
        return covers;
    };
    for (const float grain : {0.4F, 1.0F}) {
        for (const float stroke : {0.05F, 0.2F, 0.5F, 0.7F, 0.95F}) {
            EXPECT_NEAR(mean(cover(stroke, grain)), stroke, 0.01) << stroke << ", grain " << grain;
        }
        const auto caught = cover(0.5F, grain);
        EXPECT_GT(correlation(caught, heights), 0.7) << "heights take more than hollows";
        const auto [least, most] = std::ranges::minmax(caught);
        EXPECT_NEAR(least, 0.5 * (1.0 - static_cast<double>(grain)), 0.01);
        EXPECT_NEAR(most, 0.5 + 0.5 * static_cast<double>(grain), 0.01);
    }
    EXPECT_NEAR(std::ranges::max(cover(0.0F, 1.0F)), 0.0, 1e-3) << "no pigment";
    EXPECT_NEAR(std::ranges::min(cover(1.0F, 1.0F)), 1.0, 1e-3) << "pressed into all hollows";
}

} // namespace
} // namespace estampe::paper
