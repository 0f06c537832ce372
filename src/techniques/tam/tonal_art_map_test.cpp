// SPDX-License-Identifier: MIT
#include "techniques/tam/tonal_art_map.hpp"

#include <algorithm>

#include <estampe/error.hpp>
#include <gtest/gtest.h>

namespace estampe::tam {
namespace {

TonalArtMap flat_map(const std::vector<float>& darkness, const std::vector<uint8_t>& coverage)
{
    TonalArtMap map{.size_px = 32, .darkness = darkness, .level_of_tone = {}, .threshold_of_level = {}};
    for (const uint8_t texel : coverage) {
        std::vector<Gray8>& levels = map.level_of_tone.emplace_back();
        for (size_t side = 32; side > 0; side /= 2) {
            levels.emplace_back(side * side, texel);
        }
    }
    return map;
}

TEST(TonalArtMap, HasALevelForEveryPowerOfTwo)
{
    EXPECT_EQ(level_count(1), 1U);
    EXPECT_EQ(level_count(512), 10U);
}

TEST(TonalArtMap, HalvesByTheMeanOfFour)
{
    const Gray8 image{0, 100, 10, 20, 200, 100, 30, 41, 0, 0, 255, 255, 0, 0, 255, 255};
    EXPECT_EQ(half_size(image, 4), (Gray8{100, 25, 0, 255}));
}

TEST(TonalArtMap, ThresholdsLieWhereTheLineBetweenTonesPassesOneHalf)
{
    const auto threshold = [](const std::vector<uint8_t>& coverage) {
        return threshold_levels(flat_map({0.2F, 0.6F}, coverage))[0][0];
    };
    EXPECT_EQ(threshold({255, 255}), 26); // halfway from paper at 0 to ink at 0.2
    EXPECT_EQ(threshold({0, 255}), 102);  // halfway from 0.2 to 0.6
    EXPECT_EQ(threshold({51, 255}), 89);  // 0.2 + 0.4 * 0.3 / 0.8
    EXPECT_EQ(threshold({0, 0}), 204);    // halfway from 0.6 to ink at 1
    EXPECT_EQ(threshold({204, 0}), 32);   // not nested: the first crossing counts
    EXPECT_EQ(threshold({0, 127}), 153);  // just below half ink: crosses soon after 0.6
}

TEST(TonalArtMap, ChecksSizesAndOrder)
{
    const TonalArtMap good = flat_map({0.2F, 0.6F}, {10, 20});
    EXPECT_NO_THROW(check_map(good, "good"));
    TonalArtMap bad = good;
    bad.size_px = 48;
    EXPECT_THROW(check_map(bad, "size"), Error);
    bad = good;
    bad.darkness = {0.6F, 0.2F};
    EXPECT_THROW(check_map(bad, "order"), Error);
    bad = good;
    bad.darkness = {0.2F};
    EXPECT_THROW(check_map(bad, "count"), Error);
    bad = good;
    bad.level_of_tone[1].pop_back();
    EXPECT_THROW(check_map(bad, "levels"), Error);
    bad = good;
    bad.level_of_tone[1][2].pop_back();
    EXPECT_THROW(check_map(bad, "texels"), Error);
    bad = good;
    bad.threshold_of_level.emplace_back();
    EXPECT_THROW(check_map(bad, "thresholds"), Error);
}

TEST(TonalArtMap, PreviewShowsTonesFromLeftToRightOnPaper)
{
    const Image sheet = preview_sheet(flat_map({0.2F, 0.6F}, {0, 255}), glm::vec3(1.0F), glm::vec3(0.0F));
    const auto grey_at = [&](uint32_t x, uint32_t y) {
        return sheet.rgba[(size_t{y} * sheet.width + x) * 4];
    };
    EXPECT_EQ(sheet.width, 12U + 2 * (32 + 12));
    EXPECT_EQ(grey_at(0, 0), 255);
    EXPECT_EQ(grey_at(12 + 16, 12 + 16), 255);
    EXPECT_EQ(grey_at(12 + 44 + 16, 12 + 16), 0);
    EXPECT_EQ(grey_at(12 + 44 + 8, 12 + 32 + 12 + 8), 0); // its next level, below
    EXPECT_EQ(grey_at(12 + 44 + 18, 12 + 32 + 12 + 12), 255);
}

} // namespace
} // namespace estampe::tam
