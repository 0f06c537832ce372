// SPDX-License-Identifier: MIT
// Haze on layers that the tests paint, and in whole pictures.
#include "techniques/haze/haze.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>
#include <estampe/terrain.hpp>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "support/scenes.hpp"

namespace estampe::haze {
namespace {

constexpr glm::uvec2 size_px(96, 64);
constexpr double near_m = 0.1;
const Camera camera{.eye = {10.0, 2.0, -3.0}, .target = {11.0, 1.9, -4.0}, .near_m = near_m};
constexpr glm::vec3 sky_color(0.875F, 0.75F, 0.375F); // exact in half floats
constexpr glm::vec3 sand(0.5F, 0.25F, 0.125F);

struct Painted {
    test::Painter<float> depth = [](glm::uvec2) { return 0.0F; };
    test::Painter<float> hatch = [](glm::uvec2) { return 1.0F; };
    test::Painter<float> lines = [](glm::uvec2) { return 1.0F; };
};

struct Faded {
    std::vector<glm::vec4> wash;
    std::vector<float> hatch;
    std::vector<uint32_t> lines; ///< four bytes each
    std::vector<glm::vec2> left; ///< share left for vector strokes: of strokes, of lines

    [[nodiscard]] float line(size_t i) const { return static_cast<float>(lines[i] >> 24U) / 255.0F; }
};

Faded fade(const Painted& page, const HazeStyle& style, float line_half_px = 1.0F)
{
    auto depth = test::Layer::depth(size_px, page.depth);
    auto sky = test::Layer::color(size_px, [](glm::uvec2) { return glm::vec4(sky_color, 1.0F); });
    auto frame = gpu::upload_buffer(
        test::shared_device(), "frame",
        std::vector{features::frame_globals(camera, {}, camera.eye - 1.0, {.size_px = size_px})});
    Faded faded;
    for (int wanted = 0; wanted < 4; ++wanted) {
        auto wash = test::Layer::color(size_px, [](glm::uvec2) { return glm::vec4(sand, 1.0F); });
        auto hatch = test::Layer::coverage(size_px, page.hatch);
        auto lines = test::Layer::root_color(
            size_px, [&](glm::uvec2 pixel) { return glm::vec4(0.2F, 0.1F, 0.1F, page.lines(pixel)); });
        gpu::Graph graph;
        const HazeInputs in{.frame = gpu::import_whole(graph, "frame", frame),
                            .depth = depth.in(graph),
                            .line_half_px = line_half_px,
                            .size_px = size_px};
        if (wanted == 3) {
            faded.left = test::run_and_read_as<glm::vec2>(graph, add_ink_left(graph, in, style));
            continue;
        }
        const HazeLayers layers =
            add_haze(graph, in, style, sky.in(graph),
                     {.wash = wash.in(graph), .hatch = hatch.in(graph), .lines = lines.in(graph)});
        if (wanted == 0) {
            faded.wash = test::run_and_read_colors(graph, layers.wash);
        } else if (wanted == 1) {
            faded.hatch = test::run_and_read_coverage(graph, layers.hatch);
        } else {
            faded.lines = test::run_and_read_as<uint32_t>(graph, layers.lines);
        }
    }
    return faded;
}

/// Distance of a point at this pixel and depth.
double away_m(glm::uvec2 pixel, double depth)
{
    const auto globals = features::frame_globals(camera, {}, camera.eye, {.size_px = size_px});
    const glm::dvec2 ndc = 2.0 * (glm::dvec2(pixel) + 0.5) / glm::dvec2(size_px) - 1.0;
    const glm::dvec4 p = glm::inverse(glm::dmat4(globals.clip_from_anchor)) * glm::dvec4(ndc, depth, 1.0);
    return glm::length(glm::dvec3(p) / p.w);
}

double left_at(const HazeStyle& style, double metres)
{
    return std::exp2(-std::max(metres - static_cast<double>(style.start_m), 0.0) /
                     static_cast<double>(style.reach_m));
}

TEST(Haze, TakesByDistanceWhatTheFormulaSays)
{
    Painted page; // columns at increasing distances, from 1 m to 30 km
    page.depth = [](glm::uvec2 pixel) {
        return static_cast<float>(near_m / std::pow(30000.0, pixel.x / (size_px.x - 1.0)));
    };
    page.lines = [](glm::uvec2) { return 0.0F; };
    const HazeStyle style{.start_m = 30.0F, .reach_m = 500.0F, .ink = 1.5F};
    const Faded faded = fade(page, style);
    for (uint32_t i = 0; i < faded.wash.size(); ++i) {
        const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
        const double left = left_at(style, away_m(pixel, static_cast<double>(page.depth(pixel))));
        const glm::dvec3 wanted = glm::mix(glm::dvec3(sky_color), glm::dvec3(sand), left);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(faded.wash[i][channel], wanted[channel], 6e-4) << i; // half floats have 11 bits
        }
        EXPECT_EQ(faded.wash[i].w, 1.0F);
        EXPECT_NEAR(faded.hatch[i], std::pow(left, 1.5), 6e-4) << i;
        if (pixel.x > 0) {
            EXPECT_LE(faded.hatch[i], faded.hatch[i - 1]);
            EXPECT_GE(faded.wash[i].x, faded.wash[i - 1].x);
        }
    }
    EXPECT_EQ(faded.hatch[size_px.x / 4], 1.0F) << "nearer than start_m";
    EXPECT_LT(faded.hatch[size_px.x - 1], 1e-6F);
}

TEST(Haze, LeavesTheSkyAsItIs)
{
    const Faded faded = fade({}, {.start_m = 0.0F, .reach_m = 1.0F});
    for (size_t i = 0; i < faded.wash.size(); ++i) {
        EXPECT_EQ(faded.hatch[i], 1.0F);
        EXPECT_EQ(faded.lines[i] >> 24U, 255U);
        EXPECT_EQ(faded.left[i], glm::vec2(1.0F));
        EXPECT_NEAR(faded.wash[i].x, sand.x, 3e-4F);
    }
}

TEST(Haze, KeepsInkThatIsToStay)
{
    Painted page;
    page.depth = [](glm::uvec2) { return 1e-5F; };
    const Faded faded = fade(page, {.start_m = 0.0F, .reach_m = 1.0F, .ink = 0.0F});
    EXPECT_EQ(std::ranges::min(faded.hatch), 1.0F);
    EXPECT_EQ(faded.line(500), 1.0F);
    EXPECT_NEAR(faded.wash[500].x, sky_color.x, 1e-3F);
}

TEST(Haze, GivesLinesTheDepthOfTheNearerSideOfAnEdge)
{
    // Near surfaces on the left; far ground or background on the right.
    const HazeStyle style{.start_m = 0.0F, .reach_m = 100.0F, .ink = 1.0F};
    const auto near_depth = static_cast<float>(near_m / 20.0);
    for (const float behind : {0.0F, static_cast<float>(near_m / 3000.0)}) {
        Painted page;
        page.depth = [&](glm::uvec2 pixel) { return pixel.x < 48 ? near_depth : behind; };
        const Faded faded = fade(page, style, 2.0F);
        const size_t row = 20 * size_px.x;
        const double left = left_at(style, away_m({48, 20}, static_cast<double>(near_depth)));
        for (const uint32_t x : {46U, 47U, 48U, 49U, 50U}) {
            EXPECT_NEAR(faded.line(row + x), left, 0.01) << x;
        }
        EXPECT_NEAR(faded.line(row + 53), behind > 0.0F ? 0.0 : 1.0, 1e-6) << "beyond the reach of the pen";
    }
}

TEST(Haze, GivesLinesOnAPlaneTheirOwnDepth)
{
    // Flat ground with its horizon at the top of row 10: a line there is as far as the ground in that row,
    // not as the nearer ground a few pixels below.
    Painted page;
    page.depth = [](glm::uvec2 pixel) {
        return pixel.y < 10 ? 0.0F : 2e-5F * (static_cast<float>(pixel.y) - 9.5F);
    };
    const HazeStyle style{.start_m = 0.0F, .reach_m = 2000.0F, .ink = 1.0F};
    const Faded faded = fade(page, style, 3.0F);
    for (uint32_t y = 10; y < size_px.y; ++y) {
        const glm::uvec2 pixel(40, y);
        const double left = left_at(style, away_m(pixel, static_cast<double>(page.depth(pixel))));
        EXPECT_NEAR(faded.line(size_t{y} * size_px.x + 40), left, 0.01) << y;
    }
    EXPECT_LT(faded.line(9 * size_px.x + 40), 0.01F) << "half of the line that lies in the sky";
    EXPECT_EQ(faded.line(2 * size_px.x + 40), 1.0F);
}

TEST(Haze, LeavesPathsTheSameInk)
{
    Painted page;
    page.depth = [](glm::uvec2 pixel) {
        return pixel.y < 20 ? 0.0F : static_cast<float>(near_m / (300.0 + 20.0 * ((pixel.x / 9) % 7)));
    };
    const Faded faded = fade(page, {.start_m = 50.0F, .reach_m = 300.0F});
    for (size_t i = 0; i < faded.left.size(); ++i) {
        EXPECT_NEAR(faded.left[i].x, faded.hatch[i], 5e-4F);
        EXPECT_NEAR(faded.left[i].y, faded.line(i), 0.5F / 255.0F + 1e-6F);
    }
}

/// A flat desert.
Scene flat_ground()
{
    Scene scene;
    scene.terrain.emplace(TerrainDescription{.nodes = {{.name = "height", .expression = "0"}}});
    return scene;
}

/// From a dune: the ground just below the horizon is kilometres away.
const Camera from_dune{.eye = {0.0, 30.0, 0.0}, .target = {3.0, 29.5, 10.0}, .vertical_fov_rad = 0.6};
constexpr RenderSettings small{.width = 160, .height = 120};

Style smooth(const std::string& assignment)
{
    Style style;
    for (const char* flat :
         {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0", "paper.margin_mm=0", "sky.darkness=0",
          "sky.horizon=#f0dca2", "sky.zenith=#f0dca2", "sky.follow=none"}) {
        style.set(flat);
    }
    style.set(assignment);
    return style;
}

TEST(Haze, LeavesNoEdgeAtTheHorizon)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(flat_ground());
    const LayeredImage drawn = renderer.render_layers(from_dune, smooth("haze.enabled=auto"), small);
    const auto ground = std::ranges::find(drawn.masks, std::string("terrain"), &PictureMask::name);
    ASSERT_NE(ground, drawn.masks.end());
    // The horizon at infinity; the ground ends a third of a pixel below it.
    const glm::dvec3 ahead = glm::normalize(from_dune.target - from_dune.eye);
    const double up = -std::tan(std::asin(ahead.y)) / std::tan(0.5 * from_dune.vertical_fov_rad);
    const double horizon_px = 0.5 * small.height * (1.0 - up);
    const auto first_row = static_cast<uint32_t>(std::ceil(horizon_px - 0.5 + 0.4));
    ASSERT_GT(first_row, 10U);
    const auto covered = [&](uint32_t x, uint32_t y) {
        const glm::ivec2 at(static_cast<int>(x) - static_cast<int>(ground->x),
                            static_cast<int>(y) - static_cast<int>(ground->y));
        return at.x >= 0 && at.y >= 0 && at.x < static_cast<int>(ground->width) &&
               at.y < static_cast<int>(ground->height) &&
               ground->cover[static_cast<size_t>(at.y) * ground->width + static_cast<size_t>(at.x)] == 1.0F;
    };
    const auto byte = [&](uint32_t x, uint32_t y, size_t channel) {
        return static_cast<int>(drawn.picture.rgba[4 * (size_t{y} * small.width + x) + channel]);
    };
    for (uint32_t x = 0; x < small.width; ++x) {
        EXPECT_FALSE(covered(x, first_row - 2));
        for (uint32_t y = first_row; y < small.height; ++y) {
            EXPECT_TRUE(covered(x, y)) << x << ", " << y;
        }
        for (size_t channel = 0; channel < 3; ++channel) {
            EXPECT_LT(std::abs(byte(x, first_row, channel) - byte(x, first_row - 2, channel)), 2) << x;
        }
        const auto color = [&](uint32_t y) {
            return glm::ivec3(byte(x, y, 0), byte(x, y, 1), byte(x, y, 2));
        };
        EXPECT_NE(color(small.height - 1), color(first_row)) << "ground and sky differ";
    }
}

TEST(Haze, CostsNothingWhereItIsNotDrawn)
{
    Renderer& renderer = test::shared_renderer();
    const auto draw = [&](const Style& style) { return renderer.render(from_dune, style, small); };
    const auto has_pass = [&] { return renderer.graph_dot().find("haze") != std::string::npos; };
    renderer.set_scene(test::scene_of(shapes::box({20.0F, 2.0F, 20.0F})));
    const Image before = draw(smooth("haze.enabled=auto"));
    EXPECT_FALSE(has_pass());
    EXPECT_EQ(draw(smooth("haze.enabled=false")).rgba, before.rgba);
    Style far = smooth("haze.enabled=true");
    far.set("haze.start_m=1e6");
    EXPECT_EQ(draw(far).rgba, before.rgba);
    EXPECT_TRUE(has_pass());
    renderer.set_scene(flat_ground());
    std::ignore = draw(smooth("haze.enabled=false"));
    EXPECT_FALSE(has_pass());
    std::ignore = draw(smooth("haze.enabled=auto"));
    EXPECT_TRUE(has_pass());
}

TEST(Haze, ThinsPathsAndLeavesOutTheThinnest)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    test::add_object(scene, shapes::box({60.0F, 60.0F, 60.0F}), {0.8F, 0.3F, 0.2F}, {60.0, 0.0, -430.0});
    renderer.set_scene(scene);
    const Camera over{.eye = {1.0, 2.0, 6.0}, .target = {1.0, 1.0, 0.0}, .vertical_fov_rad = 0.6};
    const auto width_mm = [&](const std::string& assignment, const std::string& object) {
        const VectorDrawing drawing = renderer.draw_strokes(over, smooth(assignment), small);
        const auto number = std::ranges::find(drawing.objects, object) - drawing.objects.begin();
        float widest = 0.0F;
        for (const VectorStroke& stroke : drawing.strokes) {
            for (const VectorPoint& point : stroke.points) {
                widest = stroke.object == number ? std::max(widest, point.width_mm) : widest;
            }
        }
        return widest;
    };
    const std::string near_box = "object 0";
    const std::string far_box = "object 1";
    EXPECT_GT(width_mm("haze.enabled=false", far_box), 0.05F);
    EXPECT_EQ(width_mm("haze.enabled=true", near_box), width_mm("haze.enabled=false", near_box));
    const float thinned = width_mm("haze.enabled=true", far_box) / width_mm("haze.enabled=false", far_box);
    const auto left_of = [](float away_m) { return std::exp2(-3.0F * (away_m - 80.0F) / 700.0F); };
    EXPECT_LT(thinned, left_of(406.0F));
    EXPECT_GT(thinned, left_of(480.0F));
    Style thick = smooth("haze.enabled=true");
    thick.set("haze.reach_m=50");
    const VectorDrawing drawing = renderer.draw_strokes(over, thick, small);
    EXPECT_EQ(std::ranges::count(drawing.objects, far_box), 0);
}

} // namespace
} // namespace estampe::haze
