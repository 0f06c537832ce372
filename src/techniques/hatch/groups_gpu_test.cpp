// SPDX-License-Identifier: MIT
// Grouping of the darkness of strokes into areas of a few tones, on pages that the tests fill.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/hatch/hatch.hpp"

namespace estampe::hatch {
namespace {

constexpr glm::uvec2 size_px(123, 85); // not a multiple of a tile
constexpr float pixels_per_mm = 4.0F;
constexpr float half_step = 1e-3F; // twice the rounding step of a half float below one
constexpr float not_there = -1.0F; // darkness of a pixel without a surface

using Darks = std::vector<float>;

size_t index_of(int x, int y)
{
    return static_cast<size_t>(y) * size_px.x + static_cast<size_t>(x);
}

Darks painted(const std::function<float(int x, int y)>& paint)
{
    Darks darks;
    for (int y = 0; y < static_cast<int>(size_px.y); ++y) {
        for (int x = 0; x < static_cast<int>(size_px.x); ++x) {
            darks.push_back(paint(x, y));
        }
    }
    return darks;
}

/// Groups the darkness of a page whose tone curve is the identity, and reads the darkness or the tiles.
Darks grouped(const Darks& darks, const HatchStyle& style, bool reads_ink = false)
{
    const auto at = [&](glm::uvec2 p) {
        return darks[index_of(static_cast<int>(p.x), static_cast<int>(p.y))];
    };
    const auto globals = features::frame_globals({}, {}, glm::dvec3(0.0), {.size_px = size_px});
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    auto draw = test::Layer::words(size_px, [&](glm::uvec2 p) { return at(p) < 0.0F ? 0U : 1U; });
    auto depth = test::Layer::depth(size_px, [](glm::uvec2) { return 0.01F; });
    auto color = test::Layer::root_color(size_px, [](glm::uvec2) { return glm::vec4(1.0F); });
    auto light = test::Layer::color(size_px, [&](glm::uvec2 p) { return glm::vec4(1.0F - at(p)); });
    auto normal = test::Layer::normals(size_px, [](glm::uvec2) { return glm::vec3(0, 0, 1); });
    auto screen = test::Layer::root_color(glm::uvec2(1), [](glm::uvec2) { return glm::vec4(0.0F); });
    auto flat = test::Layer::places(size_px, [](glm::uvec2 p) { return glm::vec4(p, 0, 0); });
    auto footprint = test::Layer::footprints(
        size_px, [](glm::uvec2) { return std::pair(glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)); });
    gpu::Graph graph;
    const HatchInputs in{.frame = gpu::import_whole(graph, "frame", frame),
                         .draw = draw.in(graph),
                         .depth = depth.in(graph),
                         .normal = normal.in(graph),
                         .color = color.in(graph),
                         .coordinate = flat.in(graph),
                         .footprint = footprint.in(graph),
                         .light = light.in(graph),
                         .screen = screen.in(graph),
                         .tone = {.curve = shared::tone_linear,
                                  .exposure = 1.0F,
                                  .gamma = 1.0F,
                                  .contrast = 1.0F,
                                  .ceiling = 1.0F},
                         .pixels_per_mm = pixels_per_mm,
                         .size_px = size_px};
    const Darkness darkness = add_darkness(graph, in, style);
    const gpu::ImageId ink = reads_ink ? add_lines(graph, in, darkness, style) : darkness.image;
    return test::run_and_read_coverage(graph, ink);
}

HatchStyle style_of(int groups, float area_mm2, float strength = 1.0F)
{
    return {
        .groups = groups, .group_strength = strength, .group_area_mm2 = area_mm2, .group_smooth_mm = 0.0F};
}

int tone_of(float dark, int groups)
{
    return dark < 0.0F
               ? -1
               : static_cast<int>(std::clamp(dark, 0.0F, 1.0F) * static_cast<float>(groups - 1) + 0.5F);
}

/// Areas of one tone, found by filling them pixel by pixel.
struct Areas {
    std::vector<size_t> area_of;
    std::vector<size_t> pixels;
    std::vector<int> tone;
};

constexpr std::array<std::pair<int, int>, 4> beside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// Calls `visit` with the numbers of the pixels beside a pixel.
void visit_beside(size_t pixel, const std::function<void(size_t)>& visit)
{
    const int x = static_cast<int>(pixel % size_px.x);
    const int y = static_cast<int>(pixel / size_px.x);
    for (const auto& [dx, dy] : beside) {
        if (x + dx >= 0 && y + dy >= 0 && x + dx < static_cast<int>(size_px.x) &&
            y + dy < static_cast<int>(size_px.y)) {
            visit(index_of(x + dx, y + dy));
        }
    }
}

Areas areas_of(const Darks& darks, int groups)
{
    constexpr size_t unknown = SIZE_MAX;
    Areas areas{.area_of = std::vector<size_t>(darks.size(), unknown)};
    for (size_t first = 0; first < darks.size(); ++first) {
        if (areas.area_of[first] != unknown) {
            continue;
        }
        const size_t area = areas.tone.size();
        areas.tone.push_back(tone_of(darks[first], groups));
        areas.pixels.push_back(0);
        std::vector<size_t> open{first};
        areas.area_of[first] = area;
        while (!open.empty()) {
            const size_t pixel = open.back();
            open.pop_back();
            ++areas.pixels[area];
            visit_beside(pixel, [&](size_t next) {
                if (areas.area_of[next] == unknown && tone_of(darks[next], groups) == areas.tone[area]) {
                    areas.area_of[next] = area;
                    open.push_back(next);
                }
            });
        }
    }
    return areas;
}

/// The rule of grouping, area by area: an area below the least size takes the tone of those areas that are
/// not below it with which it shares the longest border; up to one and a half times the least size, in part.
Darks expected(const Darks& darks, int groups, float least_px)
{
    const Areas areas = areas_of(darks, groups);
    std::vector<std::map<int, int>> borders(areas.tone.size());
    for (size_t i = 0; i < darks.size(); ++i) {
        visit_beside(i, [&](size_t next) {
            const size_t other = areas.area_of[next];
            if (areas.tone[other] >= 0 && areas.tone[other] != areas.tone[areas.area_of[i]] &&
                static_cast<float>(areas.pixels[other]) >= least_px) {
                ++borders[areas.area_of[i]][areas.tone[other]];
            }
        });
    }
    Darks result;
    for (size_t i = 0; i < darks.size(); ++i) {
        const size_t area = areas.area_of[i];
        const auto share = [&](int tone) {
            return static_cast<float>(tone) / static_cast<float>(groups - 1);
        };
        float dark = std::max(0.0F, share(areas.tone[area]));
        if (areas.tone[area] >= 0 && !borders[area].empty()) {
            const auto longest = std::ranges::max_element(
                borders[area], [](const auto& a, const auto& b) { return a.second < b.second; });
            const float grown =
                std::clamp((static_cast<float>(areas.pixels[area]) / least_px - 1.0F) / 0.5F, 0.0F, 1.0F);
            dark = glm::mix(share(longest->first), dark, grown * grown * (3.0F - 2.0F * grown));
        }
        result.push_back(dark);
    }
    return result;
}

float worst_error(const Darks& a, const Darks& b)
{
    float worst = 0.0F;
    for (size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, std::abs(a[i] - b[i]));
    }
    return worst;
}

/// Rounds a darkness so that it is exact in the half floats of the images of light and darkness.
float in_steps(float dark)
{
    return std::round(1024.0F * dark) / 1024.0F;
}

/// Soft hills of darkness with grain, and a strip without surfaces.
Darks hills(uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> phase(0.0F, 6.28F);
    std::uniform_real_distribution<float> grain(-0.12F, 0.12F);
    const float a = phase(random);
    const float b = phase(random);
    return painted([&](int x, int y) {
        const auto u = static_cast<float>(x);
        const auto v = static_cast<float>(y);
        const float dark = 0.5F + 0.3F * std::sin(0.11F * u + a) + 0.3F * std::sin(0.17F * v + 0.05F * u + b);
        return x > 100 && x < 104 ? not_there : in_steps(std::clamp(dark + grain(random), 0.0F, 1.0F));
    });
}

TEST(HatchGroups, AreTheAreasFoundByFilling)
{
    float worst = 0.0F;
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        const Darks darks = hills(seed);
        for (const int groups : {2, 3, 4, 6}) {
            const float area_mm2 = seed % 2 == 0 ? 3.0F : 0.8F;
            const Darks result = grouped(darks, style_of(groups, area_mm2));
            const Darks wanted = expected(darks, groups, area_mm2 * pixels_per_mm * pixels_per_mm);
            EXPECT_LE(worst_error(result, wanted), half_step) << seed << ", " << groups;
            worst = std::max(worst, worst_error(result, wanted));
        }
    }
    std::printf("largest error of a pixel %.5f\n", static_cast<double>(worst));
}

TEST(HatchGroups, ALongWindingAreaIsOne)
{
    // A spiral two pixels wide: its pixels are connected only along its whole length.
    const Darks darks = painted([](int x, int y) {
        const int ring = std::min(std::min(x, y), std::min(122 - x, 84 - y));
        const bool is_gap = x == ring + 1 && y > 2 && y < 5;
        return ring / 2 % 2 == 0 && !is_gap ? 1.0F : 0.0F;
    });
    const float least_mm2 = 12.0F;
    EXPECT_LE(worst_error(grouped(darks, style_of(2, least_mm2)),
                          expected(darks, 2, least_mm2 * pixels_per_mm * pixels_per_mm)),
              half_step);
}

TEST(HatchGroups, NoAreaIsSmallerThanAsked)
{
    const Darks result = grouped(hills(7), style_of(4, 3.0F));
    std::map<float, int> tones;
    for (const float dark : result) {
        ++tones[dark];
    }
    const Areas areas = areas_of(result, 4);
    size_t small_px = 0;
    for (const size_t pixels : areas.pixels) {
        small_px += static_cast<float>(pixels) < 3.0F * pixels_per_mm * pixels_per_mm ? pixels : 0;
    }
    std::printf("%zu of %zu pixels lie in areas below the least\n", small_px, result.size());
    EXPECT_LE(static_cast<double>(small_px), 0.02 * static_cast<double>(result.size()));
}

TEST(HatchGroups, StrengthMixesTheToneOfTheAreaWithThatOfThePlace)
{
    const Darks darks = hills(3);
    const Darks whole = grouped(darks, style_of(4, 3.0F));
    const Darks half = grouped(darks, style_of(4, 3.0F, 0.5F));
    const Darks none = grouped(darks, style_of(4, 3.0F, 0.0F));
    for (size_t i = 0; i < darks.size(); ++i) {
        const float own = std::max(darks[i], 0.0F);
        EXPECT_NEAR(half[i], 0.5F * (whole[i] + own), 2 * half_step) << i;
        EXPECT_NEAR(none[i], own, half_step) << i;
    }
}

TEST(HatchGroups, WithoutALeastAreaEachPixelIsRounded)
{
    const Darks darks = hills(4);
    const Darks result = grouped(darks, style_of(5, 0.0F));
    for (size_t i = 0; i < darks.size(); ++i) {
        const float tone = static_cast<float>(std::max(0, tone_of(darks[i], 5))) / 4.0F;
        EXPECT_NEAR(result[i], tone, half_step) << i;
    }
}

TEST(HatchGroups, StrokesHaveTheToneOfTheirArea)
{
    // Three bands whose darkness wavers about the tones of four groups; a light speck in black is filled.
    const Darks darks = painted([](int x, int y) {
        const float waver = 0.1F * std::sin(0.7F * static_cast<float>(x + 3 * y));
        const bool is_speck = x > 98 && x < 102 && y > 30 && y < 33;
        const std::array<float, 3> middle{0.1F, 0.33F, 0.95F};
        return is_speck ? 0.0F : std::min(middle.at(static_cast<size_t>(x / 41)) + 0.5F * waver, 1.0F);
    });
    HatchStyle style = style_of(4, 3.0F);
    // Ruled lines, whose tone is exact on a small page, too.
    style.width_mm = 0.3F;
    style.wobble_mm = style.gap_mm = style.taper_mm = style.pressure = 0.0F;
    style.black_above = 0.96F;
    const Darks ink = grouped(darks, style, true);
    std::array<double, 3> sums{};
    std::array<double, 3> counts{};
    for (size_t i = 0; i < ink.size(); ++i) {
        sums.at(i % size_px.x / 41) += static_cast<double>(ink[i]);
        counts.at(i % size_px.x / 41) += 1.0;
    }
    for (size_t band = 0; band < 3; ++band) {
        const double wanted = band == 2 ? 1.0 : static_cast<double>(band) / 3.0;
        std::printf("band %zu: ink %.4f for %.4f\n", band, sums.at(band) / counts.at(band), wanted);
        EXPECT_NEAR(sums.at(band) / counts.at(band), wanted, 0.02) << band;
    }
}

/// Share of the pixels that change by more than half the distance of two of four tones from a picture to the
/// next, and change back within three pictures.
double flicker(const std::vector<Darks>& pictures)
{
    size_t back = 0;
    for (size_t t = 1; t + 3 < pictures.size(); ++t) {
        for (size_t i = 0; i < pictures[t].size(); ++i) {
            const auto differs = [&](size_t later) {
                return std::abs(pictures[later][i] - pictures[t - 1][i]) > 0.5F / 3.0F;
            };
            back += differs(t) && !(differs(t + 1) && differs(t + 2) && differs(t + 3)) ? 1 : 0;
        }
    }
    return static_cast<double>(back) / static_cast<double>(pictures[0].size() * (pictures.size() - 4));
}

TEST(HatchGroups, AreSteadierThanTheirPixelsInMotion)
{
    // Hills with fine waves, which move by a quarter of a pixel per picture. A pixel that the tip of an area
    // passes changes back, so that some pixels always do; areas that come and go at once would add to them.
    HatchStyle style = style_of(4, 3.0F);
    style.group_smooth_mm = 1.0F;
    std::vector<Darks> areas;
    std::vector<Darks> pixels;
    for (size_t picture = 0; picture < 24; ++picture) {
        const float moved = 0.25F * static_cast<float>(picture);
        const Darks darks = painted([&](int x, int y) {
            const float u = static_cast<float>(x) + moved;
            const float v = static_cast<float>(y) + 0.6F * moved;
            const float coarse = std::sin(0.11F * u + 0.4F * std::sin(0.13F * v));
            const float fine = std::sin(0.9F * u + 2.0F * std::sin(0.2F * v)) * std::sin(0.7F * v);
            return in_steps(0.5F + 0.32F * coarse + 0.15F * fine);
        });
        areas.push_back(grouped(darks, style));
        pixels.push_back(grouped(darks, style_of(4, 0.0F)));
    }
    std::printf("of the pixels, %.3f %% change back within three pictures, %.3f %% without areas\n",
                100.0 * flicker(areas), 100.0 * flicker(pixels));
    EXPECT_LE(flicker(areas), 0.5 * flicker(pixels));
}

TEST(HatchGroups, ABlankPlaceInADarkAreaIsHatchedToo)
{
    // The blank place covers whole tiles of 8 x 8 pixels, which have no strokes before grouping.
    const Darks darks =
        painted([](int x, int y) { return x >= 40 && x < 56 && y >= 40 && y < 48 ? 0.0F : 1.0F; });
    HatchStyle style = style_of(2, 20.0F);
    const Darks ink = grouped(darks, style, true);
    EXPECT_EQ(ink[index_of(48, 44)], 1.0F);
    style.group_area_mm2 = 3.0F;
    EXPECT_EQ(grouped(darks, style, true)[index_of(48, 44)], 0.0F);
}

} // namespace
} // namespace estampe::hatch
