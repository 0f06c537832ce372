// SPDX-License-Identifier: MIT
// Compares strokes as paths with the picture of the same strokes: the SVG drawn by librsvg and the frame must
// coincide.
#include <estampe/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "scene/smooth_surface.hpp"
#include "style/parameter.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings vector_page{.width = 240, .height = 180};
const Camera vector_camera{.eye = {3.0, 3.0, 5.0}, .target = {0.0, 0.4, 0.0}};

/// Objects in front of and behind each other, some of them partly outside the page.
Scene crowded_still_life()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F}, {-0.6, 0.0, 0.0});
    test::add_object(scene, shapes::sphere(0.6F), {0.2F, 0.4F, 0.7F}, {0.8, 0.6, 0.5});
    test::add_object(scene, shapes::sphere(0.9F), {0.7F, 0.7F, 0.7F}, {1.5, 0.9, -1.6});
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

/// A style with nothing but black strokes on white.
Style bare(const std::vector<std::string>& assignments)
{
    Style style;
    for (const char* assignment :
         {"wash.strength=0", "paper.grain=0", "paper.granulation=0", "paper.ink_break=0", "paper.color=#fff",
          "paper.ink=#000", "contour.ink=#000", "sky.enabled=false", "paper.height_mm=50",
          "paper.margin_mm=0"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

const std::vector<std::string> only_lines{"hatch.enabled=false"};
const std::vector<std::string> only_hatching{"contour.enabled=false"};

/// Share of ink in each pixel, using the encoding in which black was laid over white.
struct PageInk {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<double> of_pixel;

    [[nodiscard]] double at(int64_t x, int64_t y) const
    {
        const bool is_inside = x >= 0 && y >= 0 && x < width && y < height;
        return is_inside ? of_pixel[static_cast<size_t>(y * width + x)] : 0.0;
    }

    [[nodiscard]] double mean() const
    {
        double sum = 0.0;
        for (const double ink : of_pixel) {
            sum += ink;
        }
        return sum / static_cast<double>(of_pixel.size());
    }
};

PageInk page_ink(const Image& image, bool is_linear)
{
    PageInk ink{image.width, image.height, {}};
    ink.of_pixel.reserve(image.rgba.size() / 4);
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        const double value = image.rgba[i + 1] / 255.0;
        ink.of_pixel.push_back(
            1.0 - (is_linear ? static_cast<double>(style::linear_from_srgb(glm::dvec3(value)).x) : value));
    }
    return ink;
}

/// Share of the ink of `a` that has ink of `b`, at least half as much, within 1.5 pixels.
double covered(const PageInk& a, const PageInk& b)
{
    double all = 0.0;
    double met = 0.0;
    for (int64_t y = 0; y < a.height; ++y) {
        for (int64_t x = 0; x < a.width; ++x) {
            const double ink = a.at(x, y);
            double most = 0.0;
            for (int64_t i = 0; i < 9; ++i) {
                most = std::max(most, b.at(x + i % 3 - 1, y + i / 3 - 1)); // corners are 1.41 away
            }
            all += ink;
            met += most >= 0.5 * ink ? ink : 0.0;
        }
    }
    return all > 0.0 ? met / all : 1.0;
}

Image by_librsvg(const std::filesystem::path& svg, const RenderSettings& settings)
{
    const std::string png = svg.string() + ".png";
    const std::string command = fmt::format("rsvg-convert -w {} -h {} -o '{}' '{}'", settings.width,
                                            settings.height, png, svg.string());
    // NOLINTNEXTLINE(cert-env33-c,concurrency-mt-unsafe): a test's own command
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return load_image(png);
}

struct Both {
    PageInk picture;
    PageInk paths;
};

Both both_ways(const Scene& scene, const Camera& from, const Style& style, const RenderSettings& settings)
{
    const test::Folder folder;
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Image picture = renderer.render(from, style, settings);
    save_svg(renderer.draw_strokes(from, style, settings), folder / "strokes.svg");
    return {page_ink(picture, true), page_ink(by_librsvg(folder / "strokes.svg", settings), false)};
}

/// The mean ink of lines may differ: where two lines meet within a pixel, the picture keeps the darker one,
/// and an SVG lays one over the other.
void expect_alike(const Both& both, double least_covered, double most_more_ink = 0.06)
{
    EXPECT_GT(both.picture.mean(), 0.002);
    EXPECT_GE(covered(both.picture, both.paths), least_covered);
    EXPECT_GE(covered(both.paths, both.picture), least_covered);
    EXPECT_NEAR(both.paths.mean(), both.picture.mean(), most_more_ink * both.picture.mean());
}

TEST(Vectors, NoStrokeIsThinnerThanAPrinterShows)
{
    test::shared_renderer().set_scene(crowded_still_life());
    const VectorDrawing drawing = test::shared_renderer().draw_strokes(vector_camera, bare({}), vector_page);
    EXPECT_GT(drawing.strokes.size(), 100U);
    for (const VectorStroke& stroke : drawing.strokes) {
        float widest_mm = 0.0F;
        for (const VectorPoint& point : stroke.points) {
            widest_mm = std::max(widest_mm, point.width_mm);
        }
        EXPECT_GE(widest_mm, 0.02F);
    }
}

TEST(Vectors, TheMarginIsLeftBlankAndTheBorderIsRuled)
{
    Style style = bare({"paper.margin_mm=5", "paper.border_mm=0.4"});
    test::shared_renderer().set_scene(crowded_still_life());
    const VectorDrawing drawing = test::shared_renderer().draw_strokes(vector_camera, style, vector_page);
    float ruled_mm = 0.0F;
    for (const VectorStroke& stroke : drawing.strokes) {
        for (size_t i = 0; i < stroke.points.size(); ++i) {
            const glm::vec2 at = stroke.points[i].page_mm;
            EXPECT_TRUE(at.x >= 5.0F && at.y >= 5.0F && at.x <= drawing.width_mm - 5.0F && at.y <= 45.0F)
                << at.x << ", " << at.y;
            if (stroke.kind == StrokeKind::frame && i > 0) {
                EXPECT_EQ(stroke.points[i].width_mm, 0.4F);
                ruled_mm += glm::distance(at, stroke.points[i - 1].page_mm);
            }
        }
    }
    EXPECT_NEAR(ruled_mm, 2.0F * (drawing.width_mm - 10.0F + 40.0F), 1e-3F);
}

TEST(Vectors, FocusLinesLieWhereThePictureHasThem)
{
    const Style style = bare({"hatch.enabled=false", "contour.enabled=false", "focus_lines.enabled=true",
                              "focus_lines.clear=0.4", "focus_lines.ink=#000", "paper.margin_mm=5"});
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(crowded_still_life());
    const VectorDrawing drawing = renderer.draw_strokes(vector_camera, style, vector_page);
    const Image picture = renderer.render(vector_camera, style, vector_page);
    const float px_per_mm = static_cast<float>(vector_page.height) / drawing.height_mm;
    ASSERT_GT(drawing.strokes.size(), 20U);
    for (const VectorStroke& stroke : drawing.strokes) {
        ASSERT_EQ(stroke.kind, StrokeKind::focus);
        EXPECT_EQ(drawing.objects[stroke.object], "focus");
        const VectorPoint& end = stroke.points.back();
        const glm::vec2 inwards = glm::normalize(stroke.points.front().page_mm - end.page_mm);
        const glm::ivec2 pixel((end.page_mm + 0.5F * inwards) * px_per_mm);
        const auto at = 4 * static_cast<size_t>(pixel.y * static_cast<int>(vector_page.width) + pixel.x);
        const float is_wide = end.width_mm * px_per_mm;
        EXPECT_TRUE(is_wide < 1.5F || picture.rgba[at] < 128) << pixel.x << ", " << pixel.y;
    }
}

TEST(Vectors, LinesLieWhereThePictureHasThem)
{
    expect_alike(both_ways(crowded_still_life(), vector_camera, bare(only_lines), vector_page), 0.99);
}

TEST(Vectors, LinesOfMeshEdgesToo)
{
    expect_alike(
        both_ways(crowded_still_life(), vector_camera,
                  bare({"hatch.enabled=false", "contour.silhouettes=edges", "contour.wobble_mm=0.2"}),
                  vector_page),
        0.99);
}

TEST(Vectors, LinesDrawnTwiceByALooseHandToo)
{
    expect_alike(both_ways(crowded_still_life(), vector_camera,
                           bare({"hatch.enabled=false", "contour.strokes=2", "contour.retrace_mm=0.8",
                                 "contour.wobble_mm=0.2", "contour.jitter_ends_mm=1",
                                 "contour.jitter_width=0.3", "contour.overshoot_mm=0.8"}),
                           vector_page),
                 0.98, 0.08);
    Renderer& renderer = test::shared_renderer();
    const size_t once = renderer.draw_strokes(vector_camera, bare(only_lines), vector_page).strokes.size();
    const size_t twice =
        renderer.draw_strokes(vector_camera, bare({"hatch.enabled=false", "contour.strokes=2"}), vector_page)
            .strokes.size();
    EXPECT_GT(twice, once);
    EXPECT_LE(twice, 2 * once);
}

TEST(Vectors, OtherBrushesGiveWayToThePenAndItIsSaid)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(crowded_still_life());
    const VectorDrawing pen = renderer.draw_strokes(vector_camera, bare(only_lines), vector_page);
    EXPECT_TRUE(renderer.notes().empty());
    const VectorDrawing other = renderer.draw_strokes(
        vector_camera, bare({"hatch.enabled=false", "contour.brush=charcoal"}), vector_page);
    ASSERT_EQ(renderer.notes().size(), 1U);
    EXPECT_NE(renderer.notes().front().find("the pen"), std::string::npos);
    EXPECT_EQ(other.strokes.size(), pen.strokes.size());
}

class HatchVectors : public testing::TestWithParam<const char*> {};

TEST_P(HatchVectors, HatchingLiesWhereThePictureHasIt)
{
    std::vector<std::string> assignments = only_hatching;
    assignments.insert(assignments.end(), {"hatch.coordinates=uv", GetParam()});
    expect_alike(both_ways(crowded_still_life(), vector_camera, bare(assignments), vector_page), 0.98);
}

INSTANTIATE_TEST_SUITE_P(Styles, HatchVectors,
                         testing::Values("hatch.coordinates=solid", "hatch.coordinates=uv",
                                         "hatch.coordinates=form", "hatch.coordinates=page", "hatch.growth=1",
                                         "hatch.overrun_mm=1", "hatch.loose_mm=1"),
                         [](const auto& named) {
                             std::string name = named.param;
                             std::ranges::replace_if(
                                 name, [](char c) { return c == '.' || c == '='; }, '_');
                             return name;
                         });

TEST(Vectors, StrokesStayOnThePageAndKnowWhatTheyBelongTo)
{
    Scene scene = crowded_still_life();
    scene.nodes[2].name = "ball";
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const VectorDrawing drawing = renderer.draw_strokes(vector_camera, bare({}), vector_page);
    EXPECT_FLOAT_EQ(drawing.height_mm, 50.0F);
    EXPECT_NEAR(drawing.width_mm, 66.667F, 1e-3F);
    size_t of_ball = 0;
    bool has_hatching = false;
    for (const VectorStroke& stroke : drawing.strokes) {
        EXPECT_FALSE(stroke.is_hidden);
        EXPECT_GE(stroke.points.size(), 2U);
        of_ball += drawing.objects.at(stroke.object) == "ball" ? 1 : 0;
        has_hatching = has_hatching || stroke.kind == StrokeKind::hatch;
        for (const VectorPoint& point : stroke.points) {
            EXPECT_EQ(glm::clamp(point.page_mm, glm::vec2(0.0F), glm::vec2(drawing.width_mm, 50.0F)),
                      point.page_mm);
            EXPECT_GE(point.width_mm, 0.0F);
        }
    }
    EXPECT_GT(of_ball, 1U);
    EXPECT_TRUE(has_hatching);
}

/// A lentil has a rounded rim, a ring is hollow inside, and a box has an edge that is marked.
TEST(Vectors, EachKindOfLineIsAKindOfStroke)
{
    Primitive lentil = shapes::sphere(1.0F, 64, 32);
    for (size_t i = 0; i < lentil.positions.size(); ++i) {
        lentil.positions[i].y *= 0.35F;
        lentil.normals[i] = glm::normalize(lentil.normals[i] / glm::vec3(1.0F, 0.35F, 1.0F));
    }
    Scene scene = test::scene_of(lentil);
    test::add_object(scene, subdivided(shapes::torus(0.8F, 0.3F, 24, 12), 1), glm::vec3(0.5F),
                     {2.1, 0.2, 0.0});
    Primitive box = shapes::box({1.0F, 1.0F, 1.0F});
    box.edge_marks.assign(box.indices.size() / 3, 0);
    box.edge_marks[0] = 2; // a vertical edge whose faces are both visible
    test::add_object(scene, box, glm::vec3(0.5F), {-2.0, 0.0, 0.0});
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const auto mm_of = [&](StrokeKind kind, const std::vector<std::string>& assignments) {
        std::vector<std::string> all = assignments;
        all.insert(all.end(), {"hatch.enabled=false", "picture.ground=false"});
        float sum = 0.0F;
        for (const VectorStroke& stroke :
             renderer.draw_strokes({.eye = {0.6, 1.8, 8.0}}, bare(all), vector_page).strokes) {
            for (size_t i = 1; stroke.kind == kind && i < stroke.points.size(); ++i) {
                sum += glm::distance(stroke.points[i - 1].page_mm, stroke.points[i].page_mm);
            }
        }
        return sum;
    };
    EXPECT_GT(mm_of(StrokeKind::ridge,
                    {"contour.ridge.enabled=true", "contour.ridge.width_mm=0.3", "contour.ridge.turn_deg=4"}),
              5.0F);
    EXPECT_EQ(mm_of(StrokeKind::ridge, {"contour.valley.enabled=true", "contour.valley.width_mm=0.3",
                                        "contour.ridge.turn_deg=4"}),
              0.0F);
    EXPECT_EQ(mm_of(StrokeKind::valley,
                    {"contour.ridge.enabled=true", "contour.ridge.width_mm=0.3", "contour.ridge.turn_deg=4"}),
              0.0F);
    EXPECT_GT(
        mm_of(StrokeKind::suggestive, {"contour.suggestive.enabled=true", "contour.suggestive.width_mm=0.3",
                                       "contour.suggestive.growth=1"}),
        1.0F);
    EXPECT_EQ(mm_of(StrokeKind::suggestive, {}), 0.0F);
    EXPECT_GT(mm_of(StrokeKind::marked, {}), 2.0F);
    EXPECT_EQ(mm_of(StrokeKind::crease, {}), 0.0F);
    EXPECT_EQ(mm_of(StrokeKind::marked, {"contour.marked.enabled=false"}), 0.0F);
    EXPECT_GT(mm_of(StrokeKind::crease, {"contour.marked.enabled=false"}), 2.0F);
}

TEST(Vectors, HiddenLinesComeWhereAskedFor)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    test::add_sun(scene, {1.0, 2.0, 1.5});
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const auto total_mm = [&](HiddenLines hidden, bool of_hidden) {
        const VectorDrawing drawing =
            renderer.draw_strokes({.eye = {3.0, 3.0, 5.0}, .target = {0.0, 0.5, 0.0}},
                                  bare({"hatch.enabled=false", "picture.ground=false"}), vector_page, hidden);
        double sum = 0.0;
        for (const VectorStroke& stroke : drawing.strokes) {
            for (size_t i = 1; i < stroke.points.size() && stroke.is_hidden == of_hidden; ++i) {
                sum += glm::distance(stroke.points[i - 1].page_mm, stroke.points[i].page_mm);
            }
        }
        return sum;
    };
    EXPECT_EQ(total_mm(HiddenLines::left_out, true), 0.0);
    const double seen_mm = total_mm(HiddenLines::kept, false);
    EXPECT_DOUBLE_EQ(seen_mm, total_mm(HiddenLines::left_out, false));
    // Nine edges of a box are visible and three are hidden, all of similar length.
    EXPECT_NEAR(total_mm(HiddenLines::kept, true), seen_mm / 3.0, 0.12 * seen_mm);
}

TEST(Vectors, HiddenLinesOfTheStyleComeWithItsDashes)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(crowded_still_life());
    const VectorDrawing drawing = renderer.draw_strokes(
        vector_camera,
        bare({"hatch.enabled=false", "contour.hidden.enabled=true", "contour.hidden.width_mm=0.3",
              "contour.hidden.dash_mm=2", "contour.hidden.gap_mm=1"}),
        vector_page);
    EXPECT_FLOAT_EQ(drawing.dash_mm, 1.7F); // plus the round ends
    EXPECT_FLOAT_EQ(drawing.dash_gap_mm, 1.3F);
    size_t hidden = 0;
    for (const VectorStroke& stroke : drawing.strokes) {
        hidden += stroke.is_hidden ? 1U : 0U;
        EXPECT_TRUE(!stroke.is_hidden || std::abs(stroke.points.front().width_mm - 0.3F) < 1e-4F);
    }
    EXPECT_GT(hidden, 3U);
}

TEST(Vectors, WhatHasNoPathsIsAnErrorThatNamesTheKey)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(crowded_still_life());
    for (const auto& [assignment, key] :
         {std::pair("hatch.strokes=map", "hatch.strokes"), std::pair("hatch.strokes=dots", "hatch.strokes"),
          std::pair("contour.lines=page", "contour.lines")}) {
        try {
            static_cast<void>(renderer.draw_strokes(vector_camera, bare({assignment}), vector_page));
            ADD_FAILURE() << assignment;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("no paths"), std::string::npos);
            EXPECT_EQ(error.where(), key);
        }
    }
    const VectorDrawing none = renderer.draw_strokes(
        vector_camera, bare({"hatch.enabled=false", "contour.enabled=false"}), vector_page);
    EXPECT_TRUE(none.strokes.empty());
}

TEST(Vectors, ThePictureIsTheSameBeforeAndAfter)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(crowded_still_life());
    const Image before = renderer.render(vector_camera, {}, vector_page);
    const VectorDrawing first = renderer.draw_strokes(vector_camera, {}, vector_page);
    EXPECT_EQ(before, renderer.render(vector_camera, {}, vector_page));
    const VectorDrawing second = renderer.draw_strokes(vector_camera, {}, vector_page);
    ASSERT_EQ(first.strokes.size(), second.strokes.size());
    for (size_t i = 0; i < first.strokes.size(); ++i) {
        EXPECT_EQ(first.strokes[i].points, second.strokes[i].points);
    }
}

/// Uses models outside of the project, in the folder that ESTAMPE_MODELS names.
TEST(Vectors, ModelsLieWhereThePictureHasThem)
{
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets it
    const char* folder = std::getenv("ESTAMPE_MODELS");
    const std::vector<std::string> models{"suzanne.gltf", "FlightHelmet/FlightHelmet.gltf", "Fox.glb"};
    for (const std::string& model : folder != nullptr ? models : std::vector<std::string>()) {
        const std::filesystem::path path = std::filesystem::path(folder) / model;
        if (!std::filesystem::exists(path)) {
            continue;
        }
        const Scene scene = load_scene(path.string());
        const RenderSettings settings{.width = 640, .height = 480};
        const Camera from = framing_camera(scene, pose_scene(scene, 0.0), 4.0 / 3.0);
        for (const auto& only : {only_lines, only_hatching}) {
            SCOPED_TRACE(model + " " + only.front());
            Style style = bare(only);
            style.set("paper.height_mm=110");
            expect_alike(both_ways(scene, from, style, settings), 0.98, 0.08);
        }
    }
}

} // namespace
} // namespace estampe
