// SPDX-License-Identifier: MIT
// The temple's court: what no number says of the world, that its parts make a picture.
#include <gtest/gtest.h>

#include "golden/golden.hpp"
#include "support/gpu_device.hpp"
#include "temple/temple.hpp"

namespace estampe {
namespace {

TEST(Temple, Court)
{
    const Scene scene = temple::build_temple(1);
    Style style = Style::load("temple-day");
    style.set("cloth.settle_s=0"); // flags lie as they were laid: folds hang on the last bit of a float
    style.set("paper.height_mm=75");
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Camera camera = scene_camera(scene, pose_scene(scene, 0.0), "court");
    test::expect_matches_golden(renderer.render(camera, style, {.width = 320, .height = 180}), "temple");
}

} // namespace
} // namespace estampe
