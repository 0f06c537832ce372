// SPDX-License-Identifier: MIT
// Brushes of lines: their pictures must be placed correctly.
#include "techniques/contour/chains/ink/ink.hpp"

#include <algorithm>
#include <cmath>

#include <estampe/image.hpp>
#include <estampe/shapes.hpp>
#include <gtest/gtest.h>

#include "support/drawing.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

using shared::LineSample;
using shared::Stroke;

/// A picture of a stroke with ink only on its left, from a quarter to a half of its length.
Image marked_picture()
{
    Image image{.width = 256, .height = 32};
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const bool is_ink = x >= image.width / 4 && x < image.width / 2 && y < image.height / 2;
            image.rgba.insert(image.rgba.end(), {0, 0, 0, static_cast<uint8_t>(is_ink ? 255 : 0)});
        }
    }
    return image;
}

/// A straight line on the page, along which marked_picture() lies.
struct PageLine {
    glm::vec2 from{0.0F};
    glm::vec2 to{0.0F};
};

PageLine line_of(const test::ChainLists& lists, const Stroke& stroke)
{
    return {lists.samples[stroke.first].page_px, lists.samples[stroke.last].page_px};
}

/// Number of places along a stroke on a line whose ink differs from marked_picture().
size_t places_off(const test::ChainLists& lists, const Stroke& stroke, const PageLine& line,
                  const std::vector<float>& ink)
{
    const uint32_t steps = stroke.last - stroke.first;
    const float length = glm::distance(line.from, line.to);
    const glm::vec2 way = (line.to - line.from) / length;
    const glm::vec2 left(way.y, -way.x); // the page's y points down
    size_t off = 0;
    for (uint32_t i = steps / 8; i <= steps - steps / 8; ++i) {
        const LineSample& sample = lists.samples[stroke.first + i];
        const float along = glm::dot(sample.page_px - line.from, way) / length;
        const bool is_inked = along > 0.27F && along < 0.48F;
        const bool is_blank = along < 0.23F || along > 0.52F;
        const float on_left = ink_at(ink, page_px.x, sample.page_px + 3.0F * left);
        off += (is_inked && on_left < 0.95F) || (is_blank && on_left > 0.05F) ? 1U : 0U;
        off +=
            (is_inked || is_blank) && ink_at(ink, page_px.x, sample.page_px - 3.0F * left) > 0.05F ? 1U : 0U;
    }
    return off;
}

/// Number of strokes of some length, and of those drawn with marked_picture().
struct StrokeCount {
    size_t all = 0;
    size_t of_picture = 0;
};

StrokeCount count_pictured(test::Drawing& drawing, const ContourStyle& style)
{
    const std::vector<float> ink = drawing.lines(style, 1.0F);
    const test::ChainLists lists = drawing.chains(style);
    StrokeCount count;
    for (const Stroke& stroke : lists.strokes) {
        if (stroke.last - stroke.first >= 16) {
            ++count.all;
            count.of_picture += places_off(lists, stroke, line_of(lists, stroke), ink) == 0 ? 1U : 0U;
        }
    }
    return count;
}

Primitive large_box()
{
    return shapes::box({1.6F, 1.6F, 1.6F});
}

Camera view_of_box()
{
    return {.eye = {2.2, 2.7, 3.1}, .target = {0.0, 0.75, 0.0}};
}

TEST(LineBrush, APictureLiesWhereItShouldAlongAndAcrossAStretchedStroke)
{
    const test::Folder folder;
    save_png(marked_picture(), folder / "stroke.png");
    ContourStyle style = even_lines(12.0F);
    style.brush = (folder / "stroke.png").string();
    style.brush_fit = BrushFit::stretch;
    test::Drawing drawing(test::scene_of(large_box()), view_of_box(), page_px);
    const StrokeCount strokes = count_pictured(drawing, style);
    EXPECT_EQ(strokes.all, 9U);
    EXPECT_EQ(strokes.of_picture, 9U);
}

TEST(LineBrush, APictureGoesOnBehindANearerThing)
{
    const test::Folder folder;
    save_png(marked_picture(), folder / "stroke.png");
    ContourStyle style = even_lines(12.0F);
    style.brush = (folder / "stroke.png").string();
    style.brush_fit = BrushFit::stretch;
    const Camera camera{.eye = {0.0, 2.5, 6.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.6};
    const auto is_long = [](const Stroke& stroke) { return stroke.last - stroke.first >= 16; };

    Scene scene = test::scene_of(shapes::box({3.0F, 0.4F, 0.4F}));
    test::Drawing whole(scene, camera, page_px);
    const test::ChainLists whole_lists = whole.chains(style);
    PageLine edge;
    for (const Stroke& stroke : whole_lists.strokes) {
        if (is_long(stroke) && whole_lists.samples[stroke.first].source >> 28U == shared::line_crease) {
            edge = line_of(whole_lists, stroke);
        }
    }
    ASSERT_GT(glm::distance(edge.from, edge.to), 200.0F);

    // A pillar hides a part of the edge right of its middle.
    test::add_object(scene, shapes::box({0.5F, 4.0F, 0.2F}), glm::vec3(0.5F), {0.3, 0.0, 1.0});
    test::Drawing drawing(scene, camera, page_px);
    const std::vector<float> ink = drawing.lines(style, 1.0F);
    const test::ChainLists lists = drawing.chains(style);
    size_t found = 0;
    for (const Stroke& stroke : lists.strokes) {
        const PageLine part = line_of(lists, stroke);
        const glm::vec2 across(edge.from.y - edge.to.y, edge.to.x - edge.from.x);
        const float off_px = std::abs(glm::dot(part.from - edge.from, across)) / glm::length(across) +
                             std::abs(glm::dot(part.to - edge.from, across)) / glm::length(across);
        if (is_long(stroke) && off_px < 2.0F &&
            lists.samples[stroke.first].source >> 28U == shared::line_crease) {
            ++found;
            EXPECT_LE(places_off(lists, stroke, edge, ink), 1U) << part.from.x << " to " << part.to.x;
        }
    }
    EXPECT_EQ(found, 2U) << "left and right of the pillar";
}

TEST(LineBrush, AMarkedEdgeHasItsOwnAndNotThatOfCreases)
{
    const test::Folder folder;
    save_png(marked_picture(), folder / "stroke.png");
    Primitive marked_box = large_box();
    marked_box.edge_marks.assign(marked_box.indices.size() / 3, 0);
    marked_box.edge_marks[0] = 2; // the vertical edge between two visible sides
    test::Drawing marked(test::scene_of(marked_box), view_of_box(), page_px);
    test::Drawing creased(test::scene_of(large_box()), view_of_box(), page_px);
    ContourStyle style = even_lines(12.0F);
    style.marked.width_mm = 12.0F;
    style.brush_fit = BrushFit::stretch;
    style.marked.brush = (folder / "stroke.png").string();
    EXPECT_EQ(count_pictured(marked, style).of_picture, 1U);
    EXPECT_EQ(count_pictured(creased, style).of_picture, 0U);
    std::swap(style.marked.brush, style.crease.brush);
    EXPECT_EQ(count_pictured(marked, style).of_picture, 0U);
    EXPECT_EQ(count_pictured(creased, style).of_picture, 3U);
}

TEST(LineBrush, APenBesideOtherBrushesDrawsAsItDoesAlone)
{
    ContourStyle style = even_lines(6.0F);
    style.crease_deg = 180.0F;
    test::Drawing drawing(shapes_scene(), view_from_above(), page_px);
    const std::vector<float> alone = drawing.lines(style, 1.0F);
    style.crease.brush = "pencil";
    const std::vector<float> beside = drawing.lines(style, 1.0F);
    double sum = 0.0;
    double off = 0.0;
    for (size_t i = 0; i < alone.size(); ++i) {
        sum += static_cast<double>(alone[i]);
        off += static_cast<double>(std::abs(alone[i] - beside[i]));
    }
    EXPECT_GT(sum, 1000.0);
    EXPECT_LT(off, 0.005 * sum);
}

} // namespace
} // namespace estampe::contour
