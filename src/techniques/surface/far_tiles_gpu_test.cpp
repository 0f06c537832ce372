// SPDX-License-Identifier: MIT
// Every tile with a background pixel or a distant surface is listed exactly once, and no tile with only near
// surfaces.
#include <algorithm>

#include <gtest/gtest.h>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "shaders/tiles.glsl.h"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/surface/surface.hpp"

namespace estampe::surface {
namespace {

constexpr glm::uvec2 size_px(163, 91); // some tiles reach beyond the page
constexpr float from_m = 110.0F;

shared::FrameGlobals globals_of(bool is_parallel)
{
    Camera camera{.eye = {1.0, 2.0, 3.0}, .target = {4.0, 2.5, 9.0}, .near_m = 0.1};
    if (is_parallel) {
        camera.orthographic_half_height_m = 5.0;
    }
    return features::frame_globals(camera, {}, camera.eye, {.size_px = size_px});
}

/// Reversed depth of a surface at a distance from the eye; arbitrary in parallel projection.
float depth_at(const shared::FrameGlobals& globals, glm::uvec2 pixel, float away_m)
{
    if (globals.is_orthographic != 0) {
        return 0.5F;
    }
    const glm::vec2 ndc = 2.0F * (glm::vec2(pixel) + 0.5F) / glm::vec2(size_px) - 1.0F;
    const glm::vec4 far = globals.anchor_from_clip * glm::vec4(ndc, 1e-5F, 1.0F);
    const glm::vec3 way = glm::normalize(glm::vec3(far) / far.w - globals.eye_anchor);
    return globals.near_m / (away_m * glm::dot(way, globals.view_forward));
}

/// Content of a tile: 0 all near; 1 one background pixel; 2 one pixel just far enough.
uint32_t kind_of(glm::uvec2 tile)
{
    return (7 * tile.x + 3 * tile.y) % 3;
}

std::vector<uint32_t> listed(const shared::FrameGlobals& globals)
{
    auto depth = test::Layer::depth(size_px, [&](glm::uvec2 pixel) {
        const uint32_t kind = kind_of(pixel / 8U);
        const bool is_one = pixel % 8U == glm::uvec2(2, 1);
        return kind == 1 && is_one ? 0.0F
                                   : depth_at(globals, pixel, (kind == 2 && is_one ? 1.001F : 0.8F) * from_m);
    });
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    gpu::Graph graph;
    const FarInputs in{
        .frame = gpu::import_whole(graph, "frame", frame), .depth = depth.in(graph), .size_px = size_px};
    std::vector<uint32_t> list = test::run_and_read_as<uint32_t>(graph, add_far_tiles(graph, in, from_m));
    const uint32_t count = list.at(shared::tile_list_count);
    list.erase(list.begin(), list.begin() + shared::tile_list_first);
    list.resize(std::min<size_t>(list.size(), count));
    std::ranges::sort(list);
    return list;
}

TEST(FarTiles, AreThoseThatSkyMayShowIn)
{
    const glm::uvec2 tiles = (size_px + 7U) / 8U;
    std::vector<uint32_t> wanted;
    std::vector<uint32_t> all;
    for (uint32_t y = 0; y < tiles.y; ++y) {
        for (uint32_t x = 0; x < tiles.x; ++x) {
            all.push_back(x | y << 16U);
            if (kind_of({x, y}) != 0) {
                wanted.push_back(all.back());
            }
        }
    }
    std::ranges::sort(wanted);
    std::ranges::sort(all);
    EXPECT_EQ(listed(globals_of(false)), wanted);
    EXPECT_EQ(listed(globals_of(true)), all);
}

} // namespace
} // namespace estampe::surface
