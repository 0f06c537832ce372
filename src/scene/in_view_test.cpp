// SPDX-License-Identifier: MIT
#include "scene/visibility.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

namespace estampe {
namespace {

/// A cube of 2 m with its centre at `place`.
Scene cube_at(const glm::dvec3& place)
{
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back({.name = "cube", .primitives = {shapes::box({2, 2, 2})}});
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].transform.translation = place - glm::dvec3(0, 1, 0); // its origin is at the bottom
    scene.roots = {0};
    return scene;
}

bool sees(const Scene& scene, const Camera& camera)
{
    return find_in_view(scene, pose_scene(scene, 0.0), camera, 1.5).content != ViewContent::nothing;
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

TEST(InView, FollowsTheLensShift)
{
    Camera parallel = along_minus_z;
    parallel.orthographic_half_height_m = 2.0;
    for (Camera camera : {along_minus_z, parallel}) {
        EXPECT_FALSE(sees(cube_at({0, 5, 0}), camera));
        EXPECT_FALSE(sees(cube_at({9, 0, 0}), camera));
        camera.shift = {0.0, 1.0};
        EXPECT_TRUE(sees(cube_at({0, 5, 0}), camera));
        EXPECT_FALSE(sees(cube_at({0, -2.5, 0}), camera)) << "the lower half lies below the page";
        camera.shift = {1.0, 0.0};
        EXPECT_TRUE(sees(cube_at({9, 0, 0}), camera));
        EXPECT_FALSE(sees(cube_at({-4, 0, 0}), camera));
    }
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

TEST(InView, HiddenNodesAreNotSeen)
{
    Scene scene = cube_at({0, 0, 0});
    scene.nodes[0].visible = false;
    EXPECT_FALSE(sees(scene, along_minus_z));
}

InView view_of(const Scene& scene, const Camera& camera)
{
    return find_in_view(scene, pose_scene(scene, 0.0), camera, 1.5);
}

void expect_inside(const Scene& scene, const Camera& camera, Index node)
{
    const InView view = view_of(scene, camera);
    EXPECT_EQ(view.content, ViewContent::backs_only);
    EXPECT_TRUE(view.holds_eye);
    EXPECT_EQ(view.backs_of, node);
}

TEST(InView, AnEyeInAOneSidedSolidSeesItsBacksAlone)
{
    Scene scene = cube_at({0, 0, 10});
    expect_inside(scene, along_minus_z, 0);
    scene.nodes[0].transform.rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    scene.nodes[0].transform.translation = {0.1, -0.7, 10};
    expect_inside(scene, along_minus_z, 0);
    scene.nodes[0].transform.scale = {-1, 1, 1}; // mirrored, but still visible only from outside
    expect_inside(scene, along_minus_z, 0);
    scene.materials[0].double_sided = true;
    EXPECT_EQ(view_of(scene, along_minus_z).content, ViewContent::something);
}

TEST(InView, ARoomAndWhatStandsOutsideTheSolidAreSeen)
{
    Scene room = cube_at({0, 0, 10});
    for (uint32_t& index : room.meshes[0].primitives[0].indices)
        index = index / 4 * 4 + 3 - index % 4; // each side of the box has four vertices
    EXPECT_EQ(view_of(room, along_minus_z).content, ViewContent::something);

    Scene two = cube_at({0, 0, 10});
    two.nodes.push_back(cube_at({0, 0, 0}).nodes[0]);
    two.roots.push_back(1);
    EXPECT_EQ(view_of(two, along_minus_z).content, ViewContent::something) << "seen through the backs";
    two.nodes[1] = cube_at({0, 0, 20}).nodes[0];
    expect_inside(two, along_minus_z, 0);
    Camera from_outside = along_minus_z;
    from_outside.eye.z = 11.5;
    EXPECT_EQ(view_of(two, from_outside).content, ViewContent::something);
}

TEST(InView, ALargeTriangleThatPassesByIsNotSeen)
{
    Scene scene = cube_at({0, 0, 0});
    // The triangle misses the upper left corner of the page, although one of its corners is not left of the
    // page, and another not above it.
    Primitive& triangle = scene.meshes[0].primitives[0];
    triangle = {.positions = {{-20, 0, 0}, {0, 20, 0}, {-20, 20, 0}}, .indices = {0, 1, 2, 0, 2, 1}};
    EXPECT_FALSE(sees(scene, along_minus_z));
    triangle.positions[0].x = triangle.positions[2].x = -4;
    EXPECT_TRUE(sees(scene, along_minus_z));
}

TEST(InView, TheInnermostOfNestedSolidsIsNamed)
{
    Scene scene = cube_at({0, 0, 10});
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes.push_back(scene.nodes[0]);
    scene.roots = {0, 1, 2};
    scene.nodes[0].transform.scale = glm::dvec3(3.0);
    scene.nodes[0].transform.translation.y = -3.0;
    scene.nodes[2].transform.scale = glm::dvec3(2.0);
    scene.nodes[2].transform.translation.y = -2.0;
    expect_inside(scene, along_minus_z, 1);
}

TEST(InView, APlateFromBehindIsNotDrawn)
{
    Scene scene = cube_at({0, 0, 0});
    Primitive& plate = scene.meshes[0].primitives[0];
    plate = {.positions = {{-1, 0, 0}, {0, 2, 0}, {1, 0, 0}}, .indices = {0, 1, 2}};
    for (const bool parallel : {false, true}) {
        Camera camera = along_minus_z;
        if (parallel)
            camera.orthographic_half_height_m = 2.0;
        const InView view = view_of(scene, camera);
        EXPECT_EQ(view.content, ViewContent::backs_only);
        EXPECT_FALSE(view.holds_eye);
        EXPECT_EQ(view.backs_of, 0U);
        camera.eye.z = -10;
        EXPECT_EQ(view_of(scene, camera).content, ViewContent::something);
    }
    plate.topology = Topology::lines;
    plate.indices = {0, 1, 1, 2};
    EXPECT_EQ(view_of(scene, along_minus_z).content, ViewContent::something) << "lines have no back";
}

TEST(InView, ClothIsSeenFromBothSides)
{
    Scene scene = cube_at({0, 0, 10});
    scene.materials[0].cloth = Cloth{};
    EXPECT_EQ(view_of(scene, along_minus_z).content, ViewContent::something);
}

TEST(InView, BentMeshesAreOneSidedToo)
{
    Scene morphed = cube_at({0, 0, 20});
    MorphTarget target;
    target.position_offsets.assign(morphed.meshes[0].primitives[0].positions.size(), {0, 0, -10});
    morphed.meshes[0].primitives[0].morph_targets = {target};
    morphed.meshes[0].morph_weights = {1.0F};
    expect_inside(morphed, along_minus_z, 0);
    morphed.meshes[0].morph_weights = {1.5F};
    EXPECT_EQ(view_of(morphed, along_minus_z).content, ViewContent::something);
}

} // namespace
} // namespace estampe
