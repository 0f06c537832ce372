// SPDX-License-Identifier: MIT
// The number of a primitive's layers behind each other, against rays through the primitive.
#include <algorithm>
#include <random>

#include <glm/gtc/random.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

constexpr uint32_t enough = 4;

void append(Primitive& to, const Primitive& from, const glm::vec3& offset)
{
    const auto first = static_cast<uint32_t>(to.positions.size());
    for (const glm::vec3& position : from.positions) {
        to.positions.push_back(position + offset);
    }
    for (const uint32_t index : from.indices) {
        to.indices.push_back(first + index);
    }
}

Primitive several(const std::vector<std::pair<Primitive, glm::vec3>>& parts)
{
    Primitive whole;
    for (const auto& [part, offset] : parts) {
        append(whole, part, offset);
    }
    return whole;
}

/// A sheet folded once, visible from both sides of the fold.
Primitive folded()
{
    Primitive primitive;
    primitive.positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0},
                           {1, 0, 1},  {1, 1, 1}, {2, 0, 0}, {2, 1, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2, 4, 6, 7, 4, 7, 5};
    return primitive;
}

TEST(Sheets, AFlatPartIsOneAndAConvexOneHasAFrontAndABack)
{
    const Primitive quad = shapes::quad(2.0F, 1.0F);
    const Primitive ball = shapes::sphere(0.5F);
    EXPECT_EQ(most_sheets(quad, false, enough), 1U);
    EXPECT_EQ(most_sheets(quad, true, enough), 1U);
    EXPECT_EQ(most_sheets(ball, false, enough), 1U);
    EXPECT_EQ(most_sheets(ball, true, enough), 2U);
    EXPECT_EQ(most_sheets(several({{quad, glm::vec3(0)}, {quad, glm::vec3(0, 0, 1)}}), true, enough), 2U);
    EXPECT_EQ(most_sheets(several({{quad, glm::vec3(0)}, {ball, glm::vec3(0, 0, 1)}}), true, enough), 3U);
    EXPECT_EQ(most_sheets(folded(), true, enough), enough);
}

TEST(Sheets, OfWhatBendsNothingIsKnown)
{
    Primitive skinned = shapes::quad(2.0F, 1.0F);
    skinned.joints_0.assign(skinned.positions.size(), glm::u16vec4(0));
    EXPECT_EQ(most_sheets(skinned, false, enough), enough);
    Primitive morphed = shapes::quad(2.0F, 1.0F);
    morphed.morph_targets.emplace_back();
    EXPECT_EQ(most_sheets(morphed, false, enough), enough);
}

/// Number of triangles that a line hits, on their fronts or on either side.
uint32_t met(const Primitive& primitive, const glm::vec3& from, const glm::vec3& direction, bool two_sided)
{
    uint32_t count = 0;
    for (size_t i = 0; i < primitive.indices.size(); i += 3) {
        const glm::vec3 a = primitive.positions[primitive.indices[i]] - from;
        const glm::vec3 b = primitive.positions[primitive.indices[i + 1]] - from;
        const glm::vec3 c = primitive.positions[primitive.indices[i + 2]] - from;
        const float u = glm::dot(direction, glm::cross(b, a));
        const float v = glm::dot(direction, glm::cross(c, b));
        const float w = glm::dot(direction, glm::cross(a, c));
        count += (u > 0 && v > 0 && w > 0) || (two_sided && u < 0 && v < 0 && w < 0) ? 1 : 0;
    }
    return count;
}

TEST(Sheets, NoLineMeetsMore)
{
    std::mt19937 random(1); // NOLINT(cert-msc51-cpp)
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    const auto point = [&] { return glm::vec3(place(random), place(random), place(random)); };
    const std::vector<Primitive> primitives{
        shapes::quad(2.0F, 1.0F), shapes::sphere(0.7F), folded(),
        several({{shapes::sphere(0.4F), glm::vec3(0, 0, 0.5F)}, {shapes::quad(2.0F, 2.0F), glm::vec3(0)}})};
    for (const Primitive& primitive : primitives) {
        for (const bool two_sided : {false, true}) {
            const uint32_t sheets = most_sheets(primitive, two_sided, enough);
            uint32_t most = 0;
            for (int i = 0; i < 2000; ++i) {
                const glm::vec3 from = 3.0F * point();
                most = std::max(most, met(primitive, from, 0.5F * point() - from, two_sided));
            }
            EXPECT_LE(most, sheets);
            EXPECT_GE(most, 1U);
        }
    }
}

} // namespace
} // namespace estampe::pose
