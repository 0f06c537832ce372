// SPDX-License-Identifier: MIT
// Textures smaller than what holds them are stretched without rims, and across their borders as they wrap.
#include "techniques/surface/mips.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>

#include <gtest/gtest.h>

namespace estampe::surface {
namespace {

/// A grey texture.
Texture textured(uint32_t width, uint32_t height, const std::function<int(uint32_t, uint32_t)>& grey)
{
    Texture texture;
    texture.image = {.width = width, .height = height};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const auto value = static_cast<uint8_t>(grey(x, y));
            texture.image.rgba.insert(texture.image.rgba.end(), {value, value, value, 255});
        }
    }
    return texture;
}

int value_at(const std::vector<std::byte>& level, uint32_t side, uint32_t x, uint32_t y)
{
    return std::to_integer<int>(level[(static_cast<size_t>(y) * side + x) * 4]);
}

TEST(Mips, HardEdgesAreStretchedWithoutARim)
{
    for (const uint32_t width : {2U, 10U, 60U, 100U, 255U}) {
        Texture texture =
            textured(width, 7, [&](uint32_t x, uint32_t /*y*/) { return x < width / 2 ? 60 : 190; });
        texture.wrap_u = Wrap::clamp;
        const gpu::LayerPixels mips = make_mips(texture, 256);
        for (uint32_t x = 1; x < 256; ++x) {
            const int before = value_at(mips.levels[0], 256, x - 1, 100);
            const int here = value_at(mips.levels[0], 256, x, 100);
            EXPECT_GE(here, before) << width << " at " << x;
            EXPECT_GE(before, 60) << width << " at " << x;
            EXPECT_LE(here, 190) << width << " at " << x;
        }
        EXPECT_EQ(value_at(mips.levels[0], 256, 0, 0), 60);
        EXPECT_EQ(value_at(mips.levels[0], 256, 255, 255), 190);
    }
}

TEST(Mips, BordersGoOnAsTheTextureWraps)
{
    // Black on the left, white on the right: only where it repeats do the borders run into each other.
    Texture texture = textured(4, 4, [](uint32_t x, uint32_t /*y*/) { return x < 2 ? 0 : 200; });
    const auto border = [&](Wrap wrap) {
        texture.wrap_u = wrap;
        return value_at(make_mips(texture, 256).levels[0], 256, 0, 128);
    };
    EXPECT_EQ(border(Wrap::clamp), 0);
    EXPECT_EQ(border(Wrap::mirror), 0);
    EXPECT_NEAR(border(Wrap::repeat), 100, 2);
}

TEST(Mips, WhatHasTheSizeIsKeptAndLevelsAreMeans)
{
    const Texture texture =
        textured(256, 256, [](uint32_t x, uint32_t y) { return static_cast<int>((x * 7 + y * 13) % 256); });
    const gpu::LayerPixels mips = make_mips(texture, 256);
    ASSERT_EQ(mips.levels.size(), 9U);
    EXPECT_EQ(value_at(mips.levels[0], 256, 17, 201), (17 * 7 + 201 * 13) % 256);
    const int sum = value_at(mips.levels[0], 256, 10, 20) + value_at(mips.levels[0], 256, 11, 20) +
                    value_at(mips.levels[0], 256, 10, 21) + value_at(mips.levels[0], 256, 11, 21);
    EXPECT_EQ(value_at(mips.levels[1], 128, 5, 10), (sum + 2) / 4);
}

TEST(Mips, OneTexelFillsAll)
{
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        Texture texture = textured(1, 1, [](uint32_t /*x*/, uint32_t /*y*/) { return 77; });
        texture.wrap_u = wrap;
        texture.wrap_v = wrap;
        for (const std::vector<std::byte>& level : make_mips(texture, 64).levels) {
            EXPECT_EQ(std::to_integer<int>(level.front()), 77);
            EXPECT_EQ(std::to_integer<int>(level[level.size() - 4]), 77);
        }
    }
}

} // namespace
} // namespace estampe::surface
