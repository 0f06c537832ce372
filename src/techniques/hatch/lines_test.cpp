// SPDX-License-Identifier: MIT
// Nesting of strokes, tested with the shader's own functions: a line that is drawn stays as the tone deepens
// and as the eye comes nearer.
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/glsl.hpp"
#include "techniques/hatch/hatch.glsl.h"
#include "techniques/hatch/hatch.hpp"

namespace estampe {
namespace lines {

using namespace test::glsl; // NOLINT(google-build-using-namespace)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include "shaders/lines.glsl"
#pragma GCC diagnostic pop

} // namespace lines

namespace {

/// All lines that are drawn in one unit of v: number in units of 2^-20, and identity.
using Drawn = std::set<std::pair<int64_t, uint32_t>>;

Drawn lines_drawn(float unit_per_px, float width_px, float darkness, bool wraps)
{
    lines::LineField field{};
    field.v_per_px = unit_per_px;
    field.wraps = wraps;
    Drawn drawn;
    const lines::Lines spaced = lines::lines_of(field, width_px, darkness);
    const int halves = static_cast<int>(std::lround(2.0F / spaced.spacing));
    for (int number = 1; number <= halves; ++number) {
        if (number % 2 == 0 || spaced.newborn > 0.0F) {
            drawn.insert({std::llround(number * 0.5 * static_cast<double>(spaced.spacing) * (1 << 20)),
                          lines::line_identity(field, spaced, number, 7U)});
        }
    }
    return drawn;
}

bool is_subset(const Drawn& few, const Drawn& many)
{
    return std::includes(many.begin(), many.end(), few.begin(), few.end());
}

class LineNesting : public testing::TestWithParam<bool> {};

TEST_P(LineNesting, LighterTonesAreSubsetsOfDarkerOnes)
{
    for (int zoom = 0; zoom < 64; ++zoom) {
        const float unit_per_px = 0.0007F * std::exp2(static_cast<float>(zoom) / 16.0F);
        for (int tone = 1; tone < 19; ++tone) {
            const Drawn lighter =
                lines_drawn(unit_per_px, 1.7F, 0.05F * static_cast<float>(tone), GetParam());
            const Drawn darker =
                lines_drawn(unit_per_px, 1.7F, 0.05F * static_cast<float>(tone + 1), GetParam());
            EXPECT_TRUE(is_subset(lighter, darker)) << "tone " << tone << ", zoom " << zoom;
            EXPECT_FALSE(lighter.empty());
        }
    }
}

TEST_P(LineNesting, FarViewsAreSubsetsOfNearOnes)
{
    for (int tone = 1; tone < 20; ++tone) {
        Drawn far;
        for (int zoom = 64; zoom >= 0; --zoom) {
            const float unit_per_px = 0.0007F * std::exp2(static_cast<float>(zoom) / 16.0F);
            const Drawn near = lines_drawn(unit_per_px, 1.7F, 0.05F * static_cast<float>(tone), GetParam());
            EXPECT_TRUE(is_subset(far, near)) << "tone " << tone << ", zoom " << zoom;
            far = near;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Coordinates, LineNesting, testing::Values(false, true));

TEST(LineIdentity, OnAWrappingCoordinateIgnoresWholeNumbersAndSign)
{
    for (int level = 0; level >= -8; --level) {
        const int count = 1 << (1 - level);
        for (int i = -2 * count; i <= 2 * count; ++i) {
            const uint32_t here = lines::dyadic_identity(lines::folded(i, count), level, 3U);
            EXPECT_EQ(here, lines::dyadic_identity(lines::folded(i + count, count), level, 3U));
            EXPECT_EQ(here, lines::dyadic_identity(lines::folded(-i, count), level, 3U));
        }
    }
}

TEST(LineIdentity, IsTheSameAtEveryZoom)
{
    for (int i = -40; i <= 40; ++i) {
        EXPECT_EQ(lines::dyadic_identity(i, -3, 3U), lines::dyadic_identity(4 * i, -5, 3U));
    }
}

/// Lengths of the gaps in a line in pixels, longest first.
std::vector<int> breaks(const lines::HatchLineStyle& style, float dark)
{
    lines::LineField field{};
    field.u_per_px = 1e-4F;
    field.v_per_px = 1e-4F;
    const lines::LineScale scale = lines::scale_of(field, style, dark);
    std::vector<int> lengths;
    int length = 0;
    for (int px = 0; px < 400000; ++px) {
        field.u = 1e-4F * static_cast<float>(px);
        if (lines::stroke_profile(field, style, scale, 99U) < 0.5F) {
            ++length;
        } else if (length > 0) {
            lengths.push_back(length);
            length = 0;
        }
    }
    std::sort(lengths.rbegin(), lengths.rend());
    return lengths;
}

TEST(Breaks, CloseOneAfterTheOtherAndAreNoNicks)
{
    const lines::HatchLineStyle style{.width_px = 1.5F, .gap_px = 6.0F, .taper_px = 8.0F, .cell_px = 90.0F};
    size_t before = breaks(style, 0.5F).size();
    EXPECT_GT(before, 1000U);
    for (const float dark : {0.85F, 0.91F, 0.97F}) {
        const std::vector<int> lengths = breaks(style, dark);
        EXPECT_LT(static_cast<double>(lengths.size()), 0.95 * static_cast<double>(before)) << dark;
        before = lengths.size();
        const auto nicks = std::count_if(lengths.begin(), lengths.end(), [](int px) { return px < 4; });
        EXPECT_LT(static_cast<double>(nicks), 0.3 * static_cast<double>(lengths.size())) << dark;
    }
}

TEST(Breaks, AreNoneWithoutGaps)
{
    const lines::HatchLineStyle style{.width_px = 1.5F, .gap_px = 0.0F, .taper_px = 3.0F, .cell_px = 90.0F};
    for (const float dark : {0.3F, 0.6F, 0.9F}) {
        EXPECT_TRUE(breaks(style, dark).empty());
        EXPECT_EQ(lines::kept_share(style, 1.0F), 1.0F);
    }
}

TEST(GrownStrokes, AreAsLongAsAskedOnAverage)
{
    lines::LineField field{};
    field.u_per_px = 1e-4F;
    lines::HatchLineStyle style{};
    style.taper_px = 20.0F;
    lines::Lines spaced{};
    spaced.spacing = 0.125F;
    for (int step = 0; step <= 10; ++step) {
        const float share = 0.1F * static_cast<float>(step);
        double sum = 0.0;
        constexpr int samples = 400000;
        for (int i = 0; i < samples; ++i) {
            field.u = 0.001F * static_cast<float>(i);
            sum += static_cast<double>(lines::grown_profile(field, style, spaced, 99U, share)) / samples;
        }
        EXPECT_NEAR(sum, static_cast<double>(share), 0.02);
    }
}

TEST(FirstLayer, PaysForGapsAndTapersAsTheShadersLinesDo)
{
    hatch::HatchStyle style;
    style.length_mm = 7.0F;
    lines::HatchLineStyle drawn{};
    drawn.gap_px = style.gap_mm;
    drawn.taper_px = style.taper_mm;
    drawn.cell_px = style.length_mm;
    EXPECT_FLOAT_EQ(hatch::first_layer(style).darkness * lines::kept_share(drawn, 1.0F),
                    shared::first_layer_share);
}

} // namespace
} // namespace estampe
