// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

TEST(GltfScene, tree_with_matrix_trs_and_negative_scale)
{
    TestFile file = triangle_file();
    file.document["nodes"] = json::parse(R"([
        {"name": "top", "children": [1, 2], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]},
        {"mesh": 0, "translation": [1,2,3], "rotation": [0,0,2e-1,0], "scale": [-1,1,2]},
        {"mesh": 0}
    ])");
    file.document["nodes"][1]["rotation"] = {0, 0, 0.7071068, 0.7071068};
    const Scene scene = file.load();
    ASSERT_EQ(scene.nodes.size(), 3U);
    EXPECT_EQ(scene.roots, (std::vector<Index>{0}));
    EXPECT_EQ(scene.nodes[0].children, (std::vector<Index>{1, 2}));
    EXPECT_EQ(scene.nodes[1].parent, 0U);
    EXPECT_EQ(scene.nodes[0].parent, no_index);
    ASSERT_TRUE(scene.nodes[0].matrix.has_value());
    EXPECT_EQ((*scene.nodes[0].matrix)[3], glm::dvec4(5, 6, 7, 1));
    EXPECT_FALSE(scene.nodes[1].matrix.has_value());
    EXPECT_EQ(scene.nodes[1].transform.translation, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.nodes[1].transform.scale, glm::dvec3(-1, 1, 2));
    EXPECT_NEAR(scene.nodes[1].transform.rotation.z, std::numbers::sqrt2 / 2, 1e-12);
    EXPECT_NEAR(scene.nodes[1].transform.rotation.w, std::numbers::sqrt2 / 2, 1e-12);
}

TEST(GltfScene, only_the_shown_scene_shows_anything)
{
    TestFile file = triangle_file();
    file.document["nodes"] = json::parse(R"([{"mesh": 0}, {"mesh": 0, "children": [2]}, {"mesh": 0}])");
    file.document["scenes"] = json::parse(R"([{"nodes": [0]}, {"name": "second", "nodes": [1]}])");
    file.document["scene"] = 1;
    const Scene scene = file.load();
    EXPECT_EQ(scene.name, "second");
    EXPECT_EQ(scene.nodes[0].mesh, no_index);
    EXPECT_EQ(scene.nodes[1].mesh, 0U);
    EXPECT_EQ(scene.nodes[2].mesh, 0U);
    EXPECT_EQ(scene.roots, (std::vector<Index>{0, 1}));
    file.document.erase("scenes");
    file.document.erase("scene");
    EXPECT_EQ(file.load().nodes[0].mesh, 0U);
}

TEST(GltfScene, cameras_of_both_kinds)
{
    TestFile file = triangle_file();
    file.document["cameras"] = json::parse(R"([
        {"name": "eye", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.125, "aspectRatio": 2}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0.25, "zfar": 10}}
    ])");
    file.document["nodes"][0]["camera"] = 1;
    const Scene scene = file.load();
    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_FALSE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].vertical_fov_rad, 0.5);
    EXPECT_EQ(scene.cameras[0].near_m, 0.125);
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].half_height_m, 2.0);
    EXPECT_EQ(scene.nodes[0].camera, 1U);
}

TEST(GltfScene, lights)
{
    TestFile file = triangle_file();
    file.document["extensionsUsed"] = {"KHR_lights_punctual"};
    file.document["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 3},
        {"type": "point", "range": 7, "name": "bulb"},
        {"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}
    ])");
    file.document["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 2;
    const Scene scene = file.load();
    ASSERT_EQ(scene.lights.size(), 3U);
    EXPECT_EQ(scene.lights[0].type, LightType::directional);
    EXPECT_EQ(scene.lights[0].color, glm::vec3(1, 0.5F, 0));
    EXPECT_EQ(scene.lights[0].intensity, 3.0F);
    EXPECT_EQ(scene.lights[1].type, LightType::point);
    EXPECT_EQ(scene.lights[1].range_m, 7.0F);
    EXPECT_EQ(scene.lights[1].color, glm::vec3(1));
    EXPECT_EQ(scene.lights[2].type, LightType::spot);
    EXPECT_EQ(scene.lights[2].inner_cone_rad, 0.25F);
    EXPECT_EQ(scene.lights[2].outer_cone_rad, 0.5F);
    EXPECT_EQ(scene.nodes[0].light, 2U);
}

TestFile skinned_file()
{
    TestFile file = triangle_file();
    file.attributes()["JOINTS_0"] = file.add<uint8_t>({0, 1, 9, 9, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    file.attributes()["WEIGHTS_0"] = file.add<float>({1, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    file.document["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0}, {"children": [2]}, {}])");
    std::vector<float> matrices(32, 0.0F);
    for (size_t i = 0; i < 32; i += i % 16 == 15 ? 1 : 5) {
        matrices[i] = 1.0F;
    }
    matrices[16 + 12] = -4.0F;
    file.document["skins"] =
        json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", file.add(matrices, "MAT4")}}});
    return file;
}

TEST(GltfScene, skin_with_one_set)
{
    const Scene scene = skinned_file().load();
    ASSERT_EQ(scene.skins.size(), 1U);
    EXPECT_EQ(scene.skins[0].joints, (std::vector<Index>{1, 2}));
    EXPECT_EQ(scene.skins[0].joint_from_bind[0], glm::mat4(1.0F));
    EXPECT_EQ(scene.skins[0].joint_from_bind[1][3], glm::vec4(-4, 0, 0, 1));
    EXPECT_EQ(scene.nodes[0].skin, 0U);
    const Primitive& primitive = scene.meshes[0].primitives[0];
    EXPECT_EQ(primitive.joints_0[0], glm::u16vec4(0, 1, 0, 0)) << "joints without weight become joint 0";
    EXPECT_EQ(primitive.weights_0[0], glm::vec4(.5F, .5F, 0, 0));
    EXPECT_EQ(primitive.weights_0[2], glm::vec4(1, 0, 0, 0));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("WEIGHTS_0: 1 vertices have no usable skin weight"), std::string::npos);
}

TEST(GltfScene, skin_with_two_sets)
{
    TestFile file = skinned_file();
    file.attributes()["JOINTS_1"] = file.add<uint16_t>({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    file.attributes()["WEIGHTS_1"] =
        file.add<uint8_t>({255, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0}, "VEC4", {{"normalized", true}});
    const Scene scene = file.load();
    const Primitive& primitive = scene.meshes[0].primitives[0];
    EXPECT_NEAR(primitive.weights_0[0].x, 1.0F / 3.0F, 1e-6F);
    EXPECT_NEAR(primitive.weights_1[0].x, 1.0F / 3.0F, 1e-6F);
    EXPECT_EQ(primitive.joints_1[0], glm::u16vec4(1, 0, 0, 0));
    EXPECT_EQ(primitive.weights_1[2], glm::vec4(1, 0, 0, 0));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfScene, skin_without_matrices_or_weights)
{
    TestFile file = skinned_file();
    file.document["skins"][0].erase("inverseBindMatrices");
    file.attributes().erase("JOINTS_0");
    const Scene scene = file.load();
    EXPECT_EQ(scene.skins[0].joint_from_bind, std::vector<glm::mat4>(2, glm::mat4(1.0F)));
    EXPECT_EQ(scene.nodes[0].skin, no_index);
    EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(GltfScene, gpu_instancing)
{
    TestFile file = triangle_file();
    file.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    file.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", file.add<float>({1, 2, 3, 4, 5, 6}, "VEC3")},
        {"ROTATION", file.add<int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", {{"normalized", true}})},
        {"SCALE", file.add<float>({1, 1, 1, 2, 3, 4}, "VEC3")}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.nodes[0].instances.size(), 2U);
    EXPECT_EQ(scene.nodes[0].instances[0][3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(scene.nodes[0].instances[1] * glm::vec4(1, 1, 1, 1), glm::vec4(4 - 2, 5 - 3, 6 + 4, 1));
}

TEST(GltfScene, instances_in_the_same_place_are_one)
{
    TestFile file = triangle_file();
    json& attributes = file.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] =
        json::object();
    attributes["TRANSLATION"] = file.add<float>({4, 5, 6, 1, 2, 3, 4, 5, 6, 1, 2, 3, 1, 2, 4}, "VEC3");
    const Scene scene = file.load();
    ASSERT_EQ(scene.nodes[0].instances.size(), 3U) << "the first of each, in the order of the file";
    EXPECT_EQ(scene.nodes[0].instances[0][3], glm::vec4(4, 5, 6, 1));
    EXPECT_EQ(scene.nodes[0].instances[1][3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(scene.nodes[0].instances[2][3], glm::vec4(1, 2, 4, 1));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("EXT_mesh_gpu_instancing: 2 instances stand exactly where another does"),
              std::string::npos);
    // The accessor has no buffer, so all values are zero: a file of a kilobyte asks for half a million
    // copies.
    attributes["TRANSLATION"] =
        file.add_accessor({{"componentType", 5126}, {"count", 500000}, {"type", "VEC3"}});
    EXPECT_EQ(file.load().nodes[0].instances.size(), 1U);
}

TestFile animated_file(const std::string& path, const std::string& interpolation, int times, int values,
                       TestFile file)
{
    file.document["animations"] = json::array(
        {{{"name", "move"},
          {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}})},
          {"samplers",
           json::array({{{"input", times}, {"output", values}, {"interpolation", interpolation}}})}}});
    return file;
}

TEST(GltfScene, animation_interpolations)
{
    TestFile file = triangle_file();
    const int times = file.add<float>({0, 0.5F, 2}, "SCALAR");
    const int moves = file.add<float>({0, 0, 0, 1, 1, 1, 2, 2, 2}, "VEC3");
    const int splines = file.add(std::vector<float>(27, 1.0F), "VEC3");
    Scene scene = animated_file("translation", "STEP", times, moves, file).load();
    ASSERT_EQ(scene.animations.size(), 1U);
    EXPECT_EQ(scene.animations[0].name, "move");
    EXPECT_EQ(scene.animations[0].duration_s, 2.0F);
    ASSERT_EQ(scene.animations[0].channels.size(), 1U);
    EXPECT_EQ(scene.animations[0].channels[0].interpolation, Interpolation::step);
    EXPECT_EQ(scene.animations[0].channels[0].path, AnimatedPath::translation);
    EXPECT_EQ(scene.animations[0].channels[0].times_s, (std::vector<float>{0, 0.5F, 2}));
    EXPECT_EQ(scene.animations[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 1, 1, 2, 2, 2}));
    scene = animated_file("scale", "LINEAR", times, moves, file).load();
    EXPECT_EQ(scene.animations[0].channels[0].interpolation, Interpolation::linear);
    EXPECT_EQ(scene.animations[0].channels[0].path, AnimatedPath::scale);
    scene = animated_file("scale", "CUBICSPLINE", times, splines, file).load();
    EXPECT_EQ(scene.animations[0].channels[0].interpolation, Interpolation::cubic_spline);
    EXPECT_EQ(scene.animations[0].channels[0].values.size(), 27U);
}

TEST(GltfScene, animated_rotation_from_normalised_shorts)
{
    TestFile file = triangle_file();
    const int times = file.add<float>({0, 1}, "SCALAR");
    const int turns = file.add<int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0}, "VEC4", {{"normalized", true}});
    const Scene scene = animated_file("rotation", "LINEAR", times, turns, file).load();
    EXPECT_EQ(scene.animations[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0}));
}

TEST(GltfScene, animated_morph_weights)
{
    TestFile file = triangle_file();
    file.primitive()["targets"] = json::array({{{"POSITION", 0}}, {{"POSITION", 0}}});
    const int times = file.add<float>({0, 1}, "SCALAR");
    const int weights = file.add<float>({0, 1, 1, 0}, "SCALAR");
    const Scene scene = animated_file("weights", "LINEAR", times, weights, file).load();
    EXPECT_EQ(scene.animations[0].channels[0].path, AnimatedPath::weights);
    EXPECT_EQ(scene.animations[0].channels[0].values, (std::vector<float>{0, 1, 1, 0}));
}

TEST(GltfScene, animation_keys_out_of_order_are_sorted_with_a_warning)
{
    TestFile file = triangle_file();
    const int times = file.add<float>({1, 0}, "SCALAR");
    const int moves = file.add<float>({1, 2, 3, 4, 5, 6}, "VEC3");
    const Scene scene = animated_file("translation", "LINEAR", times, moves, file).load();
    EXPECT_EQ(scene.animations[0].channels[0].times_s, (std::vector<float>{0, 1}));
    EXPECT_EQ(scene.animations[0].channels[0].values, (std::vector<float>{4, 5, 6, 1, 2, 3}));
    EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(GltfScene, animation_of_nothing_is_left_out)
{
    TestFile file = triangle_file();
    const int times = file.add<float>({0, 1}, "SCALAR");
    const int moves = file.add<float>({1, 2, 3, 4, 5, 6}, "VEC3");
    TestFile animated = animated_file("translation", "LINEAR", times, moves, file);
    animated.document["animations"][0]["channels"][0]["target"].erase("node");
    EXPECT_TRUE(animated.load().animations[0].channels.empty());
    animated = animated_file("pointer", "LINEAR", times, moves, file);
    EXPECT_EQ(animated.load().warnings.size(), 1U);
}

TEST(GltfScene, extensions_are_listed)
{
    TestFile file = triangle_file();
    file.document["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_sheen"};
    const Scene scene = file.load();
    EXPECT_EQ(scene.extensions_used,
              (std::vector<std::string>{"KHR_materials_unlit", "KHR_materials_sheen"}));
    EXPECT_EQ(scene.extensions_ignored, (std::vector<std::string>{"KHR_materials_sheen"}));
    EXPECT_EQ(scene.file_unit_m, 1.0);
}

TEST(GltfScene, deep_tree_is_no_trouble)
{
    TestFile file = triangle_file();
    constexpr int depth = 50000;
    json nodes = json::array();
    for (int i = 0; i + 1 < depth; ++i) {
        nodes.push_back({{"children", {i + 1}}});
    }
    nodes.push_back({{"mesh", 0}});
    file.document["nodes"] = nodes;
    EXPECT_EQ(file.load().nodes.size(), static_cast<size_t>(depth));
}

} // namespace
} // namespace estampe::gltf
