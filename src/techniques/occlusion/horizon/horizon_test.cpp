// SPDX-License-Identifier: MIT
// The shader's own functions: light of a slice, and sectors as bits.
#include <bit>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/glsl.hpp"

namespace estampe::horizon_glsl {
using namespace test::glsl; // NOLINT(google-build-using-namespace)
#include "techniques/occlusion/horizon/horizon.glsl"
} // namespace estampe::horizon_glsl

namespace estampe::occlusion {
namespace {

/// The integral of cos(a - n) sin(a), computed in steps.
double integrated(double to, double n)
{
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double a = to * (i + 0.5) / steps;
        sum += std::cos(a - n) * std::sin(a);
    }
    return sum * to / steps;
}

TEST(Horizon, KnowsTheLightOfASlice)
{
    for (const double n : {-1.4, -0.5, 0.0, 0.3, 1.2}) {
        const double horizon = n + 0.5 * std::numbers::pi;
        const auto light = [&](double a) {
            return static_cast<double>(horizon_glsl::slice_light(
                static_cast<float>(a), static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)),
                static_cast<float>(std::cos(n)), static_cast<float>(std::sin(n))));
        };
        for (const double share : {0.1, 0.4, 0.8, 1.0}) {
            EXPECT_NEAR(light(share * horizon), integrated(share * horizon, n), 1e-5) << n;
        }
        EXPECT_NEAR(static_cast<double>(horizon_glsl::slice_light_whole(static_cast<float>(n),
                                                                        static_cast<float>(std::cos(n)),
                                                                        static_cast<float>(std::sin(n)))),
                    integrated(horizon, n), 1e-5);
    }
}

TEST(Horizon, CutsTheHemisphereIntoSectors)
{
    using horizon_glsl::sectors_between;
    EXPECT_EQ(sectors_between(0.0F, 1.0F, 0.0F), 0xffffffffU);
    EXPECT_EQ(sectors_between(-1.0F, 2.0F, 0.45F), 0xffffffffU);
    EXPECT_EQ(sectors_between(0.0F, 0.5F, 0.0F), 0x0000ffffU);
    EXPECT_EQ(sectors_between(0.5F, 1.0F, 0.0F), 0xffff0000U);
    EXPECT_EQ(sectors_between(0.3F, 0.3F, 0.0F), 0U);
    EXPECT_EQ(sectors_between(0.9999F, 1.0F, -0.45F), 0U) << "the surface's own plane";
    EXPECT_EQ(sectors_between(0.0F, 0.0001F, 0.45F), 0U);
    // Averaged over all shifts, an interval covers its own length.
    double bits = 0.0;
    constexpr int count = 90;
    for (int i = 0; i < count; ++i) {
        const float shift = 0.9F * ((static_cast<float>(i) + 0.5F) / count - 0.5F);
        bits += std::popcount(sectors_between(0.203F, 0.471F, shift));
    }
    EXPECT_NEAR(bits / count / 32.0, 0.268, 0.004);
}

} // namespace
} // namespace estampe::occlusion
