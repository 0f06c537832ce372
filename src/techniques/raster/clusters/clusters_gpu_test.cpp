// SPDX-License-Identifier: MIT
// Checks that triangles culled by their cluster's box would not have been visible.
#include <numeric>

#include <gtest/gtest.h>

#include "shaders/tiles.glsl.h"
#include "techniques/raster/raster_test_support.hpp"

namespace estampe::raster {
namespace {

/// Runs of 64 triangles, each around its own place: on the page, outside it, in front of the eye or behind
/// it.
std::vector<ClipTriangle> scattered_runs(uint32_t seed, size_t runs)
{
    Soup random(seed);
    std::vector<ClipTriangle> soup;
    for (size_t run = 0; run < runs; ++run) {
        const glm::vec3 middle(random.between(-9.0F, 9.0F), random.between(-9.0F, 9.0F),
                               random.between(-6.0F, 6.0F));
        const float size = random.between(0.02F, 1.0F);
        for (uint32_t i = 0; i < shared::cluster_triangles; ++i) {
            ClipTriangle triangle{};
            triangle.two_sided = true;
            for (glm::vec4& corner : triangle.corner) {
                const glm::vec3 off(random.between(-size, size), random.between(-size, size),
                                    random.between(-size, size));
                corner = {middle.x + off.x, middle.y + off.y, near_z, middle.z + off.z};
            }
            soup.push_back(triangle);
        }
    }
    return soup;
}

TEST(RasterClusters, LeaveOutNothingThatIsSeen)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        const auto soup = scattered_runs(seed, 500);
        // Batches need not start or end at cluster boundaries.
        const Batch batch{.first_triangle = 37, .triangle_count = static_cast<uint32_t>(soup.size()) - 50};
        const auto all = draw(soup, {160, 90}, {}, batch);
        EXPECT_TRUE(all == draw(soup, {160, 90}, {.tuning = {.clusters_from = 1}}, batch)) << seed;
        EXPECT_GT(std::ranges::count_if(all, [](uint64_t word) { return word != 0; }), 300) << seed;
    }
}

TEST(RasterClusters, OfWhichTheBoxIsBesideThePageAreNotListed)
{
    const auto soup = scattered_runs(7, 200);
    SoupBuffers buffers = upload_soup(soup);
    ClusterBoxes boxes;
    gpu::Graph graph;
    const auto count = static_cast<uint32_t>(soup.size());
    const View view{.clip_from_anchor = plain_perspective,
                    .size_px = {160, 90},
                    .tuning = {.clusters_from = 1},
                    .cluster_bounds = boxes.add(graph, test::shared_device(), buffers.inputs(graph), count)};
    const auto list = add_seen_clusters(
        graph, "clusters", {.triangle_count = count}, view,
        {.clip_from_anchor = plain_perspective, .size_px = {160, 90}, .triangle_count = count});
    ASSERT_TRUE(list);
    const auto words = test::run_and_read_as<uint32_t>(graph, *list);
    // All corners of such a run are outside one side of the page.
    uint32_t sure = 0;
    for (uint32_t run = 0; run < 200; ++run) {
        const auto is_outside = [&](auto beyond) {
            for (uint32_t i = 0; i < shared::cluster_triangles; ++i) {
                for (const glm::vec4& c : soup[run * shared::cluster_triangles + i].corner) {
                    if (!beyond(c)) {
                        return false;
                    }
                }
            }
            return true;
        };
        const bool is_beside = is_outside([](const glm::vec4& c) { return c.x > c.w + 1e-3F; }) ||
                               is_outside([](const glm::vec4& c) { return c.x < -c.w - 1e-3F; }) ||
                               is_outside([](const glm::vec4& c) { return c.y > c.w + 1e-3F; }) ||
                               is_outside([](const glm::vec4& c) { return c.y < -c.w - 1e-3F; }) ||
                               is_outside([](const glm::vec4& c) { return c.w < near_z - 1e-3F; });
        sure += is_beside ? 1U : 0U;
    }
    const uint32_t listed = words[shared::tile_list_count];
    EXPECT_GT(sure, 120U);
    EXPECT_GT(listed, 5U);
    // A box may touch a corner of the page that its triangles miss.
    EXPECT_LE(listed, 200U - sure + 20U);
    EXPECT_EQ(words[0], shared::tile_list_groups);
    EXPECT_EQ(words[1], (listed + shared::tile_list_groups - 1) / shared::tile_list_groups);
    EXPECT_EQ(words[2], 1U);
}

TEST(RasterClusters, WhoseBitIsNotSetAreNotDrawn)
{
    const auto soup = scattered_runs(10, 500);
    const auto count = static_cast<uint32_t>(soup.size());
    // Batches need not start or end at cluster boundaries.
    const Batch batch{.first_triangle = 37, .triangle_count = count - 50};
    std::vector<uint32_t> bits(500 / 32 + 1, 0U);
    std::vector<ClipTriangle> remaining = soup;
    Soup random(11);
    for (uint32_t cluster = 0; cluster < 500; ++cluster) {
        if (random.between(0.0F, 1.0F) < 0.5F) {
            bits[cluster / 32] |= 1U << cluster % 32;
            continue;
        }
        for (uint32_t i = 0; i < shared::cluster_triangles; ++i) {
            // A triangle with all corners at one place covers no pixel.
            ClipTriangle& triangle = remaining[cluster * shared::cluster_triangles + i];
            triangle.corner[1] = triangle.corner[2] = triangle.corner[0];
        }
    }
    constexpr glm::uvec2 size_px(160, 90);
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        const Way way{.path = path};
        SoupBuffers buffers = upload_soup(soup);
        gpu::Buffer seen = gpu::upload_buffer(test::shared_device(), "seen", bits);
        ClusterBoxes boxes;
        gpu::Graph graph;
        const RasterInputs in = buffers.inputs(graph);
        const View view{.clip_from_anchor = plain_perspective,
                        .size_px = size_px,
                        .path = path,
                        .cluster_bounds = boxes.add(graph, test::shared_device(), in, count),
                        .seen_clusters = gpu::import_whole(graph, "seen", seen)};
        auto page = test::run_and_read_as<uint64_t>(
            graph, add_visibility(graph, "visibility", in, {&batch, 1}, view));
        page.resize(size_t{size_px.x} * size_px.y);
        EXPECT_TRUE(page == draw(remaining, size_px, way, batch)) << name_of(path);
        EXPECT_FALSE(page == draw(soup, size_px, way, batch)) << name_of(path);
    }
}

TEST(RasterClusters, KeepTheirBoxesUntilTheyAreForgotten)
{
    const auto soup = scattered_runs(8, 3);
    SoupBuffers buffers = upload_soup(soup);
    ClusterBoxes boxes;
    const auto count = static_cast<uint32_t>(soup.size());
    const auto found = [&] {
        gpu::Graph graph;
        return test::run_and_read_as<float>(
            graph, boxes.add(graph, test::shared_device(), buffers.inputs(graph), count));
    };
    const auto first = found();
    std::vector<ClipTriangle> moved = soup;
    for (ClipTriangle& triangle : moved) {
        for (glm::vec4& corner : triangle.corner) {
            corner.x += 100.0F;
        }
    }
    buffers = upload_soup(moved);
    EXPECT_EQ(found(), first);
    boxes.forget();
    EXPECT_GT(found().front(), first.front() + 99.0F);
}

TEST(RasterClusters, AreTheSameBoxesHoweverThreadsShareTheWork)
{
    std::vector<ClipTriangle> soup = scattered_runs(9, 300);
    soup.resize(soup.size() - 27); // the last cluster is short
    SoupBuffers buffers = upload_soup(soup);
    const auto count = static_cast<uint32_t>(soup.size());
    const auto found = [&](bool by_thread) {
        gpu::Graph graph;
        ClusterBoxes boxes;
        return test::run_and_read_as<float>(graph,
                                            boxes.add(graph, test::shared_device(), buffers.inputs(graph),
                                                      count, {.threads_bound_clusters = by_thread}));
    };
    EXPECT_EQ(found(true), found(false));
}

} // namespace
} // namespace estampe::raster
