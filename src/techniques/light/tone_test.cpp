// SPDX-License-Identifier: MIT
// The tone curve, by the shader's own functions.
#include <cmath>

#include <gtest/gtest.h>

#include "shaders/tone.glsl.h"
#include "support/glsl.hpp"
#include "techniques/light/light.hpp"

namespace estampe {
namespace tone {

using namespace test::glsl; // NOLINT(google-build-using-namespace)
using shared::tone_filmic;
using shared::tone_linear;
using shared::ToneConstants;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "shaders/tone.glsl"
#pragma GCC diagnostic pop

} // namespace tone

namespace light {
namespace {

shared::ToneConstants curve(ToneCurve which, float gamma = 0.8F)
{
    return tone_constants({.curve = which, .gamma = gamma});
}

/// Only the curve, without the other tone settings.
shared::ToneConstants bare(ToneCurve which, float gamma = 1.0F)
{
    return tone_constants({.curve = which,
                           .exposure = 1.0F,
                           .gamma = gamma,
                           .contrast = 1.0F,
                           .floor = 0.0F,
                           .ceiling = 1.0F,
                           .local_value = 0.0F});
}

TEST(Tone, LinearIsLightItselfWhateverTheGamma)
{
    for (const float value : {0.0F, 0.1F, 0.25F, 0.6F, 0.99F}) {
        EXPECT_FLOAT_EQ(tone::toned(curve(ToneCurve::linear, 0.4F), value), value);
        EXPECT_NEAR(tone::darkness(bare(ToneCurve::linear, 3.0F), value, 1.0F), 1.0F - value, 1e-6F);
    }
    EXPECT_EQ(tone::toned(curve(ToneCurve::linear), 7.0F), 1.0F);
    EXPECT_EQ(tone::toned(curve(ToneCurve::linear), -1.0F), 0.0F);
}

TEST(Tone, GammaIsAPower)
{
    for (const float gamma : {0.5F, 0.8F, 2.2F}) {
        for (const float value : {0.05F, 0.3F, 0.9F}) {
            EXPECT_NEAR(tone::toned(curve(ToneCurve::gamma, gamma), value), std::pow(value, gamma), 1e-6F);
        }
        EXPECT_EQ(tone::toned(curve(ToneCurve::gamma, gamma), 1.5F), 1.0F);
    }
}

TEST(Tone, FilmicIsStraightThenKeepsBrightLightApart)
{
    const shared::ToneConstants filmic = curve(ToneCurve::filmic, 1.0F);
    for (const float value : {0.0F, 0.2F, 0.59F, 0.6F}) {
        EXPECT_FLOAT_EQ(tone::toned(filmic, value), value);
    }
    // Value and slope are continuous at the knee.
    const auto slope = [&](float from, float to) {
        return (tone::toned(filmic, to) - tone::toned(filmic, from)) / (to - from);
    };
    EXPECT_NEAR(slope(0.58F, 0.6F), 1.0F, 1e-3F);
    EXPECT_NEAR(slope(0.6F, 0.602F), 1.0F, 5e-3F);
    EXPECT_NEAR(tone::toned(filmic, 1.0F), 1.0 - 0.4 * std::exp(-1.0), 1e-6);
    float before = tone::toned(filmic, 0.6F);
    for (float value = 0.7F; value < 4.0F; value += 0.1F) {
        const float now = tone::toned(filmic, value);
        EXPECT_GT(now, before);
        EXPECT_LT(now, 1.0F);
        before = now;
    }
    EXPECT_NEAR(tone::toned(curve(ToneCurve::filmic, 0.5F), 0.36F), 0.6F, 1e-6F);
    EXPECT_NEAR(tone::toned(curve(ToneCurve::filmic, 2.0F), 1.0F), std::pow(1.0 - 0.4 * std::exp(-1.0), 2.0),
                1e-6);
}

TEST(Tone, MoreLightIsNeverDarker)
{
    for (const ToneCurve which : {ToneCurve::gamma, ToneCurve::linear, ToneCurve::filmic}) {
        float before = 1.0F;
        for (float light = 0.0F; light < 3.0F; light += 0.01F) {
            const float dark = tone::darkness(curve(which), light, 0.5F);
            EXPECT_LE(dark, before);
            EXPECT_GE(dark, 0.0F);
            before = dark;
        }
    }
}

TEST(Tone, ExposureAndLocalValueMultiplyLightBeforeTheCurve)
{
    for (const ToneCurve which : {ToneCurve::gamma, ToneCurve::linear, ToneCurve::filmic}) {
        shared::ToneConstants tone = bare(which, 0.7F);
        const float plain = tone::darkness(tone, 0.3F, 1.0F);
        tone.exposure = 2.0F;
        EXPECT_NEAR(tone::darkness(tone, 0.15F, 1.0F), plain, 1e-6F);
        tone.local_value = 0.5F;
        EXPECT_NEAR(tone::darkness(tone, 0.3F, 0.0F), plain, 1e-6F);
    }
}

} // namespace
} // namespace light
} // namespace estampe
