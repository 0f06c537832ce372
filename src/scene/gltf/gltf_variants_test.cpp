// SPDX-License-Identifier: MIT
// KHR_materials_variants, from the file to the materials of primitives.
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "scene/gltf/test_file.hpp"
#include "support/folder.hpp"

namespace estampe::gltf {
namespace {

/// Two primitives with material 0. The first has material 1 in "night" and "storm", the second material 2 in
/// "storm".
TestFile variants_file()
{
    TestFile file = triangle_file();
    file.document["extensionsUsed"] = {"KHR_materials_variants"};
    file.document["extensionsRequired"] = {"KHR_materials_variants"};
    file.document["extensions"]["KHR_materials_variants"] =
        json::parse(R"({"variants": [{"name": "night"}, {"name": "storm"}, {}]})");
    file.document["materials"] = json::parse(R"([{"name": "a"}, {"name": "b"}, {"name": "c"}])");
    json& primitives = file.document["meshes"][0]["primitives"];
    primitives[0]["material"] = 0;
    primitives.push_back(primitives[0]);
    primitives[0]["extensions"]["KHR_materials_variants"] =
        json::parse(R"({"mappings": [{"material": 1, "variants": [0, 1]}]})");
    primitives[1]["extensions"]["KHR_materials_variants"] =
        json::parse(R"({"mappings": [{"material": 2, "variants": [1]}]})");
    return file;
}

std::vector<Index> materials_of(const Scene& scene)
{
    std::vector<Index> materials;
    for (const Primitive& primitive : scene.meshes[0].primitives) {
        materials.push_back(primitive.material);
    }
    return materials;
}

std::string failure(Scene scene, const std::string& variant)
{
    try {
        apply_variant(scene, variant);
    } catch (const Error& error) {
        return error.what();
    }
    return "applied";
}

TEST(GltfVariants, TheDefaultMaterialsAreDrawnUnlessAskedFor)
{
    const Scene scene = variants_file().load();
    EXPECT_EQ(scene.variants, (std::vector<std::string>{"night", "storm", "variant 2"}));
    EXPECT_EQ(materials_of(scene), (std::vector<Index>{0, 0}));
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.extensions_ignored.empty());
}

TEST(GltfVariants, AVariantIsAppliedByNameOrIndexAndTakenBack)
{
    Scene scene = variants_file().load();
    apply_variant(scene, "storm");
    EXPECT_EQ(materials_of(scene), (std::vector<Index>{1, 2}));
    apply_variant(scene, "0");
    EXPECT_EQ(materials_of(scene), (std::vector<Index>{1, 0}))
        << "what a variant does not name is as by default";
    apply_variant(scene, "variant 2");
    EXPECT_EQ(materials_of(scene), (std::vector<Index>{0, 0}));
    apply_variant(scene, "storm");
    apply_variant(scene, "");
    EXPECT_EQ(materials_of(scene), (std::vector<Index>{0, 0}));
    scene.variants[0] = "1";
    apply_variant(scene, "1");
    EXPECT_EQ(materials_of(scene), (std::vector<Index>{1, 0})) << "names go before numbers";
}

TEST(GltfVariants, UnknownNamesAreAnErrorThatListsThem)
{
    EXPECT_NE(failure(variants_file().load(), "dawn").find("0 \"night\", 1 \"storm\", 2 \"variant 2\""),
              std::string::npos);
    EXPECT_NE(failure(variants_file().load(), "3").find("no variant \"3\""), std::string::npos);
    EXPECT_NE(failure(triangle_file().load(), "night").find("has no material variants"), std::string::npos);
}

TEST(GltfVariants, AreChosenWhileLoading)
{
    const test::Folder folder;
    write_file_atomically(folder / "scene.glb", variants_file().glb());
    EXPECT_EQ(materials_of(load_scene(folder / "scene.glb", {.variant = "storm"})),
              (std::vector<Index>{1, 2}));
    EXPECT_EQ(materials_of(load_scene(folder / "scene.glb")), (std::vector<Index>{0, 0}));
    EXPECT_THROW((void)load_scene(folder / "scene.glb", {.variant = "dawn"}), Error);
}

TEST(GltfVariants, TangentsAreMadeForANormalMapOfAVariant)
{
    TestFile file = variants_file();
    file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    const Bytes image = encode_png({.width = 1, .height = 1, .rgba = {128, 128, 255, 255}});
    file.document["images"] =
        json::array({{{"bufferView", file.add_view(image)}, {"mimeType", "image/png"}}});
    file.document["textures"] = json::parse(R"([{"source": 0}])");
    EXPECT_TRUE(file.load().meshes[0].primitives[0].tangents.empty());
    file.document["materials"][1]["normalTexture"]["index"] = 0;
    EXPECT_EQ(file.load().meshes[0].primitives[0].tangents.size(), 3U);
}

TEST(GltfVariants, BrokenMappingsAreToldWithTheirPlace)
{
    TestFile file = variants_file();
    json& mappings = file.primitive()["extensions"]["KHR_materials_variants"]["mappings"];
    mappings.push_back(json::parse(R"({"material": 2, "variants": [1]})"));
    const Scene scene = file.load();
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("/mappings/1: variant 1 has a material already"), std::string::npos);
    EXPECT_EQ(scene.meshes[0].primitives[0].variant_materials, (std::vector<Index>{1, 1, no_index}));
    mappings[0]["variants"][0] = 3;
    try {
        (void)file.load();
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("mappings/0/variants/0: index 3"), std::string::npos);
    }
    mappings[0] = json::parse(R"({"material": 3, "variants": [0]})");
    EXPECT_THROW((void)file.load(), Error);
}

} // namespace
} // namespace estampe::gltf
