// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

/// The triangles, each rotated to start at its smallest index.
std::vector<std::array<uint32_t, 3>> rotated(const Primitive& primitive)
{
    std::vector<std::array<uint32_t, 3>> triangles;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::array<uint32_t, 3> corners = {primitive.indices[i], primitive.indices[i + 1],
                                           primitive.indices[i + 2]};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        triangles.push_back(corners);
    }
    return triangles;
}

TEST(AgreeWinding, TorusOfMixedOrderIsAsBefore)
{
    // The torus has seams, where positions are equal but vertices are not.
    Primitive torus = shapes::torus(1.0F, 0.4F);
    torus.normals.clear();
    torus.uvs[0].clear();
    share_vertices(torus);
    const Primitive before = torus;
    torus.edge_marks.assign(torus.indices.size() / 3, 0);
    std::mt19937 random(7);
    size_t flipped = 0;
    for (size_t i = 0; i < torus.indices.size(); i += 3) {
        torus.edge_marks[i / 3] = 1;
        if (random() % 10 < 4) {
            std::swap(torus.indices[i + 1], torus.indices[i + 2]);
            torus.edge_marks[i / 3] = 4;
            ++flipped;
        }
    }
    std::vector<std::string> warnings;
    agree_winding(torus, "ring", warnings);
    EXPECT_EQ(rotated(torus), rotated(before));
    EXPECT_EQ(torus.edge_marks, std::vector<uint8_t>(torus.indices.size() / 3, 1));
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0], "mesh \"ring\": " + std::to_string(flipped) +
                               " triangles ran against their neighbours, turned");
    EXPECT_EQ(agree_winding(torus), 0U);
    EXPECT_EQ(torus.positions, before.positions);
}

TEST(AgreeWinding, MeshesWithoutNormalsAreMendedSo)
{
    Primitive torus = shapes::torus(1.0F, 0.4F);
    torus.normals.clear();
    for (size_t i = 0; i < torus.indices.size(); i += 9)
        std::swap(torus.indices[i + 1], torus.indices[i + 2]);
    std::vector<std::string> warnings;
    mend_primitive(torus, "ring", warnings);
    EXPECT_EQ(warnings.size(), 1U);
    EXPECT_EQ(agree_winding(torus), 0U);
}

TEST(AgreeWinding, AStripWithOneSideStays)
{
    Primitive strip;
    constexpr uint32_t count = 24;
    for (uint32_t i = 0; i < count; ++i) {
        const float turn = 6.2831853F * static_cast<float>(i) / count;
        for (const float across : {-0.3F, 0.3F}) {
            const float radius = 1.0F + across * std::cos(turn / 2.0F);
            strip.positions.emplace_back(radius * std::cos(turn), across * std::sin(turn / 2.0F),
                                         radius * std::sin(turn));
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        const bool last = i + 1 == count;
        const uint32_t a = 2 * i;
        const uint32_t c = last ? 1 : a + 2;
        const uint32_t d = last ? 0 : a + 3;
        strip.indices.insert(strip.indices.end(), {a, a + 1, c, a + 1, d, c});
    }
    const std::vector<uint32_t> before = strip.indices;
    EXPECT_EQ(agree_winding(strip), 0U);
    EXPECT_EQ(strip.indices, before);
}

TEST(AgreeWinding, EdgesOfManyTrianglesPartPieces)
{
    // Three triangles on one edge, and a triangle with its own copy.
    Primitive wings;
    wings.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}};
    wings.indices = {0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 4};
    const std::vector<uint32_t> before = wings.indices;
    EXPECT_EQ(agree_winding(wings), 0U);
    EXPECT_EQ(wings.indices, before);
}

} // namespace
} // namespace estampe
