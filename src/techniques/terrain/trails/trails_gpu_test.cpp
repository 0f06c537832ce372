// SPDX-License-Identifier: MIT
// Trails: displaced sand becomes a rim, heights decay by their half-life, and moving the window changes
// nothing.
#include "techniques/terrain/trails/trails.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"

namespace estampe::terrain {
namespace {

constexpr uint32_t trails_side = 128;
constexpr double extent_m = 8.0;
constexpr double texel_m = extent_m / trails_side;

struct Seen {
    std::vector<float> heights_m; ///< heights of the image, row by row
    glm::dvec2 corner_m{0.0};
};

/// A field that is simulated step by step.
class Walked {
public:
    Seen after(uint32_t ticks, glm::dvec2 centre_m = {})
    {
        gpu::Graph graph;
        const TrailImage image = field.add_step(graph, style, ticks, centre_m);
        return {test::run_and_read_as<float>(graph, image.height), image.corner_m};
    }

    [[nodiscard]] std::vector<float> kept()
    {
        gpu::Graph graph;
        return test::run_and_read_as<float>(graph, gpu::import_whole(graph, "trails", field.heights()));
    }

    TrailField field{test::shared_device(), trails_side, extent_m};
    TerrainTrails style;
};

/// Height of a texel of the ground, by its number.
float height_of(const std::vector<float>& kept, glm::ivec2 number)
{
    const int last = static_cast<int>(trails_side) - 1;
    return kept[static_cast<size_t>((number.y & last) * static_cast<int>(trails_side) + (number.x & last))];
}

double sum_of_heights(const std::vector<float>& heights)
{
    return std::accumulate(heights.begin(), heights.end(), 0.0);
}

double depth_sum_of(const std::vector<float>& heights)
{
    return std::accumulate(heights.begin(), heights.end(), 0.0, [](double sum, float height) {
        return sum + std::max(-static_cast<double>(height), 0.0);
    });
}

const std::vector<TrailStamp> stamps{TrailStamp::disc({0.4, -0.7}, 0.3F, 0.05F),
                                     TrailStamp::foot({-1.0, 1.0}, {1.0, 0.4}),
                                     TrailStamp::drag({-2.0, -2.0}, {2.5, -1.1}, 0.2F, 0.08F),
                                     TrailStamp::drag({2.0, -2.4}, {1.0, 2.0}, 0.1F, 0.3F)};

TEST(Trails, TheRimTakesWhatTheSoleGives)
{
    for (const TrailStamp& stamp : stamps) {
        Walked walked;
        walked.field.press({&stamp, 1});
        static_cast<void>(walked.after(0));
        const std::vector<float> kept = walked.kept();
        const double pressed = depth_sum_of(kept);
        EXPECT_GT(pressed * texel_m * texel_m, 0.01 * static_cast<double>(stamp.depth_m));
        EXPECT_NEAR(sum_of_heights(kept) / pressed, 0.0, 1e-4);
        EXPECT_GE(*std::min_element(kept.begin(), kept.end()), -stamp.depth_m);
        EXPECT_GT(*std::max_element(kept.begin(), kept.end()), 0.1F * stamp.depth_m);
    }
    // Stamps in sequence, overlapping each other, with slumping.
    Walked walked;
    walked.style.half_life_s = 1e6F;
    walked.field.press(stamps);
    walked.field.press(stamps);
    static_cast<void>(walked.after(0));
    const double pressed = depth_sum_of(walked.kept());
    static_cast<void>(walked.after(40));
    EXPECT_NEAR(sum_of_heights(walked.kept()) / pressed, 0.0, 1e-3);
    EXPECT_LT(depth_sum_of(walked.kept()), 0.9 * pressed) << "the drag of 30 cm slumps";
}

TEST(Trails, ADiscIsItsDepthWithinAndARimWithout)
{
    Walked walked;
    const TrailStamp disc = TrailStamp::disc({0.5 * texel_m, 0.5 * texel_m}, 0.5F, 0.04F);
    walked.field.press({&disc, 1});
    static_cast<void>(walked.after(0));
    const std::vector<float> kept = walked.kept();
    for (int x = 0; x < 20; ++x) {
        const float height = height_of(kept, {x, 0});
        const double distance_m = x * texel_m;
        if (distance_m < 0.45) {
            EXPECT_EQ(height, -0.04F) << x;
        } else if (distance_m > 0.51 && distance_m < 0.55) {
            EXPECT_GT(height, 0.01F) << x;
        } else if (distance_m > 0.65) {
            EXPECT_EQ(height, 0.0F) << x;
        }
        for (const glm::ivec2 turned : {glm::ivec2(-x, 0), glm::ivec2(0, x), glm::ivec2(0, -x)}) {
            EXPECT_NEAR(height_of(kept, turned), height, 1e-6F);
        }
    }
    // A second press at the same place goes no deeper.
    walked.field.press({&disc, 1});
    static_cast<void>(walked.after(0));
    EXPECT_EQ(height_of(walked.kept(), {0, 0}), -0.04F);
    EXPECT_NEAR(sum_of_heights(walked.kept()) / depth_sum_of(walked.kept()), 0.0, 1e-4);
}

TEST(Trails, HalfIsLeftAfterTheHalfLifeHoweverTimeIsSplit)
{
    Walked once;
    Walked often;
    for (Walked* walked : {&once, &often}) {
        walked->style = {.half_life_s = 5.0F};
        walked->field.press(stamps);
        static_cast<void>(walked->after(40)); // until slumping has ended
    }
    const std::vector<float> before = once.kept();
    ASSERT_EQ(before, often.kept());
    static_cast<void>(once.after(600));
    for (const uint32_t ticks : {1U, 2U, 5U, 120U, 3U, 469U}) {
        static_cast<void>(often.after(ticks));
    }
    const std::vector<float> after = once.kept();
    EXPECT_EQ(after, often.kept());
    for (size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(after[i], 0.5F * before[i], 0.5F * 0.02F * std::abs(before[i]) + 2e-6F) << i;
    }
    EXPECT_LT(depth_sum_of(after), 0.51 * depth_sum_of(before));
    static_cast<void>(once.after(120 * 3600));
    EXPECT_EQ(depth_sum_of(once.kept()), 0.0);
}

TEST(Trails, TheWindowMovesNothing)
{
    Walked walked;
    walked.field.press(stamps);
    static_cast<void>(walked.after(60));
    glm::ivec2 centre(0);
    const int half = static_cast<int>(trails_side) / 2;
    for (const glm::ivec2 step :
         {glm::ivec2(1, 0), glm::ivec2(-3, 7), glm::ivec2(20, -31), glm::ivec2(-40, 40), glm::ivec2(63, 63),
          glm::ivec2(-5, -100), glm::ivec2(0, 1000)}) {
        const std::vector<float> before = walked.kept();
        const glm::ivec2 last_centre = centre;
        centre += step;
        const Seen seen = walked.after(0, texel_m * (glm::dvec2(centre) + 0.3));
        const std::vector<float> after = walked.kept();
        EXPECT_EQ(seen.corner_m, texel_m * glm::dvec2(centre - half));
        for (int y = -half; y < half; ++y) {
            for (int x = -half; x < half; ++x) {
                const glm::ivec2 number = centre + glm::ivec2(x, y);
                const glm::ivec2 from_last = number - last_centre;
                const bool is_kept =
                    std::min(from_last.x, from_last.y) >= -half && std::max(from_last.x, from_last.y) < half;
                const bool was_level = glm::length(glm::dvec2(number)) * texel_m > 4.5;
                ASSERT_TRUE(is_kept ? height_of(after, number) == height_of(before, number)
                                    : height_of(after, number) == 0.0F || !was_level);
                const bool is_faded = std::max(std::max(x, -1 - x), std::max(y, -1 - y)) >= half - 9;
                const float shown = seen.heights_m[static_cast<size_t>((y + half) * 2 * half + x + half)];
                ASSERT_TRUE(is_faded || shown == height_of(after, number));
            }
        }
    }
    EXPECT_EQ(depth_sum_of(walked.kept()), 0.0);
}

/// Texels that newly enter the window, one by one or all at once, show the known stamps. Their depth is the
/// depth that the wind has left by then.
TEST(Trails, WhatWasPressedInIsRemembered)
{
    constexpr double far_m = 20.0;
    constexpr float age_s = 30.0F;
    Walked slowly;
    Walked at_once;
    for (Walked* walked : {&slowly, &at_once}) {
        walked->style.half_life_s = age_s;
        static_cast<void>(walked->after(0, {far_m, 0.0}));
        for (const TrailStamp& stamp : stamps) {
            walked->field.remember(stamp, static_cast<double>(age_s));
        }
    }
    for (double x_m = far_m; x_m >= 0.0; x_m -= texel_m) {
        static_cast<void>(slowly.after(0, {x_m, 0.0}));
    }
    static_cast<void>(at_once.after(0, {0.0, 0.0}));
    const std::vector<float> kept = at_once.kept();
    EXPECT_EQ(slowly.kept(), kept);
    EXPECT_EQ(height_of(kept, glm::ivec2(glm::floor(stamps[0].from_m / texel_m))), -0.025F);
    EXPECT_NEAR(sum_of_heights(kept) / depth_sum_of(kept), 0.0, 0.05);
    // Footprints are still there after the window moves away and back.
    Walked away;
    away.style.half_life_s = 1e6F;
    away.field.press({stamps.data(), 1});
    static_cast<void>(away.after(0));
    const double pressed = depth_sum_of(away.kept());
    static_cast<void>(away.after(0, {far_m, 0.0}));
    EXPECT_EQ(depth_sum_of(away.kept()), 0.0);
    static_cast<void>(away.after(0));
    EXPECT_NEAR(depth_sum_of(away.kept()), pressed, 0.1 * pressed);
    // After a pause, stamps have their correct age.
    away.style.half_life_s = 10.0F;
    away.field.pass(1200);
    static_cast<void>(away.after(0));
    EXPECT_NEAR(depth_sum_of(away.kept()), 0.5 * pressed, 0.1 * pressed);
}

/// Heights around a place after stamps there, with steps between, in a window around another place.
std::vector<float> pressed_at(glm::ivec2 texel, glm::ivec2 centre)
{
    Walked walked;
    walked.style.half_life_s = 20.0F;
    const glm::dvec2 place = texel_m * glm::dvec2(texel);
    for (const double aside : {0.0, 0.21}) {
        const std::vector<TrailStamp> here{
            TrailStamp::disc(place + aside, 0.33F, 0.12F),
            TrailStamp::drag(place - 0.7, place + glm::dvec2(0.6, aside), 0.15F, 0.2F)};
        walked.field.press(here);
        static_cast<void>(walked.after(24, texel_m * glm::dvec2(centre)));
    }
    std::vector<float> about;
    const std::vector<float> kept = walked.kept();
    for (int i = 0; i < 40 * 40; ++i) {
        about.push_back(height_of(kept, texel + glm::ivec2(i % 40 - 20, i / 40 - 20)));
    }
    return about;
}

TEST(Trails, WhereTexelsWrapThereIsNoSeam)
{
    const std::vector<float> expected = pressed_at({32, 32}, {32, 32});
    EXPECT_GT(depth_sum_of(expected), 1.0);
    // Tests the middle, the edge and the corner of the stored texels, with the window around these places or
    // beside them.
    for (const auto& [texel, centre] :
         {std::pair(glm::ivec2(32, 32), glm::ivec2(50, 18)),
          std::pair(glm::ivec2(128, 32), glm::ivec2(128, 32)), std::pair(glm::ivec2(0, 0), glm::ivec2(0, 0)),
          std::pair(glm::ivec2(0, 128), glm::ivec2(-31, 141))}) {
        ASSERT_EQ(pressed_at(texel, centre), expected) << texel.x << " " << texel.y;
    }
}

TEST(Trails, TheSameFarFromTheOrigin)
{
    // At a distance of a whole number of texels, places differ only in the last bits of a double.
    const int far = 1 << 24;
    const std::vector<float> expected = pressed_at({32, 32}, {32, 32});
    const std::vector<float> there = pressed_at({far + 32, 32 - far}, {far + 32, 32 - far});
    for (size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(there[i], expected[i], 1e-6F);
    }
}

TEST(Trails, TheImageIsLevelAtItsEdge)
{
    Walked walked;
    const TrailStamp across = TrailStamp::drag({-5.0, 3.9}, {5.0, 3.9}, 0.3F, 0.1F);
    walked.field.press({&across, 1});
    const Seen seen = walked.after(0);
    EXPECT_GT(depth_sum_of(walked.kept()), 1.0);
    for (uint32_t i = 0; i < trails_side; ++i) {
        EXPECT_EQ(seen.heights_m[i], 0.0F);
        EXPECT_EQ(seen.heights_m[(trails_side - 1) * trails_side + i], 0.0F);
        EXPECT_EQ(seen.heights_m[i * trails_side], 0.0F);
        EXPECT_EQ(seen.heights_m[i * trails_side + trails_side - 1], 0.0F);
    }
}

TEST(Trails, WhatCannotBePressedIsLeftOut)
{
    Walked walked;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<TrailStamp> bad{
        TrailStamp::disc({nan, 0.0}, 0.3F, 0.1F),
        TrailStamp::disc({0.0, std::numeric_limits<double>::infinity()}, 0.3F, 0.1F),
        TrailStamp::disc({0.0, 0.0}, -0.3F, 0.1F),
        TrailStamp::disc({0.0, 0.0}, 0.3F, std::numeric_limits<float>::quiet_NaN()),
        TrailStamp::disc({1e15, 0.0}, 0.3F, 0.1F),
        TrailStamp::disc({1e9, 40.0}, 0.3F, 0.1F),
        TrailStamp::drag({-1e6, 0.0}, {1e6, 0.0}, 0.3F, 0.1F)};
    walked.field.press(bad);
    static_cast<void>(walked.after(8));
    EXPECT_EQ(depth_sum_of(walked.kept()), 0.0);
    const glm::dvec2 corner_m = walked.after(0, {1.0, 2.0}).corner_m;
    EXPECT_EQ(walked.after(0, {nan, 2.0}).corner_m, corner_m);
    // Stamps beyond a graph's limit wait for the next graph.
    const std::vector<TrailStamp> many(TrailField::most_presses(), TrailStamp::disc({0.0, 0.0}, 0.3F, 0.1F));
    const TrailStamp last = TrailStamp::disc({2.0, 2.0}, 0.3F, 0.1F);
    walked.field.press(many);
    walked.field.press({&last, 1});
    static_cast<void>(walked.after(0));
    const glm::ivec2 there(32, 32);
    EXPECT_EQ(height_of(walked.kept(), there), 0.0F);
    static_cast<void>(walked.after(0));
    EXPECT_EQ(height_of(walked.kept(), there), -0.1F);
    for (const uint32_t wrong : {0U, 8U, 100U, 2048U}) {
        EXPECT_THROW(TrailField(test::shared_device(), wrong), std::logic_error) << wrong;
    }
    EXPECT_THROW(TrailField(test::shared_device(), 64, nan), std::logic_error);
}

} // namespace
} // namespace estampe::terrain
