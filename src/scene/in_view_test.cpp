// SPDX-License-Identifier: MIT
#include "scene/in_view.hpp"

#include <gtest/gtest.h>

#include "scene/shapes.hpp"

namespace estampe {
namespace {

/// A cube of 2 m about the place.
Scene cube_at(const glm::dvec3& place)
{
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back({.name = "cube", .primitives = {shapes::box({2, 2, 2})}});
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].transform.translation = place - glm::dvec3(0, 1, 0); // it stands on the ground
    scene.roots = {0};
    return scene;
}

bool sees(const Scene& scene, const Camera& camera)
{
    return may_see_anything(scene, pose_scene(scene, 0.0), camera, 1.5);
}

const Camera along_minus_z{.eye = {0, 0, 10}, .target = {0, 0, 0}, .vertical_fov_rad = 0.6, .near_m = 0.1};

TEST(InView, SeesWhatIsBeforeItAlone)
{
    EXPECT_TRUE(sees(cube_at({0, 0, 0}), along_minus_z));
    EXPECT_FALSE(sees(cube_at({0, 0, 12}), along_minus_z)) << "behind";
    EXPECT_TRUE(sees(cube_at({0, 0, 10}), along_minus_z)) << "around the eye";
    EXPECT_FALSE(sees(cube_at({0, 9, 0}), along_minus_z)) << "above";
    EXPECT_FALSE(sees(cube_at({-9, 0, 0}), along_minus_z)) << "to the left";
    EXPECT_TRUE(sees(cube_at({5, 0, 0}), along_minus_z)) << "partly, at the side";
    EXPECT_FALSE(sees(cube_at({0, 5, 0}), along_minus_z)) << "the page is wider than high";
}

TEST(InView, CutsAtTheNearPlane)
{
    Camera camera = along_minus_z;
    camera.near_m = 11.5;
    EXPECT_FALSE(sees(cube_at({0, 0, 0}), camera));
    camera.near_m = 10.5;
    EXPECT_TRUE(sees(cube_at({0, 0, 0}), camera));
}

TEST(InView, AWallAcrossThePageIsSeenThoughNoCornerIs)
{
    Scene scene = cube_at({0, 0, -5});
    scene.nodes[0].transform.scale = {500, 500, 1};
    EXPECT_TRUE(sees(scene, along_minus_z));
}

TEST(InView, ParallelProjection)
{
    Camera camera = along_minus_z;
    camera.orthographic_half_height_m = 2.0;
    EXPECT_TRUE(sees(cube_at({0, 2.9, -100}), camera));
    EXPECT_FALSE(sees(cube_at({0, 3.2, -100}), camera));
    EXPECT_TRUE(sees(cube_at({3.9, 0, -100}), camera));
    EXPECT_FALSE(sees(cube_at({4.3, 0, -100}), camera));
    EXPECT_TRUE(sees(cube_at({0, 0, 100}), camera)) << "all depths are drawn";
}

TEST(InView, InstancesAndBentMeshesStandWhereTheyAreDrawn)
{
    Scene instanced = cube_at({0, 0, 20});
    instanced.nodes[0].instances = {glm::mat4(1.0F)};
    EXPECT_FALSE(sees(instanced, along_minus_z));
    glm::mat4 before(1.0F);
    before[3] = {0, 0, -20, 1};
    instanced.nodes[0].instances.push_back(before);
    EXPECT_TRUE(sees(instanced, along_minus_z));

    Scene morphed = cube_at({0, 0, 20});
    MorphTarget target;
    target.position_offsets.assign(morphed.meshes[0].primitives[0].positions.size(), {0, 0, -20});
    morphed.meshes[0].primitives[0].morph_targets = {target};
    morphed.meshes[0].morph_weights = {0.0F};
    EXPECT_FALSE(sees(morphed, along_minus_z));
    morphed.meshes[0].morph_weights = {1.0F};
    EXPECT_TRUE(sees(morphed, along_minus_z));
}

TEST(InView, NothingIsMissedWhereNothingIsToBeSeen)
{
    Scene scene;
    EXPECT_TRUE(sees(scene, along_minus_z)) << "no meshes";
    Scene ground = cube_at({0, 0, 20});
    ground.terrain = Terrain(parse_terrain("[terrain]\nheight = \"2\"\n", "plain.toml"));
    EXPECT_TRUE(sees(ground, along_minus_z)) << "terrain has no end";
}

} // namespace
} // namespace estampe
