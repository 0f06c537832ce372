// SPDX-License-Identifier: MIT
// Rendering a walk: memory stays constant, and dimmed lights look as if the scene had defined them so.
#include "temple/visit.hpp"

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "temple/temple.hpp"

namespace temple {
namespace {

estampe::Style quick_style()
{
    estampe::Style style = estampe::Style::load("temple-day");
    style.set("cloth.settle_s=0");
    style.set("paper.height_mm=60");
    return style;
}

TEST(TempleWalk, TakesNoMoreMemoryFromPictureToPicture)
{
    const estampe::Scene scene = build_temple(1);
    estampe::Renderer& renderer = estampe::test::shared_renderer();
    renderer.set_scene(scene);
    const estampe::Style style = quick_style();
    Visit visit(scene, 1);
    visit.walker().put({0.0, 0.0, 30.0});
    constexpr double frame_s = 0.5;
    uint64_t early_bytes = 0;
    for (int frame = 0; frame < 9; ++frame) {
        visit.go({.way = {0.0, -1.0}, .runs = true}, frame_s, frame * frame_s);
        const std::vector<estampe::TrailStamp> prints = visit.walker().take_prints();
        EXPECT_FALSE(prints.empty());
        renderer.press(prints);
        const glm::dvec3 eye = visit.walker().eye_m();
        const estampe::Camera camera{.eye = eye, .target = eye - glm::dvec3(0.0, 0.1, 1.0), .near_m = 0.1};
        static_cast<void>(renderer.render(
            camera, style,
            {.width = 128,
             .height = 72,
             .time_s = frame * frame_s,
             .continuity = frame == 0 ? estampe::Continuity::starts : estampe::Continuity::follows}));
        if (frame == 3) {
            early_bytes = renderer.device_memory_bytes();
        }
    }
    EXPECT_LE(renderer.device_memory_bytes(), early_bytes + early_bytes / 100);
}

TEST(TempleWalk, LightsBurnAsIfTheSceneHadThemSo)
{
    const estampe::Scene scene = build_temple(1);
    estampe::Scene ended = scene;
    const Ending ending(scene, 1);
    const auto lights = ending.lights(Ending::lasts_s);
    for (const estampe::LightBrightness& light : lights) {
        ended.lights[light.light].intensity = light.intensity;
    }
    estampe::Renderer& renderer = estampe::test::shared_renderer();
    const estampe::Style style = quick_style();
    const estampe::Camera camera =
        estampe::scene_camera(scene, estampe::pose_scene(scene, 0.0, estampe::no_index), "last hall");
    const estampe::RenderSettings settings{.width = 128, .height = 72};
    renderer.set_scene(ended);
    const estampe::Image wanted = renderer.render(camera, style, settings);
    renderer.set_scene(scene);
    const estampe::Image before = renderer.render(camera, style, settings);
    renderer.set_brightness(lights);
    EXPECT_EQ(renderer.render(camera, style, settings).rgba, wanted.rgba);
    EXPECT_NE(before.rgba, wanted.rgba);
    renderer.set_brightness(ending.lights(-1.0));
    EXPECT_EQ(renderer.render(camera, style, settings).rgba, before.rgba) << "and back";
}

} // namespace
} // namespace temple
