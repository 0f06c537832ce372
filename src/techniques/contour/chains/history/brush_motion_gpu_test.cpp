// SPDX-License-Identifier: MIT
// Brushes of lines from frame to frame: their pictures must not slide along the lines.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

using shared::DrawnSample;
using shared::LineSample;
using shared::Stroke;

constexpr double most_slip_px = 8.0;    // a larger offset is a jump, not a slip
constexpr float least_whole_px = 24.0F; // shorter strokes are not tested

/// The samples and strokes of one frame of a film.
struct FilmFrame {
    std::vector<LineSample> samples;
    std::vector<DrawnSample> drawn;
    glm::dmat4 clip_from_anchor{1.0};
    std::vector<Stroke> strokes;
};

/// Renders a frame and adds it to a film.
void shoot(std::vector<FilmFrame>& frames, const Scene& scene, const Camera& camera,
           const ContourStyle& style, const std::shared_ptr<frame::Features>& features,
           LineClass lines = LineClass::seen)
{
    test::Drawing drawing(scene, camera, page_px);
    drawing.features = features;
    drawing.begin_film_frame(!frames.empty(), lines == LineClass::hidden);
    static_cast<void>(drawing.lines(style, 1.0F, true));
    drawing.end_film_frame();
    FilmFrame& frame = frames.emplace_back();
    const test::ChainLists lists = drawing.chains(style, lines);
    frame.samples = lists.samples;
    frame.strokes = lists.strokes;
    frame.clip_from_anchor = glm::dmat4(drawing.globals.clip_from_anchor);
    gpu::Graph graph;
    frame.drawn = test::run_and_read_as<DrawnSample>(
        graph, gpu::import_whole(graph, "drawn samples", features->lines.history().before(lines).samples));
    frame.drawn.resize(frame.samples.size());
}

/// A film whose camera moves around `scene` by 0.25 degrees per frame.
std::vector<FilmFrame> orbit(const Scene& scene, const ContourStyle& style, int frame_count,
                             LineClass lines = LineClass::seen)
{
    const auto features = std::make_shared<frame::Features>();
    std::vector<FilmFrame> frames;
    for (int i = 0; i < frame_count; ++i) {
        const double angle = glm::radians(0.25) * i;
        Camera camera = view_from_above();
        camera.eye = {camera.eye.x * std::cos(angle) + camera.eye.z * std::sin(angle), camera.eye.y,
                      camera.eye.z * std::cos(angle) - camera.eye.x * std::sin(angle)};
        shoot(frames, scene, camera, style, features, lines);
    }
    return frames;
}

bool is_drawn(const FilmFrame& frame, size_t i)
{
    return (frame.samples[i].state & shared::piece_is_there) != 0 && frame.drawn[i].half_width_px > 0.0F;
}

/// The sample of the previous frame at the same place of the surface.
struct Match {
    const DrawnSample* before;
    const DrawnSample* now;
    double along_px; ///< distance on the page, along the line, between both samples
};

std::vector<Match> matches(const FilmFrame& before, const FilmFrame& now)
{
    std::vector<Match> found;
    for (size_t i = 0; i < now.samples.size(); i += 4) {
        if (!is_drawn(now, i)) {
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
            if (is_drawn(before, k) && away < nearest_px &&
                glm::dot(glm::unpackHalf2x16(before.drawn[k].direction), way) > 0.9F) {
                nearest_px = away;
                same = &before.drawn[k];
            }
        }
        if (same != nullptr) {
            found.push_back({same, &now.drawn[i], static_cast<double>(glm::dot(page - same->page_px, way))});
        }
    }
    return found;
}

/// How far each sample has slid along its brush since the previous frame, compared at the same place of the
/// surface.
std::vector<double> slips_px(const FilmFrame& before, const FilmFrame& now)
{
    std::vector<double> slips;
    for (const Match& match : matches(before, now)) {
        if (match.before->seed == match.now->seed) {
            const double there = static_cast<double>(match.before->arc_px) + match.along_px;
            slips.push_back(static_cast<double>(match.now->arc_px) - there);
        }
    }
    return slips;
}

struct Steadiness {
    double slip_px = 0.0; ///< root mean square
    size_t compared = 0;
    size_t begun_anew = 0;  ///< number of samples whose brush jumped
    size_t most_change = 0; ///< of the number of strokes from frame to frame
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
        const size_t before = frames[i - 1].strokes.size();
        const size_t now = frames[i].strokes.size();
        result.most_change = std::max(result.most_change, before > now ? before - now : now - before);
    }
    result.slip_px = std::sqrt(sum_of_squares / static_cast<double>(result.compared - result.begun_anew));
    return result;
}

TEST(LineBrush, ARepeatedBrushHoldsToTheSurfaceInMotion)
{
    ContourStyle style = even_lines(4.0F);
    style.brush = "charcoal";
    const Steadiness film_of_lines = steadiness_of(orbit(shapes_scene(), style, 10));
    EXPECT_GT(film_of_lines.compared, 1500U);
    EXPECT_LT(film_of_lines.slip_px, 0.06)
        << film_of_lines.begun_anew << " of " << film_of_lines.compared << " begun anew";
    EXPECT_LT(static_cast<double>(film_of_lines.begun_anew),
              0.005 * static_cast<double>(film_of_lines.compared));
    EXPECT_LE(film_of_lines.most_change, 3U); // of some 26
}

TEST(LineBrush, DashesOfHiddenLinesHoldToo)
{
    ContourStyle style = even_lines(2.0F);
    style.hidden.enabled = true;
    const Steadiness film_of_dashes = steadiness_of(orbit(shapes_scene(), style, 6, LineClass::hidden));
    EXPECT_GT(film_of_dashes.compared, 300U);
    EXPECT_LT(film_of_dashes.slip_px, 0.15)
        << film_of_dashes.begun_anew << " of " << film_of_dashes.compared << " begun anew";
    EXPECT_LT(static_cast<double>(film_of_dashes.begun_anew),
              0.01 * static_cast<double>(film_of_dashes.compared));
}

/// A style with a stretched charcoal brush.
ContourStyle stretched_style()
{
    ContourStyle style = even_lines(4.0F);
    style.brush = "charcoal";
    style.brush_fit = BrushFit::stretch;
    return style;
}

double share_of_brush(const DrawnSample& drawn, double along_px = 0.0)
{
    return (static_cast<double>(drawn.arc_px) + along_px) / static_cast<double>(drawn.whole_px);
}

/// Statistics of samples that the previous frame drew too.
struct Slides {
    size_t compared = 0;
    size_t jumped = 0;     ///< number of samples that jumped by more than 0.035 of their brush
    double most_off = 0.0; ///< from the even position in the last frame, in shares of the brush
};

Slides slides_of(const std::vector<FilmFrame>& frames)
{
    Slides slides;
    for (size_t i = 1; i < frames.size(); ++i) {
        for (const Match& match : matches(frames[i - 1], frames[i])) {
            if (match.now->whole_px < least_whole_px) {
                continue;
            }
            const double slide = share_of_brush(*match.now) - share_of_brush(*match.before, match.along_px);
            ++slides.compared;
            slides.jumped += std::abs(slide - std::round(slide)) > 0.035 ? 1U : 0U;
        }
    }
    for (const Stroke& stroke : frames.back().strokes) {
        for (uint32_t at = stroke.first; at < stroke.last && is_drawn(frames.back(), at); ++at) {
            // The brush is laid along the part of the line behind the post, too.
            const uint32_t before = stroke.steps_behind & 0xffffU;
            const uint32_t after = stroke.steps_behind >> 16U;
            const double even = static_cast<double>(before + at - stroke.first) /
                                static_cast<double>(before + stroke.last - stroke.first + after);
            const double off = share_of_brush(frames.back().drawn[at]) - even;
            slides.most_off = std::max(slides.most_off, std::abs(off));
        }
    }
    return slides;
}

TEST(LineBrush, AStretchedOneSlidesToItsNewEndsWhereAStrokeIsSplitOrJoined)
{
    // A post beside the plane, then in front of it. Both scenes have the same size, and so the same anchor.
    const auto with_post_at = [](double x_m) {
        Scene scene = test::scene_of(shapes::plane(4.0F, 3.0F, 1));
        test::add_object(scene, shapes::box({0.3F, 2.0F, 0.3F}), glm::vec3(0.5F), {x_m, 0.5, 2.5});
        return scene;
    };
    const Scene whole = with_post_at(-1.85);
    const Scene split = with_post_at(0.4);
    const Camera camera{.eye = {0.0, 4.0, 6.0}, .target = {0.0, 0.0, 0.0}};
    const auto features = std::make_shared<frame::Features>();
    std::vector<FilmFrame> frames;
    shoot(frames, whole, camera, stretched_style(), features);
    for (const Scene* scene : std::array{&split, &whole}) {
        std::vector<FilmFrame> shots{frames.back()};
        for (int i = 0; i < 40; ++i) {
            shoot(shots, *scene, camera, stretched_style(), features);
        }
        // The edges at the front and back exist before and after the change.
        EXPECT_GT(matches(shots[0], shots[1]).size(), 60U);
        const Slides slides = slides_of(shots);
        EXPECT_GT(slides.compared, 2500U);
        EXPECT_LT(slides.jumped, 8U);
        EXPECT_LT(slides.most_off, 0.01);
        frames = std::move(shots);
    }
}

TEST(LineBrush, AStretchedOneHoldsInMotion)
{
    const Slides slides = slides_of(orbit(shapes_scene(), stretched_style(), 10));
    EXPECT_GT(slides.compared, 1500U);
    EXPECT_LT(static_cast<double>(slides.jumped), 0.01 * static_cast<double>(slides.compared));
}

TEST(LineBrush, AStretchedOneOfARingBeginsWhereItDid)
{
    const Slides slides =
        slides_of(orbit(test::scene_of(shapes::sphere(1.0F, 48, 24)), stretched_style(), 10));
    EXPECT_GT(slides.compared, 200U);
    EXPECT_EQ(slides.jumped, 0U);
}

} // namespace
} // namespace estampe::contour
