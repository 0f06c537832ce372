// SPDX-License-Identifier: MIT
#include "features/lighting/lighting.hpp"

#include <cmath>

#include <estampe/shapes.hpp>
#include <estampe/terrain.hpp>
#include <gtest/gtest.h>

#include "features/terrain/ground_mesh.hpp"
#include "support/scenes.hpp"
#include "techniques/light/light.hpp"
#include "techniques/terrain/graph/compile.hpp"

namespace estampe::features {
namespace {

light::Lighting sun_lighting(const Scene& scene, float azimuth_deg, float elevation_deg)
{
    const light::LightStyle style{.sun_azimuth_deg = azimuth_deg, .sun_elevation_deg = elevation_deg};
    DefaultLight house;
    return light::gather_lights(scene, pose_scene(scene, 0.0), {}, {}, style,
                                house.analysis(scene, style, std::nullopt));
}

void expect_sun(const Scene& scene, const light::Lighting& lighting, double azimuth_deg, double elevation_deg)
{
    SCOPED_TRACE(scene.meshes.size());
    const glm::dvec3& sun = lighting.towards_sun;
    EXPECT_NEAR(glm::degrees(std::asin(sun.y)), elevation_deg, 1e-4);
    const double turn_deg = glm::degrees(std::atan2(sun.x, sun.z)) - azimuth_deg;
    EXPECT_NEAR(std::remainder(turn_deg, 360.0), 0.0, 1e-4);
}

TEST(DefaultLight, StandsLowAndUpwindOverGroundThatNothingStandsOn)
{
    const Terrain ground(
        parse_terrain("[terrain]\nheight = \"dunes(85, 10)\"\n[wind]\ntowards_deg = 70\n", "dunes.toml"));
    Scene bare;
    bare.materials.emplace_back();
    bare.terrain = ground;
    // The wind blows from a bearing of -110 degrees.
    expect_sun(bare, sun_lighting(bare, -34.0F, 45.0F), -75.0, 16.0);
    const Scene as_drawn = with_terrain_node(bare);
    expect_sun(as_drawn, sun_lighting(as_drawn, -34.0F, 45.0F), -75.0, 16.0);
    expect_sun(bare, sun_lighting(bare, -34.0F, 21.0F), -75.0, 21.0);
    expect_sun(bare, sun_lighting(bare, 215.0F, 45.0F), 215.0, 16.0);
    expect_sun(bare, sun_lighting(bare, 215.0F, 60.0F), 215.0, 60.0);
    Scene built_on = test::scene_of(shapes::box({2.0F, 2.0F, 2.0F}));
    const glm::dvec3 without_ground = sun_lighting(built_on, -34.0F, 45.0F).towards_sun;
    built_on.terrain = ground;
    EXPECT_EQ(sun_lighting(built_on, -34.0F, 45.0F).towards_sun, without_ground);
}

} // namespace
} // namespace estampe::features
