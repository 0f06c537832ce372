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

/// A body between two rings of points, without lids. The rings follow a profile in the plane of x and y.
Primitive bar(const std::vector<glm::vec2>& profile)
{
    Primitive result;
    for (const glm::vec2& place : profile) {
        result.positions.emplace_back(place, 0.0F);
        result.positions.emplace_back(place, 2.0F);
    }
    for (uint32_t i = 0; i + 1 < profile.size(); ++i) {
        const uint32_t a = 2 * i;
        result.indices.insert(result.indices.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
    }
    return result;
}

/// A profile whose sections of length 1 turn by one angle after the other.
std::vector<glm::vec2> profile_of_turns(const std::vector<float>& turns_deg)
{
    std::vector<glm::vec2> profile{{0.0F, 0.0F}, {1.0F, 0.0F}};
    float way_deg = 0.0F;
    for (const float turn : turns_deg) {
        way_deg += turn;
        profile.push_back(profile.back() +
                          glm::vec2(std::cos(glm::radians(way_deg)), std::sin(glm::radians(way_deg))));
    }
    return profile;
}

TEST(LoneCreases, FacetsOfARoundShapeHaveNoneAndFlatSidesKeepTheirs)
{
    const auto count = [](const std::vector<float>& turns_deg) {
        return crease_lengths(bar(profile_of_turns(turns_deg)), 25.0F).size();
    };
    EXPECT_EQ(count(std::vector<float>(12, 30.0F)), 0U); // a bar of twelve sides
    EXPECT_EQ(count({30.0F, 30.0F, 30.0F}), 0U);         // a rounded corner
    EXPECT_EQ(count({-35.0F, -20.0F, -35.0F}), 0U);      // a rounded inner corner of uneven facets
    EXPECT_EQ(count(std::vector<float>(8, 45.0F)), 8U);  // a bar of eight sides
    EXPECT_EQ(count({45.0F, 45.0F}), 2U);                // a bevel
    EXPECT_EQ(count({35.0F}), 1U);                       // a wall that turns once
    EXPECT_EQ(count({30.0F, -30.0F}), 2U);               // a step
    EXPECT_EQ(count({30.0F, 90.0F}), 2U);                // an eave beside a corner
}

} // namespace
} // namespace estampe::contour
