// SPDX-License-Identifier: MIT
// Which bodies are round, so that strokes follow their form.
#include "techniques/pose/mesh_data.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

namespace estampe::pose {
namespace {

TEST(IsRound, OfBodiesThatCurveAllAround)
{
    EXPECT_TRUE(is_round(shapes::sphere(1.0F)));
    EXPECT_TRUE(is_round(shapes::sphere(1.0F, 8, 6)));
    std::array<glm::vec2, 16> vase{};
    for (size_t i = 0; i < vase.size(); ++i) {
        const float height = static_cast<float>(i) / 15.0F;
        vase.at(i) = {0.4F + 0.3F * std::sin(6.0F * height), 1.5F * height};
    }
    EXPECT_TRUE(is_round(shapes::lathe(vase)));
}

TEST(IsRound, NotOfFlatRuledOrSlightlyBentOnes)
{
    EXPECT_FALSE(is_round(shapes::box(glm::vec3(1.0F))));
    EXPECT_FALSE(is_round(shapes::cylinder(1.0F, 3.0F)));
    EXPECT_FALSE(is_round(shapes::cone(1.0F, 2.0F)));
    Primitive sheet = shapes::plane(2.0F, 2.0F, 16);
    for (size_t i = 0; i < sheet.positions.size(); ++i) {
        glm::vec3& place = sheet.positions[i];
        place.y = 0.1F * (place.x * place.x + place.z * place.z);
        sheet.normals[i] = glm::normalize(glm::vec3(-0.2F * place.x, 1.0F, -0.2F * place.z));
    }
    EXPECT_FALSE(is_round(sheet));
    std::array<glm::vec2, 12> threads{}; // a screw: every second ring of its round body is a hard edge
    for (size_t i = 0; i < threads.size(); ++i) {
        const float height = static_cast<float>(i) / 11.0F;
        threads.at(i) = {0.3F + std::sin(3.0F * height) + (i % 2 == 0 ? 0.2F : 0.0F), 3.0F * height};
    }
    EXPECT_FALSE(is_round(shapes::lathe(threads)));
    Primitive bare = shapes::sphere(1.0F);
    bare.normals.clear();
    EXPECT_FALSE(is_round(bare));
    EXPECT_FALSE(is_round(Primitive{}));
}

} // namespace
} // namespace estampe::pose
