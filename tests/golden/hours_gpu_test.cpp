// SPDX-License-Identifier: MIT
// A sheet of the example square through a summer's day and into the night, which the documentation shows.
#include <vector>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>

#include "golden/golden.hpp"
#include "support/files.hpp"
#include "support/gpu_device.hpp"

namespace estampe {
namespace {

TEST(HoursGolden, SquareFromMorningToMidnight)
{
    const Scene scene = load_scene(test::square_scene());
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Camera camera = scene_camera(scene, pose_scene(scene, 0.0), "square");
    std::vector<Image> tiles;
    for (const char* hour : {"5.4", "8.5", "13", "17.5", "20", "23"}) {
        Style style;
        style.set("sun.by=place");
        style.set("paper.margin_mm=0");
        style.set(std::string("sun.hour=") + hour);
        tiles.push_back(renderer.render(camera, style, {.width = 320, .height = 180}));
    }
    test::expect_matches_golden(test::sheet_of(tiles, 3), "square-hours");
}

} // namespace
} // namespace estampe
