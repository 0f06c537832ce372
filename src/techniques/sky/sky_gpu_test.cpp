// SPDX-License-Identifier: MIT
// Compares the sky with its equations, direction by direction. Tests the strokes by their mean ink.
#include "techniques/sky/sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/sky/sky_test_support.hpp"

namespace estampe::sky {
namespace {

constexpr glm::vec3 horizon(0.9F, 0.7F, 0.3F);
constexpr glm::vec3 zenith(0.1F, 0.3F, 0.5F);

struct SkyPixels {
    std::vector<glm::vec4> wash;
    std::vector<float> ink;
};

SkyPixels paint_sky(const View& view, SkyStyle style, std::optional<float> to_things_px = {})
{
    style.horizon = horizon;
    style.zenith = zenith;
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{view.globals()});
    auto depth = test::Layer::depth(view.size_px, [&](glm::uvec2 pixel) { return view.depth_at(pixel); });
    auto halo = test::Layer::coverage((view.size_px + 6U) / 4U,
                                      [&](glm::uvec2) { return to_things_px.value_or(0.0F); });
    const auto add = [&](gpu::Graph& graph) {
        return add_sky(graph,
                       {.frame = gpu::import_whole(graph, "frame", frame),
                        .depth = depth.in(graph),
                        .towards_sun = view.towards_sun,
                        .daylight_rad = view.daylight_rad,
                        .pixels_per_mm = view.pixels_per_mm,
                        .drawn = view.drawn,
                        .halo = to_things_px ? std::optional(halo.in(graph)) : std::nullopt,
                        .size_px = view.size_px,
                        .far_m = view.far_m},
                       style);
    };
    gpu::Graph for_wash;
    gpu::Graph for_ink;
    return {test::run_and_read_colors(for_wash, add(for_wash).wash),
            test::run_and_read_coverage(for_ink, add(for_ink).ink)};
}

double smoothstep(double low, double high, double x)
{
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Share of the zenith's colour in the sky's wash.
double zenith_share(const glm::vec4& wash)
{
    return static_cast<double>((wash.x - horizon.x) / (zenith.x - horizon.x));
}

TEST(Sky, IsBlankBehindWhatIsNear)
{
    View view{.camera = looking(20.0, 25.0, 1.2)};
    const SkyPixels all = paint_sky(view, {});
    view.far_m = 100.0F;
    const SkyPixels seen = paint_sky(view, {});
    for (size_t i = 0; i < all.wash.size(); ++i) {
        EXPECT_EQ(seen.wash[i], view.is_covered(i) ? glm::vec4(1.0F) : all.wash[i]) << i;
        EXPECT_EQ(seen.ink[i], view.is_covered(i) ? 0.0F : all.ink[i]) << i;
    }
}

TEST(Sky, WashGoesFromHorizonToZenithByItsEquation)
{
    const View view{.camera = looking(10.0, 25.0, 1.2)};
    const auto wash = paint_sky(view, {}).wash;
    size_t below = 0;
    for (size_t i = 0; i < wash.size(); ++i) {
        const glm::dvec3 d = view.direction(centre_of(i, view.size_px));
        const double height = std::clamp(1.9 * d.y, 0.0, 1.0);
        EXPECT_NEAR(zenith_share(wash[i]), smoothstep(0.0, 1.0, std::sqrt(height)), 2e-3);
        EXPECT_EQ(wash[i].w, 1.0F);
        below += height == 0.0 ? 1 : 0;
    }
    EXPECT_GT(below, 1000U);
    for (uint32_t x = 0; x < 120; ++x) {
        for (uint32_t y = 1; y < 90; ++y) {
            EXPECT_LE(zenith_share(wash[y * 120 + x]), zenith_share(wash[(y - 1) * 120 + x]) + 1e-6)
                << "never back towards the horizon on the way up";
        }
    }
    for (const glm::vec4& color : paint_sky({.camera = looking(80.0, 0.0, 0.5)}, {}).wash) {
        EXPECT_NEAR(zenith_share(color), 1.0, 1e-3);
    }
}

TEST(Sky, WashDoesNotDependOnThePicturesSize)
{
    const View small{.camera = looking(20.0, -40.0, 1.0), .size_px = {40, 30}, .pixels_per_mm = 1.0F};
    const View large{.camera = small.camera, .size_px = {120, 90}, .pixels_per_mm = 3.0F};
    const auto few = paint_sky(small, {}).wash;
    const auto many = paint_sky(large, {}).wash;
    for (size_t y = 0; y < 30; ++y) {
        for (size_t x = 0; x < 40; ++x) {
            // The middle one of nine small pixels has the same centre as the large pixel.
            EXPECT_NEAR(zenith_share(few[y * 40 + x]), zenith_share(many[(3 * y + 1) * 120 + 3 * x + 1]),
                        2e-3);
        }
    }
}

TEST(Sky, FollowsTheHourFromNightToNoonWithoutJumps)
{
    const SkyStyle style;
    const auto at = [&](double deg) { return colors_at(style, deg * std::numbers::pi / 180.0); };
    EXPECT_EQ(at(-30.0).zenith, style.night_zenith);
    EXPECT_EQ(at(-10.0).horizon, style.night_horizon);
    EXPECT_EQ(at(-30.0).darkness, style.night_darkness);
    EXPECT_EQ(at(-2.0).horizon, style.dusk_horizon);
    EXPECT_EQ(at(8.0).horizon, style.horizon);
    EXPECT_EQ(at(8.0).zenith, style.zenith);
    EXPECT_EQ(at(8.0).darkness, style.darkness);
    EXPECT_EQ(at(60.0).zenith, style.noon_zenith);
    for (double deg = -20.0; deg < 60.0; deg += 0.1) {
        EXPECT_LT(glm::distance(at(deg).horizon, at(deg + 0.1).horizon), 0.03F) << deg;
        EXPECT_LT(glm::distance(at(deg).zenith, at(deg + 0.1).zenith), 0.03F) << deg;
    }
}

TEST(Sky, KeepsItsColoursUnlessTheSunStandsByTheHour)
{
    View view{.camera = looking(80.0, 0.0, 0.5), .size_px = {24, 16}};
    SkyStyle style;
    style.noon_zenith = {0.4F, 0.4F, 0.4F};
    style.night_zenith = {0.0F, 0.0F, 0.1F};
    const auto top = [&] { return glm::vec3(paint_sky(view, style).wash.front()); };
    const auto is = [](const glm::vec3& a, const glm::vec3& b) { return glm::distance(a, b) < 2e-3F; };
    EXPECT_TRUE(is(top(), zenith)) << "by direction";
    view.daylight_rad = 1.0F;
    EXPECT_TRUE(is(top(), style.noon_zenith));
    view.daylight_rad = -1.0F;
    EXPECT_TRUE(is(top(), style.night_zenith));
    style.follow = SkyFollow::none;
    EXPECT_TRUE(is(top(), zenith));
    style.follow = SkyFollow::sun;
    view.daylight_rad.reset(); // the sun overhead
    EXPECT_TRUE(is(top(), style.noon_zenith));
}

TEST(Sky, StrokesHaveTheDarknessOfTheirPlace)
{
    SkyStyle style;
    style.darkness = 0.6F;
    style.width_mm = 0.1F; // thin, so that a picture has enough strokes for a mean
    constexpr glm::uvec2 size_px(384, 288);
    for (const double sun_away_deg : {0.0, 90.0, 180.0}) {
        double asked = 0.0;
        double drawn = 0.0;
        double count = 0.0;
        for (double bearing_deg = 5.0; bearing_deg < 360.0; bearing_deg += 60.0) {
            const Camera sun = looking(0.0, bearing_deg + sun_away_deg, 1.0);
            const glm::dvec3 sunwards = sun.target - sun.eye;
            const View view{.camera = looking(24.0, bearing_deg, 0.9),
                            .size_px = size_px,
                            .towards_sun = glm::vec3(sunwards) + glm::vec3(0.0F, 0.7F, 0.0F),
                            .pixels_per_mm = 8.0F};
            const auto ink = paint_sky(view, style).ink;
            for (size_t i = 0; i < ink.size(); ++i) {
                const glm::dvec3 d = view.direction(centre_of(i, size_px));
                const double height = std::clamp(1.9 * d.y, 0.0, 1.0);
                const double towards =
                    0.5 + 0.5 * glm::dot(glm::normalize(glm::dvec3(d.x, 0.0, d.z)), sunwards);
                asked += 0.6 * smoothstep(0.04, 0.55, height) * (1.0 - 0.75 * towards);
                drawn += static_cast<double>(ink[i]);
                count += 1.0;
                EXPECT_GE(ink[i], 0.0F);
                EXPECT_LE(ink[i], 1.0F);
            }
        }
        EXPECT_NEAR(drawn / count, asked / count, 0.02) << "sun " << sun_away_deg << " degrees aside";
        EXPECT_GT(drawn / count, 0.05);
    }
}

TEST(Sky, StrokesLieLevelAndHaveTheirWidth)
{
    SkyStyle style;
    style.darkness = 0.25F;
    style.width_mm = 0.5F;
    const View view{.camera = looking(20.0, 0.0, 0.3),
                    .size_px = {200, 200},
                    .towards_sun = {0.0F, 0.0F, 1.0F},
                    .pixels_per_mm = 8.0F};
    const auto ink = paint_sky(view, style).ink;
    const auto at = [&](size_t x, size_t y) { return static_cast<double>(ink[y * 200 + x]); };
    double along = 0.0;
    double across = 0.0;
    double widest = 0.0;
    for (size_t x = 1; x < 200; ++x) {
        double run = 0.0;
        for (size_t y = 1; y < 200; ++y) {
            along += std::abs(at(x, y) - at(x - 1, y));
            across += std::abs(at(x, y) - at(x, y - 1));
            run = at(x, y) > 0.0 ? run + at(x, y) : 0.0;
            widest = std::max(widest, run);
        }
    }
    EXPECT_GT(across, 3.0 * along);
    EXPECT_GT(widest, 4.0) << "0.5 mm at 8 pixels a millimetre";
    EXPECT_LT(widest, 4.0 * 1.35 + 0.5) << "and no wider than pressure makes it";
}

TEST(Sky, StrokesHaveNoSeamBehind)
{
    SkyStyle style;
    style.darkness = 0.5F;
    style.width_mm = 0.5F;
    const View view{.camera = looking(20.0, 180.0, 0.5),
                    .size_px = {200, 200},
                    .towards_sun = {0.0F, 0.0F, -1.0F},
                    .pixels_per_mm = 8.0F};
    const auto ink = paint_sky(view, style).ink;
    const auto step = [&](size_t x) {
        double sum = 0.0;
        for (size_t y = 0; y < 200; ++y) {
            sum += std::abs(static_cast<double>(ink[y * 200 + x] - ink[y * 200 + x - 1]));
        }
        return sum;
    };
    double largest = 0.0;
    for (size_t x = 1; x < 200; ++x) {
        largest = x == 100 ? largest : std::max(largest, step(x));
    }
    EXPECT_LE(step(100), largest) << "between two pixels that look due south";
}

TEST(Sky, DiscStandsWhereTheSunDoesAndIsAsWide)
{
    SkyStyle style;
    style.disc_deg = 6.0F;
    style.sun_color = {1.0F, 0.0F, 0.0F};
    style.moon_color = {0.0F, 1.0F, 0.0F};
    style.follow = SkyFollow::none;
    View view{.camera = looking(22.0, 40.0, 0.5), .size_px = {160, 120}};
    const auto cover = [&](const glm::vec4& color, const glm::vec3& disc) {
        const float share =
            glm::dot(glm::vec3(color) - horizon, disc - horizon) / glm::dot(disc - horizon, disc - horizon);
        // Ignores differences that rounding to half floats leaves.
        return share > 0.01F ? static_cast<double>(share) : 0.0;
    };
    const auto expect_disc = [&](const glm::dvec3& towards, const glm::vec3& color, double lit) {
        style.low_band = horizon; // a background of one colour
        style.low_band_deg = 90.0F;
        double solid_angle = 0.0;
        glm::dvec3 sum(0.0);
        const auto wash = paint_sky(view, style).wash;
        for (size_t i = 0; i < wash.size(); ++i) {
            const glm::dvec2 px = centre_of(i, view.size_px);
            const glm::dvec3 d = view.direction(px);
            const double pixel = glm::length(glm::cross(view.direction(px + glm::dvec2(1.0, 0.0)) - d,
                                                        view.direction(px + glm::dvec2(0.0, 1.0)) - d));
            solid_angle += cover(wash[i], color) * pixel;
            sum += cover(wash[i], color) * pixel * d;
        }
        const double radius = 3.0 * std::numbers::pi / 180.0;
        const double disc = 2.0 * std::numbers::pi * (1.0 - std::cos(radius));
        EXPECT_NEAR(solid_angle, lit * disc, 0.02 * disc);
        if (lit == 1.0) {
            EXPECT_LT(glm::distance(glm::normalize(sum), towards), 0.02 * radius);
        }
    };
    const glm::dvec3 ahead = glm::normalize(looking(18.0, 46.0, 0.5).target - view.camera.eye);
    view.towards_sun = glm::vec3(ahead);
    expect_disc(ahead, style.sun_color, 1.0);
    view.towards_sun = glm::vec3(glm::normalize(glm::dvec3(ahead.x, 0.1, ahead.z)));
    view.daylight_rad = static_cast<float>(std::asin(ahead.y)); // the light may come from another direction
    expect_disc(ahead, style.sun_color, 1.0);
    view.daylight_rad = -*view.daylight_rad; // the sun has set, opposite the moon
    view.towards_sun = glm::vec3(-ahead.x, 0.05F, -ahead.z);
    expect_disc(ahead, style.moon_color, 1.0);
    style.moon_lit = 0.3F;
    expect_disc(ahead, style.moon_color, 0.3);
}

TEST(Sky, NothingOfADiscIsUnderTheHorizon)
{
    SkyStyle style;
    style.disc_deg = 20.0F;
    style.sun_color = {1.0F, 0.0F, 0.0F};
    View view{.camera = looking(0.0, 0.0, 0.6), .size_px = {60, 60}, .towards_sun = {0.0F, 0.0F, -1.0F}};
    const auto wash = paint_sky(view, style).wash;
    EXPECT_EQ(glm::vec3(wash[27 * 60 + 30]), style.sun_color);
    EXPECT_NEAR(wash[32 * 60 + 30].y, horizon.y, 1e-3F);
}

TEST(Sky, BandsAreWipedInFromAboveAndBelow)
{
    SkyStyle style;
    const View view{.camera = looking(30.0, 25.0, 1.2)};
    const auto plain = paint_sky(view, style).wash;
    style.high_band = {0.0F, 1.0F, 0.0F};
    style.high_band_deg = 40.0F;
    style.low_band = {1.0F, 0.0F, 0.0F};
    style.low_band_deg = 5.0F;
    const auto banded = paint_sky(view, style).wash;
    for (size_t i = 0; i < banded.size(); ++i) {
        const double deg = std::asin(view.direction(centre_of(i, view.size_px)).y) * 180.0 / std::numbers::pi;
        if (deg > 52.5) {
            EXPECT_EQ(glm::vec3(banded[i]), style.high_band);
        } else if (deg > 8.5 && deg < 27.5) {
            EXPECT_EQ(banded[i], plain[i]);
        } else if (deg < 1.5) {
            EXPECT_EQ(glm::vec3(banded[i]), style.low_band);
        }
    }
    style = {};
    style.steps = 3;
    std::vector<float> shares;
    for (const glm::vec4& color : paint_sky(view, style).wash) {
        shares.push_back(static_cast<float>(zenith_share(color)));
    }
    const auto flat = [&](float share) {
        return std::ranges::count_if(shares, [&](float x) { return std::abs(x - share) < 2e-3F; });
    };
    EXPECT_GT(flat(0.0F) + flat(0.5F) + flat(1.0F),
              static_cast<int>(0.6 * static_cast<double>(shares.size())));
    EXPECT_GT(flat(0.5F), 500);
}

TEST(Sky, StrokesThinOutAroundThings)
{
    SkyStyle style;
    style.darkness = 0.6F;
    style.halo_mm = 4.0F;
    const View view{.camera = looking(50.0, 0.0, 0.9), .pixels_per_mm = 3.0F};
    const auto mean = [&](const std::vector<float>& ink) {
        return std::accumulate(ink.begin(), ink.end(), 0.0) / static_cast<double>(ink.size());
    };
    const double open = mean(paint_sky(view, style).ink);
    ASSERT_GT(open, 0.2);
    EXPECT_EQ(mean(paint_sky(view, style, 0.0F).ink), 0.0);
    EXPECT_NEAR(mean(paint_sky(view, style, 6.0F).ink), 0.5 * open, 0.02); // half of 12 px
    EXPECT_EQ(mean(paint_sky(view, style, 12.0F).ink), open);
    style.halo_mm = 0.0F;
    EXPECT_EQ(mean(paint_sky(view, style, 0.0F).ink), open);
}

TEST(Sky, NoDarknessIsNoInkAndNoSkyIsOneBlankTexel)
{
    SkyStyle style;
    style.darkness = 0.0F;
    const View view{.camera = looking(40.0, 0.0, 0.9)};
    for (const float ink : paint_sky(view, style).ink) {
        EXPECT_EQ(ink, 0.0F);
    }
    View bare = view;
    bare.drawn = false;
    const auto blank = paint_sky(bare, {});
    EXPECT_EQ(blank.wash, std::vector{glm::vec4(1.0F)});
    EXPECT_EQ(blank.ink, std::vector{0.0F});
}

TEST(Sky, ParallelProjectionGivesOneEvenTone)
{
    View view{.camera = looking(30.0, 10.0, 0.9)};
    view.camera.orthographic_half_height_m = 5.0;
    const auto sky = paint_sky(view, {});
    for (size_t i = 1; i < sky.wash.size(); ++i) {
        EXPECT_EQ(sky.wash[i], sky.wash[0]);
        EXPECT_EQ(sky.ink[i], sky.ink[0]);
    }
    EXPECT_NEAR(zenith_share(sky.wash[0]), smoothstep(0.0, 1.0, std::sqrt(1.9 * 0.5)), 2e-3);
}

} // namespace
} // namespace estampe::sky
