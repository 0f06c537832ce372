// SPDX-License-Identifier: MIT
// DAE, and FBX made from it: nodes, skins, animations, cameras and lights.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/importers.hpp"
#include "scene/pose.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

const char* const arm_dae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_cameras><camera id="cam" name="cam"><optics><technique_common><perspective><xfov>60</xfov>
<aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>
</library_cameras>
<library_lights><light id="sun" name="sun"><technique_common><directional><color>1 1 0.5</color></directional>
</technique_common></light></library_lights>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse><color>0.5 0.25 0.125 1</color>
</diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="clay" name="clay"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="arm"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 2 0 0 2 0</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_controllers><controller id="c"><skin source="#g">
<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
<source id="j"><Name_array id="ja" count="2">lower upper</Name_array><technique_common>
<accessor source="#ja" count="2" stride="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
<source id="b"><float_array id="ba" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 -1 0 0 1 0 0 0 0 1
</float_array><technique_common><accessor source="#ba" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/>
</accessor></technique_common></source>
<source id="w"><float_array id="wa" count="1">1</float_array><technique_common>
<accessor source="#wa" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints>
<vertex_weights count="4"><input semantic="JOINT" source="#j" offset="0"/>
<input semantic="WEIGHT" source="#w" offset="1"/><vcount>1 1 1 1</vcount><v>0 0 0 0 1 0 1 0</v></vertex_weights>
</skin></controller></library_controllers>
<library_animations><animation id="a">
<source id="i"><float_array id="ia" count="2">0 2</float_array><technique_common>
<accessor source="#ia" count="2" stride="1"><param name="TIME" type="float"/></accessor></technique_common></source>
<source id="o"><float_array id="oa" count="6">0 1 0 0 5 0</float_array><technique_common>
<accessor source="#oa" count="2" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="l"><Name_array id="la" count="2">LINEAR LINEAR</Name_array><technique_common>
<accessor source="#la" count="2" stride="1"><param name="INTERPOLATION" type="name"/></accessor></technique_common>
</source>
<sampler id="s"><input semantic="INPUT" source="#i"/><input semantic="OUTPUT" source="#o"/>
<input semantic="INTERPOLATION" source="#l"/></sampler><channel source="#s" target="upper/translate"/>
</animation></library_animations>
<library_visual_scenes><visual_scene id="vs">
<node id="lower" sid="lower" name="lower" type="JOINT">
<node id="upper" sid="upper" name="upper" type="JOINT"><translate sid="translate">0 1 0</translate></node></node>
<node id="body" name="body"><instance_controller url="#c"><skeleton>#lower</skeleton><bind_material>
<technique_common><instance_material symbol="m" target="#clay"/></technique_common></bind_material>
</instance_controller></node>
<node id="eye" name="eye"><translate>0 1 9</translate><instance_camera url="#cam"/></node>
<node id="lamp" name="lamp"><rotate>1 0 0 -90</rotate><instance_light url="#sun"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene>
</COLLADA>
)";

class SceneFormats : public testing::Test {
protected:
    SceneFormats() { std::ofstream(folder_ / "arm.dae") << arm_dae; }

    test::Folder folder_;
};

void expect_moving_arm(const Scene& scene, double unit_m = 1.0)
{
    ASSERT_EQ(scene.skins.size(), 1U);
    EXPECT_EQ(scene.skins[0].joints.size(), 2U);
    ASSERT_EQ(scene.animations.size(), 1U);
    EXPECT_NEAR(scene.animations[0].duration_s, 2.0F, 1e-3F);
    const Bounds rest = scene_bounds(scene, pose_scene(scene, 0.0, no_index));
    EXPECT_NEAR(rest.max.y - rest.min.y, 2.0 * unit_m, 1e-4 * unit_m);
    const Bounds half = scene_bounds(scene, pose_scene(scene, 1.0));
    EXPECT_NEAR(half.max.y - half.min.y, 4.0 * unit_m, 0.05 * unit_m);
    EXPECT_NEAR(half.max.x - half.min.x, unit_m, 1e-4 * unit_m);
}

TEST_F(SceneFormats, DaeArmMovesItsUpperHalf)
{
    const Scene scene = load_with_assimp(folder_ / "arm.dae");
    expect_moving_arm(scene);
    const Material& clay = scene.materials.at(scene.meshes.at(0).primitives.at(0).material);
    EXPECT_EQ(clay.base_color, glm::vec4(0.5F, 0.25F, 0.125F, 1.0F));
}

TEST_F(SceneFormats, DaeCameraAndSunLookWhereTheyShould)
{
    const Scene scene = load_with_assimp(folder_ / "arm.dae");
    const ScenePose pose = pose_scene(scene, 0.0);
    ASSERT_EQ(scene.cameras.size(), 1U);
    const Camera camera = scene_camera(scene, pose, "0");
    EXPECT_NEAR(glm::distance(camera.eye, glm::dvec3(0.0, 1.0, 9.0)), 0.0, 1e-5);
    EXPECT_NEAR(glm::distance(camera.target, glm::dvec3(0.0, 1.0, 8.0)), 0.0, 1e-5);
    EXPECT_NEAR(camera.vertical_fov_rad, 2.0 * std::atan(std::tan(glm::radians(30.0)) / 1.5), 1e-3);

    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].type, LightType::directional);
    EXPECT_NEAR(scene.lights[0].color.z, 0.5F, 1e-5F);
    for (Index index = 0; index < scene.nodes.size(); ++index)
        if (scene.nodes[index].light != no_index) {
            EXPECT_NEAR(pose.world_from_node[index][2].y, 1.0, 1e-5) << "shines down";
        }
}

/// Writes the arm as FBX text. Assimp's exporter takes ticks for seconds, so they are converted first; no
/// importer can read its binary form.
void export_fbx(const std::filesystem::path& dae, const std::filesystem::path& fbx)
{
    Assimp::Importer importer;
    ASSERT_NE(importer.ReadFile(dae.string(), 0), nullptr);
    const std::unique_ptr<aiScene> arm(importer.GetOrphanedScene());
    for (unsigned i = 0; i < arm->mNumAnimations; ++i) {
        aiAnimation& animation = *arm->mAnimations[i];
        aiNodeAnim& channel = *animation.mChannels[0];
        const double ticks = animation.mTicksPerSecond;
        for (unsigned key = 0; key < channel.mNumPositionKeys; ++key) {
            channel.mPositionKeys[key].mTime /= ticks;
            channel.mRotationKeys[key].mTime /= ticks;
            channel.mScalingKeys[key].mTime /= ticks;
        }
        animation.mDuration /= ticks;
        animation.mTicksPerSecond = 1.0;
    }
    Assimp::Exporter exporter;
    ASSERT_EQ(exporter.Export(arm.get(), "fbxa", fbx.string()), aiReturn_SUCCESS)
        << exporter.GetErrorString();
}

TEST_F(SceneFormats, FbxArmMovesItsUpperHalfAndIsInMetres)
{
    export_fbx(folder_ / "arm.dae", folder_ / "arm.fbx");
    expect_moving_arm(load_with_assimp(folder_ / "arm.fbx"), 0.01);
}

TEST_F(SceneFormats, CutFbxIsAnErrorOrAScene)
{
    const std::filesystem::path path = folder_ / "arm.fbx";
    export_fbx(folder_ / "arm.dae", path);
    const uintmax_t size = std::filesystem::file_size(path);
    for (const double part : {0.9, 0.7, 0.5, 0.3, 0.1}) {
        std::filesystem::resize_file(path, static_cast<uintmax_t>(part * static_cast<double>(size)));
        try {
            (void)load_scene(path);
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("arm.fbx"), std::string::npos);
        }
    }
}

} // namespace
} // namespace estampe
