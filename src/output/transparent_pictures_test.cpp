// SPDX-License-Identifier: MIT
// Transparent pictures as files, decoded with the libraries themselves.
#include "output/pictures.hpp"

#include <cmath>
#include <cstdio>

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <estampe/layers.hpp>
#include <estampe/vector_drawing.hpp>

#include "core/image_codec.hpp"
#include "output/layer_bytes.hpp"
#include "output/svg.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

const glm::vec3 paper(0.92F, 0.87F, 0.76F);

/// A ramp from transparent to opaque, from left to right; each row has its own colour.
LinearImage fade()
{
    LinearImage image{.width = 33, .height = 4, .pixels = {}, .paper = paper};
    const glm::vec3 colors[4] = {{0.0F, 0.0F, 0.0F}, {0.7F, 0.1F, 0.1F}, {1.0F, 1.0F, 1.0F}, paper};
    for (const glm::vec3& color : colors) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float alpha = static_cast<float>(x) / 32.0F;
            image.pixels.emplace_back(alpha * color, alpha);
        }
    }
    return image;
}

TEST(TransparentPictures, OfBytesComeBackFromPngAndWebp)
{
    const Image image = output::encoded_bytes(fade());
    EXPECT_EQ(image.rgba[3], 0);
    EXPECT_EQ(image.rgba[4 * 32 + 3], 255);
    EXPECT_EQ(decode_image(encode_png(image), "a.png"), image);
    EXPECT_EQ(decode_image(output::encode_webp(image, {}), "a.webp"), image);
    const Image lossy = decode_image(output::encode_webp(image, 95), "b.webp");
    for (size_t i = 3; i < image.rgba.size(); i += 4) {
        EXPECT_EQ(lossy.rgba[i], image.rgba[i]) << "alpha is kept as it is";
    }
}

TEST(TransparentPictures, OfSixteenBitsHaveAnAlphaChannel)
{
    const Image image = output::encoded_bytes(fade());
    const Image deep = decode_image(output::encode_deep_png(fade()), "a.png");
    ASSERT_EQ(deep.rgba.size(), image.rgba.size());
    const output::Arithmetic in(8);
    for (size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 == 3) {
            // White is so similar to the paper that bytes store its alpha less precisely.
            EXPECT_NEAR(deep.rgba[i], image.rgba[i], 12) << i;
            continue;
        }
        const double below = in.encoded(paper)[static_cast<int>(i % 4)];
        const auto shown = [&](const Image& by) {
            return in.over(below, by.rgba[i], by.rgba[i / 4 * 4 + 3]);
        };
        EXPECT_NEAR(shown(deep), shown(image), 1.5) << i;
    }
    LinearImage opaque = fade();
    opaque.paper.reset();
    const std::vector<std::byte> bytes = output::encode_deep_png(opaque);
    EXPECT_EQ(bytes.at(25), std::byte{2}) << "colour without alpha";
    EXPECT_EQ(output::encode_deep_png(fade()).at(25), std::byte{6}) << "colour with alpha";
}

TEST(TransparentPictures, InOpenExrAreMultipliedByAlpha)
{
    const test::Folder folder;
    const LinearImage image = fade();
    save_exr(image, folder / "a.exr", ExrNumbers::single);
    Imf::RgbaInputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.channels(), Imf::WRITE_RGBA);
    std::vector<Imf::Rgba> pixels(image.pixels.size());
    file.setFrameBuffer(pixels.data(), 1, image.width);
    file.readPixels(0, static_cast<int>(image.height) - 1);
    for (size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_NEAR(static_cast<float>(pixels[i].r), image.pixels[i].x, 1e-3F);
        EXPECT_NEAR(static_cast<float>(pixels[i].a), image.pixels[i].w, 1e-3F);
    }
    LinearImage opaque = image;
    opaque.paper.reset();
    save_exr(opaque, folder / "b.exr");
    EXPECT_EQ(Imf::RgbaInputFile((folder / "b.exr").c_str()).channels(), Imf::WRITE_RGB);
}

TEST(TransparentPictures, HaveOneLayerOnNothing)
{
    LayeredImage image{.picture = {.width = 2, .height = 1, .rgba = std::vector<uint8_t>(8)}};
    const auto layer = [](const char* name, LayerBlend blend, glm::vec4 left, glm::vec4 right) {
        return PictureLayer{.name = name, .blend = blend, .image = {2, 1, {left, right}, std::nullopt}};
    };
    image.layers = {layer("paper", LayerBlend::normal, glm::vec4(paper, 1.0F), glm::vec4(paper, 1.0F)),
                    layer("tint", LayerBlend::multiply, glm::vec4(1.0F), {0.5F, 0.5F, 1.0F, 1.0F}),
                    layer("ink", LayerBlend::normal, glm::vec4(0.0F), {0.1F, 0.0F, 0.0F, 0.4F})};
    image.masks.push_back(
        {.name = "ball", .above = 3, .x = 1, .y = 0, .width = 1, .height = 1, .cover = {0.25F}});
    EXPECT_EQ(output::one_layer(image, "ink").pixels[0].w, 1.0F) << "on white";
    image.paper = paper;
    const LinearImage ink = output::one_layer(image, "ink");
    EXPECT_EQ(ink.pixels, image.layers[2].image.pixels);
    EXPECT_TRUE(ink.paper.has_value());
    const LinearImage tint = output::one_layer(image, "tint");
    EXPECT_EQ(tint.pixels[0], glm::vec4(0.0F));
    EXPECT_EQ(tint.pixels[1], glm::vec4(0.0F, 0.0F, 0.5F, 0.5F)) << "on white half of yellow's light is left";
    const LinearImage mask = output::one_layer(image, "ball");
    EXPECT_EQ(mask.pixels[0], glm::vec4(0.0F));
    EXPECT_EQ(mask.pixels[1], glm::vec4(0.0F, 0.0F, 0.0F, 0.25F));
}

TEST(TransparentPictures, AsStrokesHaveNoPaper)
{
    VectorDrawing drawing{.width_mm = 10.0F, .height_mm = 10.0F};
    EXPECT_NE(output::encode_svg(drawing, {}).find("<rect"), std::string::npos);
    drawing.has_paper = false;
    EXPECT_EQ(output::encode_svg(drawing, {}).find("<rect"), std::string::npos);
}

} // namespace
} // namespace estampe
