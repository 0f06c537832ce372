// SPDX-License-Identifier: MIT
// Pages drawn in tiles equal pages drawn in one pass.
#include <estampe/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "frame/page.hpp"
#include "support/gpu_device.hpp"
#include "support/image_compare.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr double most_differing = 0.001; // share of the pixels

const Camera tile_camera{.eye = {3.0, 2.6, 5.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.65};

/// Objects in the shadows of the sun and of a lamp, intersecting objects, and a pane in front of them.
Scene crowded()
{
    Scene scene = test::scene_of(shapes::plane(8.0F, 8.0F));
    test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F}, {-0.6, 0.0, 0.0});
    test::add_object(scene, shapes::sphere(0.6F), {0.2F, 0.4F, 0.7F}, {0.3, 0.6, 0.5});
    test::add_object(scene, shapes::box({0.2F, 2.2F, 0.2F}), {0.5F, 0.5F, 0.3F}, {1.5, 0.0, -0.8});
    test::add_object(scene, shapes::box({1.4F, 1.0F, 0.02F}), {0.3F, 0.7F, 0.5F}, {0.6, 0.1, 1.5});
    scene.materials.back().alpha_mode = AlphaMode::blend;
    scene.materials.back().base_color.w = 0.4F;
    test::add_sun(scene, {1.0, 2.0, 1.5});
    scene.lights.push_back({.type = LightType::point, .color = {1.0F, 0.7F, 0.4F}, .intensity = 6.0F});
    scene.nodes.push_back({.transform = {.translation = {-1.6, 1.2, 1.4}},
                           .light = static_cast<Index>(scene.lights.size() - 1)});
    scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    return scene;
}

Style preset_with(const std::string& preset, const std::vector<std::string>& assignments)
{
    Style style = Style::load(preset);
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

/// Side of a tile when four by four tiles make a page.
uint32_t four_by_four(const Style& style, const RenderSettings& settings)
{
    const float pixels_per_mm = features::pixels_per_mm(settings.height, style.tables().paper.height_mm);
    const uint32_t overlap = frame::overlap_px(style.tables(), pixels_per_mm);
    return (std::max(settings.width, settings.height) + 3) / 4 + 2 * overlap;
}

struct TileCase {
    std::string name;
    std::string preset;
    std::vector<std::string> assignments = {};
    uint32_t samples = 1;
    glm::dvec2 shift{0.0};
};

class TiledPage : public testing::TestWithParam<TileCase> {};

TEST_P(TiledPage, IsThePageThatIsDrawnWhole)
{
    const Style style = preset_with(GetParam().preset, GetParam().assignments);
    RenderSettings settings{.width = 251, .height = 243, .samples = GetParam().samples};
    Camera camera = tile_camera;
    camera.shift = GetParam().shift;
    test::shared_renderer().set_scene(crowded());
    const Image whole = test::shared_renderer().render(camera, style, settings);
    settings.tile_px = four_by_four(style, settings);
    const Image tiled = test::shared_renderer().render(camera, style, settings);
    ASSERT_EQ(tiled.rgba.size(), whole.rgba.size());
    const test::ImageDifference difference = test::compare_images(whole, tiled, 0);
    EXPECT_LE(difference.failing_fraction, most_differing) << test::describe(difference) << "\n"
                                                           << test::heat_map(whole, tiled);
}

INSTANTIATE_TEST_SUITE_P(
    Styles, TiledPage,
    testing::Values(TileCase{"Comic", "comic"}, TileCase{"ComicInSamples", "comic", {}, 4},
                    TileCase{"ComicShifted", "comic", {}, 1, {0.3, -0.2}},
                    TileCase{"PencilOfAMap", "pencil", {"hatch.strokes=map", "hatch.overrun_mm=2"}},
                    TileCase{"Engraving", "engraving"},
                    TileCase{"WashMetered", "wash", {"light.metering=page"}, 2}, TileCase{"Ukiyoe", "ukiyoe"},
                    TileCase{"InkWash", "ink-wash"}, TileCase{"Risograph", "risograph"},
                    TileCase{"Charcoal",
                             "charcoal",
                             {"contour.joints=mitre", "contour.strokes=2", "bleed.enabled=true",
                              "bleed.width_mm=2", "pigment.pool=0.6", "pigment.stray_mm=1"}},
                    TileCase{"HiddenLines", "blueprint"},
                    TileCase{"LinesOfThePage", "comic", {"contour.lines=page", "sky.enabled=true"}},
                    TileCase{"FlowingInk", "flowing-ink"},
                    TileCase{
                        "FlowingInkInSamples", "flowing-ink", {"ink.follow=around", "ink.budget=0.05"}, 2},
                    TileCase{"ShadowLines",
                             "manual",
                             {"contour.shadow_edge.enabled=true", "contour.shadow_edge.width_mm=0.5",
                              "contour.intersection.width_mm=0.5"}}),
    [](const testing::TestParamInfo<TileCase>& tested) { return tested.param.name; });

TEST(DrawnTiles, ComeInBandsFromTheTopDown)
{
    const Style style = Style::load("comic");
    const RenderSettings settings{.width = 150, .height = 131, .tile_px = 64};
    test::shared_renderer().set_scene(crowded());
    const Image image = test::shared_renderer().render(tile_camera, style, settings);
    std::vector<uint8_t> rows;
    uint32_t bands = 0;
    double share = -1.0;
    test::shared_renderer().render_bands(tile_camera, style, settings,
                                         {.take =
                                              [&](const Image& band) {
                                                  EXPECT_EQ(band.width, 150U);
                                                  rows.insert(rows.end(), band.rgba.begin(), band.rgba.end());
                                                  ++bands;
                                              },
                                          .progress =
                                              [&](double drawn) {
                                                  EXPECT_GT(drawn, share);
                                                  share = drawn;
                                              }});
    EXPECT_EQ(rows, image.rgba);
    EXPECT_GT(bands, 2U);
    EXPECT_GT(share, 0.8);
}

/// Width in millimetres of the line down the left side of a square, measured by its ink.
double line_width_mm(uint32_t height_px, uint32_t tile_px)
{
    const Style style = preset_with(
        "manual",
        {"contour.outline.width_mm=2", "contour.crease.enabled=false", "contour.pressure=0",
         "contour.taper_mm=0", "contour.distance_thinning=0", "contour.wobble_mm=0", "contour.overshoot_mm=0",
         "contour.rank=0", "paper.height_mm=50", "paper.margin_mm=0", "paper.grain=0", "paper.ink_break=0",
         "paper.color=#ffffff", "contour.ink=#000000", "hatch.enabled=false", "wash.strength=0",
         "contour.jitter_ends_mm=0", "contour.jitter_width=0", "contour.jitter_offset_mm=0"});
    test::shared_renderer().set_scene(test::scene_of(shapes::plane(2.0F, 2.0F)));
    const Camera above{.eye = {0.0, 4.0, 0.0},
                       .target = {0.0, 0.0, 0.0},
                       .up = {0.0, 0.0, -1.0},
                       .orthographic_half_height_m = 2.0};
    const Image image = test::shared_renderer().render(
        above, style, {.width = height_px, .height = height_px, .tile_px = tile_px});
    double ink = 0.0;
    for (uint32_t x = 0; x < height_px / 2; ++x) {
        const uint8_t* const pixel = image.rgba.data() + size_t{4} * (size_t{height_px / 2} * height_px + x);
        const double shade = pixel[0] / 255.0;
        ink += 1.0 - (shade <= 0.04045 ? shade / 12.92 : std::pow((shade + 0.055) / 1.055, 2.4));
    }
    return ink * 50.0 / height_px;
}

TEST(DrawnTiles, LinesAreAsWideInMillimetresAtAnyDensity)
{
    EXPECT_NEAR(line_width_mm(100, 0), 2.0, 0.06);
    EXPECT_NEAR(line_width_mm(100, 72), 2.0, 0.06);
    EXPECT_NEAR(line_width_mm(300, 128), 2.0, 0.06);
}

TEST(DrawnTiles, OnAPageLongerThanAnyImageTheSameLooksTheSameEverywhere)
{
    constexpr uint32_t height_px = 96;
    constexpr uint32_t period_px = 144; // a metre and a half
    Scene scene = test::scene_of(shapes::plane(400.0F, 2.0F));
    for (int i = -60; i <= 60; ++i) {
        test::add_object(scene, shapes::sphere(0.4F), {0.4F, 0.5F, 0.6F}, {1.5 * i, 0.45, 0.0});
    }
    const Style style = preset_with("manual", {"paper.height_mm=12", "paper.margin_mm=0", "paper.border_mm=0",
                                               "paper.grain=0", "paper.ink_break=0", "contour.pressure=0",
                                               "contour.wobble_mm=0", "contour.taper_mm=0"});
    const Camera side{.eye = {0.0, 0.45, 8.0}, .target = {0.0, 0.45, 0.0}, .orthographic_half_height_m = 0.5};
    test::shared_renderer().set_scene(scene);
    const Image page = test::shared_renderer().render(side, style, {.width = 16800, .height = height_px});
    ASSERT_EQ(page.rgba.size(), size_t{4} * page.width * height_px);
    size_t inked = 0;
    size_t other = 0;
    for (uint32_t y = 0; y < height_px; ++y) {
        for (uint32_t x = period_px; x < page.width; ++x) {
            const size_t at = 4 * (size_t{y} * page.width + x);
            inked += page.rgba[at] < 128 ? 1 : 0;
            other += std::abs(page.rgba[at] - page.rgba[at - 4 * period_px]) > 32 ? 1 : 0;
        }
    }
    EXPECT_GT(inked, page.width * height_px / 50);
    EXPECT_LT(static_cast<double>(other), most_differing * page.width * height_px);
}

TEST(DrawnTiles, AreRefusedWhereTheyWillNotDo)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(crowded());
    EXPECT_THROW(std::ignore = renderer.render(tile_camera, {}, {.width = 70000, .height = 10}), Error);
    const RenderSettings large{.width = 17000, .height = 20};
    EXPECT_THROW(std::ignore = renderer.render_linear(tile_camera, {}, large), Error);
    EXPECT_THROW(std::ignore = renderer.render_layers(tile_camera, {}, large), Error);
    EXPECT_THROW(std::ignore = renderer.draw_strokes(tile_camera, {}, large), Error);
    RenderSettings film = large;
    film.continuity = Continuity::starts;
    EXPECT_THROW(std::ignore = renderer.render(tile_camera, {}, film), Error);
    RenderSettings moved = large;
    moved.motion_since = Moment{tile_camera, 0.0};
    EXPECT_THROW(std::ignore = renderer.render(tile_camera, {}, moved), Error);
}

} // namespace
} // namespace estampe
