// SPDX-License-Identifier: MIT
// Compares pictures through a lens with the mean of many pictures from points of its aperture.
#include <cmath>
#include <cstdio>
#include <tuple>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/exposures.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings lens_page{.width = 128, .height = 96};
constexpr double focus_m = 4.8;
// The view is so narrow that rotating the camera is as good as shifting the picture of a lens.
const Camera lens_camera{.eye = {0.0, 0.6, 4.8}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.3};

/// Colours without paper, and a lens of 150 mm at f/1.
Style lens_colors(std::initializer_list<const char*> more)
{
    Style style;
    for (const char* assignment :
         {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0", "paper.margin_mm=0",
          "paper.color=#ffffff", "hatch.enabled=false", "contour.enabled=false", "picture.ground=false",
          "sky.enabled=false", "wash.strength=1", "wash.neutral=1", "lens.focal_mm=150", "lens.f_number=1",
          "lens.focus_m=4.8", "lens.largest_mm=60"}) {
        style.set(assignment);
    }
    for (const char* assignment : more) {
        style.set(assignment);
    }
    return style;
}

/// Something sharp, a post before it, and boxes behind.
Scene posts(double post_x_m = 0.2, float post_width_m = 0.06F)
{
    Scene scene = test::scene_of(shapes::box({0.5F, 0.7F, 0.1F}));
    test::add_object(scene, shapes::box({post_width_m, 1.6F, 0.05F}), {0.1F, 0.5F, 0.2F},
                     {post_x_m, -0.4, 2.4});
    for (int i = 0; i < 5; ++i) {
        const float tone = i % 2 == 0 ? 0.15F : 0.8F;
        test::add_object(scene, shapes::box({1.0F, 8.0F, 0.2F}), {0.9F - tone, 0.3F, tone},
                         {-2.0 + i, -4.0, -7.2});
    }
    test::add_sun(scene, {0.3, 0.8, 1.0});
    return scene;
}

/// A camera at a point of the aperture, rotated so that the plane in focus keeps its place in the picture.
Camera through(int i, int count, double radius_m)
{
    const double away = radius_m * std::sqrt((i + 0.5) / count);
    const double turn = i * glm::pi<double>() * (3.0 - std::sqrt(5.0));
    const glm::dvec3 ahead = glm::normalize(lens_camera.target - lens_camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, lens_camera.up));
    const glm::dvec3 above = glm::cross(right, ahead);
    Camera moved = lens_camera;
    moved.eye += away * (std::cos(turn) * right + std::sin(turn) * above);
    moved.target = lens_camera.eye + focus_m * ahead;
    return test::shifted_in_pixel(moved, i * 7 % count, lens_page.height);
}

test::Exposure through_the_lens(int count)
{
    const Style sharp = lens_colors({"lens.enabled=false"});
    return test::mean_of(count, [&](int i) {
        return test::shared_renderer().render(through(i, count, 0.5 * 0.15), sharp, lens_page);
    });
}

test::Exposure drawn_in(const char* mode)
{
    RenderSettings smooth = lens_page;
    smooth.samples = 8;
    return test::exposure_of(
        test::shared_renderer().render(lens_camera, lens_colors({"lens.enabled=true", mode}), smooth));
}

TEST(DepthOfField, IsThatOfManyPicturesThroughTheLens)
{
    test::shared_renderer().set_scene(posts());
    const test::Exposure truth = through_the_lens(256);
    const test::Exposure seen = drawn_in("lens.enabled=true");
    const double psnr = test::psnr_db(seen, truth);
    const double none = test::psnr_db(drawn_in("lens.enabled=false"), truth);
    const int halo_px = test::widest_error_px(seen, truth, 0.1);
    std::printf("against 256 pictures: %.1f dB, halo %d px; without the lens %.1f dB\n", psnr, halo_px, none);
    EXPECT_GE(psnr, 30.0);
    EXPECT_LE(halo_px, 2);
    EXPECT_LT(none, psnr - 5.0);
    for (const char* mode : {"lens.mode=separable", "lens.mode=mips", "lens.mode=sums"}) {
        const double other = test::psnr_db(drawn_in(mode), truth);
        std::printf("%s %.1f dB\n", mode, other);
        EXPECT_GT(other, none + 1.0) << mode;
    }
}

TEST(DepthOfField, GuessesWhatIsHidden)
{
    // The post is in front of the sharp surface's edge and of an edge far behind; it hides both. Their places
    // behind the post can only be guessed, with an error of at most half of what it hides.
    for (const float width_m : {0.03F, 0.06F}) {
        test::shared_renderer().set_scene(posts(0.16, width_m));
        const test::Exposure truth = through_the_lens(64);
        const test::Exposure seen = drawn_in("lens.enabled=true");
        const double hidden_px =
            static_cast<double>(width_m) * lens_page.height / (2.0 * 2.4 * std::tan(0.15));
        const int halo_px = test::widest_error_px(seen, truth, 0.1);
        std::printf("with edges that are hidden behind %.1f px: %.1f dB, halo %d px\n", hidden_px,
                    test::psnr_db(seen, truth), halo_px);
        EXPECT_GE(test::psnr_db(seen, truth), 30.0);
        EXPECT_LE(halo_px, std::ceil(0.5 * hidden_px));
    }
}

TEST(DepthOfField, CostsNothingWhereThereIsNone)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(posts());
    const auto has_pass = [&] { return renderer.graph_dot().find("lens") != std::string::npos; };
    const Image plain = renderer.render(lens_camera, {}, lens_page);
    EXPECT_FALSE(has_pass());
    Style sharp; // a pinhole keeps everything in focus
    sharp.set("lens.enabled=true");
    sharp.set("lens.f_number=128");
    sharp.set("lens.focal_mm=1");
    EXPECT_EQ(renderer.render(lens_camera, sharp, lens_page).rgba, plain.rgba);
    EXPECT_TRUE(has_pass());
}

TEST(DepthOfField, FocusesOnWhatIsNamed)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = posts();
    scene.nodes[1].name = "Post";
    renderer.set_scene(scene);
    const auto draw = [&](std::initializer_list<const char*> more) {
        Style style = lens_colors(more);
        style.set("lens.enabled=true");
        return renderer.render(lens_camera, style, lens_page).rgba;
    };
    const double post_m = glm::dot(glm::dvec3(0.2, 0.4, 2.4) - lens_camera.eye,
                                   glm::normalize(lens_camera.target - lens_camera.eye));
    const std::string by_hand = "lens.focus_m=" + std::to_string(post_m);
    EXPECT_EQ(draw({"lens.focus_on=Post"}), draw({by_hand.c_str()}));
    EXPECT_NE(draw({"lens.focus_on=Post"}), draw({}));
    EXPECT_TRUE(renderer.notes().empty());
    std::ignore = draw({"lens.focus_on=Nobody"});
    ASSERT_EQ(renderer.notes().size(), 1U);
    EXPECT_NE(renderer.notes().front().find("lens.focus_on"), std::string::npos);
}

TEST(DepthOfField, SaysWhereThereIsNoLens)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(posts());
    Style style;
    style.set("lens.enabled=true");
    Camera parallel = lens_camera;
    parallel.orthographic_half_height_m = 1.0;
    EXPECT_EQ(renderer.render(parallel, style, lens_page).rgba,
              renderer.render(parallel, {}, lens_page).rgba);
    std::ignore = renderer.render(parallel, style, lens_page);
    EXPECT_EQ(renderer.notes().size(), 1U);
    const VectorDrawing paths = renderer.draw_strokes(lens_camera, style, lens_page);
    EXPECT_EQ(renderer.notes().size(), 2U) << "of wash, and of the lens";
    EXPECT_EQ(paths.strokes.size(), renderer.draw_strokes(lens_camera, {}, lens_page).strokes.size());
}

TEST(DepthOfField, LeavesNoSeamsBetweenTiles)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(posts());
    Style style;
    // Without ink, because its own reach would hide that the lens has none.
    for (const char* assignment :
         {"lens.enabled=true", "lens.focal_mm=150", "lens.f_number=1", "lens.focus_m=4.8",
          "lens.largest_mm=20", "hatch.enabled=false", "contour.enabled=false"}) {
        style.set(assignment);
    }
    RenderSettings tiled{.width = 480, .height = 180};
    const Image whole = renderer.render(lens_camera, style, tiled);
    tiled.tile_px = 300;
    const Image parts = renderer.render(lens_camera, style, tiled);
    int most = 0;
    for (size_t i = 0; i < whole.rgba.size(); ++i) {
        most = std::max(most, std::abs(int{whole.rgba[i]} - int{parts.rgba[i]}));
    }
    EXPECT_LE(most, 1);
}

/// Ink of strokes and lines in a part of the page.
double ink_between(const LayeredImage& picture, const char* name, uint32_t left, uint32_t right)
{
    double sum = 0.0;
    for (const PictureLayer& layer : picture.layers) {
        for (size_t i = 0; layer.name == name && i < layer.image.pixels.size(); ++i) {
            const size_t x = i % lens_page.width;
            sum += x >= left && x < right ? static_cast<double>(layer.image.pixels[i].w) : 0.0;
        }
    }
    return sum;
}

TEST(DepthOfField, DrawsFewerAndPalerStrokesWhereItIsToldTo)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(posts());
    const auto draw = [&](std::initializer_list<const char*> more) {
        Style style;
        for (const char* assignment : {"lens.focal_mm=150", "lens.f_number=1", "lens.focus_m=4.8",
                                       "paper.margin_mm=0", "light.exposure_stops=-2"}) {
            style.set(assignment);
        }
        for (const char* assignment : more) {
            style.set(assignment);
        }
        return renderer.render_layers(lens_camera, style, lens_page);
    };
    const LayeredImage sharp = draw({});
    const LayeredImage pale = draw({"lens.enabled=true", "lens.acts_on=strokes"});
    // The left part only shows surfaces far behind the focus.
    EXPECT_LT(ink_between(pale, "hatch", 0, 30), 0.9 * ink_between(sharp, "hatch", 0, 30));
    EXPECT_GT(ink_between(pale, "hatch", 0, 30), 0.1 * ink_between(sharp, "hatch", 0, 30));
}

} // namespace
} // namespace estampe
