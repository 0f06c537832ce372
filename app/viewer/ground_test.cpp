// SPDX-License-Identifier: MIT
#include "viewer/camera_rig.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

namespace estampe::viewer {
namespace {

TEST(Ground, IsTheFirstSurfaceBelow)
{
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.resize(1);
    Primitive stairs;
    stairs.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {0, 2, -1}, {0, 2, 1}, {1, 2, 1}};
    stairs.normals.assign(6, {0, 1, 0});
    stairs.indices = {0, 1, 2, 3, 4, 5};
    scene.meshes[0].primitives.push_back(stairs);
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].transform.translation = {1000.0, 5.0, 0.0};
    scene.roots = {0};
    const Ground ground(scene);
    const auto near_to = [](std::optional<double> height, double wanted) {
        return height && std::abs(*height - wanted) < 1e-3;
    };
    EXPECT_TRUE(near_to(ground.height_under({999.5, 9.0, 0.5}), 5.0));
    EXPECT_TRUE(near_to(ground.height_under({1000.2, 9.0, 0.9}), 7.0));
    EXPECT_TRUE(near_to(ground.height_under({1000.2, 6.0, 0.9}), 5.0)) << "what is overhead is no ground";
    EXPECT_FALSE(ground.height_under({1003.0, 9.0, 0.0}));
    EXPECT_FALSE(ground.height_under({999.5, 4.0, 0.5}));
}

} // namespace
} // namespace estampe::viewer
