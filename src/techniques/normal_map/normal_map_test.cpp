// SPDX-License-Identifier: MIT
// Normal maps of surfaces whose normals are known.
#include <estampe/normal_map.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

constexpr uint32_t map_side = 64;

HeightMap map_of(const std::function<double(double, double)>& height)
{
    HeightMap map{.width = map_side, .height = map_side, .heights = {}};
    for (uint32_t y = 0; y < map_side; ++y) {
        for (uint32_t x = 0; x < map_side; ++x) {
            map.heights.push_back(static_cast<float>(height((x + 0.5) / map_side, (y + 0.5) / map_side)));
        }
    }
    return map;
}

glm::dvec3 normal_at(const Image& map, uint32_t x, uint32_t y)
{
    const uint8_t* const texel = &map.rgba[size_t{4} * (y * map.width + x)];
    return glm::dvec3(texel[0], texel[1], texel[2]) / 127.5 - 1.0;
}

TEST(NormalMap, OfAFlatPictureIsFlat)
{
    const Image normals = make_normal_map(map_of([](double, double) { return 0.7; }));
    for (size_t i = 0; i < normals.rgba.size(); i += 4) {
        ASSERT_EQ(normals.rgba[i], 128);
        ASSERT_EQ(normals.rgba[i + 1], 128);
        ASSERT_EQ(normals.rgba[i + 2], 255);
        ASSERT_EQ(normals.rgba[i + 3], 255);
    }
}

TEST(NormalMap, OfAPlaneHasThePlanesNormal)
{
    // The surface rises to the right by 0.5, and downwards by 0.25, per width at the relief 1.
    const HeightMap plane = map_of([](double x, double y) { return 0.5 * x + 0.25 * y; });
    const glm::dvec3 wanted = glm::normalize(glm::dvec3(-0.5, 0.25, 1.0));
    const Image normals = make_normal_map(plane, {.relief = 1.0, .wraps = false});
    const Image down = make_normal_map(plane, {.relief = 1.0, .wraps = false, .is_green_down = true});
    for (uint32_t i = 1; i + 1 < map_side; ++i) {
        EXPECT_LT(glm::distance(normal_at(normals, i, map_side - 1 - i), wanted), 0.008) << i;
        EXPECT_LT(glm::distance(normal_at(down, i, i), wanted * glm::dvec3(1.0, -1.0, 1.0)), 0.008) << i;
    }
}

TEST(NormalMap, OfWavesIsTheirDerivativeAlsoAcrossTheEdges)
{
    constexpr double turn = 2.0 * std::numbers::pi;
    constexpr double relief = 0.1;
    const Image normals = make_normal_map(
        map_of([](double x, double y) { return 0.5 + 0.25 * std::sin(turn * x) * std::cos(turn * y); }),
        {.relief = relief});
    double worst = 0.0;
    for (uint32_t y = 0; y < map_side; ++y) {
        for (uint32_t x = 0; x < map_side; ++x) {
            const double u = turn * (x + 0.5) / map_side;
            const double v = turn * (y + 0.5) / map_side;
            const glm::dvec2 slope =
                0.25 * relief * turn * glm::dvec2(std::cos(u) * std::cos(v), -std::sin(u) * std::sin(v));
            const glm::dvec3 wanted = glm::normalize(glm::dvec3(-slope.x, slope.y, 1.0));
            worst = std::max(worst, glm::distance(normal_at(normals, x, y), wanted));
        }
    }
    EXPECT_LT(worst, 0.008) << "rounding to bytes alone gives up to 0.007";
}

TEST(NormalMap, EdgesWrapOrAreClamped)
{
    const HeightMap ramp = map_of([](double x, double) { return x; });
    const Image wrapped = make_normal_map(ramp, {.relief = 0.1});
    const Image clamped = make_normal_map(ramp, {.relief = 0.1, .wraps = false});
    EXPECT_GT(normal_at(wrapped, 0, 30).x, 0.5) << "the picture falls from its right edge to its left one";
    EXPECT_LT(normal_at(clamped, 0, 30).x, 0.0);
    EXPECT_EQ(normal_at(wrapped, 30, 30), normal_at(clamped, 30, 30));
}

TEST(NormalMap, PicturesAreReadWithAllTheirBits)
{
    const test::Folder folder;
    const std::filesystem::path deep = folder.path() / "deep.png";
    const std::vector<uint16_t> grey{1000, 1000, 1000, 1001, 1001, 1001};
    write_file_atomically(deep, encode_png(2, 1, 3, grey));
    const HeightMap map = load_height_map(deep);
    EXPECT_EQ(map.steps, 65535U);
    ASSERT_EQ(map.heights.size(), 2U);
    EXPECT_NEAR(map.heights[1] - map.heights[0], 1.0 / 65535.0, 1e-8);
    const std::filesystem::path shallow = folder.path() / "shallow.png";
    save_png({.width = 1, .height = 1, .rgba = {51, 51, 51, 255}}, shallow);
    EXPECT_EQ(load_height_map(shallow).steps, 255U);
    EXPECT_NEAR(load_height_map(shallow).heights[0], 0.2, 1e-6);
    EXPECT_THROW(static_cast<void>(load_height_map(folder.path() / "none.png")), Error);
}

TEST(NormalMap, WhatIsNoHeightMapIsRefused)
{
    EXPECT_THROW(static_cast<void>(make_normal_map({})), Error);
    EXPECT_THROW(static_cast<void>(make_normal_map({.width = 2, .height = 2, .heights = {0.0F}})), Error);
    const HeightMap flat = map_of([](double, double) { return 0.0; });
    EXPECT_THROW(static_cast<void>(make_normal_map(flat, {.relief = -1.0})), Error);
    EXPECT_THROW(static_cast<void>(make_normal_map(flat, {.relief = std::nan("")})), Error);
    EXPECT_DOUBLE_EQ(height_step_texels(flat, {.relief = 255.0 / 64.0}), 1.0);
}

} // namespace
} // namespace estampe
