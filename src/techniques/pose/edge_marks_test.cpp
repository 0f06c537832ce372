// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

/// Two primitives of two triangles each: the first transparent and marked, the second opaque.
Scene sheets(bool are_marked)
{
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.meshes.resize(1);
    for (const Index material : {0U, 1U}) {
        Primitive sheet = shapes::plane(1.0F, 1.0F, 1);
        sheet.material = material;
        scene.meshes[0].primitives.push_back(sheet);
    }
    scene.meshes[0].primitives[0].edge_marks =
        are_marked ? std::vector<uint8_t>{5, 3} : std::vector<uint8_t>{};
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.roots = {0};
    return scene;
}

TEST(EdgeMarks, GoWithTheirTrianglesHoweverThoseAreSorted)
{
    // Opaque triangles come first, then transparent ones, then the ground.
    const MeshData meshes = build_meshes(sheets(true), 1);
    EXPECT_EQ(meshes.edge_marks, (std::vector<uint8_t>{0, 0, marks_edges | 5, marks_edges | 3, 0, 0}));
    EXPECT_TRUE(build_meshes(sheets(false), 1).edge_marks.empty());
}

} // namespace
} // namespace estampe::pose
