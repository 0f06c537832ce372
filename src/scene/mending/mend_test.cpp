// SPDX-License-Identifier: MIT
#include "scene/mending/mend.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/shapes.hpp"

namespace estampe {
namespace {

Primitive bare(Primitive primitive)
{
    primitive.normals.clear();
    primitive.uvs[0].clear();
    share_vertices(primitive);
    return primitive;
}

TEST(Mend, BoxKeepsItsEdgesAndSphereGrowsSmooth)
{
    Primitive box = bare(shapes::box({1, 1, 1}));
    EXPECT_EQ(box.positions.size(), 8U);
    std::vector<std::string> warnings;
    mend_primitive(box, "box", warnings);
    EXPECT_EQ(box.positions.size(), 24U);
    for (const glm::vec3& normal : box.normals)
        EXPECT_NEAR(std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}), 1.0F, 1e-5F);

    Primitive sphere = bare(shapes::sphere(1.0F, 32, 16));
    constexpr size_t places = 15 * 32 + 2;
    mend_primitive(sphere, "sphere", warnings);
    ASSERT_EQ(sphere.positions.size(), places);
    for (size_t i = 0; i < places; ++i)
        EXPECT_GT(glm::dot(sphere.normals[i], sphere.positions[i]), 0.99F);
    EXPECT_TRUE(warnings.empty());
}

TEST(Mend, AveragesWhereVeryManyFacesMeet)
{
    Primitive cone = bare(shapes::cone(1.0F, 0.2F, 500));
    std::vector<std::string> warnings;
    mend_primitive(cone, "cone", warnings);
    for (size_t i = 0; i < cone.positions.size(); ++i)
        if (cone.positions[i].y > 0.1F) {
            EXPECT_NEAR(cone.normals[i].y, 1.0F, 1e-3F);
        }
}

TEST(Mend, DropsFacesWithoutVerticesAndSaysSo)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {0, 1e30F, 0}};
    primitive.indices = {0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5, 0, 1};
    primitive.normals.assign(5, {0, 0, nan});
    primitive.uvs[0] = {{nan, 0}};
    std::vector<std::string> warnings;
    mend_primitive(primitive, "odd", warnings);
    EXPECT_EQ(primitive.indices.size(), 3U);
    EXPECT_EQ(primitive.positions.size(), 3U);
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
    EXPECT_TRUE(primitive.uvs[0].empty());
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_NE(warnings[0].find("\"odd\": 4 faces left out"), std::string::npos) << warnings[0];
}

TEST(CheckStructure, RefusesWhatDoesNotHangTogether)
{
    Scene good;
    good.materials.emplace_back();
    good.meshes.push_back({.name = "", .primitives = {shapes::box({1, 1, 1})}, .morph_weights = {}});
    good.nodes.resize(2);
    good.nodes[0].children = {1};
    good.nodes[1].parent = 0;
    good.nodes[1].mesh = 0;
    good.roots = {0};
    EXPECT_NO_THROW(check_structure(good, "x"));
    const auto expect_refused = [&good](const std::function<void(Scene&)>& spoil) {
        Scene scene = good;
        spoil(scene);
        EXPECT_THROW(check_structure(scene, "x"), Error);
    };
    expect_refused([](Scene& scene) { scene.nodes[1].children = {0}; });
    expect_refused([](Scene& scene) { scene.nodes[1].children = {1}; });
    expect_refused([](Scene& scene) { scene.nodes[0].children = {7}; });
    expect_refused([](Scene& scene) { scene.nodes[1].parent = no_index; });
    expect_refused([](Scene& scene) { scene.roots = {}; });
    expect_refused([](Scene& scene) { scene.nodes[1].mesh = 1; });
    expect_refused([](Scene& scene) { scene.nodes[1].skin = 0; });
    expect_refused([](Scene& scene) { scene.nodes[1].transform.translation.x = INFINITY; });
    expect_refused([](Scene& scene) { scene.meshes[0].primitives[0].material = 1; });
    expect_refused([](Scene& scene) { scene.materials[0].base_color_texture.texture = 3; });
    expect_refused([](Scene& scene) {
        scene.animations.resize(1);
        scene.animations[0].channels.resize(1);
        scene.animations[0].channels[0].node = 0;
        scene.animations[0].channels[0].times_s = {0.0F};
    });
}

} // namespace
} // namespace estampe
