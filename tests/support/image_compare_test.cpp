// SPDX-License-Identifier: MIT
#include "image_compare.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace estampe::test {
namespace {

void set_pixel(Image& image, uint32_t x, uint32_t y, uint8_t grey)
{
    std::fill_n(image.rgba.begin() + static_cast<std::ptrdiff_t>((size_t{y} * image.width + x) * 4), 3, grey);
}

Image with_line(uint32_t column)
{
    Image image = flat_image(64, 36, 250);
    for (uint32_t y = 0; y < image.height; ++y)
        set_pixel(image, column, y, 10);
    return image;
}

Image grey_ramp(double scale)
{
    Image image = flat_image(256, 8, 0);
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x)
            set_pixel(image, x, y, static_cast<uint8_t>(x * scale));
    }
    return image;
}

TEST(ImageCompareTest, IdenticalPicturesDoNotDiffer)
{
    const ImageDifference d = compare_images(with_line(20), with_line(20), 0);
    EXPECT_EQ(d.max_abs, 0u);
    EXPECT_EQ(d.mean_abs, 0.0);
    EXPECT_EQ(d.failing_fraction, 0.0);
    EXPECT_EQ(d.delta_e_mean, 0.0);
    EXPECT_EQ(d.delta_e_p95, 0.0);
    EXPECT_EQ(heat_map(with_line(20), with_line(20)).find_first_not_of(" \n"), std::string::npos);
}

TEST(ImageCompareTest, ALineShiftedByOnePixelIsSeen)
{
    const ImageDifference d = compare_images(with_line(20), with_line(21));
    EXPECT_EQ(d.max_abs, 240u);
    EXPECT_DOUBLE_EQ(d.failing_fraction, 2.0 / 64.0);
    EXPECT_DOUBLE_EQ(d.mean_abs, 240.0 * 2.0 / 64.0);
    EXPECT_GT(d.delta_e_p95, 2.3);
    EXPECT_GT(d.delta_e_mean, 0.3);
    // With the blur, a shift by one pixel counts less than a missing line.
    EXPECT_LT(d.delta_e_mean, compare_images(with_line(20), flat_image(64, 36, 250)).delta_e_mean);
}

TEST(ImageCompareTest, ToneChangedByTwoPercentIsSeen)
{
    const ImageDifference d = compare_images(grey_ramp(1.0), grey_ramp(0.98));
    EXPECT_GT(d.delta_e_mean, 0.5);
    EXPECT_GT(d.delta_e_p95, 1.0);
    EXPECT_GT(d.failing_fraction, 0.3);
    EXPECT_LE(d.max_abs, 6u);
}

TEST(ImageCompareTest, TheLimitIsInclusive)
{
    EXPECT_EQ(compare_images(flat_image(4, 4, 100), flat_image(4, 4, 102), 2).failing_fraction, 0.0);
    EXPECT_EQ(compare_images(flat_image(4, 4, 100), flat_image(4, 4, 103), 2).failing_fraction, 1.0);
}

TEST(ImageCompareTest, DeltaEAgreesWithKnownColours)
{
    EXPECT_NEAR(compare_images(flat_image(8, 8, 0), flat_image(8, 8, 255)).delta_e_mean, 100.0, 0.01);
    // sRGB 119 is the L* = 50 of colour charts.
    EXPECT_NEAR(compare_images(flat_image(8, 8, 0), flat_image(8, 8, 119)).delta_e_mean, 50.03, 0.05);
    Image red = flat_image(8, 8, 0);
    for (size_t i = 0; i < red.rgba.size(); i += 4)
        red.rgba[i] = 255;
    // Pure red is L*a*b* 53.24, 80.09, 67.20.
    EXPECT_NEAR(compare_images(flat_image(8, 8, 0), red).delta_e_p95,
                std::sqrt(53.24 * 53.24 + 80.09 * 80.09 + 67.2 * 67.2), 0.05);
}

TEST(ImageCompareTest, AlphaCounts)
{
    Image clear = flat_image(8, 8, 0);
    for (size_t i = 3; i < clear.rgba.size(); i += 4)
        clear.rgba[i] = 0;
    EXPECT_EQ(compare_images(flat_image(8, 8, 0), clear).max_abs, 255u);
    EXPECT_NEAR(compare_images(flat_image(8, 8, 255), clear).delta_e_mean, 0.0, 1e-9);
}

TEST(ImageCompareTest, OnePixelShowsInItsCell)
{
    Image dotted = flat_image(160, 90, 0);
    set_pixel(dotted, 31, 49, 255);
    set_pixel(dotted, 159, 89, 1);
    const std::string map = heat_map(flat_image(160, 90, 0), dotted);
    ASSERT_EQ(map.size(), 9u * 17u);
    EXPECT_EQ(map[4 * 17 + 3], '@');
    EXPECT_EQ(map[8 * 17 + 15], '.');
    EXPECT_EQ(std::ranges::count(map, ' '), 16 * 9 - 2);
}

TEST(ImageCompareTest, TheSheetShowsAllThree)
{
    const Image sheet = difference_sheet(flat_image(10, 6, 40), flat_image(10, 6, 50));
    ASSERT_EQ(sheet.width, 3u * 10u + 2u * 4u);
    ASSERT_EQ(sheet.height, 6u);
    const auto red = [&](uint32_t x) { return sheet.rgba[x * 4]; };
    EXPECT_EQ(red(0), 40);
    EXPECT_EQ(red(14), 50);
    EXPECT_EQ(red(28), 40) << "four times the difference";
}

TEST(ImageCompareTest, TheSheetTakesPicturesOfDifferentSize)
{
    const Image sheet = difference_sheet(flat_image(10, 6, 40), flat_image(4, 9, 40));
    EXPECT_EQ(sheet.width, 38u);
    EXPECT_EQ(sheet.height, 9u);
    const uint8_t* outside = &sheet.rgba[(8 * 38 + 37) * 4];
    EXPECT_EQ(outside[0], 255);
    EXPECT_EQ(outside[1], 0);
    EXPECT_EQ(outside[2], 255);
}

TEST(ImageCompareTest, SizesMustBeEqual)
{
    EXPECT_THROW((void)compare_images(flat_image(4, 4, 0), flat_image(4, 5, 0)), std::invalid_argument);
    EXPECT_THROW((void)compare_images(Image{}, Image{}), std::invalid_argument);
    EXPECT_THROW((void)heat_map(flat_image(4, 4, 0), flat_image(5, 4, 0)), std::invalid_argument);
}

} // namespace
} // namespace estampe::test
