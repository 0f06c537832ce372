// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/image_codec.hpp"
#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

TestFile lamp_file(const char* extras)
{
    TestFile file = triangle_file();
    file.document["extensionsUsed"] = {"KHR_lights_punctual"};
    file.document["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({{{"type", "spot"}, {"spot", json::object()}, {"extras", json::parse(extras)}}});
    return file;
}

/// The only warning of a load that must succeed.
std::string warning(const TestFile& file)
{
    const Scene scene = file.load();
    EXPECT_EQ(scene.warnings.size(), 1U);
    return scene.warnings.empty() ? "" : scene.warnings[0];
}

TEST(GltfExtras, OfALight)
{
    const Light light = lamp_file(R"({"estampe": {"falloff": "unit_volume", "shape": "pyramid",
                                     "groups": [1, 3], "casters": [16]}, "other": 5})")
                            .load()
                            .lights[0];
    EXPECT_EQ(light.falloff, LightFalloff::unit_volume);
    EXPECT_EQ(light.shape, SpotShape::pyramid);
    EXPECT_EQ(light.groups, 0b101);
    EXPECT_EQ(light.casters, 0x8000);
    EXPECT_EQ(light.type, LightType::spot);
    EXPECT_FALSE(light.radius_m);
    EXPECT_EQ(lamp_file(R"({"estampe": {"radius": 0.25}})").load().lights[0].radius_m, 0.25F);
    EXPECT_EQ(lamp_file(R"({"estampe": {"radius": 0}})").load().lights[0].radius_m, 0.0F);
    EXPECT_EQ(lamp_file(R"({"estampe": {"shadows": false}})").load().lights[0].casters, 0);
    EXPECT_EQ(lamp_file(R"({"estampe": {"shadows": true}})").load().lights[0].casters, all_groups);
    EXPECT_EQ(lamp_file(R"({"estampe": {"type": "ambient"}})").load().lights[0].type, LightType::ambient);
    EXPECT_EQ(lamp_file(R"("a word")").load().lights[0], (Light{.type = LightType::spot}));
}

TEST(GltfExtras, OfNodesGoDownAndOfMaterials)
{
    TestFile file = triangle_file();
    file.document["nodes"] = json::parse(R"([
        {"children": [1, 2], "extras": {"estampe": {"groups": [2], "casts": false}}},
        {"mesh": 0},
        {"mesh": 0, "extras": {"estampe": {"casts": [1, 2], "receives": false}}},
        {"mesh": 0}
    ])");
    file.document["scenes"] = json::parse(R"([{"nodes": [0, 3]}])");
    file.document["materials"] = json::parse(R"([{"extras": {"estampe": {"casts": true, "groups": [4]}}}])");
    const Scene scene = file.load();
    EXPECT_EQ(scene.nodes[1].links, (LightLinks{.lit_by = 2, .casts_for = 0}));
    EXPECT_EQ(scene.nodes[2].links, (LightLinks{.lit_by = 2, .casts_for = 3, .receives_shadows = false}));
    EXPECT_EQ(scene.nodes[3].links, LightLinks{});
    EXPECT_EQ(scene.materials[0].links, LightLinks{.lit_by = 8});
}

TEST(GltfExtras, SayWhatIsClothAndWhatItRunsInto)
{
    TestFile file = triangle_file();
    file.document["nodes"] = json::parse(R"([
        {"mesh": 0, "name": "Cloth_flag"},
        {"mesh": 0, "name": "clothes", "extras": {"estampe": {"collider": "capsule"}}},
        {"mesh": 0, "extras": {"estampe": {"cloth": {"density": 0.5, "self": 0.02, "solver": "block_descent", "tear": 1.2}}}},
        {"mesh": 0, "name": "cloth", "extras": {"estampe": {"cloth": false}}}
    ])");
    file.document["scenes"] = json::parse(R"([{"nodes": [0, 1, 2, 3]}])");
    const Scene scene = file.load();
    EXPECT_EQ(scene.nodes[0].cloth, Cloth{});
    EXPECT_FALSE(scene.nodes[1].cloth);
    EXPECT_EQ(scene.nodes[1].collider, ClothCollider::capsule);
    EXPECT_EQ(
        scene.nodes[2].cloth,
        (Cloth{.density_kg_m2 = 0.5F, .self_m = 0.02F, .tear = 1.2F, .solver = ClothSolver::block_descent}));
    EXPECT_FALSE(scene.nodes[3].cloth);
    file.document["materials"] = json::parse(R"([{"name": "CLOTH.001"}])");
    file.document["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_TRUE(file.load().materials[0].cloth);
    file.document["materials"][0].erase("name");
    file.document["nodes"][0].erase("name");
    file.document["nodes"][2]["extras"]["estampe"]["cloth"]["weight"] = 1;
    EXPECT_EQ(warning(file).find("test.glb#/nodes/2/extras/estampe/cloth/weight: is not known"), 0U);
    EXPECT_EQ(file.load().nodes[2].cloth, scene.nodes[2].cloth) << "the other keys count";
}

TEST(GltfExtras, TexturesAndColoursSayHowMuchClothIsHeld)
{
    TestFile file = triangle_file();
    file.document["nodes"][0]["name"] = "cloth";
    EXPECT_TRUE(file.load().meshes[0].primitives[0].held.empty());
    json& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] =
        file.add(std::vector<float>{1.0F, 0.2F, 0.0F, 0.25F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F}, "VEC3");
    const Primitive coloured = file.load().meshes[0].primitives[0];
    EXPECT_EQ(coloured.held, (std::vector<float>{1.0F, 0.25F, 0.0F}));
    EXPECT_TRUE(coloured.colors.empty()); // they are not drawn as colours
    attributes["TEXCOORD_0"] = file.add(std::vector<float>{0.25F, 0.5F, 0.75F, 0.5F, 0.5F, 0.5F}, "VEC2");
    const Bytes image = encode_png({.width = 2, .height = 1, .rgba = {255, 0, 9, 255, 51, 200, 9, 255}});
    file.document["images"] =
        json::array({{{"bufferView", file.add_view(image)}, {"mimeType", "image/png"}}});
    file.document["textures"] = json::parse(R"([{"source": 0}])");
    file.document["nodes"][0]["extras"] = json::parse(R"({"estampe": {"cloth": {"held": 0}}})");
    const std::vector<float> held = file.load().meshes[0].primitives[0].held;
    ASSERT_EQ(held.size(), 3U);
    EXPECT_NEAR(held[0], 1.0F, 1e-5F);
    EXPECT_NEAR(held[1], 0.2F, 1e-5F);
    EXPECT_NEAR(held[2], 0.6F, 1e-5F);
    const json picture = file.document["images"][0];
    file.document["images"][0] = {{"uri", "missing.png"}};
    const Primitive without = file.load().meshes[0].primitives[0];
    EXPECT_EQ(without.held, coloured.held) << "a picture that is missing holds nothing";
    file.document["images"][0] = picture;
    file.document["nodes"][0]["extras"] = json::parse(R"({"estampe": {"cloth": {"held": 3}}})");
    EXPECT_EQ(warning(file).find("test.glb#/nodes/0/extras/estampe/cloth/held: should be the number"), 0U);
    file.document["nodes"][0]["extras"] = json::parse(R"({"estampe": {"cloth": {"back": 7}}})");
    EXPECT_EQ(warning(file).find("test.glb#/nodes/0/extras/estampe/cloth/back: should be the number"), 0U);
}

TEST(GltfExtras, ClothByItsNameAloneThatNothingHoldsIsAWarning)
{
    TestFile file = triangle_file();
    file.document["materials"] = json::parse(R"([{"name": "Cloth.red"}])");
    file.primitive()["material"] = 0;
    const char* const start =
        "test.glb#/nodes/0: node 0 is simulated as cloth because of the name \"cloth\", "
        "and falls down, because nothing holds it";
    EXPECT_EQ(warning(file).find(start), 0U) << warning(file);
    file.document["materials"][0]["extras"] = json::parse(R"({"estampe": {"cloth": true}})");
    EXPECT_TRUE(file.load().warnings.empty());
    file.document["materials"][0]["extras"] = json::parse(R"({"estampe": {"cloth": false}})");
    EXPECT_TRUE(file.load().warnings.empty());
    EXPECT_FALSE(file.load().materials[0].cloth);
    file.document["materials"][0].erase("extras");
    file.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        file.add(std::vector<float>{1.0F, 0.2F, 0.0F, 0.25F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F}, "VEC3");
    EXPECT_TRUE(file.load().warnings.empty()) << "the flag hangs by a corner";
}

TEST(GltfExtras, MistakesAreWarningsThatNameThePlace)
{
    const std::string light = "test.glb#/extensions/KHR_lights_punctual/lights/0/extras/estampe";
    const auto of_light = [](const char* ours) {
        return warning(lamp_file((std::string(R"({"estampe": )") + ours + "}").c_str()));
    };
    EXPECT_EQ(of_light("5").find(light + ": should be an object"), 0U) << of_light("5");
    EXPECT_EQ(of_light(R"({"fallof": 1})").find(light + "/fallof: is not known (allowed: casters"), 0U);
    EXPECT_EQ(of_light(R"({"falloff": "cubic"})").find(light + "/falloff: should be one of"), 0U);
    EXPECT_EQ(of_light(R"({"falloff": 1})").find(light + "/falloff: should be one of"), 0U);
    EXPECT_EQ(of_light(R"({"shadows": 2})").find(light + "/shadows: should be true or false"), 0U);
    EXPECT_EQ(of_light(R"({"radius": -1})").find(light + "/radius: should be a number"), 0U);
    EXPECT_EQ(of_light(R"({"radius": "wide"})").find(light + "/radius: should be a number"), 0U);
    EXPECT_EQ(of_light(R"({"groups": "all"})").find(light + "/groups: should be an array"), 0U);
    EXPECT_EQ(of_light(R"({"groups": [1, 17]})").find(light + "/groups: should be an array of groups"), 0U);
    EXPECT_EQ(of_light(R"({"groups": [0.5]})").find(light + "/groups: should be an array of groups"), 0U);
    const Scene scene = lamp_file(R"({"estampe": {"fallof": 1, "groups": [99], "casters": [2]}})").load();
    EXPECT_EQ(scene.warnings.size(), 2U);
    EXPECT_EQ(scene.lights[0], (Light{.type = LightType::spot, .casters = 2})) << "what is right counts";
}

TEST(GltfExtras, WarningsNameWhoseTheyAreAndAreSaidOnce)
{
    TestFile file = triangle_file();
    file.document["nodes"][0]["name"] = "Flag";
    file.document["nodes"][0]["extras"] = json::parse(R"({"estampe": {"receives": "perhaps"}})");
    EXPECT_EQ(warning(file),
              "test.glb#/nodes/0/extras/estampe/receives: should be true or false; node \"Flag\" "
              "is drawn without it");
    file.document["nodes"][0]["extras"] =
        json::parse(R"({"estampe": [1]})"); // several readers check this object
    EXPECT_EQ(warning(file),
              "test.glb#/nodes/0/extras/estampe: should be an object; node \"Flag\" is drawn without it");
    file.document["nodes"][0].erase("extras");
    file.document["materials"] = json::parse(R"([{"extras": {"estampe": {"cloth": "silk"}}}])");
    EXPECT_EQ(warning(file),
              "test.glb#/materials/0/extras/estampe/cloth: should be true, false or an object; "
              "material 0 is drawn without it");
}

TEST(GltfExtras, AreReadAsBlenderWritesCustomProperties)
{
    for (const char* yes : {"true", "1", "1.0", R"("1")", R"("true")", R"("True")"}) {
        const std::string text = std::string(R"({"estampe": {"shadows": )") + yes + "}}";
        const Scene scene = lamp_file(text.c_str()).load();
        EXPECT_EQ(scene.lights[0].casters, all_groups) << yes;
        EXPECT_TRUE(scene.warnings.empty()) << yes;
    }
    for (const char* no : {"false", "0", "0.0", R"("0")", R"("false")"}) {
        const std::string text = std::string(R"({"estampe": {"shadows": )") + no + "}}";
        EXPECT_EQ(lamp_file(text.c_str()).load().lights[0].casters, 0) << no;
    }
    const Light light =
        lamp_file(
            R"({"estampe": {"radius": "0.25", "groups": [1.0, "3"], "casters": 2, "shape": "Pyramid"}})")
            .load()
            .lights[0];
    EXPECT_EQ(light.radius_m, 0.25F);
    EXPECT_EQ(light.groups, 0b101);
    EXPECT_EQ(light.casters, 0b10);
    EXPECT_EQ(light.shape, SpotShape::pyramid);
    TestFile file = triangle_file();
    file.document["materials"] = json::parse(R"([{"extras": {"estampe": {"receives": 0}}}])");
    file.document["nodes"] = json::parse(R"([
        {"mesh": 0, "extras": {"estampe": {"cloth": 1, "casts": 0}}},
        {"mesh": 0, "name": "cloth", "extras": {"estampe": {"cloth": "0", "casts": "1"}}},
        {"mesh": 0, "extras": {"estampe": {"cloth": {"density": "0.5", "back": 0.0}}}}
    ])");
    file.document["scenes"] = json::parse(R"([{"nodes": [0, 1, 2]}])");
    const Scene scene = file.load();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_FALSE(scene.materials[0].links.receives_shadows);
    EXPECT_EQ(scene.nodes[0].cloth, Cloth{});
    EXPECT_EQ(scene.nodes[0].links.casts_for, 0);
    EXPECT_FALSE(scene.nodes[1].cloth);
    EXPECT_EQ(scene.nodes[1].links.casts_for, all_groups);
    EXPECT_EQ(scene.nodes[2].cloth, (Cloth{.density_kg_m2 = 0.5F, .back_material = 0}));
}

} // namespace
} // namespace estampe::gltf
