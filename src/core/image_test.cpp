// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include <jpeglib.h>
#include <png.h>
#include <webp/encode.h>
#include <zlib.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

using Bytes = std::vector<std::byte>;

size_t file_count(const test::Folder& folder)
{
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

Image gradient(uint32_t width, uint32_t height)
{
    Image image{.width = width, .height = height, .rgba = {}};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            image.rgba.insert(image.rgba.end(), {static_cast<uint8_t>(x * 7), static_cast<uint8_t>(y * 11),
                                                 static_cast<uint8_t>(x + y), static_cast<uint8_t>(255 - x)});
        }
    }
    return image;
}

Bytes encode_jpeg(const Image& image)
{
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = image.width;
    jpeg.image_height = image.height;
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_EXT_RGBX;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (uint32_t y = 0; y < image.height; ++y) {
        auto* row = const_cast<JSAMPLE*>(image.rgba.data() + size_t{y} * image.width * 4);
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    const auto* first = reinterpret_cast<const std::byte*>(data);
    Bytes bytes(first, first + size);
    free(data);
    return bytes;
}

Bytes encode_webp(const Image& image)
{
    uint8_t* data = nullptr;
    const size_t size =
        WebPEncodeLosslessRGBA(image.rgba.data(), static_cast<int>(image.width),
                               static_cast<int>(image.height), static_cast<int>(image.width) * 4, &data);
    const auto* first = reinterpret_cast<const std::byte*>(data);
    Bytes bytes(first, first + size);
    WebPFree(data);
    return bytes;
}

/// Encodes a PNG of any format with libpng's simple interface.
Bytes encode_png_as(uint32_t format, uint32_t width, uint32_t height, const void* pixels)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    Bytes bytes(1 << 16);
    png_alloc_size_t size = bytes.size();
    EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr), 0);
    bytes.resize(size);
    return bytes;
}

TEST(Image, png_round_trip)
{
    const test::Folder folder;
    const Image image = gradient(61, 37);
    save_png(image, folder / "a.png");
    EXPECT_EQ(load_image(folder / "a.png"), image);
    EXPECT_EQ(file_count(folder), 1U) << "no temporary file stays";
    EXPECT_EQ(encode_png(image), encode_png(image));
}

TEST(Image, saving_replaces_the_old_file)
{
    const test::Folder folder;
    save_png(gradient(3, 3), folder / "a.png");
    save_png(gradient(5, 2), folder / "a.png");
    EXPECT_EQ(load_image(folder / "a.png"), gradient(5, 2));
}

TEST(Image, png_of_many_strips_comes_back_whole)
{
    // A prime number of pixels per row, so that strip ends do not coincide with buffer ends; noise over a
    // ramp.
    std::mt19937 random(7);
    Image image = gradient(1009, 1201);
    for (size_t i = 0; i < image.rgba.size() / 2; ++i) {
        image.rgba[2 * i] = static_cast<uint8_t>(random());
    }
    EXPECT_EQ(decode_image(encode_png(image), "a"), image);
    std::vector<uint16_t> deep(size_t{1009} * 701 * 3);
    std::ranges::generate(deep, [&] { return static_cast<uint16_t>(random()); });
    const auto back = decode_deep_image(encode_png(1009, 701, 3, deep), "a");
    ASSERT_TRUE(back);
    for (size_t i = 0; i < deep.size(); ++i) {
        ASSERT_EQ(back->rgba[i / 3 * 4 + i % 3], deep[i]) << i;
    }
}

TEST(Image, kinds_of_png)
{
    const std::vector<uint8_t> grey = {0, 128, 255, 7};
    EXPECT_EQ(decode_image(encode_png_as(PNG_FORMAT_GRAY, 2, 2, grey.data()), "a").rgba,
              (std::vector<uint8_t>{0, 0, 0, 255, 128, 128, 128, 255, 255, 255, 255, 255, 7, 7, 7, 255}));
    EXPECT_EQ(decode_image(encode_png_as(PNG_FORMAT_GA, 2, 1, grey.data()), "a").rgba,
              (std::vector<uint8_t>{0, 0, 0, 128, 255, 255, 255, 7}));
    const std::vector<uint8_t> rgb = {1, 2, 3, 4, 5, 6};
    EXPECT_EQ(decode_image(encode_png_as(PNG_FORMAT_RGB, 2, 1, rgb.data()), "a").rgba,
              (std::vector<uint8_t>{1, 2, 3, 255, 4, 5, 6, 255}));
    const std::vector<uint16_t> deep = {0, 65535};
    EXPECT_EQ(decode_image(encode_png_as(PNG_FORMAT_LINEAR_Y, 2, 1, deep.data()), "a").rgba,
              (std::vector<uint8_t>{0, 0, 0, 255, 255, 255, 255, 255}));
}

TEST(Image, sixteen_bits_are_kept_where_they_are_asked_for)
{
    const std::vector<uint16_t> deep = {0, 1, 258, 32769, 65534, 65535};
    const auto grey = decode_deep_image(encode_png_as(PNG_FORMAT_LINEAR_Y, 3, 2, deep.data()), "a");
    ASSERT_TRUE(grey);
    EXPECT_EQ(glm::uvec2(grey->width, grey->height), glm::uvec2(3, 2));
    ASSERT_EQ(grey->rgba.size(), 24U);
    for (size_t i = 0; i < deep.size(); ++i) {
        for (size_t channel = 0; channel < 4; ++channel) {
            EXPECT_EQ(grey->rgba[4 * i + channel], channel < 3 ? deep[i] : 65535) << i;
        }
    }
    const auto colours = decode_deep_image(encode_png(1, 2, 3, deep), "a");
    ASSERT_TRUE(colours);
    EXPECT_EQ(colours->rgba, (std::vector<uint16_t>{0, 1, 258, 65535, 32769, 65534, 65535, 65535}));
    EXPECT_FALSE(decode_deep_image(encode_png(gradient(5, 2)), "a"));
    EXPECT_FALSE(decode_deep_image(encode_webp(gradient(5, 2)), "a"));
    EXPECT_FALSE(decode_deep_image({}, "a"));
    const Bytes whole = encode_png(1, 2, 3, deep);
    for (size_t size = 25; size + 16 < whole.size(); ++size) {
        EXPECT_THROW((void)decode_deep_image(std::span(whole).first(size), "a"), Error) << size;
    }
}

TEST(Image, webp_round_trip)
{
    Image image = gradient(17, 9);
    EXPECT_EQ(decode_image(encode_webp(image), "a.webp"), image);
}

TEST(Image, jpeg_is_close)
{
    const Image image = gradient(16, 16);
    const Image decoded = decode_image(encode_jpeg(image), "a.jpg");
    ASSERT_EQ(decoded.rgba.size(), image.rgba.size());
    for (size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 == 3) {
            EXPECT_EQ(decoded.rgba[i], 255);
        } else {
            EXPECT_NEAR(decoded.rgba[i], image.rgba[i], 24);
        }
    }
}

void expect_error(const Bytes& bytes, const std::string& part)
{
    try {
        (void)decode_image(bytes, "picture");
        ADD_FAILURE() << "no error: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "picture");
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(Image, every_truncation_is_an_error)
{
    const Image image = gradient(24, 24);
    for (const Bytes& whole : {encode_png(image), encode_jpeg(image), encode_webp(image)}) {
        for (size_t size = 0; size + 16 < whole.size(); size += 7) {
            expect_error(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)), "");
        }
    }
}

TEST(Image, random_bytes_never_crash)
{
    const Image image = gradient(24, 24);
    std::mt19937 random(7);
    for (const Bytes& whole : {encode_png(image), encode_jpeg(image), encode_webp(image)}) {
        for (int round = 0; round < 300; ++round) {
            Bytes bytes = whole;
            bytes[random() % bytes.size()] = static_cast<std::byte>(random() & 0xFF);
            try {
                EXPECT_FALSE(decode_image(bytes, "picture").empty());
            } catch (const Error& error) {
                EXPECT_EQ(error.where(), "picture");
            }
        }
    }
}

/// Only the header of a PNG that claims `side` x `side` pixels.
Bytes png_header(uint32_t side)
{
    Bytes bytes = encode_png(gradient(1, 1));
    const std::byte big_endian[] = {std::byte(side >> 24), std::byte(side >> 16 & 255),
                                    std::byte(side >> 8 & 255), std::byte(side & 255)};
    std::copy_n(big_endian, 4, bytes.begin() + 16);
    std::copy_n(big_endian, 4, bytes.begin() + 20);
    const auto crc =
        static_cast<uint32_t>(crc32(0, reinterpret_cast<const unsigned char*>(bytes.data()) + 12, 17));
    for (size_t i = 0; i < 4; ++i) {
        bytes[29 + i] = std::byte(crc >> (24 - 8 * i) & 255);
    }
    return bytes;
}

TEST(Image, absurd_sizes_are_errors)
{
    expect_error(png_header(2000000000),
                 "image of 2000000000 x 2000000000 pixels is beyond the limit of 16384");
    expect_error(png_header(60000), "image of 60000 x 60000 pixels is beyond the limit of 16384");
    expect_error(png_header(8192), "cannot come from");
    expect_error(png_header(0), "");
    expect_error({}, "is not a PNG, JPEG, WebP, TIFF, TGA, BMP, GIF or PSD image");
}

TEST(Image, loading_what_is_not_there)
{
    const test::Folder folder;
    EXPECT_THROW((void)load_image(folder / "none.png"), Error);
    EXPECT_THROW((void)load_image("/dev/zero"), Error);
    EXPECT_THROW((void)load_image(std::filesystem::temp_directory_path()), Error);
}

TEST(Image, saving_where_one_cannot)
{
    const test::Folder folder;
    const auto expect_unwritable = [](const Image& image, const std::filesystem::path& path) {
        try {
            save_png(image, path);
            ADD_FAILURE() << path;
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), path.string());
        }
    };
    expect_unwritable(gradient(2, 2), folder / "none/a.png");
    expect_unwritable(gradient(2, 2), std::filesystem::temp_directory_path());
    expect_unwritable({}, folder / "a.png");
    expect_unwritable({.width = 2, .height = 2, .rgba = {1, 2, 3}}, folder / "a.png");
    EXPECT_EQ(file_count(folder), 0U);
}

TEST(File, read_limit)
{
    const test::Folder folder;
    write_file_atomically(folder / "a.bin", Bytes(10));
    EXPECT_EQ(read_file(folder / "a.bin").size(), 10U);
    EXPECT_THROW((void)read_file(folder / "a.bin", 9), Error);
}

} // namespace
} // namespace estampe
