// SPDX-License-Identifier: MIT
// Pictures are decoded with the libraries themselves, by functions that the writers do not use.
#include "output/pictures.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <set>
#include <sstream>

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <jpeglib.h>
#include <lcms2.h>
#include <png.h>
#include <webp/mux.h>

#include <estampe/error.hpp>

#include "core/color.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

using Bytes = std::vector<std::byte>;

/// Slow waves of all colours, with thin red lines.
Image waves(uint32_t width, uint32_t height)
{
    Image image{.width = width, .height = height, .rgba = {}};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const auto wave = [&](double turn) {
                return static_cast<uint8_t>(
                    std::lround(127.5 + 127.5 * std::sin(0.05 * x + 0.03 * y + turn)));
            };
            const bool is_line = x % 16 == 7;
            image.rgba.insert(image.rgba.end(),
                              {is_line ? uint8_t{200} : wave(0.0), is_line ? uint8_t{20} : wave(2.0),
                               is_line ? uint8_t{30} : wave(4.0), uint8_t{255}});
        }
    }
    return image;
}

/// A ramp from black to slightly above white, in more steps than bytes have.
LinearImage ramp()
{
    LinearImage image{.width = 64, .height = 64, .pixels = {}};
    for (uint32_t i = 0; i < 64 * 64; ++i) {
        const float t = static_cast<float>(i) / 4000.0F;
        image.pixels.emplace_back(t, 0.5F * t, t * t, 1.0F);
    }
    return image;
}

double mean_difference(const Image& a, const Image& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        sum += std::abs(a.rgba[i] - b.rgba.at(i));
    }
    return sum / static_cast<double>(a.rgba.size());
}

std::string message_of(const std::function<void()>& job)
{
    try {
        job();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// Checks with lcms that the profile gives the colours of sRGB.
void expect_srgb(const void* profile_bytes, size_t size)
{
    struct Close {
        void operator()(void* profile) const { cmsCloseProfile(profile); }
    };

    const std::unique_ptr<void, Close> profile(
        cmsOpenProfileFromMem(profile_bytes, static_cast<cmsUInt32Number>(size)));
    ASSERT_TRUE(profile);
    EXPECT_EQ(cmsGetColorSpace(profile.get()), cmsSigRgbData);
    EXPECT_EQ(cmsGetDeviceClass(profile.get()), cmsSigDisplayClass);
    const std::unique_ptr<void, Close> lab(cmsCreateLab4Profile(nullptr));
    cmsHTRANSFORM to_lab = cmsCreateTransform(profile.get(), TYPE_RGB_8, lab.get(), TYPE_Lab_DBL,
                                              INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE);
    ASSERT_NE(to_lab, nullptr);
    // Lindbloom's sRGB values, adapted to D50: red, green, blue, mid grey.
    const uint8_t colors[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {119, 119, 119}};
    const double wanted[4][3] = {
        {54.29, 80.81, 69.89}, {87.82, -79.29, 80.99}, {29.57, 68.30, -112.03}, {50.03, 0.0, 0.0}};
    for (int i = 0; i < 4; ++i) {
        double values[3] = {};
        cmsDoTransform(to_lab, colors[i], values, 1);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(values[channel], wanted[i][channel], 0.2) << "colour " << i << " channel " << channel;
        }
    }
    cmsDeleteTransform(to_lab);
}

struct PngFacts {
    int bits = 0;
    int intent = -1;
    double gamma = 0.0;
    double red_x = 0.0;
    std::vector<uint16_t> values; ///< Only for 16-bit pictures
};

PngFacts read_png(const Bytes& bytes)
{
    PngFacts facts;
    std::FILE* file = fmemopen(const_cast<std::byte*>(bytes.data()), bytes.size(), "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    facts.bits = png_get_bit_depth(png, info);
    png_get_sRGB(png, info, &facts.intent);
    png_get_gAMA(png, info, &facts.gamma);
    double unused = 0.0;
    png_get_cHRM(png, info, &unused, &unused, &facts.red_x, &unused, &unused, &unused, &unused, &unused);
    if (facts.bits == 16) {
        png_set_swap(png);
        png_read_update_info(png, info);
        const size_t row_values = png_get_rowbytes(png, info) / 2;
        const uint32_t height = png_get_image_height(png, info);
        facts.values.resize(row_values * height);
        for (uint32_t y = 0; y < height; ++y) {
            png_read_row(png, reinterpret_cast<png_bytep>(facts.values.data() + row_values * y), nullptr);
        }
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return facts;
}

TEST(Pictures, PngSaysThatItIsSrgb)
{
    const PngFacts facts = read_png(encode_png(waves(8, 8)));
    EXPECT_EQ(facts.bits, 8);
    EXPECT_EQ(facts.intent, PNG_sRGB_INTENT_PERCEPTUAL);
    EXPECT_NEAR(facts.gamma, 1.0 / 2.2, 1e-4);
    EXPECT_NEAR(facts.red_x, 0.64, 1e-4);
}

TEST(Pictures, DeepPngCarriesSixteenBits)
{
    const LinearImage image = ramp();
    const PngFacts facts = read_png(output::encode_deep_png(image));
    EXPECT_EQ(facts.bits, 16);
    EXPECT_EQ(facts.intent, PNG_sRGB_INTENT_PERCEPTUAL);
    ASSERT_EQ(facts.values.size(), 3 * image.pixels.size());
    std::set<uint16_t> reds;
    for (size_t i = 0; i < facts.values.size(); ++i) {
        const double linear =
            std::min(static_cast<double>(image.pixels[i / 3][static_cast<int>(i % 3)]), 1.0);
        EXPECT_NEAR(facts.values[i], 65535.0 * srgb_from_linear(linear), 0.6) << i;
        if (i % 3 == 0) {
            reds.insert(facts.values[i]);
        }
    }
    EXPECT_GT(reds.size(), 3900U);
}

/// Properties of a JPEG file besides its pixels.
struct JpegFacts {
    int components = 0;
    bool has_full_color = true;
    std::vector<uint8_t> profile;
};

JpegFacts read_jpeg(const Bytes& bytes)
{
    JpegFacts facts;
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_save_markers(&jpeg, JPEG_APP0 + 2, 0xFFFF);
    jpeg_read_header(&jpeg, TRUE);
    facts.components = jpeg.num_components;
    for (int i = 0; i < jpeg.num_components; ++i) {
        facts.has_full_color = facts.has_full_color &&
                               jpeg.comp_info[i].h_samp_factor == jpeg.max_h_samp_factor &&
                               jpeg.comp_info[i].v_samp_factor == jpeg.max_v_samp_factor;
    }
    JOCTET* data = nullptr;
    unsigned int size = 0;
    if (jpeg_read_icc_profile(&jpeg, &data, &size) != 0) {
        facts.profile.assign(data, data + size);
        std::free(data);
    }
    jpeg_destroy_decompress(&jpeg);
    return facts;
}

TEST(Pictures, JpegHasFullColourAndAProfile)
{
    const Image image = waves(200, 120);
    const Bytes bytes = output::encode_jpeg(image, 92);
    const JpegFacts facts = read_jpeg(bytes);
    EXPECT_EQ(facts.components, 3);
    EXPECT_TRUE(facts.has_full_color);
    expect_srgb(facts.profile.data(), facts.profile.size());
    const Image decoded = decode_image(bytes, "a.jpg");
    ASSERT_EQ(decoded.width, 200U);
    EXPECT_LT(mean_difference(image, decoded), 2.5);
    // A thin line stays red.
    const uint8_t* pixel = &decoded.rgba[4 * (size_t{60} * 200 + 103)];
    EXPECT_GT(pixel[0] - pixel[1], 150);
}

TEST(Pictures, QualityTradesSizeForLikeness)
{
    const Image image = waves(200, 120);
    const auto both = [&](const Bytes& coarse, const Bytes& fine) {
        EXPECT_LT(2 * coarse.size(), fine.size());
        EXPECT_GT(mean_difference(image, decode_image(coarse, "coarse")),
                  mean_difference(image, decode_image(fine, "fine")));
    };
    both(output::encode_jpeg(image, 20), output::encode_jpeg(image, 95));
    both(output::encode_webp(image, 10), output::encode_webp(image, 95));
}

TEST(Pictures, WebpIsLosslessUnlessToldOtherwise)
{
    const Image image = waves(130, 70);
    const Bytes lossless = output::encode_webp(image, {});
    EXPECT_EQ(decode_image(lossless, "a.webp"), image);
    const Bytes lossy = output::encode_webp(image, 90);
    EXPECT_NE(decode_image(lossy, "b.webp"), image);
    EXPECT_LT(mean_difference(image, decode_image(lossy, "b.webp")), 8.0);
    for (const Bytes& bytes : {lossless, lossy}) {
        const WebPData data{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
        WebPMux* mux = WebPMuxCreate(&data, 0);
        ASSERT_NE(mux, nullptr);
        WebPData profile{};
        EXPECT_EQ(WebPMuxGetChunk(mux, "ICCP", &profile), WEBP_MUX_OK);
        expect_srgb(profile.bytes, profile.size);
        WebPMuxDelete(mux);
    }
}

/// Content of a file according to OpenEXR's general reader, as floats.
struct ExrFacts {
    std::map<std::string, Imf::PixelType> types;
    std::map<std::string, std::vector<float>> values;
    bool has_chromaticities = false;
    Imf::Chromaticities chromaticities;
};

ExrFacts read_exr(const std::filesystem::path& path)
{
    ExrFacts facts;
    Imf::InputFile file(path.c_str());
    facts.has_chromaticities = Imf::hasChromaticities(file.header());
    if (facts.has_chromaticities) {
        facts.chromaticities = Imf::chromaticities(file.header());
    }
    const Imath::Box2i window = file.header().dataWindow();
    const auto width = static_cast<size_t>(window.max.x + 1);
    const auto height = static_cast<size_t>(window.max.y + 1);
    Imf::FrameBuffer slices;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        facts.types[channel.name()] = channel.channel().type;
        std::vector<float>& values = facts.values[channel.name()];
        values.resize(width * height);
        slices.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                                 sizeof(float), sizeof(float) * width));
    }
    file.setFrameBuffer(slices);
    file.readPixels(window.min.y, window.max.y);
    return facts;
}

TEST(Pictures, ExrIsLinearAndNamesItsPrimaries)
{
    const test::Folder folder;
    const LinearImage image = ramp();
    for (const ExrNumbers numbers : {ExrNumbers::half, ExrNumbers::single}) {
        save_exr(image, folder / "a.exr", numbers);
        const ExrFacts facts = read_exr(folder / "a.exr");
        const bool is_half = numbers == ExrNumbers::half;
        ASSERT_EQ(facts.types.size(), 3U);
        ASSERT_TRUE(facts.has_chromaticities);
        EXPECT_NEAR(facts.chromaticities.red.x, 0.64F, 1e-6F);
        EXPECT_NEAR(facts.chromaticities.green.y, 0.60F, 1e-6F);
        EXPECT_NEAR(facts.chromaticities.blue.x, 0.15F, 1e-6F);
        EXPECT_NEAR(facts.chromaticities.white.x, 0.3127F, 1e-6F);
        for (int channel = 0; channel < 3; ++channel) {
            const std::string name(1, "RGB"[channel]);
            EXPECT_EQ(facts.types.at(name), is_half ? Imf::HALF : Imf::FLOAT);
            for (size_t i = 0; i < image.pixels.size(); ++i) {
                const float wanted = image.pixels[i][channel];
                EXPECT_EQ(facts.values.at(name)[i],
                          is_half ? static_cast<float>(Imath::half(wanted)) : wanted);
            }
        }
    }
}

TEST(Pictures, WhatAFormatCannotHoldIsSaid)
{
    const auto strip = [](uint32_t width) {
        return Image{.width = width, .height = 1, .rgba = std::vector<uint8_t>(4 * size_t{width}, 128)};
    };
    EXPECT_EQ(message_of([&] { std::ignore = output::encode_jpeg(strip(65500), 50); }), "");
    EXPECT_NE(
        message_of([&] { std::ignore = output::encode_jpeg(strip(65501), 50); }).find("more than 65500"),
        std::string::npos);
    EXPECT_EQ(message_of([&] { std::ignore = output::encode_webp(strip(16383), 50); }), "");
    EXPECT_NE(
        message_of([&] { std::ignore = output::encode_webp(strip(16384), 50); }).find("more than 16383"),
        std::string::npos);
    EXPECT_NE(message_of([&] { std::ignore = output::encode_jpeg(strip(4), 0); }), "");
    EXPECT_NE(message_of([&] { std::ignore = output::encode_jpeg(strip(4), 101); }), "");
    EXPECT_NE(message_of([&] { std::ignore = output::encode_webp(strip(4), -1); }), "");
    const test::Folder folder;
    const auto expect_unwritable = [&](const std::function<void()>& job) {
        EXPECT_NE(message_of(job).find((folder / "none").string()), std::string::npos) << message_of(job);
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    };
    expect_unwritable([&] { save_jpeg(strip(4), folder / "none/a.jpg"); });
    expect_unwritable([&] { save_jpeg({}, folder / "none.jpg"); });
    expect_unwritable([&] { save_webp({}, folder / "none.webp"); });
    expect_unwritable([&] { save_png(LinearImage{}, folder / "none.png"); });
    expect_unwritable([&] { save_exr({}, folder / "none.exr"); });
}

TEST(Pictures, TheSamePictureGivesTheSameBytes)
{
    const Image image = waves(40, 30);
    EXPECT_EQ(output::encode_jpeg(image, 92), output::encode_jpeg(image, 92));
    EXPECT_EQ(output::encode_webp(image, {}), output::encode_webp(image, {}));
    EXPECT_EQ(output::encode_picture_exr(ramp(), ExrNumbers::half),
              output::encode_picture_exr(ramp(), ExrNumbers::half));
    // Creation year and month in the profile must not be today's.
    const Bytes& profile = output::srgb_profile();
    EXPECT_EQ(std::to_integer<int>(profile.at(24)) * 256 + std::to_integer<int>(profile.at(25)), 2000);
}

} // namespace
} // namespace estampe
