// SPDX-License-Identifier: MIT
// Compares blurred pictures of moving objects with the mean of many pictures during the exposure.
#include <cmath>
#include <cstdio>
#include <tuple>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/exposures.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings shutter_page{.width = 128, .height = 96, .time_s = 0.5};
constexpr RenderSettings smooth_shutter_page{.width = 128, .height = 96, .samples = 8, .time_s = 0.5};
constexpr double shutter_s = 0.2;
const Camera shutter_camera{.eye = {0.0, 0.0, 4.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.7};

Style shutter_colors(std::initializer_list<const char*> more)
{
    Style style;
    for (const char* assignment :
         {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0", "paper.margin_mm=0",
          "paper.color=#ffffff", "hatch.enabled=false", "contour.enabled=false", "picture.ground=false",
          "sky.enabled=false", "wash.strength=1", "wash.neutral=1", "light.shadows=false",
          "motion_blur.shutter_deg=360", "motion_blur.frames_per_s=5"}) {
        style.set(assignment);
    }
    for (const char* assignment : more) {
        style.set(assignment);
    }
    return style;
}

void move(Scene& scene, Index node, const glm::vec3& from, const glm::vec3& to)
{
    if (scene.animations.empty()) {
        scene.animations.push_back({.name = "move", .channels = {}, .duration_s = 1.0F});
    }
    scene.animations.front().channels.push_back({.node = node,
                                                 .path = AnimatedPath::translation,
                                                 .times_s = {0.0F, 1.0F},
                                                 .values = {from.x, from.y, from.z, to.x, to.y, to.z}});
}

void turn(Scene& scene, Index node)
{
    const auto half = static_cast<float>(std::sqrt(0.5));
    scene.animations.front().channels.push_back({.node = node,
                                                 .path = AnimatedPath::rotation,
                                                 .times_s = {0.0F, 1.0F},
                                                 .values = {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, half, half}});
}

/// A wall of boards, with a box that passes in front, one that turns, and one that stands still.
Scene passing()
{
    Scene scene;
    for (int i = 0; i < 6; ++i) {
        const float tone = i % 2 == 0 ? 0.2F : 0.7F;
        test::add_object(scene, shapes::box({0.6F, 4.0F, 0.1F}), {0.8F, tone, 0.2F},
                         {-2.0 + 0.7 * i, -2.0, -1.5});
    }
    const Index fast = test::add_object(scene, shapes::box({0.45F, 0.4F, 0.2F}), {0.1F, 0.2F, 0.6F});
    move(scene, fast, {-1.0F, 0.3F, 0.3F}, {0.9F, 0.5F, 0.3F});
    const Index turning =
        test::add_object(scene, shapes::box({0.2F, 0.9F, 0.2F}), {0.1F, 0.5F, 0.2F}, {1.1, -0.6, 0.0});
    turn(scene, turning);
    test::add_object(scene, shapes::box({0.5F, 0.5F, 0.2F}), {0.9F, 0.9F, 0.3F}, {-1.1, -0.9, 0.2});
    test::add_sun(scene, {0.3, 0.8, 1.0});
    return scene;
}

RenderSettings at(double time_s)
{
    RenderSettings settings = shutter_page;
    settings.time_s = time_s;
    return settings;
}

TEST(MotionBlur, IsThatOfManyPicturesWhileTheShutterIsOpen)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(passing());
    constexpr int count = 64;
    const Style still = shutter_colors({});
    const test::Exposure truth = test::mean_of(count, [&](int i) {
        return renderer.render(test::shifted_in_pixel(shutter_camera, i * 7 % count, shutter_page.height),
                               still, at(shutter_page.time_s + shutter_s * ((i + 0.5) / count - 0.5)));
    });
    const auto measured = [&](const char* mode) {
        return test::exposure_of(renderer.render(
            shutter_camera, shutter_colors({"motion_blur.enabled=true", mode}), smooth_shutter_page));
    };
    const test::Exposure none =
        test::exposure_of(renderer.render(shutter_camera, still, smooth_shutter_page));
    const test::Exposure seen = measured("motion_blur.mode=tiles");
    const test::Exposure own = measured("motion_blur.mode=own");
    const test::Exposure stretched = measured("motion_blur.mode=stretched");
    std::printf("against %d pictures: tiles %.1f dB, stretched %.1f dB, own %.1f dB, without %.1f dB\n",
                count, test::psnr_db(seen, truth), test::psnr_db(stretched, truth), test::psnr_db(own, truth),
                test::psnr_db(none, truth));
    EXPECT_GT(test::psnr_db(stretched, truth), test::psnr_db(none, truth) + 1.0);
    EXPECT_GE(test::psnr_db(seen, truth), 30.0);
    EXPECT_GT(test::psnr_db(own, truth), test::psnr_db(none, truth));
    EXPECT_LT(test::psnr_db(none, truth), test::psnr_db(seen, truth) - 3.0);
    // Pixels that stand still and are not passed by anything are equal bit for bit.
    const Image sharp = renderer.render(shutter_camera, still, shutter_page);
    const Image blurred =
        renderer.render(shutter_camera, shutter_colors({"motion_blur.enabled=true"}), shutter_page);
    for (uint32_t y = 60; y < shutter_page.height; ++y) {
        for (size_t i = size_t{4} * y * shutter_page.width; i < size_t{4} * (y * shutter_page.width + 60);
             ++i) {
            ASSERT_EQ(sharp.rgba[i], blurred.rgba[i]) << i;
        }
    }
}

TEST(MotionBlur, IsThatOfACameraThatGoes)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(passing());
    const auto seen_at = [&](double share) {
        Camera moved = shutter_camera;
        moved.eye += share * glm::dvec3(0.25, 0.05, -0.1);
        moved.target += share * glm::dvec3(0.3, 0.0, 0.0);
        return moved;
    };
    constexpr int count = 64;
    const Style still = shutter_colors({});
    const test::Exposure truth = test::mean_of(count, [&](int i) {
        return renderer.render(
            test::shifted_in_pixel(seen_at((i + 0.5) / count - 0.5), i * 7 % count, shutter_page.height),
            still, shutter_page);
    });
    RenderSettings exposed = smooth_shutter_page;
    exposed.exposure_end = Moment{seen_at(-0.5), shutter_page.time_s};
    const test::Exposure none =
        test::exposure_of(renderer.render(shutter_camera, still, smooth_shutter_page));
    const test::Exposure seen = test::exposure_of(
        renderer.render(shutter_camera, shutter_colors({"motion_blur.enabled=true"}), exposed));
    std::printf("camera, against %d pictures: %.1f dB, without %.1f dB\n", count, test::psnr_db(seen, truth),
                test::psnr_db(none, truth));
    EXPECT_GE(test::psnr_db(seen, truth), 30.0);
    EXPECT_LT(test::psnr_db(none, truth), test::psnr_db(seen, truth) - 3.0);
}

TEST(MotionBlur, ShowsTheVelocityOfWhatMoves)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene;
    const Index wall = test::add_object(scene, shapes::quad(1.6F, 1.6F), {0.5F, 0.5F, 0.5F});
    move(scene, wall, {-0.2F, 0.1F, 0.0F}, {0.3F, -0.2F, 0.0F});
    renderer.set_scene(scene);
    constexpr float largest_mm = 12.0F;
    const LinearImage drawn =
        renderer.render_linear(shutter_camera,
                               shutter_colors({"motion_blur.enabled=true", "motion_blur.mode=velocity",
                                               "motion_blur.largest_mm=12"}),
                               shutter_page);
    const double px_per_m =
        0.5 * shutter_page.height / std::tan(0.5 * shutter_camera.vertical_fov_rad) / shutter_camera.eye.z;
    const glm::dvec2 way_px = 0.5 * shutter_s * px_per_m * glm::dvec2(0.5, -0.3);
    const double most_px = 0.5 * static_cast<double>(largest_mm) * shutter_page.height / 150.0;
    double worst_px = 0.0;
    for (uint32_t y = 28; y < 40; ++y) {
        for (uint32_t x = 56; x < 72; ++x) {
            const glm::dvec4 color(drawn.pixels[size_t{y} * shutter_page.width + x]);
            const glm::dvec2 seen_px = most_px * (2.0 * glm::dvec2(color) - 1.0);
            worst_px = std::max(worst_px, glm::distance(seen_px, way_px));
        }
    }
    std::printf("velocity off by %.4f px of %.2f\n", worst_px, glm::length(way_px));
    EXPECT_LT(worst_px, 0.02);
    EXPECT_NEAR(drawn.pixels.front().x, 0.5, 1e-3) << "what stands";
}

TEST(MotionBlur, SpreadsABarAsFarAsItGoes)
{
    // Along a row, the bar's coverage rises from 0 to 1 over the path of its edge: at the leading edge and at
    // the trailing edge, which is stretched backwards.
    Renderer& renderer = test::shared_renderer();
    Scene scene;
    const Index bar = test::add_object(scene, shapes::box({1.6F, 3.0F, 0.02F}), {0.0F, 0.0F, 0.0F});
    move(scene, bar, {-0.5F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F});
    test::add_sun(scene, {0.3, 0.8, 1.0});
    renderer.set_scene(scene);
    for (const char* mode : {"motion_blur.mode=tiles", "motion_blur.mode=stretched"}) {
        const test::Exposure seen = test::exposure_of(renderer.render(
            shutter_camera, shutter_colors({"motion_blur.enabled=true", mode, "motion_blur.largest_mm=30"}),
            shutter_page));
        const double px_per_m = 0.5 * shutter_page.height / std::tan(0.5 * shutter_camera.vertical_fov_rad) /
                                shutter_camera.eye.z;
        const double way_px = shutter_s * px_per_m;
        for (const bool is_in_front : {true, false}) {
            int between = 0;
            for (uint32_t i = 0; i < shutter_page.width / 2; ++i) {
                const uint32_t x = is_in_front ? shutter_page.width / 2 + i : shutter_page.width / 2 - 1 - i;
                const double light = seen.pixels[size_t{30} * shutter_page.width + x].x;
                const double middle = seen.pixels[size_t{30} * shutter_page.width + shutter_page.width / 2].x;
                const double share = (light - middle) / (1.0 - middle);
                between += share > 0.02 && share < 0.98 ? 1 : 0;
            }
            EXPECT_NEAR(between, way_px, 1.5) << mode << (is_in_front ? ", in front" : ", behind");
        }
    }
}

TEST(MotionBlur, LeavesNothingSharpOfWhatIsDrawnOut)
{
    // A rotating blade: when it is stretched, its ends leave the place where they are visible.
    Renderer& renderer = test::shared_renderer();
    Scene scene;
    test::add_object(scene, shapes::quad(12.0F, 12.0F), {0.9F, 0.9F, 0.9F}, {0.0, 0.0, -1.5});
    const Index blade = test::add_object(scene, shapes::box({0.3F, 1.1F, 0.1F}), {0.1F, 0.1F, 0.1F});
    scene.animations.push_back({.name = "turn", .channels = {}, .duration_s = 1.0F});
    turn(scene, blade);
    test::add_sun(scene, {0.3, 0.8, 1.0});
    renderer.set_scene(scene);
    const Image plain = renderer.render(shutter_camera, shutter_colors({}), shutter_page);
    const Image own = renderer.render(
        shutter_camera, shutter_colors({"motion_blur.enabled=true", "motion_blur.mode=own"}), shutter_page);
    const Image stretched = renderer.render(
        shutter_camera, shutter_colors({"motion_blur.enabled=true", "motion_blur.mode=stretched"}),
        shutter_page);
    int blurred = 0;
    int left = 0;
    for (size_t i = 0; i < plain.rgba.size(); i += 4) {
        const bool is_blurred = std::abs(int{own.rgba[i]} - int{plain.rgba[i]}) > 20;
        blurred += is_blurred ? 1 : 0;
        left += is_blurred && stretched.rgba[i] == plain.rgba[i] ? 1 : 0;
    }
    EXPECT_GT(blurred, 60);
    EXPECT_EQ(left, 0);
}

TEST(MotionBlur, CostsNothingWhereThereIsNone)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(passing());
    const auto has_pass = [&](const char* name) {
        return renderer.graph_dot().find(name) != std::string::npos;
    };
    const Image plain = renderer.render(shutter_camera, {}, shutter_page);
    EXPECT_FALSE(has_pass("motion"));
    EXPECT_FALSE(has_pass("speed"));
    Style shut;
    shut.set("motion_blur.enabled=true");
    shut.set("motion_blur.shutter_deg=0");
    EXPECT_EQ(renderer.render(shutter_camera, shut, shutter_page).rgba, plain.rgba);
    EXPECT_FALSE(has_pass("motion"));
    // If nothing moves, every bit stays the same although the passes run.
    Scene still = passing();
    still.animations.clear();
    renderer.set_scene(still);
    const Image before = renderer.render(shutter_camera, {}, shutter_page);
    for (const char* mode : {"motion_blur.mode=tiles", "motion_blur.mode=own", "motion_blur.mode=stretched",
                             "motion_blur.speed_lines.enabled=true"}) {
        Style open;
        open.set("motion_blur.enabled=true");
        open.set(mode);
        EXPECT_EQ(renderer.render(shutter_camera, open, shutter_page).rgba, before.rgba) << mode;
        EXPECT_TRUE(has_pass("motion"));
    }
}

TEST(MotionBlur, DrawsSpeedLinesBehindWhatIsFast)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene;
    test::add_object(scene, shapes::quad(12.0F, 12.0F), {0.9F, 0.9F, 0.9F}, {0.0, 0.0, -1.5});
    const Index fast = test::add_object(scene, shapes::box({0.5F, 0.8F, 0.2F}), {0.5F, 0.5F, 0.5F});
    move(scene, fast, {-1.5F, 0.0F, 0.0F}, {1.5F, 0.0F, 0.0F});
    renderer.set_scene(scene);
    const auto draw = [&](std::initializer_list<const char*> more) {
        return test::exposure_of(renderer.render(shutter_camera, shutter_colors(more), shutter_page));
    };
    const test::Exposure plain = draw({});
    const test::Exposure lined =
        draw({"motion_blur.speed_lines.enabled=true", "motion_blur.speed_lines.spacing_mm=4"});
    double behind = 0.0;
    double ahead = 0.0;
    for (size_t i = 0; i < plain.pixels.size(); ++i) {
        const double ink = plain.pixels[i].x - lined.pixels[i].x;
        (i % shutter_page.width < 64 ? behind : ahead) += ink;
    }
    EXPECT_GT(behind, 10.0);
    EXPECT_EQ(ahead, 0.0) << "it goes to the right";
    const test::Exposure slow =
        draw({"motion_blur.speed_lines.enabled=true", "motion_blur.speed_lines.from_mm=60"});
    EXPECT_EQ(slow.pixels, plain.pixels);
}

TEST(MotionBlur, SaysWhereThereIsNone)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(passing());
    Style style;
    style.set("motion_blur.enabled=true");
    std::ignore = renderer.draw_strokes(shutter_camera, style, shutter_page);
    const auto is_told = [&] {
        return std::ranges::any_of(renderer.notes(), [](const std::string& note) {
            return note.find("motion blur") != std::string::npos;
        });
    };
    EXPECT_TRUE(is_told());
    RenderSettings tiled = shutter_page;
    tiled.width = 640;
    tiled.height = 160;
    tiled.tile_px = 400;
    const Image parts = renderer.render(shutter_camera, style, tiled);
    EXPECT_TRUE(is_told());
    EXPECT_EQ(parts.rgba, renderer.render(shutter_camera, {}, tiled).rgba);
}

} // namespace
} // namespace estampe
