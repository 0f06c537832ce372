// SPDX-License-Identifier: MIT
// Transparent surfaces, pixel by pixel, and the picture behind them.
#include "techniques/transparency/transparency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/image_compare.hpp"
#include "support/scenes.hpp"

namespace estampe::transparency {
namespace {

constexpr uint32_t side_px = 96;
constexpr RenderSettings settings{.width = 120, .height = 90};
const glm::vec3 green(0.04F, 0.36F, 0.01F); // its square roots are exact in eight bits
const glm::vec3 blue(0.09F, 0.04F, 0.64F);

/// A camera whose page is exactly filled by a square of 2 m in z = 0.
Camera parallel_camera()
{
    Camera camera = test::front_camera(5.0, 0.6);
    camera.orthographic_half_height_m = 1.0;
    return camera;
}

/// A pane of 2 m around the z axis.
Primitive pane()
{
    Primitive primitive;
    primitive.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

void add_pane(Scene& scene, const glm::vec3& color, float opacity, double z, Primitive primitive = pane(),
              double y = 0.0)
{
    test::add_object(scene, std::move(primitive), color, {0.0, y, z});
    scene.materials.back().base_color.w = opacity;
    scene.materials.back().alpha_mode = AlphaMode::blend;
}

test::ScreenPixels look(const Scene& scene, RasterPath path = RasterPath::compute)
{
    test::Drawing drawing(scene, parallel_camera(), glm::uvec2(side_px));
    drawing.path = path;
    return drawing.screen();
}

/// Colour and coverage of panes composited over each other, nearest first.
glm::vec4 laid_over(const std::vector<glm::vec4>& panes)
{
    glm::vec3 color(0.0F);
    float through = 1.0F;
    for (const glm::vec4& pane : panes) {
        color += through * pane.w * glm::vec3(pane);
        through *= 1.0F - pane.w;
    }
    return {color / (1.0F - through), 1.0F - through};
}

void expect_color(const test::ScreenPixels& pixels, const glm::vec4& color)
{
    // Eight bits of the colour's square root and of the coverage, with some float rounding.
    for (const glm::vec4& c : pixels.color) {
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(std::sqrt(c[k]), std::sqrt(color[k]), 0.51 / 255.0) << k;
        }
        ASSERT_NEAR(c.w, color.w, 0.51 / 255.0);
    }
}

void expect_everywhere(const test::ScreenPixels& pixels, uint32_t draw, const glm::vec4& color)
{
    EXPECT_TRUE(std::ranges::all_of(pixels.draw, [&](uint32_t d) { return d == draw; })) << pixels.draw[0];
    const auto is_near = [&](const glm::vec4& c) { return glm::distance(c, color) < 6e-3F; };
    EXPECT_TRUE(std::ranges::all_of(pixels.color, is_near)) << pixels.color[0].y << ", " << pixels.color[0].w;
}

TEST(Transparency, HasTheColourAndCoverOfWhatIsInFront)
{
    Scene scene = test::scene_of(pane());
    add_pane(scene, green, 0.4F, 1.0);
    expect_everywhere(look(scene), 2, glm::vec4(green, 0.4F));
    scene.nodes.back().transform.translation.z = -1.0;
    expect_everywhere(look(scene), 0, glm::vec4(0.0F)); // behind a solid surface
    Scene alone;
    add_pane(alone, green, 1.0F, 0.0);
    expect_everywhere(look(alone), 1, glm::vec4(green, 1.0F));
}

TEST(Transparency, MultipliesByVertexColoursAndTexture)
{
    Primitive colored = pane();
    colored.colors.assign(4, {0.25F, 1.0F, 1.0F, 0.5F});
    Scene scene;
    add_pane(scene, {1.0F, 0.36F, 0.64F}, 0.8F, 0.0, std::move(colored));
    expect_everywhere(look(scene), 1, {0.25F, 0.36F, 0.64F, 0.4F});
    // A texture that is clear on the left, and half covered with black on the right.
    scene.textures.push_back(
        {.image = {.width = 4,
                   .height = 1,
                   .rgba = {255, 255, 255, 0, 255, 255, 255, 0, 0, 0, 0, 128, 0, 0, 0, 128}},
         .wrap_u = Wrap::clamp});
    scene.materials[0].base_color_texture.texture = 0;
    const auto pixels = look(scene);
    const size_t left = 50 * side_px + 4;
    const size_t right = 50 * side_px + side_px - 5;
    EXPECT_EQ(pixels.draw[left], 0U);
    EXPECT_EQ(pixels.color[left].w, 0.0F);
    EXPECT_EQ(pixels.draw[right], 1U);
    EXPECT_NEAR(pixels.color[right].w, 0.2F, 4e-3F);
    EXPECT_NEAR(pixels.color[right].y, 0.0F, 1e-3F);
}

constexpr std::array paths{RasterPath::compute, RasterPath::hardware};

TEST(Transparency, PanesInARowCoverAsTheirProductInWhateverOrderTheyCome)
{
    const std::array<glm::vec4, 4> panes{glm::vec4(green, 0.5F), glm::vec4(blue, 0.3F),
                                         glm::vec4(0.81F, 0.25F, 0.04F, 0.4F), glm::vec4(blue, 0.9F)};
    const std::vector<std::vector<size_t>> orders{{0, 1},       {1, 0},      {0, 1, 2}, {0, 2, 1},
                                                  {1, 0, 2},    {1, 2, 0},   {2, 0, 1}, {2, 1, 0},
                                                  {0, 1, 2, 3}, {3, 1, 0, 2}};
    for (const RasterPath path : paths) {
        for (const std::vector<size_t>& order : orders) {
            Scene scene;
            for (const size_t i : order) {
                add_pane(scene, panes.at(i), panes.at(i).w, 0.2 - 0.05 * static_cast<double>(i));
            }
            expect_color(look(scene, path),
                         laid_over({panes.begin(), panes.begin() + static_cast<long>(order.size())}));
        }
    }
}

TEST(Transparency, PanesThatCrossAreInOrderOnEitherSide)
{
    const std::array<glm::vec4, 2> panes{glm::vec4(green, 0.5F), glm::vec4(blue, 0.7F)};
    for (const RasterPath path : paths) {
        for (const bool turned : {false, true}) {
            Scene scene;
            for (const size_t i : {0U, 1U}) {
                add_pane(scene, panes.at(turned ? 1 - i : i), panes.at(turned ? 1 - i : i).w, 0.0);
                scene.nodes.back().transform.rotation =
                    glm::angleAxis((i == 0) != turned ? 0.3 : -0.3, glm::dvec3(0, 1, 0));
            }
            const auto pixels = look(scene, path);
            const size_t row = 40 * size_t{side_px};
            const glm::vec4 left = pixels.color[row + 20];
            const glm::vec4 right = pixels.color[row + 70];
            EXPECT_LT(glm::distance(left, laid_over({panes[0], panes[1]})), 6e-3F); // turned towards the eye
            EXPECT_LT(glm::distance(right, laid_over({panes[1], panes[0]})), 6e-3F);
            EXPECT_NE(pixels.draw[row + 20], pixels.draw[row + 70]);
        }
    }
}

TEST(Transparency, PanesInOnePlaneLookAlikeInWhateverOrderTheyCome)
{
    for (const RasterPath path : paths) {
        Scene green_first, blue_first;
        add_pane(green_first, green, 0.5F, 0.2);
        add_pane(green_first, blue, 0.7F, 0.2);
        add_pane(blue_first, blue, 0.7F, 0.2);
        add_pane(blue_first, green, 0.5F, 0.2);
        const auto pixels = look(green_first, path);
        EXPECT_NEAR(pixels.color[1000].w, 0.85F, 3e-3F);
        EXPECT_EQ(pixels.color, look(blue_first, path).color);
    }
}

TEST(Transparency, WhatStandsBetweenPanesHidesThoseBehind)
{
    Scene scene = test::scene_of(pane());
    add_pane(scene, green, 0.4F, 1.0);
    add_pane(scene, blue, 0.4F, -1.0);
    add_pane(scene, blue, 0.2F, 2.0);
    expect_color(look(scene), laid_over({glm::vec4(blue, 0.2F), glm::vec4(green, 0.4F)}));
}

TEST(Transparency, BordersOfPanesBehindPanesAreBorders)
{
    // The rear pane fills the left half; the identifier changes exactly at its border.
    Scene scene;
    add_pane(scene, green, 0.4F, 1.0);
    add_pane(scene, blue, 0.4F, 0.0);
    scene.nodes.back().transform.translation.x = -1.0;
    const auto pixels = look(scene);
    EXPECT_EQ(pixels.draw[95], 1U);
    for (size_t i = 0; i < pixels.draw.size(); ++i) {
        ASSERT_EQ(pixels.draw[i], i % side_px < side_px / 2 ? pixels.draw[0] : 1U) << i;
    }
    EXPECT_NE(pixels.draw[0], 1U);
}

TEST(Transparency, AClearPlaceHidesNoScreenBehind)
{
    Scene scene;
    add_pane(scene, green, 0.01F, 0.5);
    expect_everywhere(look(scene), 0, glm::vec4(0.0F));
    add_pane(scene, blue, 0.7F, 0.1);
    expect_everywhere(look(scene), 2, glm::vec4(blue, 0.7F));
}

TEST(Transparency, NoneIsOneBlankTexel)
{
    gpu::Graph for_draw;
    gpu::Graph for_color;
    EXPECT_EQ(test::run_and_read_as<uint32_t>(for_draw, add_no_transparency(for_draw).draw), std::vector{0U});
    EXPECT_EQ(test::run_and_read_as<uint32_t>(for_color, add_no_transparency(for_color).color),
              std::vector{0U});
}

Image draw(const Scene& scene, const Style& style = {})
{
    test::shared_renderer().set_scene(scene);
    return test::shared_renderer().render(
        {.eye = {1.0, 1.5, 7.0}, .target = {0.0, 0.8, 0.0}, .vertical_fov_rad = 0.5}, style, settings);
}

/// A sphere in front of a wall, in a room whose depth does not depend on transparent objects.
Scene still_life()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::quad(6.0F, 4.0F), glm::vec3(0.8F), {0.0, 0.0, -2.0});
    test::add_object(scene, shapes::sphere(0.7F), {0.7F, 0.1F, 0.1F}, {0.0, 0.8, 0.0});
    test::add_sun(scene, {-1.0, 2.0, 2.0});
    return scene;
}

/// Mean of a channel over a square of nine pixels, 0 to 255.
double mean_at(const Image& image, uint32_t x, uint32_t y, uint32_t channel)
{
    double sum = 0.0;
    for (uint32_t dy = 0; dy < 9; ++dy) {
        for (uint32_t dx = 0; dx < 9; ++dx) {
            sum += image.rgba[4 * ((y + dy - 4) * size_t{image.width} + x + dx - 4) + channel];
        }
    }
    return sum / 81.0;
}

TEST(Transparency, AClearPaneLeavesThePictureAsItWas)
{
    const Image without = draw(still_life());
    Scene scene = still_life();
    add_pane(scene, green, 0.0F, 2.0, pane(), 1.2);
    // The pane makes the scene a little larger, and so changes in the seventh digit how much lines get
    // thinner in the distance.
    EXPECT_LE(test::compare_images(without, draw(scene)).max_abs, 1U);
    scene.materials.back().base_color.w = 0.5F;
    EXPECT_GT(test::compare_images(without, draw(scene)).failing_fraction, 0.1);
}

TEST(Transparency, CoverPalesWhatIsBehindAndHidesItsPaintAtLast)
{
    Style paint; // without ink, the picture behind is visible only in the wash
    for (const char* assignment :
         {"hatch.enabled=false", "contour.enabled=false", "wash.strength=1", "paper.grain=0",
          "paper.granulation=0", "paper.color=#ffffff", "sky.enabled=false"}) {
        paint.set(assignment);
    }
    const auto reds = [&](float opacity) {
        Scene scene = still_life();
        add_pane(scene, green, opacity, 2.0, pane(), 1.2);
        const Image image = draw(scene, paint);
        return std::pair(mean_at(image, 60, 42, 0), mean_at(image, 60, 42, 1));
    };
    auto [red, grass] = reds(0.0F);
    EXPECT_GT(red, 150.0);
    for (const float opacity : {0.25F, 0.5F, 0.75F, 1.0F}) {
        const auto [next_red, next_grass] = reds(opacity);
        EXPECT_LT(next_red, red - 10.0);
        EXPECT_GT(next_grass, grass + 5.0);
        red = next_red;
        grass = next_grass;
    }
    // The sRGB value of the pane's colour.
    EXPECT_NEAR(red, 56.0, 3.0);
    EXPECT_NEAR(grass, 162.0, 3.0);
}

TEST(Transparency, TheOrderInTheSceneChangesNoByte)
{
    // Intersecting bodies: a bottle's two walls, a pane through it, a ball behind.
    const auto glass = [](const std::vector<size_t>& order) {
        Scene scene = still_life();
        for (const size_t i : order) {
            add_pane(scene, i % 2 == 0 ? green : blue, 0.25F + 0.1F * static_cast<float>(i),
                     1.0 + 0.1 * static_cast<double>(i),
                     i == 0   ? shapes::sphere(0.6F)
                     : i == 1 ? shapes::sphere(0.5F)
                     : i == 2 ? pane()
                              : shapes::sphere(0.3F),
                     1.0);
            scene.materials.back().double_sided = i < 2;
        }
        return draw(scene);
    };
    const Image first = glass({0, 1, 2, 3});
    EXPECT_EQ(glass({3, 2, 1, 0}), first);
    EXPECT_EQ(glass({2, 0, 3, 1}), first);
}

TEST(Transparency, AsManyLayersAreDrawnAsTheSceneCanShow)
{
    const auto layers = [](const Scene& scene, const Style& style = {}) {
        (void)draw(scene, style);
        std::set<std::string> names;
        for (const PassTiming& timing : test::shared_renderer().timings()) {
            if (timing.name.starts_with("screen") && timing.name.ends_with("/copy")) {
                names.insert(timing.name);
            }
        }
        return names.size();
    };
    Scene scene = still_life();
    EXPECT_EQ(layers(scene), 0U);
    for (const size_t count : {1U, 2U, 3U, 4U, 4U}) {
        add_pane(scene, green, 0.3F, 2.0 + 0.1 * static_cast<double>(scene.nodes.size()), pane(), 1.2);
        EXPECT_EQ(layers(scene), count);
    }
    Style nearest;
    nearest.set("transparency.layers=1");
    EXPECT_EQ(layers(scene, nearest), 1U);
}

TEST(Transparency, APaleScreenThinsTheStrokesBehindIt)
{
    Style strokes;
    for (const char* assignment :
         {"wash.strength=0", "contour.enabled=false", "paper.grain=0", "paper.ink_break=0",
          "paper.color=#ffffff", "paper.ink=#000000", "sky.enabled=false", "light.exposure_stops=-3",
          "paper.margin_mm=0", "hatch.coordinates=solid"}) {
        strokes.set(assignment);
    }
    const auto ink = [&](float opacity) {
        Scene scene = still_life();
        add_pane(scene, glm::vec3(1.0F), opacity, 2.0, pane(), 1.2);
        return 255.0 - mean_at(draw(scene, strokes), 60, 42, 0);
    };
    const double bare = ink(0.0F);
    EXPECT_GT(bare, 100.0);
    EXPECT_LT(ink(0.5F), bare - 20.0);
    EXPECT_LT(ink(1.0F), ink(0.5F) - 20.0);
}

/// The expected colour in the middle of the page, in linear light, from panes composited in depth order.
glm::dvec3 sorted_over(const std::vector<std::pair<double, glm::vec4>>& panes, const glm::dvec3& ground)
{
    std::vector<std::pair<double, glm::vec4>> far_first = panes;
    std::ranges::sort(far_first, {}, [](const auto& pane) { return pane.first; });
    glm::dvec3 color = ground;
    for (const auto& [z, pane] : far_first) {
        color = glm::mix(color, glm::dvec3(pane), static_cast<double>(pane.w));
    }
    return color;
}

TEST(Transparency, SortedPanesAreEachPaintedOverWhatLiesBehind)
{
    Style style;
    for (const char* flat : {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0", "paper.margin_mm=0",
                             "paper.color=#ffffff", "hatch.enabled=false", "contour.enabled=false",
                             "picture.ground=false", "sky.enabled=false", "wash.strength=1", "wash.neutral=1",
                             "wash.least=0", "wash.saturation=1", "wash.detail=1", "wash.light_tint=0",
                             "wash.shadow_from=1", "transparency.mode=sorted", "transparency.layers=8"}) {
        style.set(flat);
    }
    Renderer& renderer = test::shared_renderer();
    const auto middle_of = [&](const Scene& scene) {
        renderer.set_scene(scene);
        const LinearImage image = renderer.render_linear(parallel_camera(), style, settings);
        return glm::dvec3(image.pixels[size_t{45} * settings.width + 60]);
    };
    // The paint of a fully opaque pane, which may differ slightly from the material's colour.
    const auto paint_of = [&](const glm::vec3& color) {
        Scene scene;
        add_pane(scene, color, 1.0F, 0.0);
        for (Material& material : scene.materials) {
            material.unlit = true;
        }
        return middle_of(scene);
    };
    for (uint32_t turn = 0; turn < 4; ++turn) {
        Scene scene = test::scene_of(pane());
        scene.materials.front().unlit = true;
        const glm::dvec3 ground = middle_of(scene);
        std::vector<std::pair<double, glm::vec4>> panes;
        for (uint32_t i = 0; i < 6; ++i) {
            const uint32_t place = (i * 5 + turn * 3) % 7;
            const double z = 0.1 + 0.2 * place;
            const glm::vec3 color(0.1F + 0.12F * static_cast<float>(i), 0.2F,
                                  0.9F - 0.13F * static_cast<float>((i + turn) % 6));
            const float opacity = 0.25F + 0.1F * static_cast<float>((i + 2 * turn) % 6);
            add_pane(scene, color, opacity, z);
            scene.materials.back().unlit = true;
            panes.emplace_back(z, glm::vec4(glm::vec3(paint_of(color)), opacity));
        }
        const glm::dvec3 seen = middle_of(scene);
        const glm::dvec3 wanted = sorted_over(panes, ground);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(seen[channel], wanted[channel], 2e-3) << turn;
        }
    }
}

TEST(Transparency, SortedPanesBehindWhatIsSolidAreNotSeen)
{
    Style style;
    style.set("transparency.mode=sorted");
    Renderer& renderer = test::shared_renderer();
    Scene scene = test::scene_of(pane());
    add_pane(scene, blue, 0.7F, -0.5);
    renderer.set_scene(scene);
    const Image ink = renderer.render(parallel_camera(), {}, settings);
    EXPECT_EQ(renderer.graph_dot().find("screen/sheet"), std::string::npos) << "ink has none";
    EXPECT_EQ(renderer.render(parallel_camera(), style, settings).rgba, ink.rgba);
    EXPECT_NE(renderer.graph_dot().find("screen/sheet"), std::string::npos);
}

} // namespace
} // namespace estampe::transparency
