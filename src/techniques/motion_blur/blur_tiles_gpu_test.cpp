// SPDX-License-Identifier: MIT
// The longest displacements of tiles, found by a single thread and by a workgroup.
#include "techniques/motion_blur/motion_blur.hpp"

#include <array>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::motion_blur {
namespace {

constexpr glm::uvec2 size_px(75, 50); // the page's edge cuts some tiles

/// The visible part of the page, from inclusive to exclusive pixels.
struct Window {
    glm::uvec2 min_px{0};
    glm::uvec2 max_px = size_px;
};

glm::vec4 check_at(glm::uvec2 pixel)
{
    return {glm::vec3((pixel.x / 3 + pixel.y / 3) % 2 == 0 ? 0.1F : 0.9F), 1.0F};
}

/// A painted checkerboard with patches that move in different directions; some move equally far.
std::vector<glm::vec4> blurred(bool by_groups, const Window& window = {})
{
    const auto way = [](glm::uvec2 pixel) {
        constexpr std::array ways{glm::vec2(0.0F), glm::vec2(6.0F, 0.0F), glm::vec2(0.0F, -6.0F),
                                  glm::vec2(-9.0F, 4.0F), glm::vec2(4.0F, 9.0F)};
        const glm::vec2 gone = ways.at((pixel.x / 13 + 2 * (pixel.y / 11)) % ways.size());
        return glm::vec4(gone, 0.5F, 1.0F);
    };
    auto motion = test::Layer::places(size_px, way);
    auto depth = test::Layer::depth(size_px, [](glm::uvec2 pixel) { return pixel.x < 40 ? 0.5F : 0.2F; });
    auto wash = test::Layer::color(size_px, check_at);
    auto hatch = test::Layer::coverage(size_px, [](glm::uvec2) { return 0.0F; });
    auto lines = test::Layer::root_color(size_px, [](glm::uvec2) { return glm::vec4(0.0F); });
    auto sky_ink = test::Layer::coverage(size_px, [](glm::uvec2) { return 0.0F; });
    gpu::Graph graph;
    const gpu::ImageId moved = motion.in(graph);
    const MotionBlurStyle style{.enabled = true, .mode = Mode::tiles};
    const MotionBlurLayers layers = add_motion_blur(graph,
                                                    {.motion = moved,
                                                     .own_motion = moved,
                                                     .depth = depth.in(graph),
                                                     .wash = wash.in(graph),
                                                     .hatch = hatch.in(graph),
                                                     .lines = lines.in(graph),
                                                     .sky_ink = sky_ink.in(graph),
                                                     .size_px = size_px,
                                                     .window_min_px = window.min_px,
                                                     .window_max_px = window.max_px,
                                                     .by_groups = by_groups},
                                                    style, constants_of(style, 1.0F, 2.0F, 0.5F), {});
    return test::run_and_read_colors(graph, layers.wash);
}

TEST(MotionBlurTiles, AreFoundByGroupsAsByThreads)
{
    const std::vector<glm::vec4> by_threads = blurred(false);
    EXPECT_EQ(blurred(true), by_threads);
    size_t gray = 0;
    for (const glm::vec4& color : by_threads) {
        gray += color.x > 0.2F && color.x < 0.8F ? 1 : 0;
    }
    EXPECT_GT(gray, by_threads.size() / 4) << "nothing was blurred";
}

TEST(MotionBlurTiles, BeyondTheWindowAreLeftAndWithinAreBlurredAsEver)
{
    constexpr Window window{.min_px = {17, 16}, .max_px = {49, 33}};
    const std::vector<glm::vec4> whole = blurred(false);
    const std::vector<glm::vec4> part = blurred(false, window);
    size_t left = 0;
    for (uint32_t i = 0; i < part.size(); ++i) {
        const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
        const bool is_within = glm::all(glm::greaterThanEqual(pixel, window.min_px)) &&
                               glm::all(glm::lessThan(pixel, window.max_px));
        const bool is_far = pixel.x < 16 || pixel.y < 16; // in other tiles
        if (is_within) {
            EXPECT_EQ(part[i], whole[i]) << pixel.x << ", " << pixel.y;
        } else if (is_far) {
            EXPECT_NEAR(part[i].x, check_at(pixel).x, 1e-3F) << pixel.x << ", " << pixel.y;
            left += part[i] == whole[i] ? 0 : 1;
        }
    }
    EXPECT_GT(left, 100U) << "nothing would be blurred there";
}

} // namespace
} // namespace estampe::motion_blur
