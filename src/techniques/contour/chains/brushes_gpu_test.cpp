// SPDX-License-Identifier: MIT
// Brushes of lines: that their pictures lie where they should, and stay there as things move.
#include "techniques/contour/chains/brushes.hpp"

#include <algorithm>
#include <cmath>

#include <estampe/image.hpp>
#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include "gpu/imports.hpp"
#include "scene/shapes.hpp"
#include "support/drawing.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

using shared::DrawnSample;
using shared::LineSample;
using shared::Stroke;

constexpr glm::uvec2 page_px{480, 360};
constexpr double most_slip_px = 8.0; // what moved farther did not slip

/// A stroke that is inked from a quarter to a half of its length, on its left.
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

float at(const std::vector<float>& ink, const glm::vec2& place_px)
{
    const glm::ivec2 pixel(glm::floor(place_px));
    return ink[static_cast<size_t>(pixel.y) * page_px.x + static_cast<size_t>(pixel.x)];
}

/// Of places along a straight stroke those where ink or paper is not as marked_picture() has it.
size_t places_off(const test::ChainLists& lists, const Stroke& stroke, const std::vector<float>& ink)
{
    const uint32_t steps = stroke.last - stroke.first;
    const glm::vec2 way =
        glm::normalize(lists.samples[stroke.last].page_px - lists.samples[stroke.first].page_px);
    const glm::vec2 left(way.y, -way.x); // the page's y points down
    size_t off = 0;
    for (uint32_t i = steps / 8; i <= steps - steps / 8; ++i) {
        const LineSample& sample = lists.samples[stroke.first + i];
        const float along = static_cast<float>(i) / static_cast<float>(steps);
        const bool is_inked = along > 0.27F && along < 0.48F;
        const bool is_blank = along < 0.23F || along > 0.52F;
        const float on_left = at(ink, sample.page_px + 3.0F * left);
        off += (is_inked && on_left < 0.95F) || (is_blank && on_left > 0.05F) ? 1U : 0U;
        off += (is_inked || is_blank) && at(ink, sample.page_px - 3.0F * left) > 0.05F ? 1U : 0U;
    }
    return off;
}

/// Strokes of some length, and those of them that are drawn with marked_picture().
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
            count.of_picture += places_off(lists, stroke, ink) == 0 ? 1U : 0U;
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

TEST(LineBrush, AMarkedEdgeHasItsOwnAndNotThatOfCreases)
{
    const test::Folder folder;
    save_png(marked_picture(), folder / "stroke.png");
    Primitive marked_box = large_box();
    marked_box.edge_marks.assign(marked_box.indices.size() / 3, 0);
    marked_box.edge_marks[0] = 2; // the upright edge between two seen sides
    test::Drawing marked(test::scene_of(marked_box), view_of_box(), page_px);
    test::Drawing creased(test::scene_of(large_box()), view_of_box(), page_px);
    ContourStyle style = even_lines(12.0F);
    style.marked_mm = 12.0F;
    style.brush_fit = BrushFit::stretch;
    style.marked_brush = (folder / "stroke.png").string();
    EXPECT_EQ(count_pictured(marked, style).of_picture, 1U);
    EXPECT_EQ(count_pictured(creased, style).of_picture, 0U);
    std::swap(style.marked_brush, style.crease_brush);
    EXPECT_EQ(count_pictured(marked, style).of_picture, 0U);
    EXPECT_EQ(count_pictured(creased, style).of_picture, 3U);
}

TEST(LineBrush, APenBesideOtherBrushesDrawsAsItDoesAlone)
{
    ContourStyle style = even_lines(6.0F);
    style.crease_deg = 180.0F;
    test::Drawing drawing(shapes_scene(), view_from_above(), page_px);
    const std::vector<float> alone = drawing.lines(style, 1.0F);
    style.crease_brush = "pencil";
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

/// What a film of a camera that goes around leaves of one frame.
struct FilmFrame {
    std::vector<LineSample> samples;
    std::vector<DrawnSample> drawn;
    glm::dmat4 clip_from_anchor{1.0};
    size_t stroke_count = 0;
};

std::vector<FilmFrame> film(const ContourStyle& style, int frame_count, LineClass lines)
{
    const Scene scene = shapes_scene();
    LineHistory history;
    std::vector<FilmFrame> frames;
    for (int i = 0; i < frame_count; ++i) {
        const double angle = glm::radians(0.25) * i;
        Camera camera = view_from_above();
        camera.eye = {camera.eye.x * std::cos(angle) + camera.eye.z * std::sin(angle), camera.eye.y,
                      camera.eye.z * std::cos(angle) - camera.eye.x * std::sin(angle)};
        test::Drawing drawing(scene, camera, page_px);
        drawing.begin_film_frame(history, i > 0, lines == LineClass::hidden);
        static_cast<void>(drawing.lines(style, 1.0F, &history));
        history.end_frame(drawing.globals.clip_from_anchor);
        FilmFrame& frame = frames.emplace_back();
        const test::ChainLists lists = drawing.chains(style, lines);
        frame.samples = lists.samples;
        frame.stroke_count = lists.strokes.size();
        frame.clip_from_anchor = glm::dmat4(drawing.globals.clip_from_anchor);
        gpu::Graph graph;
        frame.drawn = test::run_and_read_as<DrawnSample>(
            graph, gpu::import_whole(graph, "drawn samples", history.before(lines).samples));
        frame.drawn.resize(frame.samples.size());
    }
    return frames;
}

bool is_drawn(const std::vector<LineSample>& samples, size_t i)
{
    return (samples[i].state & shared::piece_is_there) != 0;
}

/// How far along its brush each sample has slid since the frame before, at the place of the surface that it
/// lies on.
std::vector<double> slips_px(const FilmFrame& before, const FilmFrame& now)
{
    std::vector<double> slips;
    for (size_t i = 0; i < now.samples.size(); i += 4) {
        if (!is_drawn(now.samples, i)) {
            continue;
        }
        const glm::dvec4 clip = before.clip_from_anchor * glm::dvec4(now.samples[i].anchor, 1.0);
        const glm::vec2 page((0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(page_px));
        const glm::vec2 way =
            glm::normalize(now.samples[i + 1].page_px - now.samples[i].page_px + glm::vec2(1e-6F));
        float nearest_px = 2.5F;
        const DrawnSample* same = nullptr;
        for (size_t k = 0; k < before.drawn.size(); ++k) {
            const float away = glm::distance(before.drawn[k].page_px, page);
            if (is_drawn(before.samples, k) && away < nearest_px &&
                glm::dot(glm::unpackHalf2x16(before.drawn[k].direction), way) > 0.9F) {
                nearest_px = away;
                same = &before.drawn[k];
            }
        }
        if (same != nullptr && same->seed == now.drawn[i].seed) {
            const double there = static_cast<double>(same->arc_px + glm::dot(page - same->page_px, way));
            slips.push_back(static_cast<double>(now.drawn[i].arc_px) - there);
        }
    }
    return slips;
}

struct Steadiness {
    double slip_px = 0.0; ///< root of the mean square
    size_t compared = 0;
    size_t begun_anew = 0;    ///< samples whose brush jumped to another place of itself
    double most_change = 0.0; ///< of the number of strokes from frame to frame, as a share
};

Steadiness steadiness_of(const std::vector<FilmFrame>& frames)
{
    Steadiness result;
    double sum_of_squares = 0.0;
    for (size_t i = 1; i < frames.size(); ++i) {
        for (const double slip : slips_px(frames[i - 1], frames[i])) {
            ++result.compared;
            const bool begins_anew = std::abs(slip) > most_slip_px;
            result.begun_anew += begins_anew ? 1U : 0U;
            sum_of_squares += begins_anew ? 0.0 : slip * slip;
        }
        const auto strokes_before = static_cast<double>(frames[i - 1].stroke_count);
        const double change = std::abs(static_cast<double>(frames[i].stroke_count) - strokes_before);
        result.most_change = std::max(result.most_change, change / strokes_before);
    }
    result.slip_px = std::sqrt(sum_of_squares / static_cast<double>(result.compared - result.begun_anew));
    return result;
}

TEST(LineBrush, ARepeatedBrushHoldsToTheSurfaceInMotion)
{
    ContourStyle style = even_lines(4.0F);
    style.brush = "charcoal";
    const Steadiness film_of_lines = steadiness_of(film(style, 10, LineClass::seen));
    EXPECT_GT(film_of_lines.compared, 1500U);
    EXPECT_LT(film_of_lines.slip_px, 0.06)
        << film_of_lines.begun_anew << " of " << film_of_lines.compared << " begun anew";
    EXPECT_LT(static_cast<double>(film_of_lines.begun_anew),
              0.005 * static_cast<double>(film_of_lines.compared));
    EXPECT_LT(film_of_lines.most_change, 0.1);
}

TEST(LineBrush, DashesOfHiddenLinesHoldToo)
{
    ContourStyle style = even_lines(2.0F);
    style.hidden = Hidden::dashed;
    const Steadiness film_of_dashes = steadiness_of(film(style, 6, LineClass::hidden));
    EXPECT_GT(film_of_dashes.compared, 300U);
    EXPECT_LT(film_of_dashes.slip_px, 0.15)
        << film_of_dashes.begun_anew << " of " << film_of_dashes.compared << " begun anew";
    EXPECT_LT(static_cast<double>(film_of_dashes.begun_anew),
              0.01 * static_cast<double>(film_of_dashes.compared));
}

} // namespace
} // namespace estampe::contour
