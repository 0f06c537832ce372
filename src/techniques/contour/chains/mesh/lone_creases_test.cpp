// SPDX-License-Identifier: MIT
// Which folds of a mesh get lines: those of a shape, and not those of single triangles.
#include "techniques/contour/chains/mesh/lone_creases.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "techniques/contour/chains/mesh/feature_chains.hpp"

namespace estampe::contour {
namespace {

/// A square of cells with smooth shading whose heights a function gives.
template <class Height>
Primitive relief(uint32_t cells, const Height& height)
{
    Primitive result = shapes::plane(2.0F, 2.0F, cells);
    for (glm::vec3& position : result.positions) {
        position.y = height(position.x, position.z);
    }
    return result;
}

/// Lengths of the creases of a mesh with `crease_deg` degrees at least, of which the shading breaks
/// everywhere.
std::vector<float> crease_lengths(const Primitive& primitive, float crease_deg = 30.0F)
{
    std::vector<glm::uvec4> triangles;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::vec3 a = primitive.positions[primitive.indices[i]];
        const glm::vec3 b = primitive.positions[primitive.indices[i + 1]];
        const glm::vec3 c = primitive.positions[primitive.indices[i + 2]];
        const auto first = static_cast<uint32_t>(positions.size());
        triangles.emplace_back(first, first + 1, first + 2, 0U);
        positions.insert(positions.end(), {a, b, c});
        normals.insert(normals.end(), 3, glm::normalize(glm::cross(b - a, c - a)));
    }
    const std::vector<uint32_t> zeros(triangles.size(), 0);
    const EdgeMesh mesh = build_edge_mesh({triangles, positions, positions, normals, zeros, zeros, {}});
    const FeatureChains chains =
        string_features(mesh, positions, {.crease_deg = crease_deg, .borders = false, .marked = false});
    std::vector<float> lengths;
    for (const shared::FeatureChain& chain : chains.chains) {
        float length = 0.0F;
        for (uint32_t i = 1; i < chain.point_count; ++i) {
            length += glm::distance(positions[chains.points[chain.first_point + i].vertex],
                                    positions[chains.points[chain.first_point + i - 1].vertex]);
        }
        lengths.push_back(length);
    }
    return lengths;
}

TEST(LoneCreases, ARoofKeepsItsRidge)
{
    const std::vector<float> lengths =
        crease_lengths(relief(16, [](float x, float) { return -std::abs(x); }));
    ASSERT_EQ(lengths.size(), 1U);
    EXPECT_NEAR(lengths[0], 2.0F, 1e-4F);
}

TEST(LoneCreases, ACreaseThatFadesOutIsKept)
{
    const std::vector<float> lengths =
        crease_lengths(relief(16, [](float x, float z) { return -0.5F * std::abs(x) * (1.0F - z); }));
    ASSERT_EQ(lengths.size(), 1U);
    EXPECT_NEAR(lengths[0], 1.46F, 0.13F); // up to where the roof folds by 30 degrees, to one edge
}

TEST(LoneCreases, OfARoughPlaneNoneAreLeft)
{
    constexpr uint32_t cells = 64;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> share(-0.3F, 0.3F);
    const Primitive rough = relief(cells, [&](float, float) { return share(random) * 2.0F / cells; });
    EXPECT_LE(crease_lengths(rough, 60.0F).size(), 3U); // hundreds of its 12,000 edges fold by 60 degrees
}

TEST(LoneCreases, ASliverDoesNotFoldASurface)
{
    // Two squares in one plane. Between them lies a sliver that is turned over.
    const glm::vec3 low(0.0F, 0.0F, -1.0F);
    const glm::vec3 high(0.0F, 0.0F, 1.0F);
    const glm::vec3 apex(-0.01F, 0.0F, 0.0F);
    Primitive primitive;
    primitive.positions = {low, high, apex, {-1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, -1.0F}, {1.0F, 0.0F, 1.0F}};
    primitive.indices = {0, 3, 1, 1, 0, 2, 0, 2, 4, 2, 1, 5, 2, 5, 4};
    std::swap(primitive.indices[4], primitive.indices[5]);
    EXPECT_TRUE(crease_lengths(primitive).empty());
}

} // namespace
} // namespace estampe::contour
