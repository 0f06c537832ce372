// SPDX-License-Identifier: MIT
// Pictures in floats and in layers, from the scene to the file.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "core/color.hpp"
#include "output/layer_files.hpp"
#include "support/files.hpp"
#include "support/gpu_device.hpp"
#include "support/open_raster.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

/// A box and a ball with equal names on a floor, in the sun.
Scene still_life_of_things()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    scene.nodes[0].name = "floor";
    for (const Index node :
         {test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F},
                           glm::dvec3(-0.6, 0.0, 0.0)),
          test::add_object(scene, shapes::sphere(0.6F), {0.2F, 0.4F, 0.7F}, glm::dvec3(0.8, 0.6, 0.5))}) {
        scene.nodes[node].name = "thing";
    }
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

struct LayerCase {
    Scene scene;
    Camera camera;
    Style style;
};

/// One case is painted in colours; the other has light and coloured ink on dark paper, seen from above.
std::vector<LayerCase> cases()
{
    std::vector<LayerCase> cases;
    cases.push_back({still_life_of_things(), test::corner_camera, {}});
    const Scene square = load_scene(test::square_scene());
    Style night;
    night.set("paper.color=#20242c");
    night.set("paper.ink=#e8e2d0");
    night.set("contour.ink=#ffd080");
    night.set("wash.strength=1");
    cases.push_back({square, scene_camera(square, pose_scene(square, 0.0), "square"), night});
    cases.push_back({square, cases.back().camera, {}});
    Style flowing;
    flowing.set("ink.enabled=true");
    flowing.set("ink.age_s=1");
    cases.push_back({still_life_of_things(), test::corner_camera, flowing});
    return cases;
}

/// Largest difference in steps of 1/255 between a linear picture, once encoded, and bytes.
double largest_difference(const LinearImage& linear, const Image& image)
{
    std::vector<glm::dvec3> values;
    for (const glm::vec4& pixel : linear.pixels) {
        glm::dvec3& value = values.emplace_back();
        for (int channel = 0; channel < 3; ++channel) {
            value[channel] =
                255.0 * srgb_from_linear(std::clamp(static_cast<double>(pixel[channel]), 0.0, 1.0));
        }
    }
    return test::largest_difference(values, image);
}

TEST(PictureLayers, LaidOnEachOtherTheyAreThePicture)
{
    Renderer& renderer = test::shared_renderer();
    for (const LayerCase& drawn : cases()) {
        renderer.set_scene(drawn.scene);
        for (const uint32_t samples : {1U, 5U}) {
            const RenderSettings settings{.width = 200, .height = 120, .samples = samples};
            const Image picture = renderer.render(drawn.camera, drawn.style, settings);
            const LayeredImage layers = renderer.render_layers(drawn.camera, drawn.style, settings);
            EXPECT_EQ(layers.picture, picture) << "layers leave the picture as it is";
            const double in_light = largest_difference(flattened(layers), picture);
            EXPECT_LE(in_light, 1.0);
            const test::OpenRaster raster = test::read_openraster(output::encode_openraster(layers));
            EXPECT_EQ(raster.merged, picture);
            const double in_bytes = test::largest_difference(test::composite(raster, true), picture);
            const double in_floats = test::largest_difference(test::composite(raster, false), picture);
            EXPECT_LE(in_bytes, 1.0);
            EXPECT_LT(test::share_that_differs(test::composite(raster, true), picture), 0.0005);
            EXPECT_LE(in_floats, 1.0);
            RecordProperty("samples " + std::to_string(samples), std::to_string(in_light) + " " +
                                                                     std::to_string(in_bytes) + " " +
                                                                     std::to_string(in_floats));
        }
    }
}

TEST(PictureLayers, EachHoldsItsOwn)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(still_life_of_things());
    const RenderSettings settings{.width = 200, .height = 120};
    Style bare;
    bare.set("hatch.enabled=false");
    bare.set("contour.enabled=false");
    bare.set("wash.strength=0");
    const LayeredImage blank = renderer.render_layers(test::corner_camera, bare, settings);
    const LayeredImage full = renderer.render_layers(test::corner_camera, {}, settings);
    ASSERT_EQ(full.layers.size(), 4U);
    EXPECT_EQ(full.layers[0].image, blank.layers[0].image) << "paper is paper";
    size_t inked = 0;
    for (size_t i = 0; i < full.layers[0].image.pixels.size(); ++i) {
        EXPECT_EQ(blank.layers[1].image.pixels[i], glm::vec4(1.0F));
        EXPECT_EQ(blank.layers[2].image.pixels[i], glm::vec4(0.0F));
        EXPECT_EQ(blank.layers[3].image.pixels[i], glm::vec4(0.0F));
        for (const size_t ink : {2U, 3U}) {
            const glm::vec4& pixel = full.layers[ink].image.pixels[i];
            inked += pixel.w > 0.5F ? 1 : 0;
            if (pixel.w > 0.1F) { // black ink
                EXPECT_LT(pixel.x / pixel.w, 0.03F);
            }
        }
    }
    EXPECT_GT(inked, 100U);
}

TEST(PictureLayers, HaveOneOfInkThatFlows)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(still_life_of_things());
    const RenderSettings settings{.width = 200, .height = 120};
    Style style;
    style.set("ink.enabled=true");
    style.set("ink.age_s=1");
    style.set("ink.threshold=0.1");
    style.set("ink.spot_mm=4");
    style.set("ink.spacing_mm=8");
    style.set("ink.thin_color=#ff0000");
    style.set("ink.color=#ff0000");
    const LayeredImage image = renderer.render_layers(test::corner_camera, style, settings);
    const LayeredImage without = renderer.render_layers(test::corner_camera, {}, settings);
    ASSERT_EQ(image.layers.size(), 5U);
    EXPECT_EQ(image.layers[2].name, "ink");
    EXPECT_EQ(image.layers[1].image, without.layers[1].image) << "it lies over the wash, which stays";
    EXPECT_EQ(image.masks.back().above, 5U);
    size_t inked = 0;
    for (const glm::vec4& pixel : image.layers[2].image.pixels) {
        inked += pixel.w > 0.3F && pixel.x / pixel.w > 0.9F && pixel.y / pixel.w < 0.05F ? 1 : 0;
    }
    EXPECT_GT(inked, 50U) << "in its own colour";
}

TEST(PictureLayers, MasksShareThePageAmongTheNodes)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(still_life_of_things());
    for (const uint32_t samples : {1U, 8U}) {
        const LayeredImage image = renderer.render_layers(test::corner_camera, {},
                                                          {.width = 200, .height = 120, .samples = samples});
        std::vector<float> sum(200 * 120, 0.0F);
        std::set<std::string> names;
        size_t soft = 0;
        for (const PictureMask& mask : image.masks) {
            names.insert(mask.name);
            ASSERT_EQ(mask.cover.size(), size_t{mask.width} * mask.height);
            ASSERT_LE(mask.x + mask.width, 200U);
            ASSERT_LE(mask.y + mask.height, 120U);
            for (uint32_t i = 0; mask.is_object && i < mask.cover.size(); ++i) {
                sum[size_t{mask.y + i / mask.width} * 200 + mask.x + i % mask.width] += mask.cover[i];
                soft += mask.cover[i] > 0.0F && mask.cover[i] < 1.0F ? 1 : 0;
            }
        }
        EXPECT_EQ(names, (std::set<std::string>{"shadow", "floor", "ground", "thing", "thing 2"}));
        EXPECT_EQ(image.masks.front().name, "shadow");
        EXPECT_EQ(soft > 100, samples > 1) << soft;
        for (const float share : sum) {
            EXPECT_LE(share, 1.0F + 1e-5F);
        }
        EXPECT_GT(sum[size_t{80} * 200 + 100], 0.999F) << "the middle of the page is of something";
    }
}

TEST(PictureLayers, AMaskSaysWhereCloudsAre)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(still_life_of_things());
    const Camera low{.eye = {3.0, 0.6, 5.0}, .target = {0.0, 1.8, 0.0}};
    const RenderSettings settings{.width = 120, .height = 80};
    Style cloudy;
    for (const char* assignment : {"sky.enabled=true", "clouds.coverage=0.5", "clouds.hatch=0"}) {
        cloudy.set(assignment);
    }
    Style blue = cloudy;
    blue.set("clouds.coverage=0");
    const LayeredImage image = renderer.render_layers(low, cloudy, settings);
    const LayeredImage bare = renderer.render_layers(low, blue, settings);
    const auto is_of_clouds = [](const PictureMask& mask) { return mask.name == "clouds"; };
    EXPECT_TRUE(std::ranges::none_of(bare.masks, is_of_clouds));
    const auto mask = std::ranges::find_if(image.masks, is_of_clouds);
    ASSERT_NE(mask, image.masks.end());
    EXPECT_FALSE(mask->is_object);
    size_t covered = 0;
    size_t unlike = 0;
    size_t open = 0;
    for (size_t i = 0; i < mask->cover.size(); ++i) {
        const bool is_alike = image.layers[1].image.pixels[i] == bare.layers[1].image.pixels[i];
        EXPECT_TRUE(is_alike || mask->cover[i] > 0.0F) << "pixel " << i;
        covered += mask->cover[i] > 0.5F ? 1 : 0;
        unlike += mask->cover[i] > 0.5F && !is_alike ? 1 : 0;
        open += is_alike ? 1 : 0;
    }
    EXPECT_GT(covered, 300U);
    EXPECT_GE(unlike, covered * 9 / 10);
    EXPECT_GT(open, 300U);
}

/// The shadow of the box lies on the floor on the side away from the sun.
TEST(PictureLayers, ShadowIsWhereTheSunIsKeptOff)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), {0.8F, 0.3F, 0.2F}, glm::dvec3(0.0, 0.0, 0.0));
    test::add_sun(scene, {1.0, 1.0, 0.0});
    renderer.set_scene(scene);
    const Camera above{.eye = {0.0, 8.0, 0.01}, .target = {0.0, 0.0, 0.0}};
    const LayeredImage image = renderer.render_layers(above, {}, {.width = 120, .height = 120});
    ASSERT_EQ(image.masks.front().name, "shadow");
    const PictureMask& shadow = image.masks.front();
    const auto mean = [&](uint32_t from_x, uint32_t to_x) {
        float sum = 0.0F;
        for (uint32_t x = from_x; x < to_x; ++x) {
            sum += shadow.cover[size_t{60} * 120 + x];
        }
        return sum / static_cast<float>(to_x - from_x);
    };
    EXPECT_GT(mean(42, 46), 0.9F) << "to the left of the box";
    EXPECT_LT(mean(80, 100), 0.02F) << "to its right";
    Scene overcast = still_life_of_things();
    overcast.lights[0].type = LightType::point;
    renderer.set_scene(overcast);
    EXPECT_NE(renderer.render_layers(test::corner_camera, {}, {.width = 60, .height = 40}).masks.front().name,
              "shadow");
}

/// There is only paper beyond the margin, and the border is a line.
TEST(PictureLayers, EndAtTheMargin)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(still_life_of_things());
    Style style;
    style.set("paper.margin_mm=20");
    style.set("paper.border_mm=1");
    const RenderSettings settings{.width = 240, .height = 180};
    const LayeredImage image = renderer.render_layers(test::corner_camera, style, settings);
    EXPECT_EQ(image.picture, renderer.render(test::corner_camera, style, settings));
    EXPECT_LE(largest_difference(flattened(image), image.picture), 1.0);
    const test::OpenRaster raster = test::read_openraster(output::encode_openraster(image));
    EXPECT_LE(test::largest_difference(test::composite(raster, true), image.picture), 1.0);
    for (const PictureMask& mask : image.masks) {
        EXPECT_TRUE(!mask.is_object || (mask.x >= 23 && mask.x + mask.width <= 217)) << mask.name;
        EXPECT_TRUE(!mask.is_object || (mask.y >= 23 && mask.y + mask.height <= 157)) << mask.name;
    }
    const size_t corner = size_t{10} * 240 + 10;
    EXPECT_EQ(image.layers[1].image.pixels[corner], glm::vec4(1.0F));
    EXPECT_EQ(image.layers[2].image.pixels[corner].w, 0.0F);
    EXPECT_EQ(image.layers[3].image.pixels[corner].w, 0.0F);
    size_t border = 0;
    for (size_t x = 0; x < 60; ++x) {
        border += image.layers[3].image.pixels[size_t{90} * 240 + x].w > 0.4F ? 1 : 0;
    }
    EXPECT_GE(border, 1U);
}

TEST(LinearPicture, IsThePictureInMoreThanBytes)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(still_life_of_things());
    for (const uint32_t samples : {1U, 4U}) {
        const RenderSettings settings{.width = 160, .height = 120, .samples = samples};
        const LinearImage linear = renderer.render_linear(test::corner_camera, {}, settings);
        EXPECT_LE(largest_difference(linear, renderer.render(test::corner_camera, {}, settings)), 0.6);
        EXPECT_EQ(linear, renderer.render_linear(test::corner_camera, {}, settings));
        // Floats must resolve more than bytes: far more than 256 values, and several within one byte.
        std::map<int, std::set<float>> of_byte;
        size_t values = 0;
        for (const glm::vec4& pixel : linear.pixels) {
            const float encoded = srgb_from_linear(std::clamp(pixel.x, 0.0F, 1.0F));
            values += of_byte[static_cast<int>(std::lround(255.0F * encoded))].insert(pixel.x).second ? 1 : 0;
            EXPECT_EQ(pixel.w, 1.0F);
        }
        EXPECT_GT(values, 4000U);
    }
    EXPECT_THROW(std::ignore = renderer.render_linear(test::corner_camera, {}, {.width = 0, .height = 4}),
                 std::exception);
}

} // namespace
} // namespace estampe
