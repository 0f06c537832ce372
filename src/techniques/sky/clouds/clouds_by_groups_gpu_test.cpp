// SPDX-License-Identifier: MIT
// Clouds whose puffs a workgroup finds together, as on GPUs, against clouds whose puffs each pixel finds
// alone.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "techniques/sky/clouds/clouds_test_support.hpp"

namespace estampe::sky {
namespace {

/// Share of pixels with a visible difference.
double apart(const std::vector<float>& a, const std::vector<float>& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        count += std::abs(a[i] - b[i]) > 4e-3F ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(a.size());
}

double most_apart(const std::vector<float>& a, const std::vector<float>& b)
{
    double most = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    }
    return most;
}

void expect_alike(const View& view, const CloudStyle& style, const std::string& name)
{
    SCOPED_TRACE(name);
    const Painted by_pixels = paint(view, style, 30.0, {.keeps_cover = true});
    const Painted by_groups = paint(view, style, 30.0, {.by_groups = true, .keeps_cover = true});
    // Where outlines or bulges cross, the first puff found is drawn, and the two methods find puffs in
    // different orders.
    EXPECT_LT(apart(by_pixels.white, by_groups.white), 5e-4);
    EXPECT_LT(apart(by_pixels.cover, by_groups.cover), 5e-4);
    EXPECT_LT(most_apart(by_pixels.cover, by_groups.cover), 0.03) << "a puff is missed";
    EXPECT_LT(apart(by_pixels.ink, by_groups.ink), 2e-3);
    EXPECT_GT(mean(by_pixels.white), 0.05);
    EXPECT_GT(mean(by_pixels.ink), 0.002);
}

TEST(CloudsByGroups, AreThoseByPixels)
{
    const CloudStyle heaps{.coverage = 0.3F, .tones = 3, .outline_mm = 0.5F};
    CloudStyle all = heaps;
    all.flocks = 0.3F;
    all.streaks = 0.2F;
    CloudStyle hatched = all;
    hatched.hatch = 0.5F;
    const glm::vec3 low_sun = glm::normalize(glm::vec3(0.8F, 0.08F, -0.6F));
    const View odd{.camera = looking(12.0, 33.0, 0.7), .size_px = {173, 101}, .towards_sun = low_sun};
    expect_alike(odd, heaps, "heaps under a low sun, of a page that no tiles fill");
    expect_alike({.camera = looking(5.0, 0.0, 0.5), .size_px = {256, 144}, .towards_sun = low_sun}, all,
                 "the horizon, along an axis");
    expect_alike({.camera = looking(6.0, 225.0, 0.3), .size_px = {256, 144}, .towards_sun = low_sun}, hatched,
                 "the horizon, between axes");
    expect_alike({.camera = looking(89.0, 10.0, 1.6), .size_px = {128, 128}}, all, "up");
    expect_alike({.camera = looking(50.0, 140.0, 2.4), .size_px = {40, 24}}, all, "few pixels, far apart");
    CloudStyle full = heaps;
    full.coverage = 0.8F;
    expect_alike({.camera = looking(20.0, 60.0, 0.7), .size_px = {256, 144}}, full, "a sky full of them");
    View hidden = odd;
    hidden.far_m = 100.0F;
    expect_alike(hidden, all, "behind a wall");
}

} // namespace
} // namespace estampe::sky
