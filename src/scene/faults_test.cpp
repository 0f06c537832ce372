// SPDX-License-Identifier: MIT
// What is found in scenes that a program made. The tests of crossing.hpp damage each array and index in turn.
#include "scene/scene_limits.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

Scene sound_scene()
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    scene.materials[0].name = "oak";
    scene.meshes[0].name = "box";
    test::add_sun(scene, {1.0, 2.0, 1.5});
    scene.cameras.emplace_back();
    scene.animations = {{.name = "slide",
                         .channels = {{.node = 0, .times_s = {0.0F, 1.0F}, .values = {0, 0, 0, 1, 0, 0}}},
                         .duration_s = 1.0F}};
    return scene;
}

std::string fault_after(const std::function<void(Scene&)>& damage)
{
    Scene scene = sound_scene();
    damage(scene);
    const std::vector<std::string> found = faults(scene);
    return found.empty() ? "" : found.front();
}

TEST(Faults, ASoundSceneHasNone)
{
    EXPECT_EQ(faults(sound_scene()), std::vector<std::string>());
    EXPECT_NO_THROW(check_faults(sound_scene(), "here"));
}

TEST(Faults, NameThePlaceAndTheNumbers)
{
    EXPECT_EQ(fault_after([](Scene& scene) { scene.meshes[0].primitives[0].indices[5] = 24; }),
              "meshes[0] \"box\", primitives[0]: indices[5] is 24, but the number of positions is 24");
    EXPECT_EQ(fault_after([](Scene& scene) { scene.meshes[0].primitives[0].material = 7; }),
              "meshes[0] \"box\", primitives[0]: material is 7, but the number of materials is 1");
    EXPECT_EQ(fault_after([](Scene& scene) { scene.materials[0].normal_texture.texture = 0; }),
              "materials[0] \"oak\": normal_texture is 0, but the number of textures is 0");
    EXPECT_EQ(fault_after([](Scene& scene) { scene.meshes[0].primitives[0].normals.pop_back(); }),
              "meshes[0] \"box\", primitives[0]: normals has 23 items, but must be empty or have 24");
    EXPECT_EQ(fault_after([](Scene& scene) {
                  scene.nodes[0].children = {0};
                  scene.nodes[0].parent = 0;
                  scene.roots.clear();
              }),
              "nodes[0]: is neither in roots nor below a node of roots");
    EXPECT_EQ(fault_after([](Scene& scene) { scene.materials.clear(); }),
              "meshes[0] \"box\", primitives[0]: material is 0, but the number of materials is 0");
}

TEST(Faults, NumbersThatCannotBeDrawnWith)
{
    const std::vector<std::pair<std::string, std::function<void(Scene&)>>> cases = {
        {"positions", [](Scene& scene) { scene.meshes[0].primitives[0].positions[23].z = not_a_number; }},
        {"normals", [](Scene& scene) { scene.meshes[0].primitives[0].normals[0].x = infinite; }},
        {"uvs",
         [](Scene& scene) {
             scene.meshes[0].primitives[0].uvs[0] = std::vector(24, glm::vec2(not_a_number));
         }},
        {"colours", [](Scene& scene) { scene.materials[0].base_color.y = not_a_number; }},
        {"factors", [](Scene& scene) { scene.materials[0].roughness = infinite; }},
        {"place", [](Scene& scene) { scene.nodes[0].transform.translation.x = not_a_number; }},
        {"last row", [](Scene& scene) { scene.nodes[0].matrix = glm::dmat4(2.0); }},
        {"instance", [](Scene& scene) { scene.nodes[0].instances = {glm::mat4(not_a_number)}; }},
        {"intensity", [](Scene& scene) { scene.lights[0].intensity = -1.0F; }},
        {"radius", [](Scene& scene) { scene.lights[0].radius_m = infinite; }},
        {"cone",
         [](Scene& scene) {
             scene.lights[0].type = LightType::spot;
             scene.lights[0].inner_cone_rad = 1.0F;
         }},
        {"angle of view", [](Scene& scene) { scene.cameras[0].vertical_fov_rad = 0.0; }},
        {"times or values", [](Scene& scene) { scene.animations[0].channels[0].values[2] = not_a_number; }},
        {"corners", [](Scene& scene) { scene.cells = {{.low_m = glm::dvec3(not_a_number)}}; }},
        {"3 to 12", [](Scene& scene) { scene.portals.emplace_back(); }}};
    for (const auto& [word, damage] : cases)
        EXPECT_NE(fault_after(damage).find(word), std::string::npos) << word << ": " << fault_after(damage);
}

TEST(Faults, AreListedUpToAHundredAndTheFirstIsThrown)
{
    Scene scene = sound_scene();
    for (int i = 0; i < 500; ++i) {
        scene.nodes.push_back({.mesh = 9});
        scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    }
    EXPECT_EQ(faults(scene).size(), 100U);
    try {
        check_faults(scene, "here");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find("here: nodes["), 0U) << error.what();
        EXPECT_NE(std::string(error.what()).find("(and 99 more)"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace estampe
