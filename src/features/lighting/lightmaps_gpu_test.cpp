// SPDX-License-Identifier: MIT
#include "features/lighting/lightmaps.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "features/lighting/lightmap_test_support.hpp"
#include "scene/static_triangles.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::features {
namespace {

/// Two panels of one mesh side by side, 2 x 2 m each, facing +z.
Scene two_panels()
{
    Scene scene;
    test::add_object(scene, shapes::quad(2.0F, 2.0F), glm::vec3(1.0F), {-1.0, 0.0, 0.0});
    scene.nodes.push_back({.transform = {.translation = {1.0, 0.0, 0.0}}, .mesh = 0});
    scene.roots.push_back(1);
    return scene;
}

/// Maps the panels as seen from the front to a lightmap, from `low` to `high` of the map's height.
Lightmap map_of(const Scene& scene, LightImage light, float low = 0.0F, float high = 1.0F)
{
    const StaticTriangles still = static_triangles(scene);
    Lightmap map{.light = std::move(light), .geometry = geometry_fingerprint(still)};
    for (const glm::vec3& place : still.positions) {
        map.corners.emplace_back(std::clamp(place.x / 4.0F + 0.5F, 0.0F, 1.0F),
                                 std::clamp(glm::mix(high, low, 0.5F * place.y + 0.5F), 0.0F, 1.0F));
    }
    return map;
}

class WornLightmaps : public ::testing::Test {
protected:
    Image draw(const Scene& scene, const Lightmap* map, const Style& style, double side = 1.0)
    {
        renderer_.set_scene(scene, map);
        Camera camera{.eye = {0.0, 1.0, side * 8.0}, .target = {0.0, 1.0, 0.0}};
        camera.orthographic_half_height_m = 1.5;
        return renderer_.render(camera, style, {.width = 96, .height = 48});
    }

    /// Mean red over a range of columns and rows.
    static double mean(const Image& image, uint32_t left, uint32_t right, uint32_t top, uint32_t bottom)
    {
        double sum = 0.0;
        for (uint32_t y = top; y < bottom; ++y) {
            for (uint32_t x = left; x < right; ++x) {
                sum += image.rgba[4 * (static_cast<size_t>(y) * image.width + x)];
            }
        }
        return sum / ((right - left) * (bottom - top));
    }

    Renderer renderer_{test::validated()};
};

TEST_F(WornLightmaps, EvenLightIsDrawnAsTheSameAmbientLight)
{
    const Scene scene = two_panels();
    for (const float level : {0.25F, 0.5F, 0.75F}) {
        const Lightmap map = map_of(scene, even(level));
        // On an upright panel, ambient light equals its strength.
        EXPECT_EQ(draw(scene, &map, bare(0.0F)), draw(scene, nullptr, bare(level))) << level;
        EXPECT_EQ(draw(scene, &map, bare(0.9F)), draw(scene, nullptr, bare(level))) << level;
    }
    EXPECT_NE(draw(scene, nullptr, bare(0.25F)), draw(scene, nullptr, bare(0.75F)));
}

TEST_F(WornLightmaps, StrengthAndExposureScaleThem)
{
    const Scene scene = two_panels();
    Lightmap map = map_of(scene, even(1.0F));
    Style half = bare(0.0F);
    half.set("lightmap.strength=0.5");
    EXPECT_EQ(draw(scene, &map, half), draw(scene, nullptr, bare(0.5F)));
    Style darker = bare(0.0F);
    darker.set("light.exposure_stops=-2");
    EXPECT_EQ(draw(scene, &map, darker), draw(scene, nullptr, bare(0.25F)));
    map.exposure = 4.0F; // baked with lights four times as bright
    EXPECT_EQ(draw(scene, &map, bare(0.0F)), draw(scene, nullptr, bare(0.25F)));
}

TEST_F(WornLightmaps, BalanceDimsByAsMuchAsTheMapBrightens)
{
    Scene scene = two_panels();
    const Lightmap map = map_of(scene, even(1.0F));
    Style balanced = bare(0.0F);
    balanced.set("lightmap.balance=true");
    EXPECT_EQ(draw(scene, &map, balanced), draw(scene, nullptr, bare(0.5F)));
    test::add_sun(scene, {0.0, 0.0, 1.0});
    const Lightmap lit = map_of(scene, even(1.0F));
    EXPECT_EQ(draw(scene, &lit, balanced), draw(scene, nullptr, bare(0.0F)));
}

TEST_F(WornLightmaps, EachPlaceOfAMeshHasItsOwnLight)
{
    const Scene scene = two_panels();
    LightImage light = even(0.02F);
    for (size_t i = 0; i < 16; ++i) {
        light.texels[i] = glm::vec3(i % 4 < 2 ? 0.9F : 0.02F); // the left half
    }
    const Lightmap map = map_of(scene, light);
    const Image image = draw(scene, &map, bare(0.4F));
    EXPECT_GT(mean(image, 20, 40, 16, 32), mean(image, 56, 76, 16, 32) + 60.0);
}

TEST_F(WornLightmaps, TheFirstRowIsTheTop)
{
    const Scene scene = two_panels();
    LightImage light = even(0.02F);
    std::fill(light.texels.begin(), light.texels.begin() + 8, glm::vec3(0.9F));
    const Lightmap map = map_of(scene, light);
    const Image image = draw(scene, &map, bare(0.4F));
    EXPECT_GT(mean(image, 20, 76, 12, 20), mean(image, 20, 76, 28, 36) + 60.0);
}

TEST_F(WornLightmaps, BacksAndWhatMovesKeepTheAmbientLight)
{
    Scene scene = two_panels();
    Lightmap map = map_of(scene, even(1.0F));
    EXPECT_EQ(draw(scene, &map, bare(0.3F), -1.0), draw(scene, nullptr, bare(0.3F), -1.0));
    scene.animations.push_back({.channels = {{.node = 1,
                                              .path = AnimatedPath::translation,
                                              .times_s = {0.0F},
                                              .values = {1.0F, 0.0F, 0.0F}}}});
    map = map_of(scene, even(1.0F));
    ASSERT_EQ(map.corners.size(), 6U);
    const Image image = draw(scene, &map, bare(0.3F));
    const Image ambient = draw(scene, nullptr, bare(0.3F));
    EXPECT_GT(mean(image, 20, 40, 16, 32), mean(ambient, 20, 40, 16, 32) + 30.0);
    EXPECT_EQ(mean(image, 56, 76, 16, 32), mean(ambient, 56, 76, 16, 32));
}

TEST_F(WornLightmaps, LightsThatTheMapHoldsAreLeftOut)
{
    Scene scene = two_panels();
    test::add_sun(scene, {0.0, 0.0, 1.0});
    Lightmap map = map_of(scene, even(0.0F));
    const Image lit = draw(scene, &map, bare(0.0F));
    map.baked_lights = baked_directional;
    const Image unlit = draw(scene, &map, bare(0.0F));
    EXPECT_GT(mean(lit, 20, 76, 16, 32), mean(unlit, 20, 76, 16, 32) + 60.0);
}

TEST_F(WornLightmaps, GroupsByStyleLeaveTheMapWhereItIs)
{
    Scene scene = two_panels();
    scene.nodes[0].name = "left";
    const LightImage halves{.width = 4,
                            .height = 1,
                            .texels = {glm::vec3(0.8F), glm::vec3(0.8F), glm::vec3(0.3F), glm::vec3(0.3F)}};
    const Lightmap map = map_of(scene, halves);
    const Image plain = draw(scene, &map, bare(0.0F));
    EXPECT_GT(mean(plain, 20, 40, 16, 32), mean(plain, 56, 76, 16, 32) + 60.0);
    Style grouped = bare(0.0F);
    grouped.set("object.left.light.groups=2");
    grouped.set("object.left.light.shadow_groups=2");
    EXPECT_EQ(draw(scene, &map, grouped), plain);
}

TEST_F(WornLightmaps, AMapOfAnotherSceneIsAnError)
{
    Scene scene = two_panels();
    Lightmap map = map_of(scene, even(1.0F));
    scene.nodes[1].transform.translation.x = 1.5;
    EXPECT_THROW(renderer_.set_scene(scene, &map), Error);
    scene = two_panels();
    map.corners.pop_back();
    EXPECT_THROW(renderer_.set_scene(scene, &map), Error);
}

TEST_F(WornLightmaps, AFrameWithoutAMapHasNoPassForIt)
{
    const Scene scene = two_panels();
    const Lightmap map = map_of(scene, even(1.0F));
    const auto has_pass = [&] {
        const auto& timings = renderer_.timings();
        return std::any_of(timings.begin(), timings.end(),
                           [](const PassTiming& pass) { return pass.name == "lightmap"; });
    };
    static_cast<void>(draw(scene, nullptr, bare(0.3F)));
    EXPECT_FALSE(has_pass());
    static_cast<void>(draw(scene, &map, bare(0.3F)));
    EXPECT_TRUE(has_pass());
}

} // namespace
} // namespace estampe::features
