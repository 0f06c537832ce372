// SPDX-License-Identifier: MIT
#include "contact_sheet.hpp"

#include <array>

#include <gtest/gtest.h>

namespace estampe::app {
namespace {

Image plain(uint32_t width, uint32_t height, uint8_t value)
{
    return {
        .width = width, .height = height, .rgba = std::vector<uint8_t>(size_t{4} * width * height, value)};
}

const uint8_t* pixel(const Image& image, uint32_t x, uint32_t y)
{
    return &image.rgba[4 * (size_t{y} * image.width + x)];
}

TEST(ContactSheet, HoldsEveryPictureWithItsNameBeneath)
{
    std::vector<SheetEntry> entries;
    for (uint8_t i = 0; i < 15; ++i) {
        entries.push_back({plain(80, 60, static_cast<uint8_t>(10 * i)), i == 7 ? "" : "name"});
    }
    const Image sheet = lay_out_sheet(entries);
    constexpr uint32_t gap = 16;
    constexpr uint32_t cell_x = 80 + gap;
    const uint32_t columns = (sheet.width - gap) / cell_x;
    const uint32_t rows = (15 + columns - 1) / columns;
    const uint32_t cell_y = (sheet.height - gap) / rows;
    ASSERT_EQ(sheet.width, columns * cell_x + gap);
    for (uint32_t i = 0; i < 15; ++i) {
        const uint32_t left = gap + i % columns * cell_x;
        const uint32_t top = gap + i / columns * cell_y;
        for (const auto& [x, y] : {std::array{0U, 0U}, std::array{79U, 0U}, std::array{79U, 59U}}) {
            EXPECT_EQ(*pixel(sheet, left + x, top + y), 10 * i);
        }
        uint32_t black = 0;
        for (uint32_t y = top + 60; y < top + cell_y; ++y) {
            for (uint32_t x = left; x < left + 80; ++x) {
                black += *pixel(sheet, x, y) < 128 ? 1U : 0U;
            }
        }
        EXPECT_EQ(black > 100, i != 7) << i << ": " << black;
        EXPECT_EQ(*pixel(sheet, left - 1, top), 255) << "the gap is white";
    }
}

TEST(ContactSheet, IsWiderThanHighAndKeepsOneRowForFew)
{
    const std::vector<SheetEntry> two{{plain(40, 30, 0), "a"}, {plain(40, 30, 0), "b"}};
    const Image sheet = lay_out_sheet(two);
    EXPECT_GT(sheet.width, sheet.height);
    EXPECT_TRUE(lay_out_sheet({}).empty());
}

TEST(ContactSheet, LettersThatTheFontLacksAreLeftOut)
{
    const std::vector<SheetEntry> entries{{plain(200, 30, 255), "a\xf0\x9f\x92\xa7z"}};
    const std::vector<SheetEntry> without{{plain(200, 30, 255), "az"}};
    EXPECT_EQ(lay_out_sheet(entries), lay_out_sheet(without));
}

} // namespace
} // namespace estampe::app
