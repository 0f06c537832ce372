// SPDX-License-Identifier: MIT
#include "scene/mending/mend.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

namespace estampe {
namespace {

Primitive bare(Primitive primitive)
{
    primitive.normals.clear();
    primitive.uvs[0].clear();
    for (glm::vec3& position : primitive.positions)
        position += glm::vec3(0.0F); // turns negative zeros, which have other bytes, into positive ones
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

/// The result that make_crease_normals() must give, computed one corner at a time.
std::vector<glm::vec3> slow_crease_normals(const Primitive& primitive, float crease_rad)
{
    const auto face = [&primitive](size_t corner) {
        glm::dvec3 p[3];
        for (size_t k = 0; k < 3; ++k)
            p[k] = primitive.positions[primitive.indices[corner / 3 * 3 + k]];
        const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const size_t k = corner % 3;
        const double angle =
            std::atan2(glm::length(cross), glm::dot(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]));
        return std::pair(glm::normalize(cross), angle);
    };
    std::vector<glm::vec3> normals;
    for (size_t corner = 0; corner < primitive.indices.size(); ++corner) {
        glm::dvec3 sum(0.0);
        for (size_t other = 0; other < primitive.indices.size(); ++other) {
            if (primitive.positions[primitive.indices[other]] !=
                primitive.positions[primitive.indices[corner]])
                continue;
            const auto [normal, angle] = face(other);
            if (glm::dot(normal, face(corner).first) >= std::cos(static_cast<double>(crease_rad)))
                sum += angle * normal;
        }
        normals.emplace_back(glm::normalize(sum));
    }
    return normals;
}

TEST(Mend, CreaseNormalsAreThoseOfASlowAverage)
{
    for (Primitive primitive : {bare(shapes::torus(1.0F, 0.4F)), bare(shapes::cone(1.0F, 2.0F, 7)),
                                bare(shapes::box({1.0F, 2.0F, 3.0F}))}) {
        primitive.indices.resize(std::min<size_t>(primitive.indices.size(), 1800));
        const Primitive before = primitive;
        const std::vector<glm::vec3> expected = slow_crease_normals(primitive, usual_crease_rad);
        make_crease_normals(primitive, usual_crease_rad);
        ASSERT_EQ(primitive.indices.size(), before.indices.size());
        for (size_t i = 0; i < primitive.indices.size(); ++i) {
            EXPECT_EQ(primitive.positions[primitive.indices[i]], before.positions[before.indices[i]]);
            EXPECT_GT(glm::dot(primitive.normals[primitive.indices[i]], expected[i]), 0.99999F);
        }
    }
}

TEST(Mend, ALargeMeshIsTheSameInTwoHalves)
{
    // Two copies of a small mesh, one inside the other: the normals of the second must be equal wherever a
    // thread starts.
    Primitive large = bare(shapes::sphere(1.0F, 400, 200));
    const Primitive one = large;
    const auto count = static_cast<uint32_t>(one.positions.size());
    for (const glm::vec3& position : one.positions)
        large.positions.push_back(4.0F * position); // exact, without rounding
    for (const uint32_t index : one.indices)
        large.indices.push_back(index + count);
    Primitive small = one;
    make_crease_normals(small, usual_crease_rad);
    make_crease_normals(large, usual_crease_rad);
    ASSERT_EQ(large.positions.size(), 2 * small.positions.size());
    for (size_t i = 0; i < small.indices.size(); ++i) {
        ASSERT_EQ(large.indices[i], small.indices[i]);
        ASSERT_EQ(large.normals[large.indices[i]], small.normals[small.indices[i]]);
    }
}

TEST(Mend, SmoothingGroupsRuleWhereThereAreAny)
{
    const Primitive box = bare(shapes::box({1, 1, 1}));
    Primitive smooth = box;
    make_crease_normals(smooth, usual_crease_rad, std::vector<uint32_t>(12, 3));
    ASSERT_EQ(smooth.positions.size(), 8U);
    for (size_t i = 0; i < 8; ++i)
        EXPECT_GT(glm::dot(smooth.normals[i], glm::normalize(smooth.positions[i] - glm::vec3(0, 0.5F, 0))),
                  0.9F);
    Primitive flat = bare(shapes::sphere(1.0F, 16, 8));
    const std::vector<uint32_t> no_group(flat.indices.size() / 3, 0);
    make_crease_normals(flat, usual_crease_rad, no_group);
    for (size_t i = 0; i + 2 < flat.indices.size(); i += 3)
        EXPECT_EQ(flat.normals[flat.indices[i]], flat.normals[flat.indices[i + 1]]);
    Primitive unsaid = box;
    make_crease_normals(unsaid, usual_crease_rad, std::vector<uint32_t>(12, no_index));
    EXPECT_EQ(unsaid.positions.size(), 24U);
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
