// SPDX-License-Identifier: MIT
// Strokes along the light near lamps: strokes of each part of the page follow the strongest light there.
#include <gtest/gtest.h>

#include <glm/gtc/packing.hpp>

#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch_test_canvas.hpp"

namespace estampe::hatch {
namespace {

constexpr glm::uvec2 local_light_px(192, 96);

/// Octahedral code of a direction in the upper half space.
uint32_t packed(const glm::vec3& direction)
{
    const float sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    return glm::packSnorm2x16(glm::vec2(direction) / sum);
}

/// Strokes on a sheet in the plane z = 0: the left third has a lamp at its right, the middle third a lamp
/// below it, and the last third the sun at its right.
std::vector<float> strokes_under_lamps()
{
    auto draw =
        test::Layer::words(local_light_px, [](glm::uvec2) { return shared::strokes_light << 26U | 1U; });
    auto darkness = test::Layer::coverage(local_light_px, [](glm::uvec2) { return 0.35F; });
    auto normal = test::Layer::normals(local_light_px, [](glm::uvec2) { return glm::vec3(0, 0, 1); });
    auto coordinate = test::Layer::places(
        local_light_px, [](glm::uvec2 pixel) { return glm::vec4(0.01F * glm::vec2(pixel), 0.0F, 0.0F); });
    auto footprint = test::Layer::footprints(local_light_px, [](glm::uvec2) {
        return std::pair(glm::vec3(0.01F, 0.0F, 0.0F), glm::vec3(0.0F, 0.01F, 0.0F));
    });
    auto strongest = test::Layer::words(local_light_px, [](glm::uvec2 pixel) {
        const uint32_t third = 3 * pixel.x / local_light_px.x;
        return third == 0 ? packed({0.9F, 0.2F, 0.1F}) : third == 1 ? packed({0.1F, 0.9F, 0.2F}) : 0U;
    });
    test::PaperToInk paper(local_light_px);
    gpu::Graph graph;
    HatchInputs in = test::stroke_inputs(graph, local_light_px, draw, normal, coordinate, footprint);
    in.strongest_light = strongest.in(graph);
    in.towards_light = {1.0F, 0.0F, 0.0F};
    const HatchStyle style{.width_mm = 1.6F, .overrun_mm = 0.0F, .black_above = 2.0F};
    return test::run_and_read_coverage(graph,
                                       add_lines(graph, in, paper.in(graph, darkness.in(graph)), style));
}

/// How much more the ink of a third of the page changes vertically than horizontally.
double lie(const std::vector<float>& ink, uint32_t third)
{
    double across = 0.0;
    double down = 0.0;
    for (uint32_t y = 8; y + 8 < local_light_px.y; ++y) {
        for (uint32_t x = third * local_light_px.x / 3 + 8; x + 8 < (third + 1) * local_light_px.x / 3; ++x) {
            const float here = ink[y * local_light_px.x + x];
            across += static_cast<double>(std::abs(ink[y * local_light_px.x + x + 1] - here));
            down += static_cast<double>(std::abs(ink[(y + 1) * local_light_px.x + x] - here));
        }
    }
    return down / across;
}

TEST(HatchLocalLight, StrokesRunTowardsTheLampThatRules)
{
    const std::vector<float> ink = strokes_under_lamps();
    EXPECT_GT(lie(ink, 0), 3.0);
    EXPECT_LT(lie(ink, 1), 1.0 / 3.0);
    EXPECT_GT(lie(ink, 2), 3.0);
}

} // namespace
} // namespace estampe::hatch
