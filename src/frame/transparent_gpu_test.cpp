// SPDX-License-Identifier: MIT
// Pictures with transparent paper, from the scene to their look on other pictures.
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <gtest/gtest.h>

#include "features/common/style_tables.hpp"
#include "frame/transparent_test_support.hpp"
#include "output/layer_bytes.hpp"
#include "output/layer_files.hpp"
#include "support/gpu_device.hpp"
#include "support/open_raster.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

/// A box, white as paper, and a blue ball, on the ground that a scene without a camera is given.
Scene white_still_life()
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.5F, 1.0F}));
    scene.nodes[0].name = "box";
    scene.materials.push_back({.base_color = glm::vec4(1.0F)});
    const Index ball =
        test::add_object(scene, shapes::sphere(0.6F), {0.2F, 0.4F, 0.7F}, glm::dvec3(1.3, 0.6, 0.5));
    scene.nodes[ball].name = "ball";
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

Style with(Style style, std::initializer_list<const char*> assignments)
{
    for (const char* assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

Image draw_transparent(const Style& style, const RenderSettings& settings = transparent_page)
{
    return test::shared_renderer().render(transparent_camera, style, settings);
}

/// Largest difference between a transparent picture composed on paper, as programs do it, and one drawn
/// there.
double difference_on(const Image& transparent, const glm::dvec3& paper, const Image& drawn)
{
    double largest = 0.0;
    for (size_t i = 0; i < drawn.rgba.size(); ++i) {
        const size_t channel = i % 4;
        if (channel < 3) {
            const double alpha = transparent.rgba[i - channel + 3] / 255.0;
            const double below = paper[static_cast<int>(channel)];
            const double laid = std::round(below + (transparent.rgba[i] - below) * alpha);
            largest = std::max(largest, std::abs(laid - drawn.rgba[i]));
        }
    }
    return largest;
}

const glm::dvec3 own_paper(0xf6, 0xf0, 0xe2); // of the default style

TEST(Transparent, OnItsOwnPaperIsTheOpaquePicture)
{
    test::shared_renderer().set_scene(white_still_life());
    const std::vector<Style> styles{
        grainless_style({}), grainless_style({"wash.strength=1", "paper.border_mm=0.8", "paper.ink_tint=1"}),
        grainless_style({"bleed.enabled=true", "bleed.width_mm=0.5", "contour.ink=#c03020"}),
        grainless_style({"ink.enabled=true", "ink.age_s=1"})};
    for (size_t i = 0; i < styles.size(); ++i) {
        for (const uint32_t samples : {1U, 4U}) {
            RenderSettings settings = transparent_page;
            settings.samples = samples;
            const Image opaque = draw_transparent(styles[i], settings);
            for (const char* mode : {"paper.transparent=background", "paper.transparent=paper"}) {
                const Image transparent = draw_transparent(with(styles[i], {mode}), settings);
                EXPECT_LE(difference_on(transparent, own_paper, opaque), 1.0)
                    << "style " << i << " samples " << samples << " " << mode;
            }
        }
    }
}

TEST(Transparent, InkLooksOnAnyPaperAsIfDrawnThere)
{
    test::shared_renderer().set_scene(white_still_life());
    const Style ink = grainless_style({"wash.strength=0", "paper.transparent=paper"});
    const Image transparent = draw_transparent(ink);
    for (const auto& [name, color, bound] :
         {std::tuple("paper.color=#ffffff", glm::dvec3(255.0), 4.0),
          std::tuple("paper.color=#ff0000", glm::dvec3(255.0, 0.0, 0.0), 16.0),
          std::tuple("paper.color=#000000", glm::dvec3(0.0), 16.0)}) {
        const Image drawn = draw_transparent(with(ink, {name, "paper.transparent=none"}));
        const double difference = difference_on(transparent, color, drawn);
        RecordProperty(name, std::to_string(difference));
        EXPECT_LE(difference, bound) << name;
    }
}

TEST(Transparent, ThingsHideWhatIsBehindThemAndTheirShadowDoesNot)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(white_still_life());
    const Style style =
        grainless_style({"paper.transparent=background", "hatch.enabled=false", "contour.enabled=false"});
    const LayeredImage layers = renderer.render_layers(transparent_camera, style, transparent_page);
    size_t solid = 0;
    std::vector<bool> is_thing(size_t{transparent_page.width} * transparent_page.height, false);
    for (const PictureMask& mask : layers.masks) {
        for (uint32_t i = 0; mask.name != "ground" && mask.is_object && i < mask.cover.size(); ++i) {
            const size_t at =
                size_t{mask.y + i / mask.width} * transparent_page.width + mask.x + i % mask.width;
            is_thing[at] = is_thing[at] || mask.cover[i] > 0.0F;
        }
    }
    size_t shaded = 0;
    size_t bare = 0;
    for (size_t i = 0; i < is_thing.size(); ++i) {
        const uint8_t alpha = layers.picture.rgba[4 * i + 3];
        solid += is_thing[i] ? 1 : 0;
        if (is_thing[i]) {
            EXPECT_EQ(alpha, 255) << "a hole at " << i % transparent_page.width << ", "
                                  << i / transparent_page.width;
        } else {
            EXPECT_LT(alpha, 200) << "at " << i % transparent_page.width << ", "
                                  << i / transparent_page.width;
            shaded += alpha > 0 ? 1 : 0;
            bare += alpha == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(solid, 1000U);
    EXPECT_GT(shaded, 50U) << "there is a shadow on the ground";
    EXPECT_GT(bare, solid);
    // If all paper is removed, the white box disappears.
    const Image keyed = draw_transparent(with(style, {"paper.transparent=paper", "wash.strength=0"}));
    EXPECT_TRUE(std::ranges::all_of(keyed.rgba, [](uint8_t value) { return value == 0; }));
}

TEST(Transparent, BackgroundHasNoSky)
{
    test::shared_renderer().set_scene(white_still_life());
    const Style sky = grainless_style({"sky.enabled=true", "picture.ground=false"});
    const Image plain = draw_transparent(with(sky, {"sky.enabled=false"}));
    const Image without = draw_transparent(with(sky, {"paper.transparent=background"}));
    EXPECT_EQ(without.rgba[3], 0);
    EXPECT_LE(difference_on(without, own_paper, plain), 1.0);
    // The sky is paint, so it stays when paper is keyed out like the white of a scan.
    const Image keyed = draw_transparent(with(sky, {"paper.transparent=paper"}));
    EXPECT_LE(difference_on(keyed, own_paper, draw_transparent(sky)), 1.0);
    EXPECT_NE(keyed, without);
}

TEST(Transparent, LensAndShutterBlurTheEdgesToo)
{
    Scene scene = white_still_life();
    scene.animations.push_back({.channels = {{.node = 0,
                                              .path = AnimatedPath::translation,
                                              .times_s = {0.0F, 1.0F},
                                              .values = {0.0F, 0.0F, 0.0F, 4.0F, 0.0F, 0.0F}}},
                                .duration_s = 1.0F});
    test::shared_renderer().set_scene(scene);
    RenderSettings settings = transparent_page;
    settings.time_s = 0.3;
    for (const Style& style : {grainless_style({"lens.enabled=true", "lens.focus_m=2", "lens.f_number=1"}),
                               grainless_style({"motion_blur.enabled=true", "motion_blur.shutter_deg=360"}),
                               grainless_style({"motion_blur.enabled=true", "motion_blur.mode=own",
                                                "motion_blur.shutter_deg=360"})}) {
        const Image opaque = draw_transparent(style, settings);
        const Image transparent = draw_transparent(with(style, {"paper.transparent=background"}), settings);
        EXPECT_LE(difference_on(transparent, own_paper, opaque), 2.0);
        const Image sharp = draw_transparent(grainless_style({"paper.transparent=background"}), settings);
        const auto soft = [](const Image& image) {
            size_t count = 0;
            for (size_t i = 3; i < image.rgba.size(); i += 4) {
                count += image.rgba[i] > 60 && image.rgba[i] < 250 ? 1 : 0;
            }
            return count;
        };
        EXPECT_GT(soft(transparent), soft(sharp) + 100);
    }
}

TEST(Transparent, TilesAndFloatsAndLayersAgree)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(white_still_life());
    const glm::vec3 paper_linear = grainless_style({}).tables().paper.color;
    for (const char* mode : {"paper.transparent=background", "paper.transparent=paper"}) {
        for (const uint32_t samples : {1U, 3U}) {
            const Style style = grainless_style({mode});
            RenderSettings settings = transparent_page;
            settings.samples = samples;
            const Image picture = draw_transparent(style, settings);
            const LinearImage linear = renderer.render_linear(transparent_camera, style, settings);
            ASSERT_TRUE(linear.paper.has_value());
            const Image of_floats = output::encoded_bytes(linear);
            int off = 0;
            for (size_t i = 3; i < picture.rgba.size(); i += 4) {
                off = std::max(off, std::abs(picture.rgba[i] - of_floats.rgba[i]));
            }
            EXPECT_LE(off, 1);
            EXPECT_LE(difference_on(of_floats, own_paper, draw_transparent(grainless_style({}), settings)),
                      1.0);

            const LayeredImage layers = renderer.render_layers(transparent_camera, style, settings);
            EXPECT_EQ(layers.picture, picture);
            const LinearImage flat = flattened(layers);
            for (size_t i = 0; i < flat.pixels.size(); ++i) {
                const glm::vec3 shown = glm::vec3(flat.pixels[i]) + (1.0F - flat.pixels[i].w) * paper_linear;
                const glm::vec3 wanted =
                    glm::vec3(linear.pixels[i]) + (1.0F - linear.pixels[i].w) * paper_linear;
                ASSERT_LT(glm::length(shown - wanted), 2e-4F) << i;
                // The mean coverage of several samples differs from the coverage of their means.
                ASSERT_TRUE(samples > 1 || std::abs(flat.pixels[i].w - linear.pixels[i].w) < 1e-3F) << i;
            }
            test::OpenRaster raster = test::read_openraster(output::encode_openraster(layers));
            EXPECT_EQ(raster.merged, picture);
            ASSERT_EQ(raster.layers.front().name, "paper");
            EXPECT_FALSE(raster.layers.front().is_visible);
            EXPECT_LT(raster.thumbnail.rgba[3], 128);
            raster.layers.front().is_visible = true;
            EXPECT_LE(test::largest_difference(test::composite(raster, true),
                                               draw_transparent(grainless_style({}), settings)),
                      1.0);

            settings.tile_px = 96;
            const Image tiled = draw_transparent(style, settings);
            size_t differing = 0;
            for (size_t i = 0; i < tiled.rgba.size(); i += 4) {
                differing += std::abs(tiled.rgba[i + 3] - picture.rgba[i + 3]) > 2 ? 1 : 0;
            }
            EXPECT_LT(differing, tiled.rgba.size() / 4 / 100);
        }
    }
}

} // namespace
} // namespace estampe
