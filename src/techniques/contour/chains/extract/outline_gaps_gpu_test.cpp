// SPDX-License-Identifier: MIT
// Outlines have no gaps: there is a line wherever an object borders on the background.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

constexpr glm::ivec2 gaps_page_px{480, 360};
constexpr int reach_px = 3;

size_t pixel_at(const glm::ivec2& place)
{
    return static_cast<size_t>(place.y) * gaps_page_px.x + static_cast<size_t>(place.x);
}

bool is_inked(const std::vector<float>& ink, const glm::ivec2& place)
{
    for (int y = place.y - reach_px; y <= place.y + reach_px; ++y) {
        for (int x = place.x - reach_px; x <= place.x + reach_px; ++x) {
            if (ink[pixel_at({x, y})] > 0.3F) {
                return true;
            }
        }
    }
    return false;
}

/// Share of the pixels on the border of `thing` and the background that have no line nearby.
double share_of_gaps(const Primitive& thing)
{
    test::Drawing drawing(test::scene_of(thing), {.eye = {2.1, 2.4, 4.6}, .target = {0.0, 0.2, 0.0}},
                          glm::uvec2(gaps_page_px));
    const std::vector<float> depth = drawing.depth_alone();
    ContourStyle style = even_lines(2.0F);
    style.crease_deg = 180.0F;
    const std::vector<float> ink = drawing.lines(style, 1.0F);
    double edge = 0.0;
    double gaps = 0.0;
    for (int y = reach_px; y < gaps_page_px.y - reach_px; ++y) {
        for (int x = reach_px; x < gaps_page_px.x - reach_px; ++x) {
            const bool ends = depth[pixel_at({x + 1, y})] == 0.0F || depth[pixel_at({x - 1, y})] == 0.0F ||
                              depth[pixel_at({x, y + 1})] == 0.0F || depth[pixel_at({x, y - 1})] == 0.0F;
            if (depth[pixel_at({x, y})] > 0.0F && ends) {
                edge += 1.0;
                gaps += is_inked(ink, {x, y}) ? 0.0 : 1.0;
            }
        }
    }
    EXPECT_GT(edge, 300.0);
    return gaps / edge;
}

/// A gear whose teeth are 8 to 12 pixels wide.
Primitive cog()
{
    std::vector<glm::vec2> outline;
    for (int i = 0; i < 96; ++i) {
        const float angle = glm::radians(3.75F) * static_cast<float>(i);
        const float radius = i % 4 < 2 ? 1.2F : 1.05F;
        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return shapes::extrude(outline, 0.3F);
}

TEST(Outlines, OfSmoothThingsHaveNoGaps)
{
    EXPECT_EQ(share_of_gaps(shapes::torus(1.4F, 0.35F, 48, 20)), 0.0);
    EXPECT_EQ(share_of_gaps(shapes::sphere(1.0F, 24, 12)), 0.0);
}

TEST(Outlines, OfThingsWithCornersHaveNoGaps)
{
    EXPECT_EQ(share_of_gaps(shapes::box({1.6F, 1.0F, 1.2F})), 0.0);
    EXPECT_EQ(share_of_gaps(cog()), 0.0);
    EXPECT_LT(share_of_gaps(shapes::cone(1.0F, 1.6F, 24)), 0.002);
    EXPECT_LT(share_of_gaps(shapes::cylinder(1.0F, 1.2F, 24)), 0.002);
}

TEST(Outlines, ThatPassFromSmoothPartsToHardEdgesHaveFewGaps)
{
    EXPECT_LT(share_of_gaps(banded_ring()), 0.002);
    EXPECT_LT(share_of_gaps(wound_backwards(banded_ring())), 0.002);
}

/// A wall that fills the page, a sphere in front of it and, if `is_crowded`, a thousand boxes behind it.
std::vector<float> lines_before_a_screen(bool is_crowded)
{
    constexpr glm::uvec2 small_px{200, 150};
    const int rows = is_crowded ? 32 : 0;
    Scene scene;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < rows; ++column) {
            test::add_object(scene, shapes::box(glm::vec3(0.08F)), glm::vec3(0.5F),
                             {0.1 * column - 1.6, 0.1 * row - 1.6, -1.0});
        }
    }
    test::add_object(scene, shapes::box({8.0F, 8.0F, 0.1F}), glm::vec3(0.5F), {0.0, -4.0, 0.0});
    test::add_object(scene, shapes::sphere(0.6F, 48, 24), glm::vec3(0.5F), {0.0, 0.0, 1.0});
    test::Drawing drawing(scene, test::front_camera(5.0, 0.8), small_px);
    return drawing.lines(even_lines(2.0F), 1.0F);
}

TEST(Outlines, AreNotLostForALackOfRoomWhereACrowdIsHiddenOnASmallPage)
{
    const std::vector<float> alone = lines_before_a_screen(false);
    EXPECT_GT(*std::ranges::max_element(alone), 0.9F);
    EXPECT_EQ(lines_before_a_screen(true), alone);
}

} // namespace
} // namespace estampe::contour
