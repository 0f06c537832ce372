// SPDX-License-Identifier: MIT
// The background against its equations, direction by direction; its strokes by how much ink they leave.
#include "techniques/sky/sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "frame/view.hpp"
#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::sky {
namespace {

constexpr glm::vec3 horizon(0.9F, 0.7F, 0.3F);
constexpr glm::vec3 zenith(0.1F, 0.3F, 0.5F);

struct SkyPixels {
    std::vector<glm::vec4> wash;
    std::vector<float> ink;
};

struct View {
    Camera camera;
    glm::uvec2 size_px{120, 90};
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    float pixels_per_mm = 3.0F;
    bool drawn = true;
    std::optional<float> daylight_rad = {};

    [[nodiscard]] shared::FrameGlobals globals() const
    {
        return frame::frame_globals(camera, {}, camera.eye, {.size_px = size_px});
    }

    /// Where a place of the page looks.
    [[nodiscard]] glm::dvec3 direction(glm::dvec2 position_px) const
    {
        const glm::dvec2 ndc = 2.0 * position_px / glm::dvec2(size_px) - 1.0;
        const glm::dvec4 p = glm::inverse(glm::dmat4(globals().clip_from_anchor)) * glm::dvec4(ndc, 0.5, 1.0);
        return glm::normalize(glm::dvec3(p) / p.w);
    }
};

SkyPixels paint(const View& view, SkyStyle style)
{
    style.horizon = horizon;
    style.zenith = zenith;
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{view.globals()});
    const auto add = [&](gpu::Graph& graph) {
        return add_sky(graph,
                       {.frame = gpu::import_whole(graph, "frame", frame),
                        .towards_sun = view.towards_sun,
                        .daylight_rad = view.daylight_rad,
                        .pixels_per_mm = view.pixels_per_mm,
                        .drawn = view.drawn,
                        .size_px = view.size_px},
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

/// Shares of the zenith's colour.
double zenith_share(const glm::vec4& wash)
{
    return static_cast<double>((wash.x - horizon.x) / (zenith.x - horizon.x));
}

glm::dvec2 centre_of(size_t i, glm::uvec2 size_px)
{
    const size_t row = i / size_px.x;
    return {static_cast<double>(i % size_px.x) + 0.5, static_cast<double>(row) + 0.5};
}

Camera looking(double elevation_deg, double bearing_deg, double fov_rad)
{
    const double up = elevation_deg * std::numbers::pi / 180.0;
    const double around = bearing_deg * std::numbers::pi / 180.0;
    return {.eye = {3.0, 2.0, 1.0},
            .target = glm::dvec3(3.0, 2.0, 1.0) + glm::dvec3(std::cos(up) * std::sin(around), std::sin(up),
                                                             -std::cos(up) * std::cos(around)),
            .vertical_fov_rad = fov_rad};
}

TEST(Sky, WashGoesFromHorizonToZenithByItsEquation)
{
    const View view{.camera = looking(10.0, 25.0, 1.2)};
    const auto wash = paint(view, {}).wash;
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
    for (const glm::vec4& color : paint({.camera = looking(80.0, 0.0, 0.5)}, {}).wash) {
        EXPECT_NEAR(zenith_share(color), 1.0, 1e-3);
    }
}

TEST(Sky, WashDoesNotDependOnThePicturesSize)
{
    const View small{.camera = looking(20.0, -40.0, 1.0), .size_px = {40, 30}, .pixels_per_mm = 1.0F};
    const View large{.camera = small.camera, .size_px = {120, 90}, .pixels_per_mm = 3.0F};
    const auto few = paint(small, {}).wash;
    const auto many = paint(large, {}).wash;
    for (size_t y = 0; y < 30; ++y) {
        for (size_t x = 0; x < 40; ++x) {
            // The middle one of nine small pixels has the centre of the large one.
            EXPECT_NEAR(zenith_share(few[y * 40 + x]), zenith_share(many[(3 * y + 1) * 120 + 3 * x + 1]),
                        2e-3);
        }
    }
}

TEST(Sky, FollowsTheHourFromNightToNoonWithoutJumps)
{
    const SkyStyle style;
    const auto at = [&](double deg) { return look_at(style, deg * std::numbers::pi / 180.0); };
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
    const auto top = [&] { return glm::vec3(paint(view, style).wash.front()); };
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
    style.width_mm = 0.1F; // thin, so that a picture holds strokes enough for a mean
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
            const auto ink = paint(view, style).ink;
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
    const auto ink = paint(view, style).ink;
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
    const auto ink = paint(view, style).ink;
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

TEST(Sky, NoDarknessIsNoInkAndNoSkyIsOneBlankTexel)
{
    SkyStyle style;
    style.darkness = 0.0F;
    const View view{.camera = looking(40.0, 0.0, 0.9)};
    for (const float ink : paint(view, style).ink) {
        EXPECT_EQ(ink, 0.0F);
    }
    View bare = view;
    bare.drawn = false;
    const auto blank = paint(bare, {});
    EXPECT_EQ(blank.wash, std::vector{glm::vec4(1.0F)});
    EXPECT_EQ(blank.ink, std::vector{0.0F});
}

TEST(Sky, ParallelProjectionGivesOneEvenTone)
{
    View view{.camera = looking(30.0, 10.0, 0.9)};
    view.camera.orthographic_half_height_m = 5.0;
    const auto sky = paint(view, {});
    for (size_t i = 1; i < sky.wash.size(); ++i) {
        EXPECT_EQ(sky.wash[i], sky.wash[0]);
        EXPECT_EQ(sky.ink[i], sky.ink[0]);
    }
    EXPECT_NEAR(zenith_share(sky.wash[0]), smoothstep(0.0, 1.0, std::sqrt(1.9 * 0.5)), 2e-3);
}

} // namespace
} // namespace estampe::sky
