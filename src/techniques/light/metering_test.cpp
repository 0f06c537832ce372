// SPDX-License-Identifier: MIT
// Exposure of lights in lux and candela.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "scene/pose.hpp"
#include "support/scenes.hpp"
#include "techniques/light/light.hpp"

namespace estampe::light {
namespace {

/// A floor, and one light 2 m above its middle, shining down.
Scene lit_by(Light light)
{
    Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F));
    scene.lights = {std::move(light)};
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(
        {.transform = {.translation = {0.0, 2.0, 0.0},
                       .rotation = glm::angleAxis(-0.5 * std::numbers::pi, glm::dvec3(1.0, 0.0, 0.0))},
         .light = 0});
    return scene;
}

Lighting gathered(const Scene& scene, const LightStyle& style)
{
    const ScenePose pose = pose_scene(scene, 0.0);
    const Bounds bounds = scene_bounds(scene, pose);
    return gather_lights(scene, pose, bounds, bounds.center(), style);
}

/// Brightness of a white sheet under `lux` at an exposure value: its luminance, E over pi, as a share of the
/// luminance that saturates a sensor at that value, 78 / (0.65 * 100) * 2^EV (ISO 12232).
double white_sheet(double lux, double ev100)
{
    return lux / (std::numbers::pi * 1.2 * std::exp2(ev100));
}

TEST(ManualMetering, TheSunOfManyLux)
{
    for (const float ev100 : {12.0F, 15.0F}) {
        const Lighting lighting = gathered(lit_by({.type = LightType::directional, .intensity = 100000.0F}),
                                           {.metering = Metering::manual, .ev100 = ev100});
        ASSERT_EQ(lighting.records.size(), 1U);
        const double wanted = white_sheet(100000.0, static_cast<double>(ev100));
        EXPECT_NEAR(lighting.records[0].color.y, wanted, 1e-4 * wanted);
    }
    // A white sheet in sunlight is nearly white.
    EXPECT_NEAR(white_sheet(100000.0, 15.0), 0.81, 0.01);
}

TEST(ManualMetering, ALampOfCandelaByItsDistance)
{
    const Lighting lighting = gathered(lit_by({.type = LightType::point, .intensity = 800.0F}),
                                       {.metering = Metering::manual, .ev100 = 5.0F});
    ASSERT_EQ(lighting.records.size(), 1U);
    const shared::LightRecord& lamp = lighting.records[0];
    // 800 cd are 200 lux at two metres.
    EXPECT_NEAR(lamp.color.y / 4.0F, white_sheet(200.0, 5.0), 1e-4);
    // Without a range in the file, the light's range ends where a 400th of white is left.
    const double far_m = static_cast<double>(lamp.range_m);
    EXPECT_NEAR(static_cast<double>(lamp.color.y) / (far_m * far_m), 1.0 / 400.0, 1e-5);
}

TEST(ManualMetering, StopsAreAddedAndLightsCountInFull)
{
    const Scene scene = lit_by({.type = LightType::directional, .intensity = 2000.0F});
    const auto level = [&](const LightStyle& style) { return gathered(scene, style).records[0].color.y; };
    const float at_8 = level({.metering = Metering::manual, .ev100 = 8.0F});
    EXPECT_NEAR(level({.metering = Metering::manual, .ev100 = 9.0F}), 0.5F * at_8, 1e-5F);
    EXPECT_NEAR(level({.metering = Metering::manual, .exposure_stops = 2.0F, .ev100 = 8.0F}), 4.0F * at_8,
                1e-5F);
    const Scene brighter = lit_by({.type = LightType::directional, .intensity = 6000.0F});
    EXPECT_NEAR(gathered(brighter, {.metering = Metering::manual, .ev100 = 8.0F}).records[0].color.y,
                3.0F * at_8, 1e-4F);
    // Metering by the lights gives both scenes equal exposure.
    EXPECT_NEAR(gathered(brighter, {}).records[0].color.y, level({}), 1e-5F);
}

TEST(ManualMetering, OfASceneWithoutLightsChangesNothing)
{
    const Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F));
    const Lighting manual = gathered(scene, {.metering = Metering::manual, .ev100 = 3.0F});
    const Lighting plain = gathered(scene, {});
    ASSERT_EQ(manual.records.size(), plain.records.size());
    EXPECT_EQ(manual.records[0].color, plain.records[0].color);
}

TEST(MeteringByLights, RemembersWhatStandsAndLooksAnewAtWhatMoved)
{
    Scene scene = lit_by({.type = LightType::point, .intensity = 800.0F});
    const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0));
    ExposureKeyCache memory;
    const auto expect_same = [&](const glm::dvec3& anchor) {
        const ScenePose pose = pose_scene(scene, 0.0);
        const float remembered = gather_lights(scene, pose, bounds, anchor, {}, {}, &memory).exposure;
        EXPECT_EQ(remembered, gather_lights(scene, pose, bounds, anchor, {}).exposure);
        return remembered;
    };
    const float first = expect_same(bounds.center());
    EXPECT_EQ(first, expect_same(bounds.center()));
    memory.key *= 2.0F; // the cached value is used
    EXPECT_EQ(gather_lights(scene, pose_scene(scene, 0.0), bounds, bounds.center(), {}, {}, &memory).exposure,
              0.5F * first);
    scene.lights[0].intensity = 400.0F;
    EXPECT_NE(first, expect_same(bounds.center()));
    scene.nodes.back().transform.translation.y = 3.0;
    const float higher = expect_same(bounds.center());
    scene.nodes.front().transform.translation.x = 1.5;
    const float aside = expect_same(bounds.center());
    EXPECT_NE(higher, aside);
    expect_same(bounds.center() + glm::dvec3(0.0, 100.0, 0.0));
}

} // namespace
} // namespace estampe::light
