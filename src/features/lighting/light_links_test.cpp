// SPDX-License-Identifier: MIT
#include "features/lighting/lighting.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe::features {
namespace {

/// A figure of two parts, with a lamp and a sun.
Scene named_scene()
{
    Scene scene;
    scene.materials = {{.name = "Skin"}, {.name = "Glass"}};
    scene.nodes = {{.name = "Figure", .children = {1}},
                   {.name = "Arm", .parent = 0},
                   {.name = "Lantern", .light = 0},
                   {.name = "Day", .light = 1}};
    scene.roots = {0, 2, 3};
    scene.lights = {{.name = "Lamp", .intensity = 3.0F}, {.name = "Sun", .type = LightType::directional}};
    return scene;
}

LightingOfScene styled(const std::string& lights, const std::string& objects)
{
    const Scene scene = named_scene();
    light::LightStyle style;
    style.lights = lights;
    style.objects = objects;
    return styled_lighting(lighting_of(scene), scene, style);
}

std::string failure(const std::string& lights, const std::string& objects)
{
    try {
        static_cast<void>(styled(lights, objects));
    } catch (const Error& error) {
        return error.what();
    }
    return "fine";
}

TEST(LightLinks, NothingSaidChangesNothing)
{
    EXPECT_EQ(styled("", " "), lighting_of(named_scene()));
}

TEST(LightLinks, LightsBurnBrighterWithoutOtherShadows)
{
    const LightingOfScene before = styled("", "");
    LightingOfScene lighting = before;
    brighten(lighting, std::vector<LightBrightness>{{.light = 0, .intensity = 0.5F}});
    EXPECT_EQ(lighting.lights[0].intensity, 0.5F);
    EXPECT_EQ(lighting.lights[1], before.lights[1]);
    EXPECT_TRUE(same_but_for_brightness(before, lighting));
    brighten(lighting, std::vector<LightBrightness>{{.light = 0, .intensity = 0.0F}});
    EXPECT_FALSE(same_but_for_brightness(before, lighting)) << "a light that is out has no shadow";
    EXPECT_FALSE(same_but_for_brightness(before, styled("Lamp=range:3", "")));
    EXPECT_FALSE(same_but_for_brightness(before, styled("", "Arm=no_cast")));
}

TEST(LightLinks, WhatIsNoLightOrNoBrightnessIsRefusedWhole)
{
    LightingOfScene lighting = styled("", "");
    const LightingOfScene before = lighting;
    using Lights = std::vector<LightBrightness>;
    EXPECT_THROW(brighten(lighting, Lights{{0, 2.0F}, {2, 1.0F}}), Error);
    EXPECT_THROW(brighten(lighting, Lights{{0, 2.0F}, {1, -1.0F}}), Error);
    EXPECT_THROW(brighten(lighting, Lights{{0, std::numeric_limits<float>::quiet_NaN()}}), Error);
    EXPECT_EQ(lighting, before);
}

TEST(LightLinks, LightsGoByTheirNameOrTheirNodes)
{
    const LightingOfScene lighting =
        styled("Lamp = unit_volume range:4 intensity:0.5 groups:1+3, Day=no_shadow", "");
    EXPECT_EQ(lighting.lights[0].falloff, LightFalloff::unit_volume);
    EXPECT_EQ(lighting.lights[0].range_m, 4.0F);
    EXPECT_EQ(lighting.lights[0].intensity, 1.5F);
    EXPECT_EQ(lighting.lights[0].groups, 0b101);
    EXPECT_EQ(lighting.lights[0].casters, all_groups);
    EXPECT_EQ(lighting.lights[1].casters, 0);
    EXPECT_FALSE(lighting.lights[0].radius_m);
    EXPECT_EQ(styled("Lamp=radius:0.2", "").lights[0].radius_m, 0.2F);
    EXPECT_EQ(styled("Sun=off", "").lights[1].intensity, 0.0F);
    EXPECT_EQ(styled("Lantern=pyramid casters:2", "").lights[0].shape, SpotShape::pyramid);
    EXPECT_EQ(styled("Lantern=pyramid casters:2", "").lights[0].casters, 0b10);
}

TEST(LightLinks, ObjectsGoByNodeWithAllBelowOrByMaterial)
{
    const LightingOfScene lighting =
        styled("", "Figure=groups:2 no_receive, Arm=receive casts:1, Glass=no_cast");
    EXPECT_EQ(lighting.node_links[0], (LightLinks{.lit_by = 2, .receives_shadows = false}));
    EXPECT_EQ(lighting.node_links[1], (LightLinks{.lit_by = 2, .casts_for = 1}));
    EXPECT_EQ(lighting.node_links[2], LightLinks{});
    EXPECT_EQ(lighting.material_links[1], LightLinks{.casts_for = 0});
    EXPECT_TRUE(same_links(lighting, styled("Sun=off", "Figure=groups:2 no_receive, Arm=receive casts:1, "
                                                       "Glass=no_cast")));
    EXPECT_FALSE(same_links(lighting, styled("", "")));
}

TEST(LightLinks, WhatCannotBeReadIsAnError)
{
    EXPECT_EQ(failure("Lmp=off", ""), "light.lights: the scene has no light \"Lmp\"; did you mean \"Lamp\"?");
    EXPECT_EQ(failure("Lamp", "").find("light.lights: \"Lamp\" is not of the form"), 0U);
    EXPECT_EQ(failure("Lamp=of", "").find("light.lights: \"of\" says nothing of it; allowed: off,"), 0U);
    EXPECT_EQ(failure("Lamp=groups:0", "").find("light.lights: \"0\" is not a group"), 0U);
    EXPECT_EQ(failure("Lamp=range:-1", "").find("light.lights: \"-1\" is not a number"), 0U);
    EXPECT_EQ(failure("", "Skn=cast").find("light.objects: the scene has no node or material"), 0U);
    EXPECT_EQ(failure("", "Skin=off").find("light.objects: \"off\" says nothing of it"), 0U);
}

} // namespace
} // namespace estampe::features
