// SPDX-License-Identifier: MIT
// Layers of all kinds of colours, read back by independent code and composited as the formats specify.
#include "output/layer_files.hpp"

#include <cmath>
#include <map>
#include <random>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

#include "core/color.hpp"
#include "core/file.hpp"
#include "output/layer_bytes.hpp"
#include "support/folder.hpp"
#include "support/open_raster.hpp"

namespace estampe {
namespace {

constexpr uint32_t layers_width = 300; // Larger than a thumbnail
constexpr uint32_t layers_height = 90;

Image picture_of(const LinearImage& linear)
{
    Image image{.width = linear.width, .height = linear.height, .rgba = {}};
    for (const glm::vec4& pixel : linear.pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            const float value = std::clamp(pixel[channel], 0.0F, 1.0F);
            image.rgba.push_back(static_cast<uint8_t>(std::lround(255.0F * srgb_from_linear(value))));
        }
        image.rgba.push_back(255);
    }
    return image;
}

/// Random layers: light and dark paper, paints of any strength, and inks of any colour and coverage.
LayeredImage any_layers(uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    const auto color = [&](float power) {
        return glm::vec3(std::pow(share(random), power), std::pow(share(random), power),
                         std::pow(share(random), power));
    };
    LayeredImage image;
    for (const char* name : {"paper", "wash", "hatch", "lines"}) {
        image.layers.push_back(
            {.name = name, .image = {.width = layers_width, .height = layers_height, .pixels = {}}});
    }
    image.layers[1].blend = LayerBlend::multiply;
    for (uint32_t i = 0; i < layers_width * layers_height; ++i) {
        const float lightness = share(random) < 0.3F ? 0.05F : 1.04F;
        image.layers[0].image.pixels.emplace_back(lightness * (1.0F - 0.2F * color(1.0F)), 1.0F);
        image.layers[1].image.pixels.emplace_back(share(random) < 0.3F ? glm::vec3(1.0F) : color(0.5F), 1.0F);
        for (size_t ink = 2; ink < 4; ++ink) {
            const float kind = share(random);
            const float cover = kind < 0.3F   ? 0.0F
                                : kind < 0.5F ? 1.0F
                                : kind < 0.7F ? 0.03F * share(random)
                                              : share(random);
            image.layers[ink].image.pixels.emplace_back(cover * color(3.0F), cover);
        }
    }
    image.picture = picture_of(flattened(image));
    image.masks.push_back({.name = "shadow",
                           .is_object = false,
                           .above = 2,
                           .width = layers_width,
                           .height = layers_height,
                           .cover = std::vector<float>(layers_width * layers_height, 0.25F)});
    image.masks.push_back({.name = "a \"b\" <c> & d",
                           .above = 4,
                           .x = 20,
                           .y = 10,
                           .width = 2,
                           .height = 3,
                           .cover = {0, 1, 0.5F, 1, 1, 0.2F}});
    image.masks.push_back(
        {.name = "a.b", .above = 4, .x = 299, .y = 89, .width = 1, .height = 1, .cover = {1}});
    return image;
}

TEST(Layers, OpenRasterGivesThePictureAgain)
{
    for (const uint32_t seed : {1U, 2U, 3U}) {
        const LayeredImage image = any_layers(seed);
        const test::OpenRaster raster = test::read_openraster(output::encode_openraster(image));
        EXPECT_EQ(raster.merged, image.picture);
        const std::vector<glm::dvec3> in_bytes = test::composite(raster, true);
        EXPECT_LE(test::largest_difference(in_bytes, image.picture), 1.0);
        EXPECT_LT(test::share_that_differs(in_bytes, image.picture), 0.0005) << "most are the very bytes";
        EXPECT_LE(test::largest_difference(test::composite(raster, false), image.picture), 1.0);
    }
}

TEST(Layers, OpenRasterIsAsTheFormatWantsIt)
{
    const test::OpenRaster raster = test::read_openraster(output::encode_openraster(any_layers(1)));
    EXPECT_EQ(raster.entries.at(0), "mimetype");
    EXPECT_EQ(raster.mimetype, "image/openraster");
    EXPECT_TRUE(raster.is_mimetype_stored);
    EXPECT_EQ(raster.width, layers_width);
    EXPECT_EQ(raster.height, layers_height);
    EXPECT_EQ(raster.thumbnail.width, 256U);
    EXPECT_EQ(raster.thumbnail.height, 76U);
    std::vector<std::string> told;
    for (const test::RasterLayer& layer : raster.layers) {
        told.push_back(layer.group + "/" + layer.name + (layer.is_visible ? " " : " hidden ") +
                       layer.operation);
    }
    const std::vector<std::string> wanted{"/paper svg:src-over",
                                          "/wash svg:multiply",
                                          "/shadow hidden svg:src-over",
                                          "/hatch svg:src-over",
                                          "/lines svg:src-over",
                                          "objects/a \"b\" <c> & d hidden svg:src-over",
                                          "objects/a.b hidden svg:src-over"};
    EXPECT_EQ(told, wanted);
    const test::RasterLayer& mask = raster.layers.at(5);
    EXPECT_EQ(mask.x, 20U);
    EXPECT_EQ(mask.y, 10U);
    ASSERT_EQ(mask.image.rgba.size(), 24U);
    EXPECT_EQ(mask.image.rgba[3], 0);
    EXPECT_EQ(mask.image.rgba[7], 255);
    EXPECT_EQ(mask.image.rgba[11], 128);
    for (size_t i = 3; i < raster.layers[0].image.rgba.size(); i += 4) {
        ASSERT_EQ(raster.layers[0].image.rgba[i], 255) << "paper is opaque";
    }
}

/// An ink layer keeps its pigment's colour wherever that works and enough ink is visible.
TEST(Layers, InkKeepsItsColour)
{
    LayeredImage image = any_layers(5);
    const glm::vec3 ink(0.02F, 0.05F, 0.2F);
    for (uint32_t i = 0; i < layers_width * layers_height; ++i) {
        const float cover = static_cast<float>(i % 101) / 100.0F;
        image.layers[0].image.pixels[i] = glm::vec4(0.9F, 0.85F, 0.7F, 1.0F);
        image.layers[1].image.pixels[i] = glm::vec4(1.0F);
        image.layers[2].image.pixels[i] = glm::vec4(cover * ink, cover);
        image.layers[3].image.pixels[i] = glm::vec4(0.0F);
    }
    image.picture = picture_of(flattened(image));
    const test::OpenRaster raster = test::read_openraster(output::encode_openraster(image));
    const Image& hatch = raster.layers.at(3).image;
    size_t seen = 0;
    size_t of_ink = 0;
    for (size_t i = 0; i < hatch.rgba.size(); i += 4) {
        seen += hatch.rgba[i + 3] > 25 ? 1 : 0;
        bool is_ink = true;
        for (size_t channel = 0; channel < 3; ++channel) {
            const float own = 255.0F * srgb_from_linear(ink[static_cast<int>(channel)]);
            is_ink = is_ink && std::abs(static_cast<float>(hatch.rgba[i + channel]) - own) < 40.0F;
        }
        of_ink += hatch.rgba[i + 3] > 25 && is_ink ? 1 : 0;
    }
    EXPECT_GT(seen, 20000U);
    EXPECT_EQ(of_ink, seen);
}

TEST(Layers, FolderListsItsFiles)
{
    const test::Folder folder;
    const LayeredImage image = any_layers(7);
    for (const int bits : {8, 16}) {
        const auto target = folder / ("layers" + std::to_string(bits));
        save_layers(image, target, bits);
        const auto bytes = read_file(target / "layers.json");
        const auto manifest =
            nlohmann::json::parse(reinterpret_cast<const char*>(bytes.data()),
                                  reinterpret_cast<const char*>(bytes.data() + bytes.size()));
        EXPECT_EQ(manifest.at("width"), layers_width);
        ASSERT_EQ(manifest.at("layers").size(), 7U);
        test::OpenRaster raster{.width = layers_width, .height = layers_height};
        for (const auto& layer : manifest.at("layers")) {
            raster.layers.push_back(
                {.name = layer.at("name"),
                 .operation = layer.at("blend") == "multiply" ? "svg:multiply" : "svg:src-over",
                 .is_visible = layer.at("visible"),
                 .x = layer.at("x"),
                 .y = layer.at("y"),
                 .image = load_image(target / layer.at("file").get<std::string>())});
            EXPECT_EQ(raster.layers.back().image.width, layer.at("width"));
        }
        // The reader converts 16 bits to bytes layer by layer.
        EXPECT_LE(test::largest_difference(test::composite(raster, false), image.picture),
                  bits == 8 ? 1.0 : 2.5);
        EXPECT_THROW(save_layers(image, target, bits), Error) << "it is not empty";
    }
    // With 16 bits, the layers give the picture from before its conversion to bytes.
    const LinearImage whole = flattened(image);
    const std::vector<output::EncodedLayer> layers = output::encoded_layers(image, 16);
    double worst = 0.0;
    for (size_t i = 0; i < whole.pixels.size(); ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            double below = 0.0;
            for (const output::EncodedLayer& layer : layers) {
                const double value = layer.rgba[4 * i + channel] / 65535.0;
                const double color = layer.blend == LayerBlend::multiply ? value * below : value;
                below += (color - below) * layer.rgba[4 * i + 3] / 65535.0;
            }
            const double linear =
                std::clamp(static_cast<double>(whole.pixels[i][static_cast<int>(channel)]), 0.0, 1.0);
            worst = std::max(worst, std::abs(below - srgb_from_linear(linear)));
        }
    }
    EXPECT_LE(65535.0 * worst, 1.5);
}

TEST(Layers, ExrHoldsAllOfThem)
{
    const test::Folder folder;
    const LayeredImage image = any_layers(9);
    save_layers_exr(image, folder / "a.exr", ExrNumbers::half);
    Imf::InputFile file((folder / "a.exr").c_str());
    std::map<std::string, std::vector<float>> values;
    Imf::FrameBuffer slices;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        std::vector<float>& own = values[channel.name()];
        own.resize(size_t{layers_width} * layers_height);
        slices.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(own.data()),
                                                 sizeof(float), sizeof(float) * layers_width));
    }
    file.setFrameBuffer(slices);
    file.readPixels(0, static_cast<int>(layers_height) - 1);
    const auto listed =
        nlohmann::json::parse(file.header().typedAttribute<Imf::StringAttribute>("estampe:layers").value());
    ASSERT_EQ(listed.at("layers").size(), 7U);
    EXPECT_EQ(listed["layers"][6]["file"], "a_b");
    EXPECT_EQ(values.at("a_b.Y").back(), 1.0F);
    EXPECT_EQ(values.at("a \"b\" <c> & d.Y")[size_t{11} * layers_width + 20], 0.5F);
    double worst = 0.0;
    double worst_whole = 0.0;
    for (size_t i = 0; i < size_t{layers_width} * layers_height; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const std::string letter(1, "RGB"[channel]);
            double below = 0.0;
            for (const auto& layer : listed["layers"]) {
                if (layer["visible"] == true) {
                    const std::string prefix = layer["file"].get<std::string>() + ".";
                    const double value = values.at(prefix + letter)[i];
                    below = layer["blend"] == "multiply" ? below * value
                                                         : value + below * (1.0 - values.at(prefix + "A")[i]);
                }
            }
            const double byte = image.picture.rgba[4 * i + static_cast<size_t>(channel)];
            worst = std::max(worst, std::abs(255.0 * srgb_from_linear(std::clamp(below, 0.0, 1.0)) - byte));
            const double whole = std::clamp(static_cast<double>(values.at(letter)[i]), 0.0, 1.0);
            worst_whole = std::max(worst_whole, std::abs(255.0 * srgb_from_linear(whole) - byte));
        }
    }
    EXPECT_LE(worst, 1.0);
    EXPECT_LE(worst_whole, 1.0);
}

TEST(Layers, WhatIsNoPictureIsAnError)
{
    const test::Folder folder;
    const auto expect_error = [&](const LayeredImage& image) {
        EXPECT_THROW(save_openraster(image, folder / "a.ora"), Error);
        EXPECT_THROW(save_layers(image, folder / "layers"), Error);
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    };
    expect_error({});
    LayeredImage image = any_layers(1);
    image.layers[2].image.width = 1;
    expect_error(image);
    EXPECT_THROW(save_layers_exr(image, folder / "a.exr"), Error);
    image = any_layers(1);
    image.layers[0].image.pixels[5].w = 0.5F;
    expect_error(image);
    image = any_layers(1);
    EXPECT_THROW(save_layers(image, folder / "layers", 12), Error);
    EXPECT_THROW(save_openraster(image, folder / "none/a.ora"), Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Layers, AreLookedAtAlone)
{
    LayeredImage image;
    image.picture = {.width = 2, .height = 2, .rgba = std::vector<uint8_t>(16, 255)};
    const auto layer = [](const char* name, LayerBlend blend, const glm::vec4& pixel) {
        return PictureLayer{.name = name,
                            .blend = blend,
                            .image = {.width = 2, .height = 2, .pixels = std::vector<glm::vec4>(4, pixel)}};
    };
    image.layers = {layer("paper", LayerBlend::normal, {0.5F, 0.4F, 0.3F, 1.0F}),
                    layer("wash", LayerBlend::multiply, {0.5F, 1.0F, 0.25F, 1.0F}),
                    layer("lines", LayerBlend::normal, {0.1F, 0.0F, 0.0F, 0.5F})};
    image.masks = {{.name = "occlusion",
                    .is_object = false,
                    .x = 1,
                    .y = 0,
                    .width = 1,
                    .height = 2,
                    .cover = {0.25F, 1.0F}}};
    EXPECT_EQ(output::one_layer(image, "wash").pixels[3], glm::vec4(0.5F, 1.0F, 0.25F, 1.0F));
    EXPECT_EQ(glm::vec3(output::one_layer(image, "lines").pixels[0]), glm::vec3(0.6F, 0.5F, 0.5F));
    const LinearImage mask = output::one_layer(image, "occlusion");
    EXPECT_EQ(mask.pixels[0].x, 1.0F);
    EXPECT_EQ(mask.pixels[1].x, 0.75F);
    EXPECT_EQ(mask.pixels[3].x, 0.0F);
    EXPECT_EQ(output::encoded_bytes(mask).rgba[4 * 1], 225) << "sRGB of three quarters";
    EXPECT_THROW(std::ignore = output::one_layer(image, "hatch"), Error);
}

} // namespace
} // namespace estampe
