// SPDX-License-Identifier: MIT
// Lines of objects behind glass that a file marks as transmissive.
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings glass_page{.width = 240, .height = 120};
const Camera glass_camera{.eye = {0.0, 0.0, 8.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.5};

/// Material of a pane.
struct Pane {
    float share = 0.0F; ///< of what lies behind
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha = 1.0F;
};

/// Two balls side by side, with a pane in front of each.
Scene balls_behind(const Pane& left, const Pane& right)
{
    Scene scene = test::scene_of(shapes::sphere(0.7F));
    scene.nodes[0].transform.translation = {-1.6, 0.0, 0.0};
    test::add_object(scene, shapes::sphere(0.7F), glm::vec3(1.0F), {1.6, 0.0, 0.0});
    for (const auto& [pane, x] : {std::pair(left, -1.6), std::pair(right, 1.6)}) {
        const Index node =
            test::add_object(scene, shapes::box({2.4F, 2.4F, 0.1F}), glm::vec3(1.0F), {x, -1.2, 1.5});
        Material& material = scene.materials[scene.meshes[scene.nodes[node].mesh].primitives[0].material];
        material.metallic = 0.0F;
        material.roughness = 0.0F;
        material.alpha_mode = pane.alpha_mode;
        material.base_color.w = pane.alpha;
        if (pane.share > 0.0F) {
            material.transmission = Transmission{.share = pane.share};
        }
    }
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

Style lines_alone()
{
    Style style;
    for (const char* const assignment :
         {"paper.grain=0", "hatch.enabled=false", "wash.strength=0", "picture.ground=false",
          "contour.outline.width_mm=1", "contour.pressure=0", "contour.taper_mm=0"}) {
        style.set(assignment);
    }
    return style;
}

/// Dark pixels in the areas of the left and the right ball, without the edges of the panes.
struct GlassInk {
    int left = 0;
    int right = 0;
};

GlassInk glass_ink(const Scene& scene, const char* raster)
{
    RendererOptions options = test::validated();
    options.raster = std::string(raster) == "compute" ? RasterPath::compute : RasterPath::hardware;
    Renderer renderer(options);
    renderer.set_scene(scene);
    const Image image = renderer.render(glass_camera, lines_alone(), glass_page);
    GlassInk ink;
    for (uint32_t y = 30; y < 90; ++y) {
        for (uint32_t x = 0; x < glass_page.width; ++x) {
            const bool is_dark = image.rgba[4 * (size_t{y} * glass_page.width + x)] < 200;
            ink.left += is_dark && x > 45 && x < 100 ? 1 : 0;
            ink.right += is_dark && x > 140 && x < 195 ? 1 : 0;
        }
    }
    return ink;
}

TEST(GlassLines, WhatStandsBehindClearGlassHasItsLines)
{
    const Pane blended{.alpha_mode = AlphaMode::blend, .alpha = 0.1F};
    const Pane clear{.share = 1.0F};
    const Pane nearly_solid{.share = 0.3F};
    for (const char* const raster : {"hardware", "compute"}) {
        const GlassInk soft = glass_ink(balls_behind(blended, blended), raster);
        ASSERT_GT(soft.left, 60) << raster;
        const double bound = 0.15 * soft.left; // each stroke deviates at random
        const GlassInk glass = glass_ink(balls_behind(clear, clear), raster);
        EXPECT_NEAR(glass.left, soft.left, bound) << raster;
        EXPECT_NEAR(glass.right, soft.right, bound) << raster;
        const GlassInk solid = glass_ink(balls_behind({}, {}), raster);
        EXPECT_EQ(solid.left + solid.right, 0) << raster;
        const GlassInk mixed = glass_ink(balls_behind(clear, nearly_solid), raster);
        EXPECT_NEAR(mixed.left, soft.left, bound) << raster;
        EXPECT_EQ(mixed.right, 0) << raster << ": little is seen of what lies behind";
    }
}

TEST(GlassLines, AreBentWithWhatIsSeenThroughABall)
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 96, 48));
    Material& glass = scene.materials.front();
    glass.metallic = 0.0F;
    glass.roughness = 0.0F;
    glass.transmission = Transmission{.share = 1.0F, .thickness_m = 1.0F, .ior = 1.5F};
    test::add_object(scene, shapes::box({0.2F, 6.0F, 0.2F}), glm::vec3(1.0F), {0.35, -3.0, -3.0});
    test::add_sun(scene, {1.0, 2.0, 1.5});
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    // Dark pixels inside the ball, on the side of the post and on the other side.
    const auto ink = [&](const char* refraction) {
        Style style = lines_alone();
        style.set(refraction);
        const Image image = renderer.render(glass_camera, style, glass_page);
        GlassInk found;
        for (uint32_t y = 50; y < 70; ++y) {
            for (uint32_t x = 100; x < 140; ++x) {
                const bool is_dark = image.rgba[4 * (size_t{y} * glass_page.width + x)] < 200;
                found.left += is_dark && x < 116 ? 1 : 0;
                found.right += is_dark && x > 120 ? 1 : 0;
            }
        }
        return found;
    };
    const GlassInk straight = ink("subsurface.refraction=none");
    EXPECT_GT(straight.right, 15);
    EXPECT_EQ(straight.left, 0);
    const GlassInk bent = ink("subsurface.refraction=thick");
    EXPECT_GT(bent.left, 10) << "a ball shows left on the right";
    EXPECT_EQ(bent.right, 0);
    EXPECT_NE(renderer.graph_dot().find("subsurface/bent lines"), std::string::npos);
}

TEST(GlassLines, StrokesAsPathsGoOnBehindGlass)
{
    const auto length_mm = [](const Pane& pane) {
        Renderer& renderer = test::shared_renderer();
        renderer.set_scene(balls_behind(pane, pane));
        const VectorDrawing drawing =
            renderer.draw_strokes(glass_camera, lines_alone(), glass_page, HiddenLines::left_out);
        double length = 0.0;
        for (const VectorStroke& stroke : drawing.strokes) {
            for (size_t i = 1; i < stroke.points.size(); ++i) {
                length += glm::length(stroke.points[i].page_mm - stroke.points[i - 1].page_mm);
            }
        }
        return length;
    };
    const double solid = length_mm({});
    EXPECT_GT(length_mm({.share = 1.0F}), 1.2 * solid);
    EXPECT_NEAR(length_mm({.share = 0.3F}), solid, 1e-3 * solid);
}

} // namespace
} // namespace estampe
