// SPDX-License-Identifier: MIT
// Properties of a tonal art map: tones, nesting, no seam, strokes of one width, identical bytes.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "techniques/tam/test_support.hpp"

namespace estampe::tam {
namespace {

using testing::message_of;
using testing::small_style;

bool is_ink(uint8_t texel)
{
    return texel > 127;
}

/// A style's map and its strokes.
struct Drawn {
    explicit Drawn(const TamStyle& style) : map(make_map(style, nullptr, &strokes)) {}

    std::vector<PlacedStroke> strokes;
    TonalArtMap map;
};

class EachTool : public ::testing::TestWithParam<Tool> {
protected:
    static TamStyle style()
    {
        TamStyle style = small_style(GetParam(), 256);
        style.tones = 6;
        style.width_px = GetParam() == Tool::pen || GetParam() == Tool::burin ? 2.4F : 5.0F;
        style.opacity = 0.9F;
        style.grain = 0.9F;
        style.tip = 0.25F;
        return style;
    }

    /// Cache: each map is drawn once for all tests.
    static const Drawn& drawn()
    {
        static std::map<Tool, Drawn> drawn_by_tool;
        return drawn_by_tool.try_emplace(GetParam(), style()).first->second;
    }

    static const TonalArtMap& map() { return drawn().map; }
};

INSTANTIATE_TEST_SUITE_P(Tam, EachTool,
                         ::testing::Values(Tool::pen, Tool::pencil, Tool::charcoal, Tool::burin,
                                           Tool::brush));

TEST_P(EachTool, ReachesEveryToneInEveryLevel)
{
    const TonalArtMap& map = EachTool::map();
    check_map(map, "made");
    for (size_t tone = 0; tone < map.darkness.size(); ++tone) {
        for (size_t level = 0; level < map.level_of_tone[tone].size(); ++level) {
            const double bound = (map.size_px >> level) >= 16 ? 0.01 : 0.03;
            EXPECT_NEAR(mean_coverage(map.level_of_tone[tone][level]), map.darkness[tone], bound)
                << "tone " << tone << " level " << level;
        }
    }
}

TEST_P(EachTool, KeepsTheInkOfATonesInAllDarkerOnes)
{
    const TonalArtMap& map = EachTool::map();
    for (size_t tone = 0; tone + 1 < map.darkness.size(); ++tone) {
        for (size_t level = 0; level < map.level_of_tone[tone].size(); ++level) {
            const Gray8& lighter = map.level_of_tone[tone][level];
            const Gray8& darker = map.level_of_tone[tone + 1][level];
            for (size_t texel = 0; texel < lighter.size(); ++texel) {
                ASSERT_LE(lighter[texel], darker[texel]) << tone << " " << level << " " << texel;
            }
        }
    }
}

/// Samples the centre of every stroke, two samples per texel of the finer level. Most samples that are ink in
/// the coarser level must also be ink in the finer level.
TEST_P(EachTool, KeepsTheStrokesOfALevelInAllFinerOnes)
{
    const Drawn& drawn = EachTool::drawn();
    constexpr size_t steps = 5; // from 256 px to 8
    std::array<size_t, steps> ink{};
    std::array<size_t, steps> kept{};
    for (const PlacedStroke& placed : drawn.strokes) {
        for (size_t level = 0; level < placed.level; ++level) {
            const uint32_t fine_px = drawn.map.size_px >> level;
            const Gray8& fine = drawn.map.level_of_tone[placed.tone][level];
            const Gray8& coarse = drawn.map.level_of_tone[placed.tone][level + 1];
            const int samples = static_cast<int>(2.0F * placed.stroke.length * static_cast<float>(fine_px));
            for (int i = 0; i < samples; ++i) {
                const glm::vec2 place =
                    placed.stroke.point((static_cast<float>(i) + 0.5F) / static_cast<float>(samples));
                const glm::ivec2 texel(glm::floor(place * static_cast<float>(fine_px)));
                const uint32_t x = static_cast<uint32_t>(texel.x) & (fine_px - 1);
                const uint32_t y = static_cast<uint32_t>(texel.y) & (fine_px - 1);
                if (is_ink(coarse[size_t{y / 2} * (fine_px / 2) + x / 2])) {
                    ++ink.at(level);
                    kept.at(level) += is_ink(fine[size_t{y} * fine_px + x]) ? 1 : 0;
                }
            }
        }
    }
    for (size_t level = 0; level < steps; ++level) {
        const double share = static_cast<double>(kept.at(level)) / static_cast<double>(ink.at(level));
        EXPECT_GT(ink.at(level), 100U);
        EXPECT_GE(share, 0.999) << "level " << level << ", of " << ink.at(level);
    }
}

/// Sum of the squared differences of neighbouring columns (or rows), for each pair.
std::vector<double> differences(const Gray8& image, size_t side, bool rows)
{
    std::vector<double> sums(side);
    for (size_t a = 0; a < side; ++a) {
        const size_t b = (a + 1) % side;
        for (size_t i = 0; i < side; ++i) {
            const int here = rows ? image[a * side + i] : image[i * side + a];
            const int next = rows ? image[b * side + i] : image[i * side + b];
            sums[a] += (here - next) * (here - next);
        }
    }
    return sums;
}

TEST_P(EachTool, WrapsWithoutASeam)
{
    const TonalArtMap& map = EachTool::map();
    for (const bool rows : {false, true}) {
        for (const std::vector<Gray8>& levels : map.level_of_tone) {
            const std::vector<double> energy = differences(levels.front(), map.size_px, rows);
            const double count = static_cast<double>(energy.size());
            const double mean = std::accumulate(energy.begin(), energy.end(), 0.0) / count;
            double variance = 0.0;
            for (const double value : energy) {
                variance += (value - mean) * (value - mean) / count;
            }
            EXPECT_LE(std::abs(energy.back() - mean), 4.0 * std::sqrt(variance));
        }
    }
}

TEST(Stroke, MovedOnTheSquareIsTheSameDrawingRolled)
{
    constexpr uint32_t size_px = 64;
    const TamStyle style = small_style();
    const Brush brush(style);
    Stroke stroke{
        .start = {0.5F, 0.25F}, .direction = {0.8F, 0.6F}, .length = 0.375F, .bow = 0.03F, .seed = 7};
    const auto image_of = [&] {
        std::vector<Mark> marks;
        draw_stroke(stroke, {}, brush, {}, size_px, marks);
        std::vector<uint16_t> image(size_t{size_px} * size_px);
        for (const Mark& mark : marks) {
            EXPECT_EQ(image[mark.texel], 0) << "drawn twice";
            image[mark.texel] = mark.ink;
        }
        return image;
    };
    const std::vector<uint16_t> at_home = image_of();
    stroke.start += glm::vec2(0.5F, 0.75F);
    const std::vector<uint16_t> moved = image_of();
    for (uint32_t y = 0; y < size_px; ++y) {
        for (uint32_t x = 0; x < size_px; ++x) {
            const uint32_t to = (y + 48) % size_px * size_px + (x + 32) % size_px;
            ASSERT_NEAR(at_home[y * size_px + x], moved[to], 2) << x << " " << y;
        }
    }
}

/// Mean length of vertical runs of ink in the middle of the lightest tone, whose strokes are horizontal.
double mean_run(const Gray8& image, size_t side)
{
    double ink = 0.0;
    double runs = 0.0;
    for (size_t x = 0; x < side; ++x) {
        for (size_t y = 0; y < side; ++y) {
            ink += image[y * side + x] / 255.0;
            runs +=
                is_ink(image[y * side + x]) && !is_ink(image[(y + side - 1) % side * side + x]) ? 1.0 : 0.0;
        }
    }
    return ink / runs;
}

TEST(Maker, DrawsStrokesAsWideInEveryLevel)
{
    TamStyle style = small_style(Tool::pen, 512);
    style.width_px = 3.0F;
    style.pressure = 0.0F;
    style.tip = 1.0F;
    style.taper_px = 0.0F;
    style.lightest = 0.06F;
    const TonalArtMap map = make_map(style);
    for (size_t level = 0; level < 5; ++level) {
        EXPECT_NEAR(mean_run(map.level_of_tone[0][level], map.size_px >> level), 3.0, 0.35) << level;
    }
}

/// Compares the spread of the mean ink of windows of 32 px with that of random strokes.
TEST(Maker, SpacesStrokesMoreEvenlyTheMoreItTries)
{
    const auto unevenness = [](int candidates) {
        TamStyle style = small_style(Tool::pen, 256);
        style.candidates = candidates;
        const TonalArtMap map = make_map(style);
        const Gray8& image = map.level_of_tone[1][0];
        double variance = 0.0;
        for (size_t window = 0; window < 64; ++window) {
            double sum = 0.0;
            for (size_t y = 0; y < 32; ++y) {
                for (size_t x = 0; x < 32; ++x) {
                    sum += image[(window / 8 * 32 + y) * 256 + window % 8 * 32 + x] / 255.0 / 1024.0;
                }
            }
            variance += (sum - map.darkness[1]) * (sum - map.darkness[1]) / 64.0;
        }
        return std::sqrt(variance);
    };
    EXPECT_LT(unevenness(48), 0.55 * unevenness(1));
}

uint32_t checksum(const TonalArtMap& map)
{
    uint32_t sum = 2166136261U;
    for (const std::vector<Gray8>& levels : map.level_of_tone) {
        for (const Gray8& level : levels) {
            for (const uint8_t texel : level) {
                sum = (sum ^ texel) * 16777619U;
            }
        }
    }
    return sum;
}

/// g++ 12 and clang 14, optimised or not, agree on this checksum; update it when the drawing changes.
TEST(Maker, DrawsTheSameBytesEverywhere)
{
    TamStyle style = small_style(Tool::charcoal, 64);
    const TonalArtMap map = make_map(style);
    EXPECT_EQ(map, make_map(style));
    EXPECT_EQ(checksum(map), 676508491U);
    style.seed = 2;
    EXPECT_NE(map, make_map(style));
}

double share_of(const Gray8& image, int most)
{
    const auto count =
        std::count_if(image.begin(), image.end(), [&](uint8_t texel) { return texel <= most; });
    return static_cast<double>(count) / static_cast<double>(image.size());
}

TEST_P(EachTool, ThresholdsGiveEveryDarkness)
{
    const TonalArtMap& map = EachTool::map();
    const std::vector<Gray8> thresholds = threshold_levels(map);
    ASSERT_EQ(thresholds.size(), 9U);
    for (size_t level = 0; level < 3; ++level) {
        for (int darkness = 26; darkness <= 200; darkness += 6) {
            EXPECT_NEAR(share_of(thresholds[level], darkness), darkness / 255.0, 0.03) << "level " << level;
        }
    }
}

TEST_P(EachTool, ThresholdsKeepTheOrderOfTheTones)
{
    const TonalArtMap& map = EachTool::map();
    const std::vector<Gray8> thresholds = threshold_levels(map);
    for (size_t level = 0; level < 5; ++level) {
        for (const std::vector<Gray8>& levels : map.level_of_tone) {
            int last_ink = 0;
            int first_paper = 255;
            for (size_t texel = 0; texel < levels[level].size(); ++texel) {
                const int threshold = thresholds[level][texel];
                (is_ink(levels[level][texel]) ? last_ink : first_paper) =
                    is_ink(levels[level][texel]) ? std::max(last_ink, threshold)
                                                 : std::min(first_paper, threshold);
            }
            EXPECT_LE(last_ink, first_paper) << "level " << level;
        }
    }
}

TEST(Maker, LaysTheSecondLayerFromItsTone)
{
    std::vector<PlacedStroke> strokes;
    TamStyle style = small_style(Tool::pen, 128);
    style.angle_spread_deg = 5.0F;
    style.second_from = 3;
    style.second_deg = 90.0F;
    style.third_from = 9;
    static_cast<void>(make_map(style, nullptr, &strokes));
    size_t crossing = 0;
    for (const PlacedStroke& placed : strokes) {
        const bool upright = std::abs(placed.stroke.direction.y) > 0.9F;
        EXPECT_TRUE(!upright || placed.tone >= 2);
        crossing += upright ? 1 : 0;
    }
    EXPECT_GT(crossing, 20U);
}

TEST(Maker, DrawsWithThePictureOfAStroke)
{
    Image picture{.width = 64, .height = 8, .rgba = {}};
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool gap = x > 24 && x < 40;
            picture.rgba.insert(picture.rgba.end(), {0, 0, 0, static_cast<uint8_t>(gap ? 0 : 255)});
        }
    }
    TamStyle style = small_style();
    style.width_px = 4.0F;
    const TonalArtMap map = make_map(style, &picture);
    EXPECT_NEAR(mean_coverage(map.level_of_tone[2][0]), map.darkness[2], 0.01);

    std::vector<Mark> marks;
    const Stroke stroke{.start = {0.125F, 0.5F}, .length = 0.75F};
    draw_stroke(stroke, {.width_px = 4.0F, .taper_px = 0.0F, .tip = 1.0F}, Brush(style, &picture), {}, 128,
                marks);
    for (const Mark& mark : marks) {
        const uint32_t x = mark.texel % 128;
        EXPECT_TRUE(x <= 16 + 96 * 26 / 64 || x >= 16 + 96 * 38 / 64) << x;
    }
    picture.rgba.assign(picture.rgba.size(), 255);
    EXPECT_NE(message_of([&] { static_cast<void>(Brush(style, &picture)); }).find("no ink"),
              std::string::npos);
}

TEST(Maker, RefusesWhatCannotBe)
{
    TamStyle style = small_style();
    style.size_px = 100;
    EXPECT_NE(message_of([&] { static_cast<void>(make_map(style)); }).find("not a power of two"),
              std::string::npos);
    style = small_style();
    style.darkest = 0.3F;
    style.lightest = 0.4F;
    EXPECT_NE(message_of([&] { static_cast<void>(make_map(style)); }).find("tam.darkest"), std::string::npos);
}

} // namespace
} // namespace estampe::tam
