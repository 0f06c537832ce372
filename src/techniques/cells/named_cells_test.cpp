// SPDX-License-Identifier: MIT
// Nodes without a mesh that are named cell... and portal... divide a scene into rooms.
#include <gtest/gtest.h>

#include "techniques/cells/cells.hpp"

namespace estampe::cells {
namespace {

Node& add_node(Scene& scene, const char* name, const glm::dvec3& middle, const glm::dvec3& scale)
{
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.transform.translation = middle;
    node.transform.scale = scale;
    return node;
}

TEST(NamedCells, AreTheBoxesOfEmptyNodes)
{
    Scene scene;
    add_node(scene, "cell front", {0, 1.5, -2}, {2, 1.5, 2});
    add_node(scene, "cell back", {0, 1.5, -6}, {2, 1.5, 2});
    add_node(scene, "portal.001", {0, 1, -4}, {0.5, 1, 0.1});
    add_node(scene, "portal out", {0, 1, -8}, {0.5, 1, 0});
    add_node(scene, "portal nowhere", {0, 1, -2}, {0.5, 1, 0.1});
    add_node(scene, "cell flat", {0, 1.5, -2}, {2, 0, 2});
    add_node(scene, "Cell of another meaning", {0, 0, 0}, {1, 1, 1});
    add_node(scene, "cellar", {0, 0, 0}, {1, 1, 1}).mesh = 0;
    add_node(scene, "cell hidden", {0, 0, 0}, {1, 1, 1}).visible = false;
    const NamedCells named = named_cells(scene);
    ASSERT_EQ(named.cells.size(), 2U);
    EXPECT_EQ(named.cells[0].low_m, glm::dvec3(-2, 0, -4));
    EXPECT_EQ(named.cells[0].high_m, glm::dvec3(2, 3, 0));
    ASSERT_EQ(named.portals.size(), 2U);
    EXPECT_EQ(std::minmax(named.portals[0].from, named.portals[0].to), std::minmax(Index{0}, Index{1}));
    EXPECT_EQ(std::minmax(named.portals[1].from, named.portals[1].to), std::minmax(Index{1}, no_index));
    for (const glm::dvec3& corner : named.portals[0].corners_m) {
        EXPECT_EQ(std::abs(corner.x), 0.5);
        EXPECT_EQ(std::abs(corner.y - 1.0), 1.0);
        EXPECT_EQ(corner.z, -4.0);
    }
    EXPECT_EQ(named.notes.size(), 2U);
    scene.cells = named.cells;
    scene.portals = named.portals;
    check_cells(scene);
}

TEST(NamedCells, TurnWithTheirNodes)
{
    Scene scene;
    add_node(scene, "cell", {0, 0, 0}, {1, 1, 1});
    Node& door = add_node(scene, "portal", {1, 0, 0}, {0.5, 0.5, 0.01});
    door.transform.rotation = glm::angleAxis(1.5707963267948966, glm::dvec3(0.0, 1.0, 0.0));
    const NamedCells named = named_cells(scene);
    ASSERT_EQ(named.portals.size(), 1U);
    for (const glm::dvec3& corner : named.portals[0].corners_m) {
        EXPECT_NEAR(corner.x, 1.0, 1e-9) << "the cube's short side now lies along x";
    }
    EXPECT_TRUE(named_cells(Scene()).cells.empty());
}

} // namespace
} // namespace estampe::cells
