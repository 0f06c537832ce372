// SPDX-License-Identifier: MIT
// Culling by cells and portals changes no pixel of the temple's pictures, nor of its film.
#include <algorithm>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "temple/temple.hpp"
#include "temple/world.hpp"

namespace temple {
namespace {

estampe::Style style_of(const char* preset, bool culls)
{
    estampe::Style style = estampe::Style::load(preset);
    style.set("cloth.settle_s=0");
    style.set("paper.height_mm=60");
    style.set(culls ? "culling.cells=portals" : "culling.cells=off");
    return style;
}

TEST(TempleCulling, ChangesNoPixelOfTheViewpoints)
{
    const estampe::Scene scene = build_temple(1);
    const estampe::ScenePose pose = estampe::pose_scene(scene, 0.0, estampe::no_index);
    estampe::Renderer& renderer = estampe::test::shared_renderer();
    renderer.set_scene(scene);
    const estampe::RenderSettings settings{.width = 192, .height = 108};
    for (const char* const view :
         {"avenue", "court", "colossus", "threshold", "hall", "corridor", "last hall"}) {
        const estampe::Camera camera = estampe::scene_camera(scene, pose, view);
        const estampe::Image whole = renderer.render(camera, style_of("temple-day", false), settings);
        EXPECT_EQ(renderer.render(camera, style_of("temple-day", true), settings), whole) << view;
    }
    // Without its portals, the hall shows no other room.
    estampe::Scene shut = scene;
    shut.portals.clear();
    const estampe::Camera hall = estampe::scene_camera(scene, pose, "hall");
    const estampe::Image whole = renderer.render(hall, style_of("temple-day", false), settings);
    renderer.set_scene(shut);
    EXPECT_NE(renderer.render(hall, style_of("temple-day", true), settings), whole);
}

TEST(TempleCulling, ChangesNoPixelOfTheFilm)
{
    const auto film = [](bool culls) {
        estampe::Renderer& renderer = estampe::test::shared_renderer();
        World world(1);
        const estampe::Scene scene = world.scene();
        renderer.set_scene(scene);
        world.begin(scene, {.occasion = worlds::Occasion::film, .is_draft = true});
        const auto path = world.film_camera(scene);
        std::vector<estampe::Image> frames;
        // From the stairs through the portal into the prison.
        for (int frame = 0; frame < 4; ++frame) {
            const double time_s = 34.0 + 0.5 * frame;
            const estampe::Camera camera = path->camera(time_s);
            world.go_to(time_s, camera);
            world.show(renderer);
            world.press(renderer);
            frames.push_back(renderer.render(
                camera, world.style(style_of("temple-day", culls), camera),
                {.width = 128,
                 .height = 72,
                 .time_s = time_s,
                 .continuity = frame == 0 ? estampe::Continuity::starts : estampe::Continuity::follows}));
        }
        return frames;
    };
    const std::vector<estampe::Image> culled = film(true);
    const std::vector<estampe::Image> whole = film(false);
    for (size_t frame = 0; frame < whole.size(); ++frame) {
        EXPECT_EQ(culled[frame], whole[frame]) << frame;
    }
    EXPECT_NE(whole.front(), whole.back());
}

} // namespace
} // namespace temple
