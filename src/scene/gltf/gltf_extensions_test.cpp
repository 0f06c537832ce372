// SPDX-License-Identifier: MIT
// Unsupported extensions: which of them a scene can be drawn without, and the warnings.
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "core/image_codec.hpp"
#include "scene/gltf/convert.hpp"
#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

const Image blue{.width = 1, .height = 1, .rgba = {0, 0, 255, 255}};
const Image white{.width = 1, .height = 1, .rgba = {255, 255, 255, 255}};

/// A material that uses texture 0 for colour, normals and emission; the texture has its picture only through
/// an extension.
TestFile textured_by(const std::string& extension, const std::string& image_file)
{
    TestFile file = triangle_file();
    file.primitive()["material"] = 0;
    file.document["extensionsUsed"] = {extension};
    file.document["extensionsRequired"] = {extension};
    file.document["images"] = json::array({{{"uri", image_file}}});
    file.document["textures"] = json::array({{{"extensions", {{extension, {{"source", 0}}}}}}});
    file.document["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "normalTexture": {"index": 0}, "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1]}])");
    return file;
}

TEST(GltfExtensions, TexturesInUnreadFormatsAreLeftOutWithAWarning)
{
    for (const auto& [extension, format] :
         {std::pair("KHR_texture_basisu", "KTX2/Basis Universal"), std::pair("EXT_texture_avif", "AVIF"),
          std::pair("MSFT_texture_dds", "DDS")}) {
        const Scene scene = textured_by(extension, "leaf.bin").load();
        ASSERT_EQ(scene.warnings.size(), 1U) << extension;
        EXPECT_EQ(scene.warnings[0], std::string("test.glb#/textures/0: texture 0 is ") + format +
                                         ", which is not read; drawn without it");
        EXPECT_EQ(scene.textures.at(0).image, white);
        EXPECT_EQ(scene.extensions_ignored, std::vector<std::string>{extension});
        EXPECT_TRUE(scene.missing_files.empty()) << "the file was not looked for";
        const Material& material = scene.materials[0];
        EXPECT_EQ(material.base_color_texture.texture, 0U);
        EXPECT_EQ(material.normal_texture.texture, no_index) << "white is no normal";
        EXPECT_EQ(material.emissive, glm::vec3(0.0F)) << "white would glow";
    }
}

TEST(GltfExtensions, AReadableFallbackIsTaken)
{
    TestFile file = textured_by("KHR_texture_basisu", "leaf.ktx2");
    file.document["images"].push_back(
        {{"bufferView", file.add_view(encode_png(blue))}, {"mimeType", "image/png"}});
    file.document["textures"][0]["source"] = 1;
    file.document["extensionsRequired"] = json::array();
    const Scene scene = file.load();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.textures.at(0).image, blue);
    EXPECT_EQ(scene.materials[0].normal_texture.texture, 0U);
    EXPECT_EQ(scene.materials[0].emissive, glm::vec3(1.0F));
}

TEST(GltfExtensions, EachTextureIsNamed)
{
    TestFile file = textured_by("KHR_texture_basisu", "leaf.ktx2");
    file.document["textures"].push_back(file.document["textures"][0]);
    file.document["materials"][0]["normalTexture"]["index"] = 1;
    const Scene scene = file.load();
    ASSERT_EQ(scene.warnings.size(), 2U);
    EXPECT_NE(scene.warnings[1].find("texture 1 is KTX2"), std::string::npos);
}

TEST(GltfExtensions, LooksThatAreNotReadAreDrawnWithoutThem)
{
    for (const char* name :
         {"KHR_materials_clearcoat", "KHR_materials_sheen", "ADOBE_materials_thin_transparency",
          "EXT_lights_image_based", "KHR_lights_area", "KHR_xmp_json_ld", "EXT_structural_metadata",
          "MSFT_lod", "MSFT_packing_occlusionRoughnessMetallic", "OMI_physics_body", "VRMC_springBone",
          "KHR_gaussian_splatting", "KHR_interactivity", "KHR_audio_emitter", "NV_materials_mdl",
          "CESIUM_primitive_outline"}) {
        TestFile file = triangle_file();
        file.document["extensionsUsed"] = {name};
        file.document["extensionsRequired"] = {name};
        const Scene scene = file.load();
        ASSERT_EQ(scene.warnings.size(), 1U) << name;
        EXPECT_EQ(scene.warnings[0], std::string("test.glb#/extensionsRequired/0: ") + name +
                                         " is required but not read; the scene is drawn without it");
    }
}

TEST(GltfExtensions, WhatMayChangeTheGeometryIsRefused)
{
    for (const char* name :
         {"KHR_meshopt_compression", "WEB3D_quantized_attributes", "KHR_gaussian_splatting_compression_spz",
          "KHR_accessor_float64", "EXT_primitive_voxels", "MPEG_accessor_timed", "ACME_new", "nothing", ""}) {
        TestFile file = triangle_file();
        file.document["extensionsRequired"] = {name};
        try {
            (void)file.load();
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_EQ(
                text.find("test.glb#/extensionsRequired/0: requires the extension " + std::string(name)), 0U)
                << text;
            EXPECT_NE(text.find("may change or compress the geometry"), std::string::npos) << text;
        }
    }
}

TEST(GltfExtensions, WhatIsUnderstoodIsNotAlsoUnread)
{
    for (const char* name : {"EXT_texture_webp", "KHR_materials_variants", "KHR_node_visibility",
                             "KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
        EXPECT_TRUE(knows_extension(name));
        EXPECT_FALSE(unread_picture_format(name));
    }
    EXPECT_FALSE(knows_extension("KHR_texture_basisu"));
}

} // namespace
} // namespace estampe::gltf
