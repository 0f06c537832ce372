// SPDX-License-Identifier: MIT
// The temple's twelve viewpoints: what no number says of the world, that its parts make a picture.
#include <algorithm>

#include <gtest/gtest.h>

#include "golden/golden.hpp"
#include "support/gpu_device.hpp"
#include "temple/temple.hpp"

namespace estampe {
namespace {

TEST(TempleGolden, Viewpoints)
{
    const Scene scene = temple::build_temple(1);
    ASSERT_EQ(scene.cameras.size(), 12U);
    Style style = Style::load("temple-day");
    style.set("cloth.settle_s=0"); // flags lie as they were laid: folds hang on the last bit of a float
    style.set("paper.height_mm=75");
    style.set("paper.grain=0"); // which hides what is drawn, and makes files large
    style.set("paper.granulation=0");
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const ScenePose pose = pose_scene(scene, 0.0);
    for (const SceneCamera& lens : scene.cameras) {
        SCOPED_TRACE(lens.name);
        std::string name = "temple-" + lens.name;
        std::ranges::replace(name, ' ', '-');
        const Image image =
            renderer.render(scene_camera(scene, pose, lens.name), style, {.width = 320, .height = 180});
        test::expect_matches_golden(image, name);
    }
}

} // namespace
} // namespace estampe
