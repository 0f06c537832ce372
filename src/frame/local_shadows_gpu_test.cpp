// SPDX-License-Identifier: MIT
// Which shadow maps of local lights are drawn when.
#include <algorithm>

#include <estampe/style.hpp>
#include <gtest/gtest.h>

#include "scene/shapes.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::frame {
namespace {

constexpr RenderSettings small_page{.width = 96, .height = 64};

void add_lamp(Scene& scene, const glm::dvec3& place, float range_m)
{
    scene.lights.push_back({.type = LightType::point, .intensity = 5.0F, .range_m = range_m});
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(
        {.transform = {.translation = place}, .light = static_cast<Index>(scene.lights.size() - 1)});
}

/// Two lamps ten metres apart, a box by each; the right box slides during the first animation.
Scene two_lamps()
{
    Scene scene = test::scene_of(shapes::plane(20.0F, 8.0F));
    test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {-5.0, 0.0, 0.0});
    const Index mover =
        test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {5.0, 0.0, 0.0});
    add_lamp(scene, {-5.0, 2.5, 1.0}, 4.0F);
    add_lamp(scene, {5.0, 2.5, 1.0}, 4.0F);
    Animation slide{.channels = {{.node = mover,
                                  .path = AnimatedPath::translation,
                                  .times_s = {0.0F, 1.0F},
                                  .values = {5.0F, 0.0F, 0.0F, 6.0F, 0.0F, 0.0F}}},
                    .duration_s = 1.0F};
    scene.animations.push_back(slide);
    return scene;
}

const Camera camera{.eye = {0.0, 5.0, 12.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.7};

bool drew_maps(const Renderer& renderer)
{
    return std::ranges::any_of(renderer.timings(), [](const PassTiming& timing) {
        return timing.name.starts_with("local shadows");
    });
}

TEST(LocalShadows, AStillSceneDrawsNoMap)
{
    Renderer renderer(test::validated());
    renderer.set_scene(two_lamps());
    const Style style;
    const Image first = renderer.render(camera, style, small_page);
    EXPECT_TRUE(drew_maps(renderer));
    const Image second = renderer.render(camera, style, small_page);
    EXPECT_FALSE(drew_maps(renderer));
    EXPECT_EQ(first.rgba, second.rgba);
}

TEST(LocalShadows, WhatMovesWithinReachIsDrawnAfresh)
{
    Renderer renderer(test::validated());
    renderer.set_scene(two_lamps());
    const Style style;
    RenderSettings later = small_page;
    later.time_s = 0.5;
    (void)renderer.render(camera, style, small_page);
    const Image kept = renderer.render(camera, style, later);
    EXPECT_TRUE(drew_maps(renderer));
    Renderer fresh(test::validated());
    fresh.set_scene(two_lamps());
    EXPECT_EQ(kept.rgba, fresh.render(camera, style, later).rgba);
}

} // namespace
} // namespace estampe::frame
