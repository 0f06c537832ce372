// SPDX-License-Identifier: MIT
// Position of the smoke's box, and its solid cells.
#include "features/smoke/smoke_air.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "features/smoke/rising_smoke.hpp"

namespace estampe::features {
namespace {

Scene one_triangle(const std::array<glm::vec3, 3>& corners)
{
    Scene scene;
    scene.materials.emplace_back();
    Primitive primitive{.positions = {corners.begin(), corners.end()}, .indices = {0, 1, 2}};
    scene.meshes.push_back({.primitives = {primitive}});
    scene.nodes.push_back({.mesh = 0});
    scene.roots = {0};
    return scene;
}

TEST(SmokeObstacles, AreNoCloth)
{
    Scene scene = one_triangle({glm::vec3(1.0F), {5.0F, 1.0F, 2.0F}, {1.0F, 6.0F, 3.0F}});
    const smoke::Box box{.cells = glm::uvec3(8)};
    const auto touched = [&] {
        const auto cells = standing_cells(scene, pose_scene(scene, 0.0), glm::dvec3(0.0), box);
        return std::ranges::count(cells, 1);
    };
    EXPECT_GT(touched(), 10);
    scene.nodes[0].cloth = Cloth{};
    EXPECT_EQ(touched(), 0);
}

TEST(SmokeObstacles, AreAllCellsThatATriangleTouchesAndNoOther)
{
    constexpr uint32_t side = 12;
    const smoke::Box box{.cells = glm::uvec3(side)};
    std::mt19937 random(11);
    const auto number = [&] { return 16.0F * static_cast<float>(random()) / 4294967295.0F - 2.0F; };
    for (int round = 0; round < 40; ++round) {
        std::array<glm::vec3, 3> corners;
        for (glm::vec3& corner : corners) {
            corner = {number(), number(), number()};
        }
        const Scene scene = one_triangle(corners);
        const auto cells = standing_cells(scene, pose_scene(scene, 0.0), glm::dvec3(0.0), box);
        std::vector<glm::vec3> points;
        constexpr int steps = 150;
        for (int i = 0; i <= steps; ++i) {
            for (int k = 0; k <= steps - i; ++k) {
                const float u = static_cast<float>(i) / steps;
                const float v = static_cast<float>(k) / steps;
                const glm::vec3 point =
                    corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
                if (glm::all(glm::greaterThanEqual(point, glm::vec3(0.0F))) &&
                    glm::all(glm::lessThan(point, glm::vec3(side)))) {
                    points.push_back(point);
                }
            }
        }
        std::vector<uint8_t> sampled(cells.size());
        for (const glm::vec3& point : points) {
            const glm::uvec3 cell(point);
            sampled[(size_t{cell.z} * side + cell.y) * side + cell.x] = 1;
        }
        for (size_t i = 0; i < cells.size(); ++i) {
            EXPECT_GE(cells[i], sampled[i]);
            if (cells[i] > sampled[i]) { // missed by the samples, which are near it
                const glm::vec3 middle = glm::vec3(i % side, i / side % side, i / (side * side)) + 0.5F;
                const bool is_near = std::ranges::any_of(points, [&](const glm::vec3& point) {
                    const glm::vec3 off = glm::abs(point - middle);
                    return std::max({off.x, off.y, off.z}) < 0.5F + 0.16F;
                });
                const bool is_at_rim = glm::any(glm::lessThan(middle, glm::vec3(1.0F))) ||
                                       glm::any(glm::greaterThan(middle, glm::vec3(side - 1)));
                EXPECT_TRUE(is_near || is_at_rim) << i;
            }
        }
    }
}

TEST(SmokeBox, StandsOnItsNodeInWholeCells)
{
    Scene scene;
    Node node{.name = "smoke 1"};
    node.transform.translation = {100.0, 5.0, -3.0};
    node.transform.rotation = glm::angleAxis(0.7, glm::dvec3(0.0, 1.0, 0.0));
    node.transform.scale = {1.1, 4.0, 0.9};
    scene.nodes = {Node{.name = "smoke with a mesh", .mesh = 0}, node};
    scene.roots = {0, 1};
    const ScenePose pose{.world_from_node = {glm::dmat4(1.0), node.transform.matrix()}, .morph_weights = {}};
    const glm::dvec3 anchor(90.0, 0.0, 0.0);
    EXPECT_TRUE(smoke_boxes(scene, pose, anchor, "fog*", 64).empty());
    EXPECT_TRUE(smoke_boxes(scene,
                            {.world_from_node = {glm::dmat4(1.0), glm::dmat4(0.0)}, .morph_weights = {}},
                            anchor, "smoke*", 64)
                    .empty());
    const auto boxes = smoke_boxes(scene, pose, anchor, "smoke*", 64);
    ASSERT_EQ(boxes.size(), 1U);
    const smoke::Box* const box = boxes.data();
    EXPECT_EQ(box->cells, glm::uvec3(16, 64, 16));
    EXPECT_NEAR(box->cell_m, 8.0 / 64.0, 1e-6);
    const auto in_grid = [&](const glm::dvec3& place) {
        return glm::dvec3(box->grid_from_anchor * glm::vec4(glm::vec3(place - anchor), 1.0F));
    };
    EXPECT_LT(glm::distance(in_grid({100.0, 5.0, -3.0}), glm::dvec3(8.0, 0.0, 8.0)), 1e-3);
    EXPECT_LT(glm::distance(in_grid({100.0, 13.0, -3.0}), glm::dvec3(8.0, 64.0, 8.0)), 1e-3);
    const glm::dvec3 right(std::cos(0.7), 0.0, -std::sin(0.7));
    EXPECT_LT(glm::distance(in_grid(glm::dvec3(100.0, 5.0, -3.0) + right), glm::dvec3(16.0, 0.0, 8.0)), 1e-3);
}

TEST(SmokeBox, HasTheNumberOfItsNodeAlsoWhereAnotherIsScaledToNothing)
{
    Scene scene;
    scene.nodes = {Node{.name = "smoke a"}, Node{.name = "fire"}, Node{.name = "smoke b"}};
    scene.roots = {0, 1, 2};
    ScenePose pose{.world_from_node = {glm::dmat4(1.0), glm::dmat4(1.0), glm::dmat4(1.0)},
                   .morph_weights = {}};
    const auto numbers = [&] {
        std::vector<uint32_t> found;
        for (const smoke::Box& box : smoke_boxes(scene, pose, glm::dvec3(0.0), "smoke*", 16)) {
            found.push_back(box.number);
        }
        return found;
    };
    EXPECT_EQ(numbers(), (std::vector<uint32_t>{0, 1}));
    pose.world_from_node[0] = glm::dmat4(0.0);
    EXPECT_EQ(numbers(), (std::vector<uint32_t>{1}));
}

} // namespace
} // namespace estampe::features
