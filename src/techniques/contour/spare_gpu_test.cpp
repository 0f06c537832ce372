// SPDX-License-Identifier: MIT
// Lines in solid black: white within it, and black along its border.
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "shaders/tone.glsl.h"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "support/scenes.hpp"
#include "techniques/contour/contour.hpp"

namespace estampe::contour {
namespace {

constexpr glm::uvec2 size_px(64, 48);

/// Ink of hatching that is solid on the left half and half dark on the right. Lines cover one row, the
/// columns beside the border, and a column on the right.
std::vector<float> hatching_beside_lines(const ContourStyle& style)
{
    auto hatch = test::Layer::coverage(
        size_px, [](glm::uvec2 pixel) { return pixel.x < size_px.x / 2 ? shared::solid_ink : 0.5F; });
    auto lines = test::Layer::root_color(size_px, [](glm::uvec2 pixel) {
        const bool is_line = pixel.y == 20 || pixel.x == 31 || pixel.x == 50;
        return glm::vec4(0.0F, 0.0F, 0.0F, is_line ? 1.0F : 0.0F);
    });
    gpu::Graph graph;
    const InkImages spared = add_spared(graph, {hatch.in(graph), lines.in(graph)}, style, 1.0F);
    return test::run_and_read_coverage(graph, spared.hatch);
}

TEST(SparedLines, AreWhiteWithinTheBlackOnly)
{
    ContourStyle style;
    style.spared = 0.75F;
    style.outline.width_mm = style.border.width_mm = style.crease.width_mm = 2.0F;
    const uint32_t reach = spare_reach_px(style, 1.0F);
    ASSERT_LT(reach, 16U);
    const std::vector<float> ink = hatching_beside_lines(style);
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < size_px.x; ++x) {
            const bool is_within = x + reach < size_px.x / 2;
            const float hatched = x >= size_px.x / 2 ? 0.5F : y == 20 && is_within ? 0.25F : 1.0F;
            EXPECT_NEAR(ink[size_px.x * y + x], hatched, 1e-3F) << x << ", " << y;
        }
    }
}

/// Lightest green on the edge between the two faces of a box that turn away from the sun.
int lightest_on_edge(const char* spared)
{
    Style style = Style::load("comic");
    for (const char* assignment : {"light.source=sun", "light.turn_sun=false", "light.sun_azimuth_deg=225",
                                   "hatch.black_above=0.1", "wash.strength=0", "picture.ground=false",
                                   "sky.enabled=false", "paper.height_mm=20", "paper.margin_mm=0", spared}) {
        style.set(assignment);
    }
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(test::scene_of(shapes::box(glm::vec3(1.0F))));
    constexpr uint32_t picture_px = 200;
    const Image image = renderer.render({.eye = {3.0, 0.5, 3.0}, .target = {0.0, 0.5, 0.0}}, style,
                                        {.width = picture_px, .height = picture_px});
    int lightest = 0;
    for (uint32_t x = picture_px / 2 - 6; x <= picture_px / 2 + 6; ++x) {
        lightest = std::max<int>(lightest, image.rgba[4 * (size_t{picture_px / 2} * picture_px + x) + 1]);
    }
    return lightest;
}

TEST(SparedLines, OfAPictureAreWhiteOrLost)
{
    EXPECT_LT(lightest_on_edge("contour.spared=0"), 60);
    EXPECT_GT(lightest_on_edge("contour.spared=1"), 200);
}

} // namespace
} // namespace estampe::contour
