// SPDX-License-Identifier: MIT
// Tonal art maps keep their tone at every distance and tilt, on surfaces that the test sets pixel by pixel.
#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "features/hatching/hatching.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch_test_canvas.hpp"

namespace estampe {
namespace {

using test::Canvas;
using test::Patch;

constexpr uint32_t patch_tones = 33;
constexpr uint32_t patch_px = 144;
constexpr glm::uvec2 patches_px{11 * patch_px, 3 * patch_px};

uint32_t tone_at(glm::uvec2 pixel)
{
    return pixel.x / patch_px + 11 * (pixel.y / patch_px);
}

double darkness_of(uint32_t tone)
{
    return static_cast<double>(tone) / (patch_tones - 1);
}

class HatchMap : public testing::TestWithParam<hatch::MapTone> {};

TEST_P(HatchMap, InkIsTheDarknessAtEveryDistanceAndTilt)
{
    hatch::HatchStyle style;
    style.map_tone = GetParam();
    style.map_texel_mm = 1.0F;
    style.black_above = 2.0F;
    style.map_contrast = GetParam() == hatch::MapTone::blend ? 2.0F : 12.0F;
    hatch::MapImages map = hatch::upload_map(
        test::shared_device(), features::load_map(features::map_choice(features::StyleTables())),
        style.map_tone, style.map_contrast);
    Canvas canvas(patches_px, shared::strokes_uv);
    canvas.paint_darkness([](glm::uvec2 pixel) { return static_cast<float>(darkness_of(tone_at(pixel))); });
    double worst = 0.0;
    int views = 0;
    std::array<double, patch_tones> means{};
    for (int octave = 0; octave <= 6; ++octave) {
        for (const double tilt_deg : {0.0, 25.0, 50.0, 75.0}) {
            const double g = 0.9 / 512.0 * std::exp2(octave);
            const double stretch = 1.0 / std::cos(tilt_deg * std::numbers::pi / 180.0);
            canvas.paint_surface([=](glm::dvec2 p) {
                return Patch{.coordinate = glm::vec3(p.x * g, p.y * g * stretch, 0.0),
                             .dx = {static_cast<float>(g), 0, 0},
                             .dy = {0, static_cast<float>(g * stretch), 0}};
            });
            const std::vector<float> ink = canvas.ink(style, &map);
            std::array<double, patch_tones> sums{};
            for (uint32_t i = 0; i < ink.size(); ++i) {
                sums.at(tone_at({i % patches_px.x, i / patches_px.x})) += ink[i];
            }
            for (uint32_t tone = 0; tone < patch_tones; ++tone) {
                const double mean = sums.at(tone) / (patch_px * patch_px);
                means.at(tone) += mean;
                worst = std::max(worst, std::abs(mean - darkness_of(tone)));
            }
            ++views;
        }
    }
    double worst_mean = 0.0;
    for (uint32_t tone = 0; tone < patch_tones; ++tone) {
        worst_mean = std::max(worst_mean, std::abs(means.at(tone) / views - darkness_of(tone)));
        EXPECT_TRUE(tone == 0 || means.at(tone) > means.at(tone - 1)) << "tone " << tone;
    }
    fmt::print("worst mean over all views {:.4f}, worst patch of {} px {:.4f}\n", worst_mean, patch_px,
               worst);
    EXPECT_LE(worst_mean, 0.03);
    EXPECT_LE(worst, 0.03);
    EXPECT_EQ(means.front(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Tones, HatchMap, testing::Values(hatch::MapTone::order, hatch::MapTone::blend));

} // namespace
} // namespace estampe
