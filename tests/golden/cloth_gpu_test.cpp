// SPDX-License-Identifier: MIT
// A contact sheet of cloth in its set-ups, which the documentation shows.
#include <gtest/gtest.h>

#include "golden/golden.hpp"
#include "set_ups.hpp"
#include "support/gpu_device.hpp"

namespace estampe {
namespace {

TEST(ClothSheet, SetUps)
{
    std::vector<Image> tiles;
    for (const std::string& name : set_up_names()) {
        if (name == "curtain") { // whose folds the last bit of a float decides
            continue;
        }
        const ClothScene set_up = make_set_up(name, 0.5F);
        Style style = Style::load("chirico");
        for (const std::string& assignment : set_up.style) {
            style.set(assignment);
        }
        style.set("paper.height_mm=56");
        style.set("cloth.settle_s=2");
        style.set("paper.margin_mm=0");
        style.set("paper.border_mm=0");
        Renderer& renderer = test::shared_renderer();
        renderer.set_scene(set_up.scene);
        tiles.push_back(renderer.render(set_up.camera, style, {.width = 240, .height = 200, .time_s = 1.5}));
    }
    test::expect_matches_golden(test::sheet_of(tiles, 4), "cloth");
}

} // namespace
} // namespace estampe
