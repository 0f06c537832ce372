// SPDX-License-Identifier: MIT
// The teeth of shadow edges, tested with the shader's own functions.
#include <algorithm>

#include <gtest/gtest.h>

#include "support/glsl.hpp"
#include "techniques/shadow/shadow_style.hpp"

namespace estampe {
namespace teeth {

using namespace test::glsl; // NOLINT(google-build-using-namespace)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include "techniques/shadow/local/teeth.glsl"
#pragma GCC diagnostic pop

} // namespace teeth

namespace shadow {
namespace {

constexpr float width_px = 1.5F;
constexpr float darkness = 0.5F;

float tooth_at(double v, double v_per_px, float variety, bool wraps = false)
{
    teeth::LineField field{};
    field.v = static_cast<float>(v);
    field.v_per_px = static_cast<float>(v_per_px);
    field.wraps = wraps;
    return teeth::tooth(field, 3U, width_px, darkness, variety);
}

constexpr double octave[] = {0.01, 0.0112, 0.0126, 0.0141, 0.0159, 0.0178, 0.0199};

TEST(Teeth, AddAsMuchAsTheyTakeAway)
{
    for (const double v_per_px : octave) {
        for (const float variety : {0.0F, 0.5F, 1.0F}) {
            constexpr int samples = 1 << 18;
            double sum = 0.0;
            float highest = -1.0F;
            float lowest = 1.0F;
            for (int i = 0; i < samples; ++i) {
                const float height = tooth_at(64.0 * i / samples, v_per_px, variety);
                sum += static_cast<double>(height) / samples;
                highest = std::max(highest, height);
                lowest = std::min(lowest, height);
            }
            // Teeth are complete, except for the teeth at both ends of the thousand.
            EXPECT_NEAR(sum, 0.0, 0.001);
            EXPECT_LE(highest, 1.0F);
            EXPECT_GE(lowest, -1.0F);
            EXPECT_GT(highest, 0.5F);
            EXPECT_LT(lowest, -0.5F);
        }
    }
}

TEST(Teeth, StandOnTheLinesOfTheHatching)
{
    for (const double v_per_px : octave) {
        teeth::LineField field{};
        field.v_per_px = static_cast<float>(v_per_px);
        const teeth::Lines lines = teeth::lines_of(field, width_px, darkness);
        const auto spacing = static_cast<double>(lines.spacing);
        for (int i = 1; i < 40; ++i) {
            const float on_line = tooth_at(i * spacing, v_per_px, 0.0F);
            EXPECT_GT(on_line, 0.99F);
            EXPECT_LT(tooth_at((i + 0.01) * spacing, v_per_px, 0.0F), on_line);
            EXPECT_LT(tooth_at((i - 0.01) * spacing, v_per_px, 0.0F), on_line);
        }
    }
}

TEST(Teeth, ChangeLittleWhileOneComesNearer)
{
    for (int i = 0; i < 500; ++i) {
        double v_per_px = 0.02;
        float before = tooth_at(0.00731 * i, v_per_px, 0.6F);
        for (; v_per_px > 0.005; v_per_px /= 1.01) {
            const float now = tooth_at(0.00731 * i, v_per_px, 0.6F);
            EXPECT_LT(std::abs(now - before), 0.09F);
            before = now;
        }
    }
}

TEST(Teeth, AreContinuous)
{
    for (int i = 0; i < 20000; ++i) {
        const double v = 0.0001 * i;
        EXPECT_LT(std::abs(tooth_at(v, 0.013, 1.0F) - tooth_at(v + 0.0001, 0.013, 1.0F)), 0.04F) << v;
    }
}

TEST(Teeth, OnAWrappingCoordinateIgnoreWholeNumbersAndSign)
{
    for (int i = 0; i < 200; ++i) {
        const double v = 0.00517 * i;
        const float height = tooth_at(v, 0.013, 0.8F, true);
        EXPECT_NEAR(tooth_at(v + 1.0, 0.013, 0.8F, true), height, 1e-3F);
        EXPECT_NEAR(tooth_at(-v, 0.013, 0.8F, true), height, 1e-3F);
    }
}

TEST(EdgeProfile, StrokesWithoutLinesAreWaves)
{
    const ShadowStyle strokes{.edge = Edge::strokes};
    EXPECT_EQ(shadow_variant({}, HatchedLines{}), 0U);
    EXPECT_EQ(shadow_variant(strokes, HatchedLines{}), shared::light_has_stroke_edges);
    EXPECT_EQ(shadow_variant(strokes, std::nullopt), shared::light_has_wave_edges);
    EXPECT_EQ(shadow_variant({.edge = Edge::waves, .sun_radius_deg = 1.0F}, HatchedLines{}),
              shared::light_has_wave_edges | shared::light_has_soft_sun);
    EXPECT_EQ(shadow_variant({.edge = Edge::waves, .edge_reach_mm = 0.0F}, HatchedLines{}), 0U);
    EXPECT_EQ(lamps_variant(std::vector(2, shared::LocalShadow{})), 0U);
    EXPECT_EQ(lamps_variant(std::vector{shared::LocalShadow{}, shared::LocalShadow{.radius_m = 0.1F}}),
              shared::light_has_soft_lamps);
    EXPECT_FLOAT_EQ(edge_profile(strokes, HatchedLines{.width_mm = 0.4F}, 10.0F).width_px, 4.0F);
    EXPECT_FLOAT_EQ(edge_profile(strokes, std::nullopt, 10.0F).amplitude_px, 10.0F);
}

} // namespace
} // namespace shadow
} // namespace estampe
