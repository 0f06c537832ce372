// SPDX-License-Identifier: MIT
// Ink that flows in whole pictures and films, through the public header.
#include <estampe/renderer.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "support/effect_pictures.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

/// A sunlit box that slides along a floor for a second.
Scene sliding_box()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    const Index box = test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F});
    scene.nodes[box].name = "box";
    Animation animation;
    animation.duration_s = 1.0F;
    animation.channels.push_back({.node = box,
                                  .path = AnimatedPath::translation,
                                  .interpolation = Interpolation::linear,
                                  .times_s = {0.0F, 1.0F},
                                  .values = {-0.5F, 0.0F, 0.0F, 0.8F, 0.0F, 0.2F}});
    scene.animations.push_back(std::move(animation));
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

Style flowing(const std::vector<std::string>& more = {})
{
    Style style;
    style.set("ink.enabled=true");
    // So few pixels cannot show finer threads.
    for (const char* assignment :
         {"ink.age_s=0.5", "ink.threshold=0.1", "ink.spot_mm=4", "ink.spacing_mm=8"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : more) {
        style.set(assignment);
    }
    return style;
}

constexpr RenderSettings ink_still{.width = 96, .height = 72, .time_s = 0.25};

std::vector<Image> ink_film(Renderer& renderer, const Style& style)
{
    std::vector<Image> images;
    for (int number = 0; number < 4; ++number) {
        Camera moving = test::corner_camera;
        moving.eye.x += 0.05 * number;
        RenderSettings settings = ink_still;
        settings.time_s = number / 24.0;
        settings.continuity = number == 0 ? Continuity::starts : Continuity::follows;
        images.push_back(renderer.render(moving, style, settings));
    }
    return images;
}

TEST(FlowingInk, CostsNothingWhereItIsOff)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(sliding_box());
    static_cast<void>(
        renderer.render(test::corner_camera, {}, ink_still)); // poses the scene and draws shadow maps
    const Image plain = renderer.render(test::corner_camera, {}, ink_still);
    const std::string graph = renderer.graph_dot();
    Style off;
    off.set("ink.source=things");
    off.set("object.nobody.ink.zone.give=1");
    off.set("ink.granulation=1");
    EXPECT_EQ(renderer.render(test::corner_camera, off, ink_still), plain);
    EXPECT_EQ(renderer.graph_dot(), graph);
    EXPECT_EQ(graph.find("ink/"), std::string::npos);
}

TEST(FlowingInk, IsTheSameEachTimeAndLeavesNothingBehind)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(sliding_box());
    const Image plain = renderer.render(test::corner_camera, {}, ink_still);
    const Image first = renderer.render(test::corner_camera, flowing(), ink_still);
    EXPECT_GT(test::changed_pixels(first, plain), 100U);
    static_cast<void>(ink_film(renderer, flowing()));
    EXPECT_EQ(renderer.render(test::corner_camera, flowing(), ink_still), first)
        << "a still stands for itself";
    EXPECT_EQ(renderer.render(test::corner_camera, {}, ink_still), plain);
}

TEST(FlowingInk, FlowsOnInFilms)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(sliding_box());
    for (const char* follow : {"page", "turn", "advance", "around", "surface"}) {
        const Style style = flowing({std::string("ink.follow=") + follow, "ink.cell_mm=3"});
        const std::vector<Image> once = ink_film(renderer, style);
        renderer.set_scene(sliding_box());
        EXPECT_EQ(ink_film(renderer, style), once) << follow << ", of the scene loaded anew";
        EXPECT_GT(test::changed_pixels(once[2], once[3]), 20U) << follow;
    }
}

TEST(FlowingInk, ComesFromChosenObjectsAlone)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(sliding_box());
    const Image plain = renderer.render(test::corner_camera, {}, ink_still);
    const size_t of_all = test::changed_pixels(
        renderer.render(test::corner_camera, flowing({"ink.source=things"}), ink_still), plain);
    const size_t of_box = test::changed_pixels(
        renderer.render(test::corner_camera, flowing({"ink.source=things", "ink.objects=b*"}), ink_still),
        plain);
    EXPECT_GT(of_box, 50U);
    EXPECT_LT(of_box, of_all);
    const Image of_none = renderer.render(test::corner_camera, flowing({"ink.objects=nobody"}), ink_still);
    EXPECT_EQ(of_none, plain);
    ASSERT_FALSE(renderer.notes().empty());
    EXPECT_NE(renderer.notes().back().find("nobody"), std::string::npos);
}

/// A level camera that looks along -z sees a wind towards +x blow to the right, and no wind along its view.
TEST(FlowingInk, FollowsTheWindOfTheSceneAsTheCameraSeesIt)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(sliding_box());
    const Camera level{.eye = {0.0, 0.8, 5.0}, .target = {0.0, 0.8, 0.0}};
    const auto drawn = [&](const std::vector<std::string>& more) {
        return renderer.render(level, flowing(more), ink_still).rgba;
    };
    const auto to_the_right = drawn({"ink.wind_mm_per_s=-1", "wind.towards_deg=90", "wind.speed_m_per_s=8"});
    EXPECT_EQ(to_the_right, drawn({"ink.wind_mm_per_s=36", "ink.wind_deg=0"}));
    EXPECT_NE(to_the_right, drawn({"ink.wind_mm_per_s=-1", "wind.towards_deg=-90", "wind.speed_m_per_s=8"}));
    EXPECT_EQ(drawn({"ink.wind_mm_per_s=-1", "wind.towards_deg=180", "wind.speed_m_per_s=8"}),
              drawn({"ink.wind_mm_per_s=0"}));
}

TEST(FlowingInk, TellsWhatItCannotRead)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(sliding_box());
    EXPECT_THROW(static_cast<void>(renderer.render(test::corner_camera,
                                                   flowing({"ink.flow_map=/nowhere/flow.png"}), ink_still)),
                 Error);
    static_cast<void>(
        renderer.render(test::corner_camera, flowing({"object.nothing.ink.zone.give=1"}), ink_still));
    ASSERT_FALSE(renderer.notes().empty());
    EXPECT_NE(renderer.notes().back().find("nothing"), std::string::npos);
    const RenderSettings tiled{.width = 200, .height = 120, .tile_px = 120};
    static_cast<void>(renderer.render(test::corner_camera, flowing({"ink.objects=nobody"}), tiled));
    ASSERT_EQ(renderer.notes().size(), 1U);
    EXPECT_NE(renderer.notes().back().find("nobody"), std::string::npos);
}

/// A mesh that the style makes a zone is not drawn and throws no shadow, and appears again when the style
/// names it no more. Ink flows out of its shape.
TEST(FlowingInk, AMeshThatIsAZoneIsNotDrawn)
{
    const Camera camera{.eye = {2.0, 3.0, 5.0}, .target = {0.0, 0.3, 0.0}};
    const RenderSettings settings{.width = 160, .height = 120};
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(sliding_box());
    Style zone;
    zone.set("object.box.ink.zone.give=1");
    const Image whole = renderer.render(camera, {}, settings);
    const Image hidden = renderer.render(camera, zone, settings);
    EXPECT_TRUE(renderer.render(camera, {}, settings) == whole);
    Scene empty = sliding_box();
    empty.nodes[1].mesh = no_index;
    renderer.set_scene(empty);
    EXPECT_TRUE(renderer.render(camera, {}, settings) == hidden);
    EXPECT_FALSE(hidden == whole);
    renderer.set_scene(sliding_box());
    for (const char* const setting : {"ink.enabled=true", "ink.threshold=0.99"}) {
        zone.set(setting);
    }
    const Image giving = renderer.render(camera, zone, settings);
    zone.set("object.box.ink.zone.give=0");
    EXPECT_FALSE(renderer.render(camera, zone, settings) == giving) << "ink flows out of the box's shape";
    zone.set("object.*.ink.zone.give=1");
    EXPECT_THROW(static_cast<void>(renderer.render(camera, zone, settings)), Error) << "nothing is left";
    EXPECT_TRUE(renderer.render(camera, {}, settings) == whole) << "all meshes are there as before";
}

} // namespace
} // namespace estampe
