// SPDX-License-Identifier: MIT
#include "features/cloth/cloth_solids.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace estampe::features {
namespace {

Scene on_ground(const char* height)
{
    Scene scene;
    scene.terrain = Terrain(
        parse_terrain(fmt::format("[terrain]\nheight = \"h\"\n[nodes]\nh = \"{}\"\n", height), "test"));
    return scene;
}

const std::vector<SheetPlace> one_box{{.box = {.min = {-2.0, 0.0, -1.0}, .max = {1.0, 1.0, 2.5}}}};

TEST(SolidGrids, GroundIsTheTerrainsBelowTheSheets)
{
    const Scene scene = on_ground("2 + sine(7)");
    const glm::dvec3 anchor(128.0, 0.5, -64.0);
    SolidGrids grids(scene);
    EXPECT_FALSE(grids.ground());
    ASSERT_TRUE(grids.follow_ground(scene, one_box, anchor, 0.0));
    ASSERT_TRUE(grids.ground());
    const cloth::SolidGrid& grid = grids.grids().at(grids.ground()->grid);
    EXPECT_LE(grid.centre_m.x - grid.half_m.x, -3.0F);
    EXPECT_GE(grid.centre_m.z + grid.half_m.z, 3.5F);
    for (uint32_t z = 0; z < grid.nodes.z; z += 3) {
        for (uint32_t x = 0; x < grid.nodes.x; x += 3) {
            const glm::dvec2 share = 2.0 * glm::dvec2(x, z) / glm::dvec2(grid.nodes.x - 1, grid.nodes.z - 1);
            const glm::dvec3 at = anchor + glm::dvec3(grid.centre_m) +
                                  glm::dvec3(grid.half_m) * glm::dvec3(share.x - 1.0, 0.0, share.y - 1.0);
            const double height_m = scene.terrain->sample(at.x, at.z).height_m - anchor.y;
            ASSERT_NEAR(grid.values_m[z * grid.nodes.x + x], height_m, 1e-5);
        }
    }
}

TEST(SolidGrids, GroundIsSampledAnewWhereItIsAnother)
{
    Scene scene = on_ground("time + x");
    SolidGrids grids(scene);
    EXPECT_TRUE(grids.follow_ground(scene, one_box, {}, 0.0));
    EXPECT_FALSE(grids.follow_ground(scene, one_box, {}, 0.3)); // within the same half second
    EXPECT_TRUE(grids.follow_ground(scene, one_box, {}, 0.6));
    EXPECT_TRUE(grids.follow_ground(scene, one_box, {64.0, 0.0, 0.0}, 0.6));
    EXPECT_FALSE(grids.follow_ground(scene, one_box, {64.0, 0.0, 0.0}, 0.6));
    scene.terrain = on_ground("time + x").terrain;
    EXPECT_TRUE(grids.follow_ground(scene, one_box, {64.0, 0.0, 0.0}, 0.6));
    EXPECT_FALSE(SolidGrids().follow_ground(Scene{}, one_box, {}, 0.0));
}

/// A sheet high above the ground cannot touch it, so the ground is not sampled.
TEST(SolidGrids, GroundIsNearWhereSheetsMayComeDown)
{
    const Scene scene = on_ground("2 + 0.5 * x");
    const auto flag_at = [](double low_m) {
        return std::vector<SheetPlace>{
            {.box = {.min = {-1.0, low_m + 1.0, -1.0}, .max = {1.0, low_m + 2.0, 1.0}},
             .stays_in = Bounds{.min = {-2.0, low_m, -2.0}, .max = {2.0, low_m + 3.0, 2.0}}}};
    };
    SolidGrids grids(scene);
    EXPECT_FALSE(grids.follow_ground(scene, flag_at(5.0), {}, 0.0)) << "the ground is 3 m high below";
    EXPECT_FALSE(grids.ground());
    auto both = flag_at(5.0);
    both.push_back(flag_at(2.5).front());
    both.back().box.min.x = -30.0; // so that the sheets' common box changes
    EXPECT_TRUE(grids.follow_ground(scene, both, {}, 0.0));
    ASSERT_TRUE(grids.ground());
    const cloth::SolidGrid& grid = grids.grids().at(grids.ground()->grid);
    EXPECT_EQ(grid.values_m.front(), -1e4F) << "far from where the sheet stays";
    EXPECT_NEAR(grid.values_m.at(grid.values_m.size() - 1), 2.0 + 0.5 * 2.0, 0.05);
    both.pop_back();
    EXPECT_FALSE(grids.follow_ground(scene, both, {}, 0.0));
    EXPECT_FALSE(grids.ground()) << "it is far again";
    EXPECT_TRUE(grids.follow_ground(scene, flag_at(2.5), {}, 0.0)) << "let down in its place";
}

TEST(SolidGrids, MirroredMeshesAreMirrored)
{
    Scene scene;
    // A roof higher at +x: four corners and a ridge.
    scene.meshes.push_back(
        {.primitives = {{.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {1, 2, 0}},
                         .indices = {0, 1, 2, 0, 2, 3, 0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0}}}});
    scene.nodes.push_back({.mesh = 0, .collider = ClothCollider::mesh});
    const SolidGrids grids(scene);
    const auto is_within = [&](const cloth::Solid& solid, const glm::vec3& place) {
        const cloth::SolidGrid& grid = grids.grids().at(solid.grid);
        const glm::vec3 own = glm::inverse(solid.rotation) * (place - solid.centre_m);
        const glm::uvec3 node(glm::round((0.5F + 0.5F * own / solid.half_m) * glm::vec3(grid.nodes - 1U)));
        return grid.values_m.at((node.z * grid.nodes.y + node.y) * grid.nodes.x + node.x) < 0.0F;
    };
    glm::dmat4 place(1.0);
    place[3] = {5.0, 0.0, 0.0, 1.0};
    const auto plain = grids.placed_mesh(0, place);
    place[0] = -place[0];
    const auto mirrored = grids.placed_mesh(0, place);
    ASSERT_TRUE(plain && mirrored);
    EXPECT_TRUE(is_within(*plain, {5.7F, 0.8F, 0.0F}));
    EXPECT_FALSE(is_within(*plain, {4.3F, 0.8F, 0.0F}));
    EXPECT_FALSE(is_within(*mirrored, {5.7F, 0.8F, 0.0F}));
    EXPECT_TRUE(is_within(*mirrored, {4.3F, 0.8F, 0.0F}));
    EXPECT_FALSE(grids.placed_mesh(7, place));
}

} // namespace
} // namespace estampe::features
