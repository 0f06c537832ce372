// SPDX-License-Identifier: MIT
// Lightmaps that scene files name.
#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/lightmap.hpp>

#include "core/exr.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "scene/gltf/test_file.hpp"
#include "scene/static_triangles.hpp"
#include "support/folder.hpp"

namespace estampe::gltf {
namespace {

class NamedLightmap : public ::testing::Test {
protected:
    NamedLightmap()
    {
        const Image grey{.width = 1, .height = 1, .rgba = {188, 188, 188, 255}};
        write_file_atomically(folder_ / "grey.png", encode_png(grey));
        write_file_atomically(folder_ / "light.exr",
                              encode_exr({.image = {.width = 1, .height = 1, .texels = {glm::vec3(2.5F)}}}));
        file_.document["nodes"] = json::parse(R"([{"children": [1]}, {"mesh": 0}])");
        file_.document["materials"] = json::array({json::object(), json::object()});
    }

    [[nodiscard]] std::optional<Lightmap> named() const
    {
        write_file_atomically(folder_ / "scene.glb", file_.glb());
        return named_lightmap(folder_ / "scene.glb");
    }

    [[nodiscard]] std::string failure() const
    {
        try {
            static_cast<void>(named());
        } catch (const Error& error) {
            return error.what();
        }
        return "reads";
    }

    static json ours(const char* text)
    {
        json extras;
        extras["estampe"]["lightmap"] = json::parse(text);
        return extras;
    }

    test::Folder folder_;
    TestFile file_ = triangle_file();
};

TEST_F(NamedLightmap, AFileThatNamesNoneHasNone)
{
    EXPECT_FALSE(named());
    file_.document["nodes"][0]["name"] = "lightmap"; // a word alone names no lightmap
    EXPECT_FALSE(named());
    EXPECT_FALSE(named_lightmap(folder_ / "other.obj"));
}

TEST_F(NamedLightmap, OfMaterialsNodesAndTheScene)
{
    file_.document["materials"][1]["extras"] = ours(R"({"uri": "grey.png"})");
    file_.document["nodes"][0]["extras"] = ours(R"({"uri": "light.exr", "texCoord": 0, "intensity": 0.5})");
    file_.document["scenes"][0]["extras"] = ours(R"({"uri": "grey.png", "intensity": 2})");
    const auto map = named();
    ASSERT_TRUE(map);
    ASSERT_EQ(map->pictures.size(), 2U); // the same file is read once
    EXPECT_NEAR(map->pictures[0].texels[0].y, 0.503F, 0.002F);
    EXPECT_EQ(map->pictures[1].texels[0].y, 2.5F);
    EXPECT_FALSE(map->of_material[0]);
    EXPECT_EQ(map->of_material[1], (WornPicture{.picture = 0, .uv_set = 1}));
    const WornPicture of_node{.picture = 1, .uv_set = 0, .intensity = 0.5F};
    EXPECT_EQ(map->of_node[0], of_node);
    EXPECT_EQ(map->of_node[1], of_node); // inherited from the parent
    EXPECT_EQ(map->of_scene, (WornPicture{.picture = 0, .uv_set = 1, .intensity = 2.0F}));
    // The rest of the importer ignores lightmaps.
    EXPECT_EQ(load_scene(folder_ / "scene.glb").nodes.size(), 2U);
}

TEST_F(NamedLightmap, ByTextureAndByMozLightmap)
{
    const int view = file_.add_view(read_file(folder_ / "grey.png"));
    file_.document["images"] =
        json::array({{{"bufferView", view}, {"mimeType", "image/png"}}, {{"uri", "grey.png"}}});
    file_.document["textures"] = json::array({{{"source", 0}}, {{"source", 1}}});
    file_.document["extensionsUsed"] = json::array({"MOZ_lightmap"});
    file_.document["materials"][0]["extensions"]["MOZ_lightmap"] =
        json::parse(R"({"index": 0, "texCoord": 1, "intensity": 3})");
    file_.document["materials"][1]["extras"] = ours(R"({"texture": 1})");
    const auto map = named();
    ASSERT_TRUE(map);
    ASSERT_EQ(map->pictures.size(), 2U);
    EXPECT_EQ(map->pictures[0], map->pictures[1]);
    EXPECT_EQ(map->of_material[0], (WornPicture{.picture = 0, .uv_set = 1, .intensity = 3.0F}));
    EXPECT_EQ(map->of_material[1], (WornPicture{.picture = 1, .uv_set = 1}));
    EXPECT_TRUE(load_scene(folder_ / "scene.glb").extensions_ignored.empty());
}

TEST_F(NamedLightmap, TheSceneMayNameABakedMap)
{
    const Lightmap baked{.light = {.width = 1, .height = 1, .texels = {glm::vec3(0.5F)}},
                         .corners = std::vector<glm::vec2>(3, glm::vec2(0.5F)),
                         .geometry = geometry_fingerprint(static_triangles(file_.load())),
                         .exposure = 2.0F};
    save_lightmap(baked, folder_ / "room.exr");
    file_.document["scenes"][0]["extras"] = ours(R"({"uri": "room.exr"})");
    EXPECT_EQ(named(), baked);
    // For a material, the file is an ordinary picture.
    file_.document["scenes"][0].erase("extras");
    file_.document["materials"][0]["extras"] = ours(R"({"uri": "room.exr"})");
    ASSERT_TRUE(named());
    EXPECT_EQ(named()->pictures.size(), 1U);
}

TEST_F(NamedLightmap, ErrorsNameThePlace)
{
    json& extras = file_.document["materials"][0]["extras"];
    const std::string place = (folder_ / "scene.glb").string() + "#/materials/0/extras/estampe/lightmap";
    const auto of = [&](const char* text) {
        extras = ours(text);
        return failure();
    };
    const std::string missing = of(R"({"uri": "none.png"})");
    EXPECT_EQ(missing.find(place + "/uri: names a lightmap that cannot be read"), 0U) << missing;
    EXPECT_NE(missing.find("none.png"), std::string::npos) << missing;
    EXPECT_NE(of(R"({"uri": "../grey.png"})").find("cannot be read"), std::string::npos);
}

TEST_F(NamedLightmap, MistakesInItsKeysAreWarningsOfTheScene)
{
    json& material = file_.document["materials"][0];
    material["name"] = "Wall";
    const std::string place = (folder_ / "scene.glb").string() + "#/materials/0/extras/estampe/lightmap";
    const auto warning = [&](const char* text) {
        material["extras"] = ours(text);
        static_cast<void>(named()); // named() writes the file
        const Scene scene = load_scene(folder_ / "scene.glb");
        EXPECT_EQ(scene.warnings.size(), 1U) << text;
        return scene.warnings.empty() ? "" : scene.warnings[0];
    };
    EXPECT_EQ(warning("5"), place + ": should be an object; material \"Wall\" is drawn without it");
    EXPECT_EQ(warning(R"({"intensity": 1})").find(place + ": names no picture"), 0U);
    EXPECT_EQ(warning(R"({"uri": "grey.png", "texture": 0})").find(place + ": names a picture twice"), 0U);
    EXPECT_EQ(warning(R"({"texture": 0})").find(place + "/texture: should be one of"), 0U);
    EXPECT_EQ(warning(R"({"uri": 5})").find(place + "/uri: should be text"), 0U);
    EXPECT_FALSE(named()) << "what names no picture is none";
    EXPECT_EQ(warning(R"({"uri": "grey.png", "texCoord": 2})").find(place + "/texCoord: should be 0 or 1"),
              0U);
    EXPECT_EQ(warning(R"({"uri": "grey.png", "intensity": -1})").find(place + "/intensity: should be"), 0U);
    EXPECT_EQ(warning(R"({"uri": "grey.png", "strength": 1})").find(place + "/strength: is not known"), 0U);
    const WornPicture plain{.picture = 0, .uv_set = 1};
    EXPECT_EQ(named()->of_material[0], plain) << "the other keys count";
    material["extras"] = ours(R"({"uri": "grey.png", "texCoord": "0", "intensity": "0.5"})");
    const WornPicture typed{.picture = 0, .uv_set = 0, .intensity = 0.5F};
    EXPECT_EQ(named()->of_material[0], typed);
}

} // namespace
} // namespace estampe::gltf
