// SPDX-License-Identifier: MIT
#include "features/lighting/lighting.hpp"

#include <limits>
#include <string>
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

StyleTables style_of(const std::vector<std::string>& changes)
{
    StyleTables style;
    for (const std::string& change : changes) {
        style_schema().set(style, change);
    }
    return style;
}

LightingOfScene styled(const std::vector<std::string>& changes)
{
    const Scene scene = named_scene();
    return styled_lighting(lighting_of(scene), scene, style_of(changes));
}

std::string failure(const std::vector<std::string>& changes)
{
    try {
        static_cast<void>(styled(changes));
    } catch (const Error& error) {
        return error.what();
    }
    return "fine";
}

TEST(LightLinks, NothingSaidChangesNothing)
{
    EXPECT_EQ(styled({}), lighting_of(named_scene()));
    EXPECT_EQ(styled({"light.shadows=false", "object.Arm.hatch.enabled=false"}), lighting_of(named_scene()));
}

TEST(LightLinks, LightsBurnBrighterWithoutOtherShadows)
{
    const LightingOfScene before = styled({});
    LightingOfScene lighting = before;
    brighten(lighting, std::vector<LightBrightness>{{.light = 0, .intensity = 0.5F}});
    EXPECT_EQ(lighting.lights[0].intensity, 0.5F);
    EXPECT_EQ(lighting.lights[1], before.lights[1]);
    EXPECT_TRUE(same_but_for_brightness(before, lighting));
    brighten(lighting, std::vector<LightBrightness>{{.light = 0, .intensity = 0.0F}});
    EXPECT_FALSE(same_but_for_brightness(before, lighting)) << "a light that is out has no shadow";
    EXPECT_FALSE(same_but_for_brightness(before, styled({"object.Lamp.light.range_m=3"})));
    EXPECT_FALSE(same_but_for_brightness(before, styled({"object.Arm.light.shadows=false"})));
}

TEST(LightLinks, WhatIsNoLightOrNoBrightnessIsRefusedWhole)
{
    LightingOfScene lighting = styled({});
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
        styled({"object.Lamp.light.attenuation=unit_volume", "object.Lamp.light.range_m=4",
                "object.Lamp.light.intensity=0.5", "object.L*.light.groups=1 + 3",
                "object.Day.light.shadows=false"});
    EXPECT_EQ(lighting.lights[0].falloff, LightFalloff::unit_volume);
    EXPECT_EQ(lighting.lights[0].range_m, 4.0F);
    EXPECT_EQ(lighting.lights[0].intensity, 1.5F);
    EXPECT_EQ(lighting.lights[0].groups, 0b101);
    EXPECT_EQ(lighting.lights[0].casters, all_groups);
    EXPECT_EQ(lighting.lights[1].casters, 0);
    EXPECT_EQ(lighting.lights[1].groups, all_groups);
    EXPECT_FALSE(lighting.lights[0].radius_m);
    EXPECT_EQ(styled({"object.Lamp.light.radius_m=0.2"}).lights[0].radius_m, 0.2F);
    EXPECT_EQ(styled({"object.Sun.light.enabled=false"}).lights[1].intensity, 0.0F);
    const Light lantern =
        styled({"object.Lantern.light.spot_volume=pyramid", "object.Lantern.light.shadow_groups=2"})
            .lights[0];
    EXPECT_EQ(lantern.shape, SpotShape::pyramid);
    EXPECT_EQ(lantern.casters, 0b10);
}

TEST(LightLinks, ThePicturesValuesApplyToAllAndOverridesInTheirOrder)
{
    const LightingOfScene lighting =
        styled({"light.intensity=2", "object.Lamp.light.intensity=3", "light.receives_shadows=false",
                "object.Arm.light.receives_shadows=true"});
    EXPECT_EQ(lighting.lights[0].intensity, 9.0F);
    EXPECT_EQ(lighting.lights[1].intensity, 2.0F);
    EXPECT_FALSE(lighting.node_links[0].receives_shadows);
    EXPECT_TRUE(lighting.node_links[1].receives_shadows);
    EXPECT_EQ(styled({"object.L*.light.intensity=0", "object.Lamp.light.intensity=1"}).lights[0].intensity,
              3.0F);
}

TEST(LightLinks, ShadowsOfALightThatThrowsNoneInTheFileCanBeTurnedOn)
{
    Scene scene = named_scene();
    scene.lights[0].casters = 0;
    const auto casters = [&](const std::vector<std::string>& changes) {
        return styled_lighting(lighting_of(scene), scene, style_of(changes)).lights[0].casters;
    };
    EXPECT_EQ(casters({"light.shadows=true"}), 0);
    EXPECT_EQ(casters({"object.Lamp.light.shadows=true"}), all_groups);
}

TEST(LightLinks, ObjectsGoByNodeWithAllBelowOrByMaterial)
{
    const std::vector<std::string> changes{
        "object.Figure.light.groups=2", "object.Figure.light.receives_shadows=false",
        "object.Arm.light.receives_shadows=true", "object.Arm.light.shadow_groups=1",
        "material.Glass.light.shadows=false"};
    const LightingOfScene lighting = styled(changes);
    EXPECT_EQ(lighting.node_links[0], (LightLinks{.lit_by = 2, .receives_shadows = false}));
    EXPECT_EQ(lighting.node_links[1], (LightLinks{.lit_by = 2, .casts_for = 1}));
    EXPECT_EQ(lighting.node_links[2], LightLinks{});
    EXPECT_EQ(lighting.material_links[1], LightLinks{.casts_for = 0});
    std::vector<std::string> with_sun = changes;
    with_sun.emplace_back("object.Sun.light.enabled=false");
    EXPECT_TRUE(same_links(lighting, styled(with_sun)));
    EXPECT_FALSE(same_links(lighting, styled({})));
}

TEST(LightLinks, WhatCannotBeReadIsAnError)
{
    EXPECT_EQ(failure({"object.Lamp.light.groups=0"}).find("light.groups: \"0\" is not a group"), 0U);
    EXPECT_EQ(failure({"object.Lamp.light.groups=1+"}).find("light.groups: \"\" is not a group"), 0U);
    EXPECT_EQ(failure({"object.Lamp.light.shadow_groups=17"}).find("light.shadow_groups: \"17\" is not"), 0U);
    EXPECT_NE(failure({"object.Lamp.light.range_m=-2"}).find("-1 to"), std::string::npos);
    EXPECT_NE(failure({"material.Skin.light.enabled=false"}).find("cannot differ by material"),
              std::string::npos);
}

TEST(LightLinks, PatternsThatMatchNoLightAreReported)
{
    const auto notes = [](const char* change) { return idle_overrides(named_scene(), style_of({change})); };
    EXPECT_TRUE(notes("object.Lamp.light.enabled=false").empty());
    EXPECT_TRUE(notes("object.Sun.light.shadows=false").empty()) << "the name of a light alone";
    EXPECT_TRUE(notes("object.Arm.light.shadows=false").empty());
    ASSERT_EQ(notes("object.Arm.light.enabled=false").size(), 1U);
    EXPECT_EQ(notes("object.Arm.light.enabled=false")[0],
              "the style speaks of lights \"Arm\", of which the scene has none");
    EXPECT_EQ(notes("object.Lmp.light.groups=1").size(), 1U);
}

TEST(LightLinks, SettingsNoticeChangesOfLightAlone)
{
    const std::vector<std::string> changes{"light.intensity=2", "object.Lamp.light.intensity=3"};
    const LightingSettings settings(style_of(changes));
    const auto holds = [&](std::vector<std::string> more) {
        more.insert(more.begin(), changes.begin(), changes.end());
        return settings.are_of(style_of(more));
    };
    EXPECT_TRUE(holds({}));
    EXPECT_TRUE(holds({"light.ambient=0.5", "object.Lamp.hatch.enabled=false"}));
    EXPECT_FALSE(holds({"light.intensity=1"}));
    EXPECT_FALSE(holds({"object.Lamp.light.enabled=false"}));
    EXPECT_FALSE(settings.are_of(style_of({"light.intensity=2"})));
}

} // namespace
} // namespace estampe::features
