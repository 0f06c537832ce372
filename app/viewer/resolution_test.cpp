// SPDX-License-Identifier: MIT
#include "viewer/studio.hpp"

#include <gtest/gtest.h>

namespace estampe::viewer {
namespace {

/// Draws until the scale is stable, with a device that takes `whole_s` for all pixels plus `fixed_s` per
/// picture.
double settle(Resolution& resolution, double whole_s, double fixed_s)
{
    for (int i = 0; i < 60; ++i) {
        const double scale = resolution.scale();
        resolution.drawn(scale, fixed_s + whole_s * scale * scale);
    }
    return resolution.scale();
}

TEST(Resolution, HoldsFifteenPicturesASecondWithAsManyPixelsAsThatAllows)
{
    for (const double whole_s : {0.005, 0.05, 0.1, 0.3, 0.8}) {
        for (const double fixed_s : {0.001, 0.01, 0.03}) {
            Resolution resolution;
            const double scale = settle(resolution, whole_s, fixed_s);
            const double takes_s = fixed_s + whole_s * scale * scale;
            EXPECT_LE(takes_s, Resolution::wanted_s) << whole_s << " " << fixed_s;
            const double larger = scale + 3.0 / 16.0;
            EXPECT_TRUE(scale == 1.0 || fixed_s + whole_s * larger * larger > 0.7 * Resolution::wanted_s)
                << whole_s << " " << fixed_s << " stays at " << scale;
            EXPECT_EQ(settle(resolution, whole_s, fixed_s), scale) << "goes to and fro";
        }
    }
}

TEST(Resolution, OneSlowPictureChangesNothing)
{
    Resolution resolution;
    const double scale = settle(resolution, 0.1, 0.005);
    resolution.drawn(scale, 2.0);
    EXPECT_EQ(resolution.scale(), scale);
    resolution.drawn(scale, 0.005 + 0.1 * scale * scale);
    EXPECT_EQ(resolution.scale(), scale);
}

TEST(Resolution, NeverLessThanCanBeRead)
{
    Resolution resolution;
    EXPECT_EQ(settle(resolution, 100.0, 1.0), Resolution::least);
}

} // namespace
} // namespace estampe::viewer
