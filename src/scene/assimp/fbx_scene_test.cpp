// SPDX-License-Identifier: MIT
// Whole FBX files: axes, units, pivots, cameras, lights and time.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/assimp/fbx/test_file.hpp"
#include "scene/importers.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

using fbx::test::axes;
using fbx::test::File;
using fbx::test::number;
using fbx::test::vector;
using fbx::test::whole;

class FbxScene : public testing::Test {
protected:
    Scene load(const std::string& text, const std::string& name = "test.fbx")
    {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return load_with_assimp(folder_ / name);
    }

    Scene load(const File& file) { return load(file.text()); }

    test::Folder folder_;
};

void expect_near(const glm::dvec3& found, const glm::dvec3& wanted, double tolerance = 1e-5)
{
    EXPECT_NEAR(glm::distance(found, wanted), 0.0, tolerance)
        << found.x << ", " << found.y << ", " << found.z << " in place of " << wanted.x << ", " << wanted.y
        << ", " << wanted.z;
}

void expect_bounds(const Scene& scene, const glm::dvec3& min, const glm::dvec3& max, double time_s = 0.0)
{
    const Bounds bounds = scene_bounds(scene, pose_scene(scene, time_s));
    expect_near(bounds.min, min);
    expect_near(bounds.max, max);
}

/// A file with one tetrahedron, these settings, and these properties of its node.
File tetrahedron(const std::string& settings, const std::string& properties = "")
{
    File file;
    file.settings = settings;
    file.add_model(10, "tetrahedron", "Mesh", properties);
    file.add_tetrahedron(11, 10);
    return file;
}

glm::dvec3 direction_of(const Camera& camera)
{
    return glm::normalize(camera.target - camera.eye);
}

Camera camera_of(const Scene& scene, double time_s = 0.0)
{
    return scene_camera(scene, pose_scene(scene, time_s), "0");
}

glm::dvec3 light_direction(const Scene& scene, double time_s = 0.0)
{
    const ScenePose pose = pose_scene(scene, time_s);
    for (Index index = 0; index < scene.nodes.size(); ++index)
        if (scene.nodes[index].light != no_index)
            return -glm::normalize(glm::dvec3(pose.world_from_node[index][2]));
    return glm::dvec3(0.0);
}

TEST_F(FbxScene, UnitIsCentimetresTimesTheScaleFactorAlone)
{
    expect_bounds(load(tetrahedron("")), {0, 0, 0}, {0.01, 0.02, 0.03});
    expect_bounds(
        load(tetrahedron(number("UnitScaleFactor", 2.54) + number("OriginalUnitScaleFactor", 100.0))),
        {0, 0, 0}, {0.0254, 0.0508, 0.0762});
    expect_bounds(load(tetrahedron(number("UnitScaleFactor", 100.0))), {0, 0, 0}, {1, 2, 3});
}

TEST_F(FbxScene, AxesTurnTheSceneUpright)
{
    const std::string metres = number("UnitScaleFactor", 100.0);
    expect_bounds(load(tetrahedron(metres + axes(2, 3, 1))), {0, 0, 0}, {1, 2, 3});
    expect_bounds(load(tetrahedron(metres + axes(3, -2, 1))), {0, 0, -2}, {1, 3, 0});   // 3ds Max
    expect_bounds(load(tetrahedron(metres + axes(3, 2, -1))), {-1, 0, 0}, {0, 3, 2});   // front reversed
    expect_bounds(load(tetrahedron(metres + axes(1, 3, -2))), {-2, 0, 0}, {0, 1, 3});   // x is up
    expect_bounds(load(tetrahedron(metres + axes(-2, 3, -1))), {-1, -2, 0}, {0, 0, 3}); // upside down
    expect_bounds(load(tetrahedron(metres + axes(2, -3, 1))), {0, 0, -3}, {1, 2, 0});   // left-handed
    expect_bounds(load(tetrahedron(metres + axes(2, 2, 1))), {0, 0, 0}, {1, 2, 3});     // invalid axes
}

TEST_F(FbxScene, KeysOfATurnedSceneTurnWithIt)
{
    File file = tetrahedron(number("UnitScaleFactor", 100.0) + axes(3, -2, 1));
    file.animate(90, 10, "Lcl Translation", "Z", 0.0, 2.0, 0.0, 8.0);
    expect_bounds(load(file), {0, 4, -2}, {1, 7, 0}, 1.0);
}

TEST_F(FbxScene, GeometryIsDisplacedWithoutItsChildren)
{
    File file = tetrahedron(number("UnitScaleFactor", 100.0),
                            vector("GeometricTranslation", 10, 0, 0) + vector("GeometricScaling", 2, 2, 2));
    file.add_model(20, "child", "Mesh", vector("Lcl Translation", 0, 100, 0), 10);
    file.add_tetrahedron(21, 20);
    expect_bounds(load(file), {0, 0, 0}, {12, 102, 6});
}

TEST_F(FbxScene, ANodeTurnsAndGrowsAboutItsPivots)
{
    const std::string pivots = vector("RotationPivot", 1, 0, 0) + vector("ScalingPivot", 0, 2, 0) +
                               vector("RotationOffset", 0, 0, 5);
    expect_bounds(
        load(tetrahedron(number("UnitScaleFactor", 100.0),
                         pivots + vector("Lcl Rotation", 0, 0, 90) + vector("Lcl Scaling", 1, 2, 1))),
        {-1, -1, 5}, {3, 0, 8});
    File animated = tetrahedron(number("UnitScaleFactor", 100.0), pivots + vector("Lcl Scaling", 1, 2, 1));
    animated.animate(90, 10, "Lcl Rotation", "Z", 0.0, 2.0, 0.0, 180.0);
    expect_bounds(load(animated), {-1, -1, 5}, {3, 0, 8}, 1.0);
}

TEST_F(FbxScene, FixedTurnsStandBeforeAndAfterTheRotation)
{
    // The node is turned upright, then rotated about the parent's y; its x is rotated beforehand.
    const std::string turns =
        whole("RotationActive", 1) + vector("PreRotation", -90, 0, 0) + vector("PostRotation", 0, 0, 90);
    const std::string metres = number("UnitScaleFactor", 100.0);
    expect_bounds(load(tetrahedron(metres, turns)), {0, 0, 0}, {2, 3, 1});
    File animated = tetrahedron(metres, turns);
    animated.animate(90, 10, "Lcl Rotation", "Z", 0.0, 2.0, 0.0, 180.0);
    expect_bounds(load(animated), {0, 0, -2}, {1, 3, 0}, 1.0);
    // Without RotationActive the fixed rotations do not apply.
    expect_bounds(load(tetrahedron(metres, whole("RotationActive", 0) + vector("PreRotation", -90, 0, 0))),
                  {0, 0, 0}, {1, 2, 3});
}

TEST_F(FbxScene, CameraOfBlenderHasItsNearPlaneInTheUnitOfTheFile)
{
    File file = tetrahedron(number("UnitScaleFactor", 1.0), vector("Lcl Scaling", 100, 100, 100));
    file.creator = "Blender (stable FBX IO) - 3.4.0 - 4.37.1";
    file.add_model(20, "Camera", "Camera",
                   vector("Lcl Translation", 0, 0, 1000) + vector("Lcl Rotation", 0, 90, 0) +
                       vector("Lcl Scaling", 100, 100, 100));
    file.add_attribute(21, "Camera",
                       number("NearPlane", 10) + whole("ApertureMode", 3) + whole("GateFit", 2) +
                           number("FilmWidth", 36 / 25.4) + number("FilmHeight", 24 / 25.4) +
                           number("FocalLength", 50) + number("AspectWidth", 1920) +
                           number("AspectHeight", 1080) + whole("AspectRatioMode", 2),
                       20);
    const Camera camera = camera_of(load(file));
    EXPECT_NEAR(camera.near_m, 0.1, 1e-9);
    expect_near(camera.eye, {0, 0, 10});
    expect_near(direction_of(camera), {0, 0, -1});
    expect_near(camera.up, {0, 1, 0});
    EXPECT_NEAR(std::tan(0.5 * camera.vertical_fov_rad), 18.0 / 50.0 * 9.0 / 16.0, 1e-9);
}

TEST_F(FbxScene, CamerasAreNumberedAsTheirNodesAre)
{
    File file = tetrahedron("");
    for (const auto& [id, name] :
         {std::pair(70, "Producer Perspective"), std::pair(60, "first"), std::pair(50, "second")}) {
        file.add_model(id, name, "Camera", "");
        file.add_attribute(id + 1, "Camera", "", id);
    }
    const Scene scene = load(file);
    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.cameras[0].name, "first");
    EXPECT_EQ(scene.cameras[1].name, "second");
}

TEST_F(FbxScene, PostRotationOfACameraIsUndone)
{
    File file = tetrahedron("");
    file.add_model(20, "Camera", "Camera",
                   whole("RotationActive", 1) + vector("PostRotation", 0, -90, 0) +
                       vector("Lcl Rotation", -30, 0, 0));
    file.add_attribute(21, "Camera", number("NearPlane", 1), 20);
    const Camera camera = camera_of(load(file));
    expect_near(direction_of(camera), {0, -0.5, -std::sqrt(0.75)});
    EXPECT_GT(camera.up.y, 0.8);
}

TEST_F(FbxScene, ATargetCameraLooksAtItsTarget)
{
    for (const bool z_up : {false, true}) {
        File file = tetrahedron(number("UnitScaleFactor", 100.0) + (z_up ? axes(3, -2, 1) : ""));
        file.add_model(20, "Camera01", "Camera", vector("Lcl Translation", 3, 4, 5));
        file.add_attribute(21, "Camera", number("FieldOfView", 45) + whole("ApertureMode", 1), 20);
        file.add_model(30, "Camera01.Target", "Null", vector("Lcl Translation", 0, 4, 1));
        file.link(30, 20, "LookAtProperty");
        const Camera camera = camera_of(load(file));
        expect_near(direction_of(camera), z_up ? glm::dvec3(-0.6, -0.8, 0.0) : glm::dvec3(-0.6, 0.0, -0.8));
        expect_near(camera.up, z_up ? glm::dvec3(-0.8, 0.6, 0.0) : glm::dvec3(0, 1, 0));
    }
}

TEST_F(FbxScene, ATargetCameraFollowsItsTargetAndRolls)
{
    File file = tetrahedron(number("UnitScaleFactor", 100.0));
    file.add_model(20, "Camera01", "Camera", vector("Lcl Scaling", 2, 2, 2));
    file.add_attribute(21, "Camera", number("Roll", 90), 20);
    file.add_model(30, "Camera01.Target", "Null", vector("Lcl Translation", 0, 0, -10));
    file.link(30, 20, "LookAtProperty");
    file.animate(90, 30, "Lcl Translation", "X", 0.0, 2.0, 0.0, 20.0);
    const Scene scene = load(file);
    expect_near(direction_of(camera_of(scene, 0.0)), {0, 0, -1});
    expect_near(camera_of(scene, 0.0).up, {1, 0, 0});
    expect_near(direction_of(camera_of(scene, 1.0)), glm::normalize(glm::dvec3(1, 0, -1)), 1e-3);
    expect_near(direction_of(camera_of(scene, 1.9)), glm::normalize(glm::dvec3(1.9, 0, -1)), 1e-3);
}

TEST_F(FbxScene, ATargetCameraInAMirroredGroupLooksAtItsTarget)
{
    File file = tetrahedron("");
    file.add_model(15, "group", "Null", vector("Lcl Scaling", -1, 1, 1) + vector("Lcl Rotation", 20, 30, 40));
    file.add_model(20, "Camera01", "Camera", vector("Lcl Translation", 100, 200, 300), 15);
    file.add_attribute(21, "Camera", "", 20);
    file.add_model(30, "Camera01.Target", "Null", "");
    file.link(30, 20, "LookAtProperty");
    const Camera camera = camera_of(load(file));
    expect_near(direction_of(camera), -glm::normalize(camera.eye));
    EXPECT_NEAR(glm::dot(camera.up, glm::cross(camera.eye, glm::dvec3(0, 1, 0))), 0.0, 1e-5) << "upright";
    EXPECT_GT(camera.up.y, 0.0);
}

TEST_F(FbxScene, LightsShineAlongTheirNodesMinusYOrAtTheirTarget)
{
    File file = tetrahedron("");
    file.add_model(20, "Sun", "Light", whole("RotationActive", 1) + vector("PostRotation", 90, 0, 0));
    file.add_attribute(21, "Light", whole("LightType", 1), 20);
    expect_near(light_direction(load(file)), {0, 0, 1});
    file.add_model(30, "Sun.Target", "Null", vector("Lcl Translation", -300, 0, 400));
    file.link(30, 20, "LookAtProperty");
    expect_near(light_direction(load(file)), {-0.6, 0, 0.8});
}

TEST_F(FbxScene, FrameRateAndLengthAreTheFiles)
{
    File file = tetrahedron(whole("TimeMode", 11));
    file.animate(90, 10, "Lcl Translation", "X", 1.0, 3.0, 0.0, 1.0);
    const Scene film = load(file);
    EXPECT_EQ(film.frames_per_s, 24.0);
    ASSERT_EQ(film.animations.size(), 1U);
    EXPECT_NEAR(film.animations[0].duration_s, 2.0F, 1e-5F);
    EXPECT_EQ(film.animations[0].start_s, 0.0F);
    EXPECT_EQ(load(tetrahedron(whole("TimeMode", 14) + number("CustomFrameRate", 12.5))).frames_per_s, 12.5);
    EXPECT_EQ(load(tetrahedron(whole("TimeMode", 14) + number("CustomFrameRate", -1))).frames_per_s,
              std::nullopt);
    EXPECT_EQ(load(tetrahedron(whole("TimeMode", 0))).frames_per_s, std::nullopt);
}

TEST_F(FbxScene, AMeshFarFromItsOriginIsWarnedOf)
{
    File file;
    file.add_model(10, "far house", "Mesh", "");
    file.add_tetrahedron(11, 10, 4e5);
    const Scene scene = load(file);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("\"far house\""), std::string::npos) << scene.warnings[0];
    EXPECT_NE(scene.warnings[0].find("origin"), std::string::npos) << scene.warnings[0];
    // The position of a node has no limit.
    const Scene moved = load(tetrahedron("", vector("Lcl Translation", 123456789.25, 0, 0)));
    EXPECT_TRUE(moved.warnings.empty());
    EXPECT_NEAR(scene_bounds(moved, pose_scene(moved, 0.0)).min.x, 1234567.8925, 1e-6);
}

TEST_F(FbxScene, OlderVersionsAreRefusedForWhatTheyAre)
{
    const auto refusal = [this](const std::string& text) -> std::string {
        try {
            (void)load(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const std::string binary =
        std::string("Kaydara FBX Binary  \0\x1a\0", 23) + std::string("\xd4\x17\0\0", 4);
    for (const std::string& old :
         {binary, std::string("; FBX 6.1.0 project file\nFBXHeaderExtension:  {\n}\n"),
          std::string("FBXHeaderExtension:  {\n\tFBXVersion: 6100\n}\n")}) {
        EXPECT_NE(refusal(old).find("is FBX 6.1"), std::string::npos) << refusal(old);
        EXPECT_NE(refusal(old).find("FBX Converter"), std::string::npos);
    }
    std::string newer = tetrahedron("").text();
    newer.replace(newer.find("7400"), 4, "7700");
    EXPECT_NO_THROW((void)load(newer));
}

TEST_F(FbxScene, HiddenModelsAreHidden)
{
    const auto shown = [this](const std::string& properties) {
        const Scene scene = load(tetrahedron("", properties));
        return !scene_bounds(scene, pose_scene(scene, 0.0)).empty();
    };
    EXPECT_TRUE(shown(number("Visibility", 1) + whole("Show", 1)));
    EXPECT_FALSE(shown(number("Visibility", 0)));
    EXPECT_FALSE(shown(whole("Show", 0)));
}

TEST_F(FbxScene, VisibilityIsInheritedAndShowIsNot)
{
    // The child stands 100 m aside, so its bounds show whether it is visible.
    const auto child_is_shown = [this](const std::string& parent, const std::string& child,
                                       const std::string& between = "") {
        File file = tetrahedron(number("UnitScaleFactor", 100.0), parent);
        file.add_model(20, "between", "Null", between, 10);
        file.add_model(30, "child", "Mesh", vector("Lcl Translation", 100, 0, 0) + child, 20);
        file.add_tetrahedron(31, 30);
        const Scene scene = load(file);
        const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0));
        return !bounds.empty() && bounds.max.x > 100.0;
    };
    EXPECT_TRUE(child_is_shown("", ""));
    EXPECT_FALSE(child_is_shown(number("Visibility", 0), ""));
    EXPECT_FALSE(child_is_shown(number("Visibility", 0), number("Visibility", 1)));
    EXPECT_TRUE(child_is_shown(number("Visibility", 0), whole("VisibilityInheritance", 0)));
    EXPECT_TRUE(child_is_shown(number("Visibility", 0), "", whole("VisibilityInheritance", 0)));
    EXPECT_FALSE(child_is_shown("", "", number("Visibility", 0)));
    EXPECT_TRUE(child_is_shown(whole("Show", 0), "")) << "Show hides the model alone";
    EXPECT_TRUE(child_is_shown("", "", whole("Show", 0)));
}

} // namespace
} // namespace estampe
