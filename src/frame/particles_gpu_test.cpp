// SPDX-License-Identifier: MIT
// Particles and clouds in whole pictures.
#include "frame/particles.hpp"

#include <gtest/gtest.h>

#include "scene/shapes.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::frame {
namespace {

const Camera camera{.eye = {2.0, 1.5, 7.0}, .target = {0.0, 1.5, 0.0}, .vertical_fov_rad = 0.7};
constexpr RenderSettings small{.width = 120, .height = 80};

Scene with_empty(const std::string& name)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    Node node{.name = name};
    node.transform.translation = {0.0, 1.2, 0.0};
    scene.nodes.push_back(node);
    scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    return scene;
}

RenderSettings moment(double time_s)
{
    RenderSettings settings = small;
    settings.time_s = time_s;
    return settings;
}

bool has_pass(const std::string& name)
{
    return test::shared_renderer().graph_dot().find(name) != std::string::npos;
}

TEST(ParticlesInFrame, ComeFromNodesThatArePatternsSay)
{
    const Scene scene = with_empty("emitter of steam");
    const ScenePose pose = pose_scene(scene, 0.0);
    EXPECT_EQ(emitters_of(scene, pose, "emitter*").size(), 1U);
    EXPECT_EQ(emitters_of(scene, pose, "lamp, *steam").size(), 1U);
    EXPECT_EQ(emitters_of(scene, pose, "steam").size(), 0U);
    EXPECT_EQ(emitters_of(scene, pose, "").size(), 0U);
    EXPECT_EQ(emitters_of(scene, pose, "*").size(), 1U) << "what has a mesh gives none";
    EXPECT_NEAR(emitters_of(scene, pose, "*").front().place.y, 1.2, 1e-9);
}

TEST(ParticlesInFrame, AreTheSameWhateverWasDrawnBefore)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(with_empty("stand"));
    const Image bare = renderer.render(camera, {}, moment(2.0));
    EXPECT_FALSE(has_pass("particles"));
    renderer.set_scene(with_empty("emitter"));
    const Image first = renderer.render(camera, {}, moment(2.0));
    EXPECT_TRUE(has_pass("particles"));
    EXPECT_NE(first.rgba, bare.rgba);
    EXPECT_NE(renderer.render(camera, {}, moment(9.0)).rgba, first.rgba);
    EXPECT_EQ(renderer.render(camera, {}, moment(2.0)).rgba, first.rgba);
}

TEST(CloudsInFrame, AreTheSameInTilesAndCostNothingUnasked)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(with_empty("emitter"));
    Style style;
    style.set("sky.mode=drawn");
    style.set("hatch.width_mm=0.5");
    std::ignore = renderer.render(camera, style, moment(2.0));
    EXPECT_FALSE(has_pass("clouds"));
    style.set("clouds.coverage=0.5");
    const Camera up{.eye = camera.eye, .target = {0.0, 3.5, 0.0}, .vertical_fov_rad = 0.9};
    RenderSettings settings = moment(2.0);
    settings.width = 320;
    settings.height = 220;
    const Image whole = renderer.render(up, style, settings);
    EXPECT_TRUE(has_pass("clouds"));
    settings.tile_px = 200;
    const Image tiled = renderer.render(up, style, settings);
    ASSERT_EQ(whole.rgba.size(), tiled.rgba.size());
    size_t different = 0;
    for (size_t i = 0; i < whole.rgba.size(); ++i) {
        different += std::abs(whole.rgba[i] - tiled.rgba[i]) > 8 ? 1 : 0;
    }
    EXPECT_LT(different, whole.rgba.size() / 200);
}

} // namespace
} // namespace estampe::frame
