// SPDX-License-Identifier: MIT
// The look, guarded: the example scene in the house's default and in each preset, through the public API
// alone.
#include <filesystem>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>

#include "golden/golden.hpp"
#include "support/files.hpp"
#include "support/gpu_device.hpp"

namespace estampe {
namespace {

class Golden : public testing::TestWithParam<const char*> {};

TEST_P(Golden, SquareLooksAsApproved)
{
    const std::string name = GetParam();
    const Style style = name == "default" ? Style() : Style::load(name);
    const Scene scene = load_scene(test::square_scene());
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Camera camera = scene_camera(scene, pose_scene(scene, 0.0), "square");
    test::expect_matches_golden(renderer.render(camera, style, {.width = 320, .height = 180}),
                                "square-" + name);
}

INSTANTIATE_TEST_SUITE_P(Styles, Golden, testing::Values("default", "comic", "engraving", "pencil", "wash"),
                         [](const auto& named) { return std::string(named.param); });

} // namespace
} // namespace estampe
