// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <webp/encode.h>

#include "core/image_codec.hpp"
#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

Image two_pixels()
{
    return {.width = 2, .height = 1, .rgba = {10, 20, 30, 255, 40, 50, 60, 128}};
}

Bytes webp_of(const Image& image)
{
    uint8_t* encoded = nullptr;
    const size_t size =
        WebPEncodeLosslessRGBA(image.rgba.data(), static_cast<int>(image.width),
                               static_cast<int>(image.height), static_cast<int>(image.width) * 4, &encoded);
    const auto* first = reinterpret_cast<const std::byte*>(encoded);
    Bytes bytes(first, first + size);
    WebPFree(encoded);
    return bytes;
}

/// The triangle with one material, whose base colour is the embedded image.
TestFile textured_file(const Bytes& image)
{
    TestFile file = triangle_file();
    file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    file.primitive()["material"] = 0;
    file.document["images"] =
        json::array({{{"bufferView", file.add_view(image)}, {"mimeType", "image/png"}}});
    file.document["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}}});
    file.document["textures"] = json::array({{{"source", 0}, {"sampler", 0}, {"name", "bark"}}});
    file.document["materials"] =
        json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    return file;
}

Material material_of(const std::string& text)
{
    TestFile file = triangle_file();
    file.document["materials"] = json::array({json::parse(text)});
    return file.load().materials.at(0);
}

TEST(GltfMaterial, defaults)
{
    const Scene scene = triangle_file().load();
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1));
    EXPECT_EQ(scene.materials[0].metallic, 1.0F);
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::opaque);
    EXPECT_FALSE(scene.materials[0].toon.has_value());
}

TEST(GltfMaterial, factors_and_alpha)
{
    const Material material = material_of(R"({
        "name": "paint", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true, "emissiveFactor": [1, 0.5, 0],
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 0, "roughnessFactor": 0.5},
        "extensions": {"KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {"emissiveStrength": 4}}
    })");
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(material.alpha_cutoff, 0.25F);
    EXPECT_TRUE(material.double_sided);
    EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
    EXPECT_EQ(material.base_color, glm::vec4(.5F, .25F, 1, .75F));
    EXPECT_EQ(material.metallic, 0.0F);
    EXPECT_EQ(material.roughness, 0.5F);
    EXPECT_TRUE(material.unlit);
    EXPECT_EQ(material_of(R"({"alphaMode": "BLEND"})").alpha_mode, AlphaMode::blend);
}

TEST(GltfMaterial, specular_glossiness_gives_the_diffuse_colour)
{
    const Material material = material_of(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor": [0.5, 0.25, 0, 1], "glossinessFactor": 0.75}}})");
    EXPECT_EQ(material.base_color, glm::vec4(.5F, .25F, 0, 1));
    EXPECT_EQ(material.metallic, 0.0F);
    EXPECT_EQ(material.roughness, 0.25F);
}

TEST(GltfMaterial, transmission_and_volume)
{
    const Material glass = material_of(R"({"extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 0.75},
        "KHR_materials_volume": {"thicknessFactor": 0.02, "attenuationDistance": 0.5,
                                 "attenuationColor": [0.25, 1, 0.5]}}})");
    ASSERT_TRUE(glass.transmission.has_value());
    EXPECT_EQ(glass.transmission->share, 0.75F);
    EXPECT_EQ(glass.transmission->thickness_m, 0.02F);
    EXPECT_EQ(glass.transmission->attenuation_m, 0.5F);
    EXPECT_EQ(glass.transmission->attenuation_color, glm::vec3(.25F, 1, .5F));
    const Material pane =
        material_of(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})");
    ASSERT_TRUE(pane.transmission.has_value());
    EXPECT_EQ(pane.transmission->attenuation_m, 0.0F);
    EXPECT_EQ(pane.transmission->attenuation_color, glm::vec3(1));
    EXPECT_FALSE(
        material_of(R"({"extensions": {"KHR_materials_transmission": {}}})").transmission.has_value());
    EXPECT_FALSE(material_of(R"({"extensions": {"KHR_materials_volume": {"thicknessFactor": 1}}})")
                     .transmission.has_value())
        << "nothing is seen through it";
}

TEST(GltfMaterial, index_of_refraction)
{
    const auto ior_of = [](const std::string& more) {
        return material_of(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, )" +
                           more + "}}")
            .transmission->ior;
    };
    const std::string volume = R"("KHR_materials_volume": {"thicknessFactor": 1})";
    EXPECT_EQ(ior_of(volume + R"(, "KHR_materials_ior": {"ior": 1.33})"), 1.33F);
    EXPECT_EQ(ior_of(volume), 1.5F) << "the default of the extension";
    EXPECT_EQ(ior_of(volume + R"(, "KHR_materials_ior": {"ior": 0})"), 1.0F) << "with a warning";
    EXPECT_EQ(ior_of(R"("KHR_materials_ior": {"ior": 1.33})"), 1.0F) << "a sheet without volume";
}

TEST(GltfMaterial, mtoon)
{
    TestFile file = textured_file(encode_png(two_pixels()));
    file.document["materials"][0]["extensions"]["VRMC_materials_mtoon"] = json::parse(R"({
        "specVersion": "1.0", "shadeColorFactor": [0.5, 0.25, 0], "shadeMultiplyTexture": {"index": 0, "texCoord": 1},
        "outlineWidthMode": "worldCoordinates", "outlineWidthFactor": 0.005, "outlineColorFactor": [0, 0.5, 1]})");
    Scene scene = file.load();
    ASSERT_TRUE(scene.materials[0].toon.has_value());
    EXPECT_EQ(scene.materials[0].toon->shade_color, glm::vec3(.5F, .25F, 0));
    EXPECT_EQ(scene.materials[0].toon->shade_texture.texture, 0U);
    EXPECT_EQ(scene.materials[0].toon->shade_texture.uv_set, 1U);
    EXPECT_EQ(scene.materials[0].toon->outline_width_m, 0.005F);
    EXPECT_EQ(scene.materials[0].toon->outline_color, glm::vec3(0, .5F, 1));
    EXPECT_EQ(scene.materials[0].toon->shade_shift, 0.0F) << "the extension's own values";
    EXPECT_EQ(scene.materials[0].toon->shade_toony, 0.9F);
    file.document["materials"][0]["extensions"]["VRMC_materials_mtoon"]["outlineWidthMode"] = "none";
    scene = file.load();
    EXPECT_EQ(scene.materials[0].toon->outline_width_m, 0.0F);
}

TEST(GltfMaterial, mtoon_says_where_the_shade_begins_and_how_its_texture_lies)
{
    TestFile file = textured_file(encode_png(two_pixels()));
    json& material = file.document["materials"][0];
    material["extensions"]["KHR_materials_unlit"] = json::object();
    json& mtoon = material["extensions"]["VRMC_materials_mtoon"];
    mtoon = json::parse(R"({"specVersion": "1.0", "shadingShiftFactor": -0.25, "shadingToonyFactor": 0.5,
        "shadeMultiplyTexture": {"index": 0, "extensions": {
            "KHR_texture_transform": {"offset": [0.5, 0.25], "scale": [2, 3], "texCoord": 1}}}})");
    Scene scene = file.load();
    ASSERT_TRUE(scene.materials[0].toon.has_value());
    const ToonShade& toon = *scene.materials[0].toon;
    EXPECT_EQ(toon.shade_shift, -0.25F);
    EXPECT_EQ(toon.shade_toony, 0.5F);
    EXPECT_EQ(toon.shade_texture.uv_set, 1U);
    EXPECT_EQ(toon.shade_texture.uv_transform * glm::vec3(1, 1, 1), glm::vec3(2.5F, 3.25F, 1));
    EXPECT_FALSE(scene.materials[0].unlit) << "unlit is for programs that do not know the toon material";
    EXPECT_TRUE(scene.warnings.empty());
    mtoon["shadingToonyFactor"] = 2;
    mtoon["shadingShiftTexture"] = {{"index", 0}, {"scale", 1}};
    scene = file.load();
    EXPECT_EQ(scene.materials[0].toon->shade_toony, 1.0F);
    ASSERT_EQ(scene.warnings.size(), 2U);
    EXPECT_NE(scene.warnings[0].find("shadingToonyFactor: is 2, outside 0 to 1"), std::string::npos);
    EXPECT_NE(scene.warnings[1].find("shadingShiftTexture: is not looked up"), std::string::npos);
}

TEST(GltfMaterial, a_shade_texture_that_cannot_be_read_is_left_out)
{
    TestFile file = textured_file({std::byte{1}, std::byte{2}});
    file.document["materials"][0]["extensions"]["VRMC_materials_mtoon"] =
        json::parse(R"({"specVersion": "1.0", "shadeMultiplyTexture": {"index": 0}})");
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials[0].toon->shade_texture.texture, no_index);
    EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(GltfMaterial, embedded_texture)
{
    const Scene scene = textured_file(encode_png(two_pixels())).load();
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].image, two_pixels());
    EXPECT_EQ(scene.textures[0].name, "bark");
    EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp);
    EXPECT_EQ(scene.textures[0].wrap_v, Wrap::mirror);
    EXPECT_EQ(scene.materials[0].base_color_texture.texture, 0U);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterial, all_kinds_of_textures)
{
    TestFile file = textured_file(encode_png(two_pixels()));
    file.document["textures"].push_back({{"source", 0}});
    file.document["materials"][0].update(json::parse(R"({
        "normalTexture": {"index": 1, "scale": 0.5}, "occlusionTexture": {"index": 0, "strength": 0.25, "texCoord": 1},
        "emissiveTexture": {"index": 1}})"));
    const Scene scene = file.load();
    EXPECT_EQ(scene.textures.size(), 2U) << "one for each wrap mode of the image";
    EXPECT_EQ(scene.textures[1].wrap_u, Wrap::repeat);
    EXPECT_EQ(scene.textures[1].image, two_pixels());
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.normal_texture.texture, 1U);
    EXPECT_EQ(material.normal_scale, 0.5F);
    EXPECT_EQ(material.occlusion_texture.texture, 0U);
    EXPECT_EQ(material.occlusion_texture.uv_set, 1U);
    EXPECT_EQ(material.occlusion_strength, 0.25F);
    EXPECT_EQ(material.emissive_texture.texture, 1U);
}

TEST(GltfMaterial, texture_transform)
{
    TestFile file = textured_file(encode_png(two_pixels()));
    json& info = file.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}, {"texCoord", 1}};
    const TextureRef ref = file.load().materials[0].base_color_texture;
    EXPECT_EQ(ref.uv_set, 1U);
    const glm::vec3 uv = ref.uv_transform * glm::vec3(1, 1, 1);
    EXPECT_NEAR(uv.x, 0.5F + 3.0F, 1e-6F);
    EXPECT_NEAR(uv.y, 0.25F - 2.0F, 1e-6F);
}

TEST(GltfMaterial, webp_texture)
{
    TestFile file = textured_file(encode_png({.width = 1, .height = 1, .rgba = {1, 2, 3, 4}}));
    file.document["extensionsRequired"] = {"EXT_texture_webp"};
    file.document["images"].push_back(
        {{"bufferView", file.add_view(webp_of(two_pixels()))}, {"mimeType", "image/webp"}});
    file.document["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    EXPECT_EQ(file.load().textures[0].image, two_pixels());
}

TEST(GltfMaterial, texture_as_data_uri)
{
    TestFile file = textured_file({std::byte{0}});
    file.document["images"][0] = {{"uri", "data:image/png;base64," + base64(encode_png(two_pixels()))}};
    const Scene scene = file.load();
    EXPECT_EQ(scene.textures[0].image, two_pixels());
    EXPECT_TRUE(scene.warnings.empty());
}

void expect_white(const TestFile& file, const std::string& part_of_warning)
{
    const Scene scene = file.load();
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].image, (Image{.width = 1, .height = 1, .rgba = {255, 255, 255, 255}}));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find(part_of_warning), std::string::npos) << scene.warnings[0];
    EXPECT_EQ(scene.warnings[0].find('\n'), std::string::npos);
}

TEST(GltfMaterial, textures_that_cannot_be_read_are_white_with_a_warning)
{
    Bytes png = encode_png(two_pixels());
    png.resize(png.size() - 20);
    expect_white(textured_file(png), "test.glb#/images/0: corrupt PNG");
    expect_white(textured_file({std::byte{1}, std::byte{2}}),
                 "test.glb#/images/0: is not a PNG, JPEG, WebP, TIFF, TGA, BMP, GIF or PSD image");

    TestFile file = textured_file({std::byte{0}});
    file.document["images"][0] = {{"uri", "wood.png"}};
    expect_white(file, "wood.png");
    file.document["images"][0] = {{"uri", "https://example.org/wood.png"}};
    expect_white(file, "not a relative path");
    file.document["images"][0] = {{"uri", "data:image/png;base64,!!"}};
    expect_white(file, "test.glb#/images/0: embedded data: is not valid base64");
    file.document["images"][0] = json::object();
    expect_white(file, "has neither uri nor bufferView");
    file.document["textures"][0] = json::object();
    expect_white(file, "test.glb#/textures/0: has no image that can be read");
}

TEST(GltfMaterial, factors_out_of_range_are_clamped_with_a_warning)
{
    TestFile file = triangle_file();
    file.primitive()["material"] = 0;
    file.document["materials"] =
        json::parse(R"([{"pbrMetallicRoughness": {"metallicFactor": 2, "roughnessFactor": -0.0000001}}])");
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].metallic, 1.0F);
    EXPECT_EQ(scene.materials[0].roughness, 0.0F);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_EQ(scene.warnings[0],
              "test.glb#/materials/0/pbrMetallicRoughness/metallicFactor: is 2, outside 0 to 1; 1 is used");
}

TEST(GltfMaterial, third_uv_set_is_warned_about)
{
    TestFile file = textured_file(encode_png(two_pixels()));
    file.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2;
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials[0].base_color_texture.uv_set, 0U);
    EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(GltfMaterial, unused_images_are_not_read)
{
    TestFile file = textured_file(encode_png(two_pixels()));
    file.document["images"].push_back({{"uri", "missing.png"}});
    file.document["textures"].push_back({{"source", 1}});
    EXPECT_TRUE(file.load().warnings.empty());
}

} // namespace
} // namespace estampe::gltf
