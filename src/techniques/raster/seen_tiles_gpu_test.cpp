// SPDX-License-Identifier: MIT
// Every tile in which a surface is visible is listed once, and no other tile is.
#include <algorithm>
#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "shaders/tiles.glsl.h"
#include "support/gpu_device.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {
namespace {

constexpr glm::uvec2 tiles_across(glm::uvec2 size_px)
{
    return (size_px + 7U) / 8U;
}

/// A visibility buffer in which a share of the tiles shows triangles, numbered from 0, in one pixel each.
std::vector<glm::uvec2> sparse_page(glm::uvec2 size_px, double share)
{
    std::mt19937 random(size_px.x);
    std::uniform_real_distribution<double> chance(0.0, 1.0);
    std::vector<glm::uvec2> words(size_t{size_px.x} * size_px.y, glm::uvec2(0));
    const glm::uvec2 tiles = tiles_across(size_px);
    for (uint32_t ty = 0; ty < tiles.y; ++ty) {
        for (uint32_t tx = 0; tx < tiles.x; ++tx) {
            const glm::uvec2 from = 8U * glm::uvec2(tx, ty);
            const glm::uvec2 size = glm::min(size_px - from, glm::uvec2(8));
            const glm::uvec2 pixel = from + glm::uvec2(random() % size.x, random() % size.y);
            if (chance(random) < share) {
                words[size_t{pixel.y} * size_px.x + pixel.x] = {tx, std::bit_cast<uint32_t>(0.5F)};
            }
        }
    }
    return words;
}

void expect_tiles(glm::uvec2 size_px, double share)
{
    SCOPED_TRACE(testing::Message() << size_px.x << " x " << size_px.y << ", " << share);
    const std::vector<glm::uvec2> words = sparse_page(size_px, share);
    std::vector<uint32_t> wanted;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i].y != 0) {
            wanted.push_back(static_cast<uint32_t>(i % size_px.x / 8) |
                             static_cast<uint32_t>(i / size_px.x / 8) << 16U);
        }
    }
    std::ranges::sort(wanted);
    gpu::Buffer buffer = gpu::upload_buffer(test::shared_device(), "words", words);
    gpu::Graph graph;
    const gpu::BufferId visibility = gpu::import_whole(graph, "words", buffer);
    std::vector<uint32_t> list =
        test::run_and_read_as<uint32_t>(graph, add_seen_tiles(graph, "test", visibility, size_px));
    ASSERT_GE(list.size(), shared::tile_list_first + wanted.size());
    const uint32_t count = list[shared::tile_list_count];
    ASSERT_EQ(count, wanted.size());
    // The dispatch has enough workgroups, in rows, and no row too many.
    EXPECT_EQ(list[0], shared::tile_list_groups);
    EXPECT_EQ(list[1], (count + shared::tile_list_groups - 1) / shared::tile_list_groups);
    EXPECT_EQ(list[2], 1U);
    const auto first = list.begin() + shared::tile_list_first;
    std::sort(first, first + count);
    EXPECT_TRUE(std::ranges::equal(wanted, std::span(&*first, count)));
}

TEST(SeenTiles, AreThoseInWhichAnythingIsSeen)
{
    for (const double share : {0.0, 0.02, 0.5, 1.0}) {
        expect_tiles({640, 360}, share);
        expect_tiles({163, 91}, share); // tiles that extend beyond the page
        expect_tiles({5, 3}, share);
    }
}

} // namespace
} // namespace estampe::raster
