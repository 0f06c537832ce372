// SPDX-License-Identifier: MIT
// KHR_node_visibility, and its animation through KHR_animation_pointer.
#include <gtest/gtest.h>

#include <estampe/default_light.hpp>
#include <estampe/error.hpp>

#include "scene/gltf/test_file.hpp"
#include "scene/scene_limits.hpp"
#include "scene/static_triangles.hpp"
#include "scene/visibility.hpp"

namespace estampe::gltf {
namespace {

/// A triangle at the origin, and one at x = 100 under a node with a sun; `visible` sets that node's
/// visibility.
TestFile two_nodes(bool visible)
{
    TestFile file = triangle_file();
    file.document["extensionsUsed"] = {"KHR_node_visibility", "KHR_lights_punctual"};
    file.document["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "directional"}}});
    file.document["nodes"] = json::parse(R"([
        {"mesh": 0},
        {"name": "Hall", "children": [2], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"mesh": 0, "translation": [100, 0, 0], "extensions": {"KHR_node_visibility": {"visible": true}}}
    ])");
    file.document["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = visible;
    file.document["scenes"] = json::parse(R"([{"nodes": [0, 1]}])");
    return file;
}

TEST(GltfVisibility, AHiddenNodeHidesWhatIsBelowIt)
{
    const Scene shown = two_nodes(true).load();
    const Scene hidden = two_nodes(false).load();
    EXPECT_EQ(visible_nodes(shown), (std::vector<bool>{true, true, true}));
    EXPECT_EQ(visible_nodes(hidden), (std::vector<bool>{true, false, false}));
    EXPECT_EQ(scene_bounds(shown, pose_scene(shown, 0.0)).max.x, 101.0);
    EXPECT_EQ(scene_bounds(hidden, pose_scene(hidden, 0.0)).max.x, 1.0);
    EXPECT_EQ(drawn_size(shown).triangles, 2U);
    EXPECT_EQ(drawn_size(hidden).triangles, 1U);
    EXPECT_EQ(static_triangles(hidden).count(), 1U) << "it throws no shadow in baked light either";
    EXPECT_EQ(default_light(shown), LightChoice::own);
    EXPECT_EQ(default_light(hidden), LightChoice::sun);
    const Camera camera = framing_camera(hidden, pose_scene(hidden, 0.0), 1.5);
    EXPECT_LT(glm::length(camera.target), 5.0) << "the picture is not framed for what is hidden";
    EXPECT_TRUE(hidden.extensions_ignored.empty());
}

TEST(GltfVisibility, HiddenNodesKeepTheirPlacesAndCameras)
{
    Scene scene = two_nodes(false).load();
    scene.cameras.emplace_back();
    scene.nodes[2].camera = 0;
    hide_invisible(scene);
    EXPECT_EQ(scene.nodes[1].light, no_index);
    EXPECT_FALSE(scene.nodes[2].visible) << "it emits neither smoke nor particles";
    EXPECT_EQ(scene.nodes[2].mesh, no_index);
    EXPECT_EQ(scene.nodes[0].mesh, 0U);
    EXPECT_EQ(scene_camera(scene, pose_scene(scene, 0.0), "0").eye.x, 100.0);
}

TEST(GltfVisibility, VisibleIsTheDefaultAndABoolean)
{
    TestFile file = two_nodes(true);
    file.document["nodes"][0]["extensions"]["KHR_node_visibility"] = json::object();
    EXPECT_TRUE(file.load().nodes[0].visible);
    file.document["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = "no";
    EXPECT_THROW((void)file.load(), Error);
}

TEST(GltfVisibility, ASceneOfHiddenNodesIsRefusedWithThatReason)
{
    TestFile file = two_nodes(false);
    file.document["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    try {
        (void)file.load();
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("hidden by KHR_node_visibility"), std::string::npos);
    }
}

TestFile pointer_file(const std::string& pointer)
{
    TestFile file = two_nodes(false);
    const int times = file.add<float>({0, 1}, "SCALAR");
    const int places = file.add<float>({0, 0, 0, 0, 2, 0}, "VEC3");
    file.document["animations"] =
        json::array({{{"samplers", json::array({{{"input", times}, {"output", places}}})},
                      {"channels", json::array({{{"sampler", 0}, {"target", {{"path", "pointer"}}}}})}}});
    file.document["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]
                 ["pointer"] = pointer;
    return file;
}

TEST(GltfAnimationPointer, MovesNodes)
{
    const Scene scene = pointer_file("/nodes/0/translation").load();
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.animations[0].channels.size(), 1U);
    EXPECT_EQ(scene.animations[0].channels[0].path, AnimatedPath::translation);
    EXPECT_NEAR(pose_scene(scene, 0.5).world_from_node[0][3].y, 1.0, 1e-6);
}

TEST(GltfAnimationPointer, SaysWhatIsNotAnimated)
{
    const auto warning = [](const std::string& pointer) {
        const Scene scene = pointer_file(pointer).load();
        EXPECT_EQ(scene.warnings.size(), 1U) << pointer;
        EXPECT_TRUE(scene.animations[0].channels.empty()) << pointer;
        return scene.warnings.empty() ? "" : scene.warnings[0];
    };
    const std::string visibility = warning("/nodes/1/extensions/KHR_node_visibility/visible");
    EXPECT_NE(visibility.find("the visibility of node 1 \"Hall\" is not animated; it stays hidden"),
              std::string::npos)
        << visibility;
    EXPECT_NE(warning("/materials/0/emissiveFactor").find("\"/materials/0/emissiveFactor\" is not animated"),
              std::string::npos);
    for (const char* odd : {"", "/nodes/", "/nodes/3/rotation", "/nodes/-1/scale", "/nodes/0x", "/nodes/0/",
                            "nodes/0/scale", "/nodes/99999999999999/scale"}) {
        EXPECT_NE(warning(odd).find("is not animated"), std::string::npos) << odd;
    }
}

} // namespace
} // namespace estampe::gltf
