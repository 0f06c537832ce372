// SPDX-License-Identifier: MIT
#include "techniques/tam/files/map_files.hpp"

#include <gtest/gtest.h>

#include "techniques/tam/stroke.hpp"
#include "techniques/tam/test_support.hpp"

namespace estampe::tam {
namespace {

using testing::message_of;
using testing::small_map;

void put(std::vector<std::byte>& bytes, size_t place, uint32_t value)
{
    for (size_t i = 0; i < 4; ++i) {
        bytes[place + i] = static_cast<std::byte>(value >> (8 * i) & 0xFFU);
    }
}

/// A file without a DX10 header, as written by DxTex and old painting programs: 4 x 4, one level.
std::vector<std::byte> old_file(uint32_t flags, uint32_t bits, uint32_t red, uint32_t green, uint32_t blue,
                                uint32_t alpha)
{
    std::vector<std::byte> bytes(128);
    for (const auto& [place, value] : {std::pair<size_t, uint32_t>{0, 0x20534444},
                                       {4, 124},
                                       {12, 4},
                                       {16, 4},
                                       {28, 1},
                                       {76, 32},
                                       {80, flags},
                                       {88, bits},
                                       {92, red},
                                       {96, green},
                                       {100, blue},
                                       {104, alpha}}) {
        put(bytes, place, value);
    }
    return bytes;
}

TEST(Dds, ReadsBackWhatItWrote)
{
    const DdsImages images = decode_dds(encode_dds(small_map()), "small.dds");
    EXPECT_EQ(images.size_px, 32U);
    EXPECT_EQ(images.level_of_layer, small_map().level_of_tone);
}

TEST(Dds, ReadsLuminanceColourAndAlpha)
{
    std::vector<std::byte> luminance = old_file(0x20000, 8, 0xFF, 0, 0, 0);
    luminance.resize(128 + 16, std::byte{55});
    EXPECT_EQ(decode_dds(luminance, "l8").level_of_layer[0][0], Gray8(16, 200));

    std::vector<std::byte> bgra = old_file(0x41, 32, 0xFF0000, 0xFF00, 0xFF, 0xFF000000);
    for (int texel = 0; texel < 16; ++texel) {
        bgra.insert(bgra.end(), {std::byte{0}, std::byte{0}, std::byte{0}, std::byte{120}});
    }
    EXPECT_EQ(decode_dds(bgra, "bgra8").level_of_layer[0][0], Gray8(16, 120));

    std::vector<std::byte> rgb = old_file(0x40, 24, 0xFF, 0xFF00, 0xFF0000, 0);
    for (int texel = 0; texel < 16; ++texel) {
        rgb.insert(rgb.end(), {std::byte{255}, std::byte{255}, std::byte{0}});
    }
    EXPECT_EQ(decode_dds(rgb, "rgb8").level_of_layer[0][0],
              Gray8(16, 32)); // yellow: an eighth of the luminance is missing

    std::vector<std::byte> alpha = old_file(0x2, 8, 0, 0, 0, 0xFF);
    alpha.resize(128 + 16, std::byte{55});
    EXPECT_EQ(decode_dds(alpha, "a8").level_of_layer[0][0], Gray8(16, 55));
}

std::vector<std::byte> volume_file(uint32_t slices, uint32_t levels)
{
    std::vector<std::byte> bytes = old_file(0x20000, 8, 0xFF, 0, 0, 0);
    put(bytes, 24, slices);
    put(bytes, 28, levels);
    put(bytes, 112, 0x200000);
    return bytes;
}

TEST(Dds, ReadsTheSlicesOfAVolumeAsTones)
{
    std::vector<std::byte> bytes = volume_file(3, 3);
    for (const int light : {200, 100, 50}) {
        bytes.insert(bytes.end(), 16, static_cast<std::byte>(light));
    }
    const DdsImages images = decode_dds(bytes, "volume");
    ASSERT_EQ(images.level_of_layer.size(), 3U);
    EXPECT_EQ(images.level_of_layer[0].size(), 1U) << "all tones share the only slice of level 1";
    EXPECT_EQ(images.level_of_layer[2][0], Gray8(16, 205));
}

TEST(Dds, BlendsTheTonesOfAVolumesLevelsFromItsSlices)
{
    std::vector<std::byte> bytes = volume_file(5, 3);
    for (const int ink : {20, 60, 100, 140, 220}) {
        bytes.insert(bytes.end(), 16, static_cast<std::byte>(255 - ink));
    }
    const auto half = [&](int left, int right) { // a level of 2 px: ink on the left, ink on the right
        for (const int ink : {left, right, left, right}) {
            bytes.push_back(static_cast<std::byte>(255 - ink));
        }
    };
    half(80, 0);   // darkness 40
    half(255, 65); // darkness 160
    const DdsImages images = decode_dds(bytes, "volume");
    ASSERT_EQ(images.level_of_layer.size(), 5U);
    const std::vector<Gray8> expected{
        {40, 0, 40, 0}, {109, 11, 109, 11}, {168, 33, 168, 33}, {226, 54, 226, 54}, {255, 65, 255, 65}};
    for (size_t tone = 0; tone < 5; ++tone) {
        ASSERT_EQ(images.level_of_layer[tone].size(), 2U) << "level 2 has one slice";
        EXPECT_EQ(images.level_of_layer[tone][1], expected[tone]) << tone;
    }
    bytes.pop_back();
    EXPECT_NE(message_of([&] { static_cast<void>(decode_dds(bytes, "cut")); }).find("truncated"),
              std::string::npos);
}

TEST(Dds, RefusesCompressedAndOddOnes)
{
    std::vector<std::byte> dxt = old_file(0x4, 0, 0, 0, 0, 0);
    put(dxt, 84, 0x31545844); // "DXT1"
    dxt.resize(400);
    EXPECT_NE(message_of([&] { static_cast<void>(decode_dds(dxt, "dxt.dds")); }).find("save it uncompressed"),
              std::string::npos);
    std::vector<std::byte> wide = old_file(0x20000, 8, 0xFF, 0, 0, 0);
    put(wide, 16, 8);
    EXPECT_NE(message_of([&] { static_cast<void>(decode_dds(wide, "wide.dds")); }).find("is 8 x 4 pixels"),
              std::string::npos);
    std::vector<std::byte> masks = old_file(0x40, 16, 0xF800, 0x7E0, 0x1F, 0);
    EXPECT_NE(message_of([&] { static_cast<void>(decode_dds(masks, "masks.dds")); }).find("cannot be read"),
              std::string::npos);
}

TEST(Dds, RefusesATruncatedFile)
{
    const std::vector<std::byte> bytes = encode_dds(small_map());
    for (size_t length = 0; length < bytes.size(); length += 1 + length / 50) {
        EXPECT_THROW(static_cast<void>(decode_dds(std::span(bytes).first(length), "cut.dds")), Error)
            << length;
    }
}

TEST(Dds, SurvivesAnyHeader)
{
    Random random(3);
    const std::vector<std::byte> good = encode_dds(small_map());
    int refused = 0;
    for (int round = 0; round < 3000; ++round) {
        std::vector<std::byte> bytes = good;
        for (int i = 0; i < 1 + round % 3; ++i) {
            bytes[random.bits() % 148] = static_cast<std::byte>(random.bits());
        }
        if (round % 5 == 0) {
            put(bytes, 4 * (random.bits() % 37), 0xFFFFFFFFU);
        }
        refused += message_of([&] { static_cast<void>(decode_dds(bytes, "hostile.dds")); }).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 500);
}

} // namespace
} // namespace estampe::tam
