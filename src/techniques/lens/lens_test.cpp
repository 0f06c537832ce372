// SPDX-License-Identifier: MIT
#include "techniques/lens/lens.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace estampe::lens {
namespace {

TEST(Lens, MakesTheCirclesOfAThinLens)
{
    constexpr double without_end = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(circle_mm(50.0, 2.8, 2.0, 1.0), 0.4579, 5e-5);
    EXPECT_NEAR(circle_mm(50.0, 2.8, 2.0, 1.5), 0.1526, 5e-5);
    EXPECT_NEAR(circle_mm(50.0, 2.8, 2.0, 3.0), 0.1526, 5e-5);
    EXPECT_NEAR(circle_mm(50.0, 2.8, 2.0, 10.0), 0.3663, 5e-5);
    EXPECT_NEAR(circle_mm(50.0, 2.8, 2.0, without_end), 0.4579, 5e-5);
    EXPECT_EQ(circle_mm(50.0, 2.8, 2.0, 2.0), 0.0);
}

TEST(Lens, MakesTheSameCirclesOnThePage)
{
    // The sensor is at the distance where the lens projects the plane in focus.
    const LensStyle style{
        .enabled = true, .mode = Mode::gather, .focal_mm = 85.0F, .f_number = 1.8F, .largest_mm = 60.0F};
    constexpr double focus_m = 3.0;
    constexpr double fov_rad = 0.5;
    constexpr double height_px = 720.0;
    constexpr double near_m = 0.1;
    const double image_mm = 1.0 / (1.0 / 85.0 - 1.0 / (1e3 * focus_m));
    const double sensor_mm = 2.0 * image_mm * std::tan(0.5 * fov_rad);
    const auto lens = lens_on(style, {.focus_m = focus_m,
                                      .near_m = near_m,
                                      .pixel_at_one_m = 2.0 * std::tan(0.5 * fov_rad) / height_px,
                                      .pixels_per_mm = 4.8F});
    ASSERT_TRUE(lens.has_value());
    for (const double away_m : {0.8, 2.0, 2.9, 3.0, 4.0, 20.0, 1e9}) {
        const double radius_px = static_cast<double>(lens->radius_px) -
                                 static_cast<double>(lens->radius_per_depth) * near_m / away_m;
        const double circle_px =
            circle_mm(85.0, static_cast<double>(style.f_number), focus_m, away_m) / sensor_mm * height_px;
        EXPECT_NEAR(std::abs(radius_px), 0.5 * circle_px, 2e-4 * circle_px + 1e-4) << away_m;
        EXPECT_EQ(radius_px < -1e-4, away_m < focus_m) << away_m;
    }
}

TEST(Lens, IsNoneWhereTheStyleHasNone)
{
    EXPECT_FALSE(lens_on({}, {}).has_value());
    EXPECT_EQ(reach_px({}, 10.0F), 0U);
    EXPECT_GE(reach_px({.enabled = true, .mode = Mode::gather, .largest_mm = 8.0F}, 10.0F), 80U);
}

} // namespace
} // namespace estampe::lens
