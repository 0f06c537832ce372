// SPDX-License-Identifier: MIT
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "techniques/terrain/mesh/mesh_method.hpp"

namespace estampe::terrain {
namespace {

using Edge = std::array<std::pair<float, float>, 2>;

std::pair<float, float> key(const glm::vec2& p)
{
    return {p.x, p.y};
}

/// Signed double area in the plane, positive for counter-clockwise from above (x right, z down).
double area2(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c)
{
    const glm::dvec2 p(b - a), q(c - a);
    return p.y * q.x - p.x * q.y;
}

/// A hash of an edge, which changes its sign with the edge's direction.
uint64_t signed_hash(const glm::ivec2& from, const glm::ivec2& to)
{
    const auto mixed = [](uint64_t bits) {
        bits = (bits ^ (bits >> 31U)) * 0x9E3779B97F4A7C15U;
        bits = (bits ^ (bits >> 29U)) * 0xBF58476D1CE4E5B9U;
        return bits ^ (bits >> 32U);
    };
    const auto word = [](const glm::ivec2& p) {
        return uint64_t{static_cast<uint32_t>(p.x)} << 32U | static_cast<uint32_t>(p.y);
    };
    return mixed(word(from) + mixed(word(to))) - mixed(word(to) + mixed(word(from)));
}

/// Every inner edge has a triangle on either side, with equal corners. The other edges form one closed
/// border.
TEST(Rings, HaveNoCracksWhereverTheEyeIs)
{
    const auto method = mesh_method({.cell_m = 0.25F, .cells = 32, .reach_m = 100.0F});
    const MeshTopology mesh = method->topology();
    for (int camera = 0; camera < 400; ++camera) {
        const glm::dvec2 eye(1000.0 * std::sin(camera * 12.9898), 1000.0 * std::cos(camera * 78.233));
        const auto levels = method->place({.eye_m = eye}, {64.0, -128.0});
        std::map<Edge, int> edges;
        double area = 0.0;
        for (const glm::uvec3& triangle : mesh.triangles) {
            glm::vec2 corner[3];
            for (int i = 0; i < 3; ++i) {
                corner[i] = vertex_place(mesh.vertices[triangle[i]], levels);
            }
            const double part = area2(corner[0], corner[1], corner[2]);
            ASSERT_GT(part, 0.0);
            area += 0.5 * part;
            for (int i = 0; i < 3; ++i) {
                const auto from = key(corner[i]);
                const auto to = key(corner[(i + 1) % 3]);
                edges[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
            }
        }
        const shared::TerrainLevel& last = levels.back();
        const double side = 32.0 * static_cast<double>(last.cell_m);
        EXPECT_NEAR(area, side * side, 1e-6 * side * side);
        int open = 0;
        for (const auto& [edge, sum] : edges) {
            ASSERT_LE(std::abs(sum), 1);
            open += std::abs(sum);
        }
        EXPECT_EQ(open, 4 * 32) << "only the outermost border is open";
    }
}

/// Tests ten thousand eye positions by sums. Edges with opposite directions cancel, so that the sum over all
/// triangles equals the sum over the outermost border. Positions are whole multiples of half the finest cell.
TEST(Rings, HaveNoCracksFromTenThousandEyes)
{
    const auto method = mesh_method({.cell_m = 0.25F, .cells = 32, .reach_m = 30.0F});
    const MeshTopology mesh = method->topology();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-1e6, 1e6);
    std::vector<glm::ivec2> places(mesh.vertices.size());
    for (int camera = 0; camera < 10000; ++camera) {
        const glm::dvec2 eye(anywhere(random), anywhere(random));
        const glm::dvec2 anchor = 64.0 * glm::round(eye / 64.0);
        const auto levels = method->place({.eye_m = eye}, anchor);
        std::ranges::transform(mesh.vertices, places.begin(), [&](uint32_t vertex) {
            return glm::ivec2(glm::round(8.0F * vertex_place(vertex, levels)));
        });
        uint64_t sum = 0;
        for (const glm::uvec3& triangle : mesh.triangles) {
            for (int i = 0; i < 3; ++i) {
                sum += signed_hash(places[triangle[i]], places[triangle[(i + 1) % 3]]);
            }
        }
        const shared::TerrainLevel& last = levels.back();
        const glm::ivec2 corner(glm::round(8.0F * last.origin_m));
        const int cell = static_cast<int>(8.0F * last.cell_m);
        for (int i = 0; i < 32; ++i) {
            const auto border = [&](glm::ivec2 from, glm::ivec2 to) {
                sum -= signed_hash(corner + cell * from, corner + cell * to);
            };
            border({i, 32}, {i + 1, 32}); // counter-clockwise from above, where z points down
            border({i + 1, 0}, {i, 0});
            border({0, i}, {0, i + 1});
            border({32, i + 1}, {32, i});
        }
        ASSERT_EQ(sum, 0U) << eye.x << " " << eye.y;
    }
}

TEST(Rings, VerticesKeepTheirPlaces)
{
    const auto method = mesh_method({.cell_m = 0.5F, .cells = 32, .reach_m = 60.0F});
    const MeshTopology mesh = method->topology();
    for (int step = 0; step < 200; ++step) {
        const glm::dvec2 eye(0.37 * step, -0.11 * step);
        const auto levels = method->place({.eye_m = eye}, {0.0, 0.0});
        for (const uint32_t vertex : mesh.vertices) {
            const glm::vec2 place = vertex_place(vertex, levels) / levels[vertex >> 28U].cell_m;
            ASSERT_EQ(place, glm::round(place));
        }
        // The eye is in the middle, where the finest cells are.
        EXPECT_LE(std::abs(levels[0].eye_cells.x - 17.0F), 1.0F);
        EXPECT_LE(std::abs(levels[0].eye_cells.y - 17.0F), 1.0F);
    }
}

TEST(Rings, ReachAsFarAsIsAsked)
{
    for (const float reach_m : {50.0F, 1000.0F, 20000.0F}) {
        const auto levels = mesh_method({.reach_m = reach_m})->place({}, {});
        const shared::TerrainLevel& last = levels.back();
        EXPECT_LE(last.origin_m.x, -reach_m);
        EXPECT_GE(last.origin_m.x + 128.0F * last.cell_m, reach_m);
    }
}

TEST(Grid, LiesBeforeTheEyeAndTurnsByRightAngles)
{
    const auto method = mesh_method({.method = TerrainMesh::grid, .cell_m = 1.0F, .cells = 64});
    const auto ahead = method->place({.eye_m = {10.3, 20.7}, .ahead = {3.0, 1.0}}, {0.0, 0.0});
    EXPECT_EQ(ahead[0].origin_m, glm::vec2(10.0F - 16.0F, 20.0F - 32.0F));
    const auto behind = method->place({.eye_m = {10.3, 20.7}, .ahead = {-3.0, 1.0}}, {0.0, 0.0});
    EXPECT_EQ(behind[0].origin_m, glm::vec2(10.0F - 48.0F, 20.0F - 32.0F));
    const auto across = method->place({.eye_m = {10.9, 20.1}, .ahead = {1.0, 3.0}}, {0.0, 0.0});
    EXPECT_EQ(across[0].origin_m, glm::vec2(10.0F - 32.0F, 20.0F - 16.0F));
}

} // namespace
} // namespace estampe::terrain
