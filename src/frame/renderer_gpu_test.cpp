// SPDX-License-Identifier: MIT
// The whole path from a scene to a picture.
#include <estampe/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "core/long_jobs.hpp"
#include "support/gpu_device.hpp"
#include "support/image_compare.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings renderer_page{.width = 160, .height = 120};

Scene placed_still_life(const glm::dvec3& place = glm::dvec3(0.0))
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    scene.nodes[0].transform.translation = place;
    test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F},
                     place + glm::dvec3(-0.6, 0.0, 0.0));
    test::add_object(scene, shapes::sphere(0.6F), {0.2F, 0.4F, 0.7F}, place + glm::dvec3(0.8, 0.6, 0.5));
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

/// A tall box that a joint bends sideways over time.
Scene bending()
{
    Primitive box = shapes::box({0.5F, 2.0F, 0.5F});
    for (const glm::vec3& p : box.positions) {
        box.joints_0.emplace_back(0, 1, 0, 0);
        box.weights_0.emplace_back(p.y > 1.0F ? glm::vec4(0, 1, 0, 0) : glm::vec4(1, 0, 0, 0));
    }
    Scene scene = test::scene_of(std::move(box));
    scene.nodes[0].skin = 0;
    scene.nodes.push_back({.children = {2}});
    scene.nodes.push_back({.parent = 1});
    scene.roots.push_back(1);
    scene.skins.push_back({.joints = {1, 2}, .joint_from_bind = {glm::mat4(1.0F), glm::mat4(1.0F)}});
    scene.animations.push_back({.channels = {{.node = 2,
                                              .path = AnimatedPath::translation,
                                              .times_s = {0.0F, 1.0F},
                                              .values = {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F}}},
                                .duration_s = 1.0F});
    return scene;
}

Image draw_still_life(const Scene& scene, const Camera& from = test::corner_camera,
                      const RenderSettings& settings = renderer_page, const Style& style = {})
{
    test::shared_renderer().set_scene(scene);
    return test::shared_renderer().render(from, style, settings);
}

/// Number of different red values: 1 for an even page, dozens in a drawing.
size_t shades(const Image& image)
{
    std::vector<bool> seen(256, false);
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        seen[image.rgba[i]] = true;
    }
    return static_cast<size_t>(std::ranges::count(seen, true));
}

TEST(Renderer, AMarginShrinksThePictureAndNotItsStrokes)
{
    Style style;
    for (const char* assignment : {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0",
                                   "paper.margin_mm=0", "paper.height_mm=120"}) {
        style.set(assignment);
    }
    const Image whole =
        draw_still_life(placed_still_life(), test::corner_camera, {.width = 160, .height = 120}, style);
    style.set("paper.margin_mm=10");
    style.set("paper.height_mm=140");
    EXPECT_DOUBLE_EQ(style.window_aspect(180, 140), 160.0 / 120.0);
    const Image framed =
        draw_still_life(placed_still_life(), test::corner_camera, {.width = 180, .height = 140}, style);
    double difference = 0.0;
    for (uint32_t y = 2; y < 118; ++y) {
        for (uint32_t x = 2; x < 158; ++x) {
            const size_t within = 4 * ((y + 10) * size_t{180} + x + 10);
            const size_t alone = 4 * (y * size_t{160} + x);
            difference += std::abs(framed.rgba[within] - whole.rgba[alone]) / (156.0 * 116.0);
        }
    }
    EXPECT_LT(difference, 1.0);
    for (const uint32_t y : {0U, 5U, 8U, 131U, 139U}) {
        for (uint32_t x = 0; x < 180; ++x) {
            const size_t at = 4 * (y * size_t{180} + x);
            EXPECT_EQ(framed.rgba[at], framed.rgba[0]) << x << ", " << y;
        }
    }
}

/// Place of the middle of all dark pixels, in pixels from the left and the top.
glm::dvec2 middle_of_ink(const Image& image)
{
    glm::dvec2 sum(0.0);
    double weight = 0.0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const double ink = image.rgba[4 * (y * size_t{image.width} + x)] < 128 ? 1.0 : 0.0;
            sum += ink * (glm::dvec2(x, y) + 0.5);
            weight += ink;
        }
    }
    EXPECT_GT(weight, 0.0);
    return sum / std::max(weight, 1.0);
}

TEST(Renderer, TheLensShiftMovesThePictureOnThePage)
{
    Scene scene = test::scene_of(shapes::sphere(0.5F));
    scene.materials[0].base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    scene.materials[0].unlit = true;
    Camera camera = test::front_camera(6.0, 0.5);
    camera.target = camera.target + glm::dvec3(0.2, 0.1, 0.0);
    Camera parallel = camera;
    parallel.orthographic_half_height_m = 1.5;
    for (const Camera& from : {camera, parallel}) {
        const RenderSettings settings{.width = 240, .height = 120};
        for (const double margin_mm : {0.0, 15.0}) {
            Style style = Style::load("cel+no-shadow");
            style.set("paper.height_mm=120"); // a millimetre is a pixel
            style.set("paper.margin_mm=" + std::to_string(margin_mm));
            style.set("paper.border_mm=0");
            const glm::dvec2 before = middle_of_ink(draw_still_life(scene, from, settings, style));
            Camera shifted = from;
            shifted.shift = {0.25, -0.2};
            const glm::dvec2 after = middle_of_ink(draw_still_life(scene, shifted, settings, style));
            EXPECT_NEAR(after.x - before.x, -0.25 * (240 - 2.0 * margin_mm), 1.0) << margin_mm;
            EXPECT_NEAR(after.y - before.y, -0.2 * (120 - 2.0 * margin_mm), 1.0) << margin_mm;
        }
    }
}

TEST(Renderer, ASceneThatAProgramMadeWronglyIsRefusedWithItsFault)
{
    const auto refusal = [](const std::function<void(Scene&)>& damage) {
        Scene scene = placed_still_life();
        damage(scene);
        try {
            test::shared_renderer().set_scene(scene);
            return std::string("accepted");
        } catch (const Error& error) {
            return std::string(error.what());
        }
    };
    EXPECT_NE(refusal([](Scene& scene) {
                  scene.meshes[0].primitives[0].indices[0] = 1'000'000;
              }).find("indices[0] is 1000000"),
              std::string::npos);
    EXPECT_NE(refusal([](Scene& scene) { scene.nodes[1].children = {1}; }).find("nodes[1]"),
              std::string::npos);
    EXPECT_NE(refusal([](Scene& scene) { scene.nodes[0].mesh = 99; }).find("mesh is 99"), std::string::npos);
    EXPECT_NE(refusal([](Scene& scene) {
                  scene.nodes[0].transform.scale.x = std::numeric_limits<double>::quiet_NaN();
              }).find("not finite"),
              std::string::npos);
    EXPECT_EQ(refusal([](Scene&) {}), "accepted");
}

TEST(Renderer, TheSameBytesAgainAndAgain)
{
    const Image first = draw_still_life(placed_still_life());
    EXPECT_GT(shades(first), 50U);
    EXPECT_EQ(first, test::shared_renderer().render(test::corner_camera, {}, renderer_page));
    std::ignore = draw_still_life(bending());
    std::ignore =
        test::shared_renderer().render({}, {}, {.width = 33, .height = 20, .samples = 3, .time_s = 0.5});
    EXPECT_EQ(first, draw_still_life(placed_still_life()));
    Renderer other(test::validated());
    other.set_scene(placed_still_life());
    EXPECT_EQ(first, other.render(test::corner_camera, {}, renderer_page));
}

TEST(Renderer, RefusesWhatItCannotDraw)
{
    Renderer fresh(test::validated());
    EXPECT_THROW(std::ignore = fresh.render(test::corner_camera, {}, renderer_page), Error);
    fresh.set_scene(placed_still_life());
    const RenderSettings wrong[] = {{.width = 0, .height = 10},
                                    {.width = 10, .height = 0},
                                    {.width = 1U << 20U, .height = 4},
                                    {.width = 4, .height = 4'000'000'000U},
                                    {.width = 4, .height = 4, .samples = 0}};
    for (const RenderSettings& settings : wrong) {
        EXPECT_THROW(std::ignore = fresh.render(test::corner_camera, {}, settings), Error)
            << settings.width << " x " << settings.height;
    }
    EXPECT_GT(shades(fresh.render(test::corner_camera, {}, renderer_page)), 50U) << "and goes on drawing";
}

TEST(Renderer, RefusesNumbersThatNothingCanBeDrawnWith)
{
    Renderer fresh(test::validated());
    fresh.set_scene(placed_still_life());
    Camera far = test::corner_camera;
    far.eye.x = 1e30;
    EXPECT_THROW(std::ignore = fresh.render(far, {}, renderer_page), Error);
    RenderSettings moved = renderer_page;
    moved.motion_since = Moment{far, 0.0};
    EXPECT_THROW(std::ignore = fresh.render(test::corner_camera, {}, moved), Error);
    Scene stretched = placed_still_life();
    for (const double size : {1e-20, 1e20, 1e300}) {
        for (Node& node : stretched.nodes) {
            node.transform.scale = glm::dvec3(size);
            node.transform.translation = glm::dvec3(0.0);
        }
        EXPECT_THROW(fresh.set_scene(stretched), Error) << size;
    }
    Scene lost = bending();
    lost.animations[0].channels[0].values[3] = 3e38F;
    lost.nodes[1].transform.scale = glm::dvec3(10.0);
    fresh.set_scene(lost);
    EXPECT_THROW(std::ignore =
                     fresh.render(test::corner_camera, {}, {.width = 160, .height = 120, .time_s = 0.9}),
                 Error);
}

TEST(Renderer, DrawsPaperWhereThereIsNothing)
{
    Scene empty;
    empty.materials.emplace_back();
    EXPECT_EQ(draw_still_life(empty).rgba.size(), 160U * 120U * 4U);
    Scene no_triangles = test::scene_of(Primitive{});
    EXPECT_EQ(draw_still_life(no_triangles).rgba.size(), 160U * 120U * 4U);
    Primitive strokes{.topology = Topology::lines};
    strokes.positions = {{0, 0, 0}, {1, 1, 0}};
    strokes.indices = {0, 1};
    const Image lines = draw_still_life(test::scene_of(strokes));
    EXPECT_EQ(lines.rgba.size(), 160U * 120U * 4U);
    const Camera elsewhere{.eye = {0.0, 9.0, 0.0}, .target = {0.0, 20.0, 0.1}};
    Style blank;
    blank.set("sky.enabled=false");
    blank.set("paper.grain=0");
    blank.set("paper.granulation=0");
    EXPECT_LE(shades(draw_still_life(placed_still_life(), elsewhere, renderer_page, blank)), 2U);
}

TEST(Renderer, SamplesAreTheMeanOfShiftedPictures)
{
    const Image one = draw_still_life(placed_still_life());
    RenderSettings settings = renderer_page;
    settings.samples = 4;
    const Image four = draw_still_life(placed_still_life(), test::corner_camera, settings);
    EXPECT_NE(one, four);
    EXPECT_LT(test::compare_images(one, four).delta_e_mean, 6.0);
    const auto roughness = [](const Image& image) {
        double sum = 0.0;
        for (size_t i = 4; i < image.rgba.size(); i += 4) {
            const double step = image.rgba[i] - image.rgba[i - 4];
            sum += step * step;
        }
        return sum;
    };
    EXPECT_LT(roughness(four), 0.9 * roughness(one)) << "edges grow softer";
    EXPECT_EQ(four, test::shared_renderer().render(test::corner_camera, {}, settings));
    settings.samples = 16;
    const Image sixteen = draw_still_life(placed_still_life(), test::corner_camera, settings);
    EXPECT_LT(test::compare_images(four, sixteen).mean_abs, test::compare_images(one, sixteen).mean_abs);
}

TEST(Renderer, CanBeStoppedBetweenSamples)
{
    RenderSettings settings = renderer_page;
    settings.samples = 8;
    const Image whole = draw_still_life(placed_still_life(), test::corner_camera, settings);
    Renderer& renderer = test::shared_renderer();
    const auto is_read_back = [&] {
        return std::ranges::any_of(renderer.timings(),
                                   [](const PassTiming& pass) { return pass.name == "read back"; });
    };
    EXPECT_TRUE(is_read_back());
    {
        int samples = 0;
        const ProgressWatch watch([&](double share) {
            EXPECT_EQ(share, samples / 8.0);
            return ++samples <= 3;
        });
        EXPECT_THROW(static_cast<void>(renderer.render(test::corner_camera, {}, settings)), Error);
        EXPECT_EQ(samples, 4) << "it was told to stop after three";
    }
    EXPECT_FALSE(is_read_back()) << "the third of eight samples is no picture";
    EXPECT_EQ(whole, renderer.render(test::corner_camera, {}, settings)) << "the next one begins anew";
}

TEST(Renderer, DrawsNearlyTheSameByEitherRasterPath)
{
    std::vector<Image> images;
    for (const RasterPath path : {RasterPath::hardware, RasterPath::compute}) {
        RendererOptions options = test::validated();
        options.raster = path;
        Renderer renderer(options);
        EXPECT_EQ(renderer.raster_path(), path);
        renderer.set_scene(placed_still_life());
        images.push_back(renderer.render(test::corner_camera, {}, renderer_page));
        EXPECT_EQ(images.back(), renderer.render(test::corner_camera, {}, renderer_page)) << name_of(path);
    }
    // One pixel in ten thousand may show another triangle, and a stroke or a line may end beside it.
    const test::ImageDifference difference = test::compare_images(images[0], images[1]);
    EXPECT_LE(difference.failing_fraction, 1e-3) << test::describe(difference);
    EXPECT_LE(difference.delta_e_p95, 0.1) << test::describe(difference);
}

TEST(Renderer, TheRasterPathIsFixedOnAProcessor)
{
    EXPECT_EQ(test::shared_renderer().raster_path(), RasterPath::hardware);
}

TEST(Renderer, DrawsInParallelProjection)
{
    Camera parallel = test::corner_camera;
    parallel.orthographic_half_height_m = 2.0;
    const Image image = draw_still_life(placed_still_life(), parallel);
    EXPECT_GT(shades(image), 50U);
    // In parallel projection the eye's distance only affects the weight of lines.
    parallel.eye = parallel.target + 3.0 * (test::corner_camera.eye - test::corner_camera.target);
    Style even;
    even.set("contour.distance_thinning=0");
    const Image far = draw_still_life(placed_still_life(), parallel, renderer_page, even);
    parallel.eye = test::corner_camera.eye;
    EXPECT_LT(test::compare_images(draw_still_life(placed_still_life(), parallel, renderer_page, even), far)
                  .delta_e_mean,
              0.5);
}

TEST(Renderer, StandsACameraInsideOfThings)
{
    const Scene scene = placed_still_life();
    for (const glm::dvec3 eye : {glm::dvec3(-0.6, 0.7, 0.0), glm::dvec3(0.8, 0.6, 0.5),
                                 glm::dvec3(0.0, 0.0, 0.0), glm::dvec3(-0.6, 1.5, 0.0)}) {
        const Image image = draw_still_life(scene, {.eye = eye, .target = eye + glm::dvec3(0.3, 0.1, -1.0)});
        EXPECT_EQ(image.rgba.size(), 160U * 120U * 4U);
        EXPECT_EQ(image, test::shared_renderer().render(
                             {.eye = eye, .target = eye + glm::dvec3(0.3, 0.1, -1.0)}, {}, renderer_page));
    }
    // A near plane inside the sphere opens it, and removes nothing behind it.
    const Image cut =
        draw_still_life(scene, {.eye = {3.0, 3.0, 5.0}, .target = {0.0, 0.5, 0.0}, .near_m = 5.0});
    EXPECT_GT(shades(cut), 30U);
    EXPECT_NE(cut, draw_still_life(scene));
}

TEST(Renderer, TimeMovesASkin)
{
    const auto at = [](double time_s) {
        RenderSettings settings = renderer_page;
        settings.time_s = time_s;
        return test::shared_renderer().render(test::corner_camera, {}, settings);
    };
    test::shared_renderer().set_scene(bending());
    const Image start = at(0.0);
    const Image middle = at(0.5);
    EXPECT_GT(test::compare_images(start, middle).failing_fraction, 0.01);
    EXPECT_EQ(start, at(0.0));
    EXPECT_EQ(middle, at(0.5));
}

TEST(Renderer, TakesOneSceneAfterAnother)
{
    const Image first = draw_still_life(placed_still_life());
    const Image second = draw_still_life(test::scene_of(shapes::torus(1.0F, 0.4F)));
    EXPECT_GT(test::compare_images(first, second).failing_fraction, 0.1);
    EXPECT_EQ(first, draw_still_life(placed_still_life()));
    EXPECT_EQ(second, draw_still_life(test::scene_of(shapes::torus(1.0F, 0.4F))));
}

TEST(Renderer, DrawsTheSmallestPictures)
{
    for (const auto& [width, height] :
         {std::pair(1U, 1U), std::pair(7U, 3U), std::pair(1U, 90U), std::pair(300U, 1U)}) {
        for (const uint32_t samples : {1U, 2U}) {
            const Image image = draw_still_life(placed_still_life(), test::corner_camera,
                                                {.width = width, .height = height, .samples = samples});
            EXPECT_EQ(image.width, width);
            EXPECT_EQ(image.height, height);
            EXPECT_EQ(image.rgba.size(), size_t{4} * width * height);
        }
    }
}

TEST(Renderer, ALongWayFromTheOriginLooksTheSame)
{
    const Image here = draw_still_life(placed_still_life());
    const glm::dvec3 away(1e6, -2e5, 3e6);
    Camera there = test::corner_camera;
    there.eye += away;
    there.target += away;
    const test::ImageDifference difference =
        test::compare_images(here, draw_still_life(placed_still_life(away), there));
    EXPECT_LT(difference.mean_abs, 1.0) << test::describe(difference);
}

} // namespace
} // namespace estampe
