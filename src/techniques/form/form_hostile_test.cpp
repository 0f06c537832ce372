// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "techniques/form/form_test_meshes.hpp"

namespace estampe::form {
namespace {

using namespace test;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

FormField follow_sanely(const TestMesh& mesh, const FormOptions& options)
{
    FormField field = follow_form(mesh.positions, mesh.indices, options);
    EXPECT_EQ(field.corners.size(), mesh.indices.size() / 3);
    EXPECT_EQ(field.is_faulty.size(), field.corners.size());
    for (const auto& triangle : field.corners) {
        for (const glm::vec2& corner : triangle) {
            EXPECT_TRUE(std::isfinite(corner.x) && std::isfinite(corner.y));
        }
    }
    return field;
}

FormField follow_sanely(const TestMesh& mesh)
{
    return follow_sanely(mesh, {.period_m = 0.5F});
}

TEST(FormHostile, NothingToFollow)
{
    EXPECT_FALSE(follow_sanely({}).follows_form);
    EXPECT_FALSE(follow_sanely({{glm::vec3(0.0F)}, {}}).follows_form);
    EXPECT_FALSE(follow_sanely({{}, {0, 1, 2}}).follows_form);
    EXPECT_FALSE(follow_sanely({std::vector<glm::vec3>(3, glm::vec3(1.0F)), {0, 1, 2}}).follows_form);
    EXPECT_FALSE(follow_sanely({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {0, 1, 2}}).follows_form);
    EXPECT_FALSE(follow_sanely({std::vector<glm::vec3>(3, glm::vec3(nan)), {0, 1, 2}}).follows_form);
    const FormField lone = follow_sanely({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0}});
    EXPECT_TRUE(lone.follows_form);
    EXPECT_EQ(lone.corners.size(), 1U);
}

TEST(FormHostile, BadTrianglesAreSlicedAndTheRestFollowed)
{
    TestMesh mesh = cylinder();
    const auto good = static_cast<uint32_t>(mesh.indices.size() / 3);
    const auto next = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {glm::vec3(nan, 0, 0), glm::vec3(0, infinity, 0), glm::vec3(0, 0, -infinity)});
    mesh.indices.insert(mesh.indices.end(), {0, 1, next, 2, next + 1, 3, next + 2, 4, 5, 6, 6, 7, 8, 9, ~0U});
    const FormField field = follow_sanely(mesh);
    EXPECT_TRUE(field.follows_form);
    EXPECT_EQ(field.faults.dropped_triangles, 5U);
    EXPECT_EQ(field.faults.branch_triangles_a, 0U);
    EXPECT_EQ(field.corners.size(), good + 5U);
}

TEST(FormHostile, AnyScale)
{
    for (const float scale : {1e-30F, 1e-15F, 1e-6F, 1e6F, 1e15F, 1e30F}) {
        TestMesh mesh = torus();
        for (glm::vec3& p : mesh.positions) {
            p *= scale;
        }
        const FormField field = follow_sanely(mesh, {.period_m = 0.5F * scale});
        EXPECT_TRUE(field.follows_form) << scale;
        EXPECT_EQ(field.faults.branch_triangles_a, 0U) << scale;
    }
    TestMesh mesh = torus();
    mesh.positions.front() = glm::vec3(3e38F);
    follow_sanely(mesh);
    mesh.positions.back() = glm::vec3(-3e38F);
    follow_sanely(mesh);
}

TEST(FormHostile, AnyOptions)
{
    const TestMesh mesh = ball(6, [](const glm::vec3& p) { return p; });
    for (const float period_m : {nan, infinity, -1.0F, 0.0F, 1e-30F, 1e30F}) {
        EXPECT_TRUE(follow_sanely(mesh, {.period_m = period_m}).follows_form);
    }
    for (const float smoothing : {nan, infinity, -1.0F, 0.0F, 1e30F}) {
        EXPECT_TRUE(follow_sanely(mesh, {.period_m = 0.5F, .smoothing = smoothing}).follows_form);
    }
    for (const glm::vec3 up : {glm::vec3(0.0F), glm::vec3(nan), glm::vec3(infinity), glm::vec3(1e-30F)}) {
        EXPECT_TRUE(follow_sanely(mesh, {.period_m = 0.5F, .up = up}).follows_form);
    }
}

TEST(FormHostile, EdgesOfManyTriangles)
{
    TestMesh book{{{0, 0, 0}, {0, 1, 0}}, {}};
    for (uint32_t page = 0; page < 40; ++page) {
        const float angle = 0.15F * static_cast<float>(page);
        book.positions.emplace_back(std::cos(angle), 0.5F, std::sin(angle));
        book.indices.insert(book.indices.end(), {page % 2, 1 - page % 2, page + 2});
    }
    EXPECT_TRUE(follow_sanely(book).follows_form);
}

TEST(FormHostile, BandWithOneSide)
{
    TestMesh mesh = make_grid({.columns = 60, .rows = 6, .closes_columns = false}, [](float u, float v) {
        const float half = pi * u;
        const float away = 2.0F + (v - 0.5F) * std::cos(half);
        return glm::vec3(away * std::cos(2 * half), (v - 0.5F) * std::sin(half), away * std::sin(2 * half));
    });
    for (uint32_t row = 0; row <= 6; ++row) {
        mesh.positions[row * 61 + 60] = mesh.positions[(6 - row) * 61];
    }
    EXPECT_TRUE(follow_sanely(mesh).follows_form);
}

TEST(FormHostile, TwoTrianglesBackToBack)
{
    const TestMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 1, 0, 1, 2, 0, 2, 1}};
    EXPECT_TRUE(follow_sanely(mesh).follows_form);
}

TEST(FormHostile, Soup)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-1.0F, 1.0F);
    for (const uint32_t vertices : {4U, 9U, 60U, 900U}) {
        TestMesh mesh;
        for (uint32_t i = 0; i < vertices; ++i) {
            mesh.positions.emplace_back(anywhere(random), anywhere(random), anywhere(random));
        }
        for (uint32_t i = 0; i < 3 * 2000; ++i) {
            mesh.indices.push_back(static_cast<uint32_t>(random() % vertices));
        }
        EXPECT_TRUE(follow_sanely(mesh).follows_form);
    }
}

TEST(FormHostile, Slivers)
{
    for (const float thinness : {1e-2F, 1e-4F, 1e-6F, 1e-8F}) {
        const TestMesh mesh = make_grid({.columns = 40, .rows = 10}, [&](float u, float v) {
            return glm::vec3(u, v * thinness, 0.01F * std::sin(20.0F * u));
        });
        follow_sanely(mesh, {.period_m = 0.1F});
    }
}

TEST(FormHostile, ManyParts)
{
    TestMesh mesh;
    for (uint32_t part = 0; part < 3000; ++part) {
        const glm::vec3 place(part % 50, part / 50, 0.0F);
        for (const glm::vec3 corner : {glm::vec3(0.0F), glm::vec3(0.5F, 0, 0), glm::vec3(0, 0.5F, 0.2F)}) {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(place + corner);
        }
    }
    EXPECT_TRUE(follow_sanely(mesh).follows_form);
}

} // namespace
} // namespace estampe::form
