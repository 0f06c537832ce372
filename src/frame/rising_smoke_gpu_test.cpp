// SPDX-License-Identifier: MIT
// Smoke in whole pictures and films, through the public header.
#include <estampe/renderer.hpp>

#include <gtest/gtest.h>

#include "scene/shapes.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

const Camera camera{.eye = {3.0, 3.0, 5.0}, .target = {0.0, 1.0, 0.0}};

/// A box on a floor, in the sun, with a place on it from which smoke may rise.
Scene smoking_box()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::box({1.0F, 0.8F, 1.0F}), {0.8F, 0.3F, 0.2F});
    Node node{.name = "smoke of the box"};
    node.transform.translation = {0.0, 0.4, 0.0};
    node.transform.scale = glm::dvec3(0.8, 1.1, 0.8);
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(node);
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

Style smoking(const std::vector<std::string>& more = {})
{
    Style style;
    for (const char* assignment :
         {"smoke.drawn=true", "smoke.cells=16", "smoke.age_s=0.8", "smoke.rise_s=1"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : more) {
        style.set(assignment);
    }
    return style;
}

constexpr RenderSettings still{.width = 96, .height = 72, .time_s = 0.25};

std::vector<Image> film(Renderer& renderer, const Style& style)
{
    std::vector<Image> images;
    for (int number = 0; number < 4; ++number) {
        RenderSettings settings = still;
        settings.time_s = number / 12.0;
        settings.continuity = number == 0 ? Continuity::starts : Continuity::follows;
        images.push_back(renderer.render(camera, style, settings));
    }
    return images;
}

/// How many pixels differ.
size_t changed(const Image& a, const Image& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        count += std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]) ? 0 : 1;
    }
    return count;
}

TEST(RisingSmoke, CostsNothingWhereItIsOff)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    static_cast<void>(renderer.render(camera, {}, still)); // poses the scene, draws shadow maps
    const Image plain = renderer.render(camera, {}, still);
    const std::string graph = renderer.graph_dot();
    Style off;
    off.set("smoke.cells=256");
    EXPECT_EQ(renderer.render(camera, off, still), plain);
    EXPECT_EQ(renderer.graph_dot(), graph);
    EXPECT_EQ(graph.find("smoke"), std::string::npos);
}

TEST(RisingSmoke, WantsAnObjectToRiseFrom)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image plain = renderer.render(camera, {}, still);
    EXPECT_EQ(renderer.render(camera, smoking({"smoke.objects=fog*"}), still), plain);
    ASSERT_FALSE(renderer.notes().empty());
    EXPECT_NE(renderer.notes().back().find("fog*"), std::string::npos);
}

TEST(RisingSmoke, AStillStandsForItselfAndAFilmFlowsOn)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image plain = renderer.render(camera, {}, still);
    const Image first = renderer.render(camera, smoking(), still);
    EXPECT_GT(changed(first, plain), 100U);
    const std::vector<Image> once = film(renderer, smoking());
    EXPECT_GT(changed(once[2], once[3]), 20U);
    EXPECT_EQ(renderer.render(camera, smoking(), still), first);
    EXPECT_EQ(renderer.render(camera, {}, still), plain);
    renderer.set_scene(smoking_box());
    EXPECT_EQ(film(renderer, smoking()), once) << "of the scene loaded anew";
}

TEST(RisingSmoke, ATiledPageIsTheSame)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    RenderSettings settings{.width = 200, .height = 120};
    const Image whole = renderer.render(camera, smoking(), settings);
    settings.tile_px = 120;
    EXPECT_LT(changed(renderer.render(camera, smoking(), settings), whole), 20U);
}

TEST(RisingSmoke, HasALayerOfItsOwn)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const LayeredImage with = renderer.render_layers(camera, smoking(), still);
    ASSERT_FALSE(with.layers.empty());
    EXPECT_EQ(with.layers.back().name, "smoke");
    EXPECT_EQ(with.picture, renderer.render(camera, smoking(), still));
    const LayeredImage without = renderer.render_layers(camera, {}, still);
    ASSERT_EQ(with.layers.size(), without.layers.size() + 1);
    EXPECT_EQ(with.layers[with.layers.size() - 2].image.pixels, without.layers.back().image.pixels);
}

TEST(RisingSmoke, FlowsAroundWhatStandsInItsBox)
{
    Scene scene = smoking_box();
    test::add_object(scene, shapes::box({0.9F, 0.1F, 0.9F}), {0.5F, 0.5F, 0.5F}, {0.0, 1.2, 0.0});
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Image through = renderer.render(camera, smoking(), still);
    const Image around = renderer.render(camera, smoking({"smoke.obstacles=true"}), still);
    EXPECT_GT(changed(through, around), 50U);
}

} // namespace
} // namespace estampe
