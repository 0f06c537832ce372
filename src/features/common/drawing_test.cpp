// SPDX-License-Identifier: MIT
#include "features/common/drawing.hpp"

#include <gtest/gtest.h>

#include "features/common/style_tables.hpp"

namespace estampe::features {
namespace {

StyleTables drawn(std::initializer_list<const char*> assignments)
{
    StyleTables style;
    for (const char* const assignment : assignments) {
        style_schema().set(style, assignment);
    }
    StyleTables room;
    return with_drawing(style, room);
}

TEST(DrawingFactors, OfOneChangeNothingAndCopyNothing)
{
    const StyleTables style;
    StyleTables room;
    EXPECT_EQ(&with_drawing(style, room), &style);
}

TEST(DrawingFactors, MultiplyWhatTheStyleSays)
{
    const StyleTables style =
        drawn({"contour.outline.width_mm=0.5", "contour.crease.width_m=0.01", "hatch.width_mm=0.4",
               "hatch.wobble_mm=0.1", "tone.contrast=2", "drawing.line_weight=3", "drawing.hatch_spacing=2",
               "drawing.wobble=0", "drawing.contrast=0.5"});
    EXPECT_FLOAT_EQ(style.contour.outline.width_mm, 1.5F);
    EXPECT_FLOAT_EQ(style.contour.crease.width_m, 0.03F);
    EXPECT_FLOAT_EQ(style.hatch.width_mm, 0.8F);
    EXPECT_FLOAT_EQ(style.tone.gamma, StyleTables().tone.gamma);
    EXPECT_EQ(style.hatch.wobble_mm, 0.0F);
    EXPECT_FLOAT_EQ(style.tone.contrast, 1.0F);
}

TEST(DrawingFactors, MultiplyWhatSingleSurfacesHave)
{
    const StyleTables style = drawn({"object.tower.contour.outline.width_mm=0.5", "drawing.line_weight=2"});
    EXPECT_FLOAT_EQ(std::get<float>(style.overrides.at(0).value), 1.0F);
}

TEST(DrawingFactors, KeepValuesInTheirRange)
{
    EXPECT_EQ(drawn({"contour.outline.width_mm=15", "drawing.line_weight=10"}).contour.outline.width_mm,
              20.0F);
    EXPECT_EQ(drawn({"wash.strength=0.9", "drawing.color=2"}).wash.strength, 1.0F);
    EXPECT_EQ(drawn({"drawing.detail=0"}).contour.crease_deg, 180.0F);
}

TEST(DrawingFactors, WithoutColorLeaveGreys)
{
    const StyleTables style = drawn({"drawing.color=0"});
    EXPECT_EQ(style.wash.strength, 0.0F);
    for (const glm::vec3& color : {style.sky.horizon, style.sky.zenith, style.clouds.shade_color}) {
        EXPECT_NEAR(color.x, color.z, 1e-6F);
        EXPECT_NEAR(color.y, color.z, 1e-6F);
    }
}

TEST(DrawingFactors, ReachTogglesAndColorsOfSingleSurfaces)
{
    const StyleTables plain = drawn({"object.tower.contour.crease.enabled=true", "drawing.detail=0"});
    EXPECT_FALSE(plain.contour.crease.enabled);
    EXPECT_EQ(plain.overrides.at(0).value, style::Value(false));
    const StyleTables grey = drawn({"material.brick.wash.shadow_tint=#ff0000", "drawing.color=0"});
    const auto tint = std::get<glm::vec3>(grey.overrides.at(0).value);
    EXPECT_FLOAT_EQ(tint.x, tint.y);
}

TEST(DrawingFactors, PaperReplacesThatOfThePreset)
{
    EXPECT_EQ(drawn({"paper.color=#204060", "drawing.paper=white"}).paper.color, glm::vec3(1.0F));
    EXPECT_EQ(drawn({"drawing.paper=none"}).paper.transparent, paper::Transparency::background);
}

TEST(DrawingFactors, DarkenTonesButNotWhitePaper)
{
    EXPECT_FLOAT_EQ(drawn({"tone.gamma=0.8", "drawing.darkness=2"}).tone.gamma, 1.6F);
    const StyleTables linear = drawn({"tone.curve=linear", "drawing.darkness=2"});
    EXPECT_EQ(linear.tone.curve, light::ToneCurve::gamma);
    EXPECT_FLOAT_EQ(linear.tone.gamma, 2.0F);
    EXPECT_EQ(drawn({"tone.curve=linear", "drawing.wobble=2"}).tone.curve, light::ToneCurve::linear);
}

TEST(DrawingFactors, HaveOneSeedForAll)
{
    const StyleTables style = drawn({"drawing.seed=7"});
    EXPECT_EQ(style.hatch.seed, 7);
    EXPECT_EQ(style.paper.seed, 7);
    EXPECT_EQ(style.contour.outline.width_mm, StyleTables().contour.outline.width_mm);
}

/// A factor with a misspelt key would fail only when it is used.
TEST(DrawingFactors, AllNameParameters)
{
    std::ignore = drawn({"drawing.line_weight=2", "drawing.hatch_spacing=2", "drawing.hatch_weight=2",
                         "drawing.darkness=2", "drawing.contrast=2", "drawing.detail=2", "drawing.wobble=2",
                         "drawing.color=0.5"});
}

} // namespace
} // namespace estampe::features
