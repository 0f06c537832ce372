// SPDX-License-Identifier: MIT

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

namespace estampe::shapes {
namespace {

constexpr double pi = std::numbers::pi;

using Place = std::array<float, 3>;

Place place_of(const glm::vec3& p)
{
    return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
}

/// Whether every edge, by position, occurs exactly once in each direction.
bool watertight(const Primitive& mesh)
{
    std::map<std::pair<Place, Place>, int> edges;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const Place a = place_of(mesh.positions[mesh.indices[i + k]]);
            const Place b = place_of(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
            ++edges[{a, b}];
            --edges[{b, a}];
        }
    for (const auto& [edge, balance] : edges)
        if (balance != 0)
            return false;
    return !edges.empty();
}

glm::dvec3 area_vector(const Primitive& mesh, size_t triangle)
{
    const glm::dvec3 a = mesh.positions[mesh.indices[triangle]];
    const glm::dvec3 b = mesh.positions[mesh.indices[triangle + 1]];
    const glm::dvec3 c = mesh.positions[mesh.indices[triangle + 2]];
    return 0.5 * glm::cross(b - a, c - a);
}

double area(const Primitive& mesh)
{
    double sum = 0.0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        sum += glm::length(area_vector(mesh, i));
    return sum;
}

/// Signed volume; positive if triangles face outwards.
double volume(const Primitive& mesh)
{
    double sum = 0.0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        sum += glm::dot(area_vector(mesh, i), glm::dvec3(mesh.positions[mesh.indices[i]])) / 3.0;
    return sum;
}

void expect_sound(const Primitive& mesh)
{
    ASSERT_FALSE(mesh.indices.empty());
    ASSERT_EQ(mesh.indices.size() % 3, 0U);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs[0].size(), mesh.positions.size());
    for (const uint32_t index : mesh.indices)
        ASSERT_LT(index, mesh.positions.size());
    for (const glm::vec3& normal : mesh.normals)
        ASSERT_NEAR(glm::length(normal), 1.0F, 1e-4F);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 face = area_vector(mesh, i);
        ASSERT_GT(glm::length(face), 0.0) << "triangle " << i / 3;
        for (size_t k = 0; k < 3; ++k)
            ASSERT_GT(glm::dot(glm::normalize(face), glm::dvec3(mesh.normals[mesh.indices[i + k]])), 0.3)
                << "triangle " << i / 3;
    }
}

void expect_solid(const Primitive& mesh)
{
    expect_sound(mesh);
    EXPECT_TRUE(watertight(mesh));
    EXPECT_GT(volume(mesh), 0.0);
}

void expect_within_percent(double actual, double wanted)
{
    EXPECT_NEAR(actual, wanted, 0.01 * wanted);
}

TEST(Shapes, PlaneFacesUpAndCountsItsCells)
{
    const Primitive mesh = plane(4.0F, 6.0F, 3);
    expect_sound(mesh);
    EXPECT_EQ(mesh.indices.size(), 54U);
    EXPECT_EQ(mesh.positions.size(), 16U);
    expect_within_percent(area(mesh), 24.0);
    EXPECT_GT(area_vector(mesh, 0).y, 0.0);
    EXPECT_EQ(mesh.uvs[0].back(), glm::vec2(4.0F, 6.0F));
}

TEST(Shapes, QuadFacesTheViewer)
{
    const Primitive mesh = quad(2.0F, 3.0F);
    expect_sound(mesh);
    expect_within_percent(area(mesh), 6.0);
    EXPECT_GT(area_vector(mesh, 0).z, 0.0);
}

TEST(Shapes, BoxIsSolid)
{
    const Primitive mesh = box({0.7F, 0.3F, 1.1F});
    expect_solid(mesh);
    EXPECT_EQ(mesh.positions.size(), 24U);
    EXPECT_EQ(mesh.indices.size(), 36U);
    expect_within_percent(volume(mesh), 0.7 * 0.3 * 1.1);
    expect_within_percent(area(mesh), 2.0 * (0.7 * 0.3 + 0.3 * 1.1 + 0.7 * 1.1));
}

TEST(Shapes, SphereIsSolid)
{
    const Primitive mesh = sphere(2.0F, 64, 32);
    expect_solid(mesh);
    expect_within_percent(area(mesh), 16.0 * pi);
    expect_within_percent(volume(mesh), 32.0 * pi / 3.0);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_NEAR(glm::distance(mesh.normals[i], glm::normalize(mesh.positions[i])), 0.0F, 1e-5F);
}

TEST(Shapes, TorusIsSolid)
{
    const Primitive mesh = torus(2.0F, 0.5F, 96, 48);
    expect_solid(mesh);
    EXPECT_EQ(mesh.indices.size(), 96U * 48U * 6U);
    expect_within_percent(area(mesh), 4.0 * pi * pi * 2.0 * 0.5);
    expect_within_percent(volume(mesh), 2.0 * pi * pi * 2.0 * 0.25);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p = mesh.positions[i];
        const glm::vec3 middle = 2.0F * glm::normalize(glm::vec3(p.x, 0.0F, p.z));
        EXPECT_NEAR(glm::distance(mesh.normals[i], glm::normalize(p - middle)), 0.0F, 1e-5F);
    }
}

TEST(Shapes, CylinderAndConeAreSolid)
{
    const Primitive drum = cylinder(1.0F, 3.0F, 64);
    expect_solid(drum);
    expect_within_percent(area(drum), 2.0 * pi + 6.0 * pi);
    expect_within_percent(volume(drum), 3.0 * pi);
    const Primitive roof = cone(1.0F, 2.0F, 64);
    expect_solid(roof);
    EXPECT_EQ(roof.indices.size(), 64U * 6U);
    expect_within_percent(area(roof), pi + pi * std::sqrt(5.0));
}

TEST(Shapes, LatheKeepsHardCornersAndSmoothCurves)
{
    const glm::vec2 vase[] = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.1F, 0.5F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    const Primitive mesh = lathe(vase, 24);
    expect_solid(mesh);
    bool level = false;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i].y == 0.5F) {
            EXPECT_NEAR(mesh.normals[i].y, 0.0F, 1e-6F);
        }
        level = level || (mesh.positions[i].y == 1.0F && mesh.normals[i].y == 1.0F);
    }
    EXPECT_TRUE(level);
}

TEST(Shapes, ExtrudeClosesAConcaveOutline)
{
    const glm::vec2 outline[] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
    const Primitive mesh = extrude(outline, 2.0F);
    expect_solid(mesh);
    expect_within_percent(volume(mesh), 8.0);
    expect_within_percent(area(mesh), 2.0 * 4.0 + 10.0 * 2.0);
    EXPECT_TRUE(extrude(std::span(outline).first(2), 1.0F).indices.empty());
}

TEST(Shapes, ArchWallIsSolidAndOpen)
{
    const ArchWall wall{.height = 7.0F,
                        .thickness = 1.2F,
                        .arches = 7,
                        .opening = 3.0F,
                        .pier = 1.0F,
                        .springing = 3.0F,
                        .arch_segments = 48};
    const Primitive mesh = arch_wall(wall);
    expect_solid(mesh);
    const double face = 7.0 * (7 * 3.0 + 8.0) - 7 * (9.0 + 0.5 * pi * 2.25);
    expect_within_percent(volume(mesh), 1.2 * face);
    EXPECT_FLOAT_EQ(arch_wall_length(wall), 29.0F);
}

TEST(Shapes, FlutedColumnIsSolidWholeAndBroken)
{
    FlutedColumn column;
    expect_solid(fluted_column(column));
    column.break_height = 0.8F;
    expect_solid(fluted_column(column));
    EXPECT_LT(volume(fluted_column(column)), pi * 0.36 * 6.0);
}

TEST(Shapes, StairsRiseAwayFromTheViewer)
{
    const Primitive mesh = stairs(3.0F, 0.2F, 0.3F, 4);
    expect_solid(mesh);
    expect_within_percent(volume(mesh), 3.0 * 0.2 * 0.3 * 10.0);
    for (const glm::vec3& p : mesh.positions)
        if (p.y > 0.7F) {
            EXPECT_LT(p.z, -0.2F);
        }
}

TEST(Shapes, CountsBelowASolidAreRaised)
{
    expect_solid(sphere(1.0F, 0, 0));
    expect_solid(cylinder(1.0F, 1.0F, 1));
    expect_sound(plane(1.0F, 1.0F, 0));
    expect_solid(stairs(1.0F, 1.0F, 1.0F, 0));
    expect_solid(arch_wall({.arches = 0}));
}

TEST(Shapes, AppendMirrorsWithoutTurningInsideOut)
{
    Primitive whole;
    append(whole, box({1.0F, 2.0F, 3.0F}), glm::scale(glm::mat4(1.0F), {-1.0F, 1.0F, 2.0F}));
    expect_solid(whole);
    expect_within_percent(volume(whole), 12.0);
}

TEST(Shapes, ARodGoesFromPointToPointWithRoundEnds)
{
    const Primitive mesh = rod({1.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 0.0F}, 0.5F, 0.5F, 64, 16);
    expect_solid(mesh);
    expect_within_percent(volume(mesh), pi * 0.25 * 2.0 + 4.0 / 3.0 * pi * 0.125);
    for (const glm::vec3& place : mesh.positions) {
        const float along = std::clamp(place.y, 0.0F, 2.0F);
        EXPECT_NEAR(glm::distance(place, glm::vec3(1.0F, along, 0.0F)), 0.5F, 1e-5F);
    }
}

TEST(Shapes, AppendingTurnsEdgeMarksWithTheirTriangles)
{
    Primitive marked = quad(1.0F, 1.0F);
    marked.edge_marks = {0b001, 0b110};
    Primitive whole = quad(1.0F, 1.0F);
    append(whole, marked, glm::mat4(1.0F));
    append(whole, marked, glm::scale(glm::mat4(1.0F), {-1.0F, 1.0F, 1.0F}));
    append(whole, quad(1.0F, 1.0F), glm::mat4(1.0F));
    EXPECT_EQ(whole.edge_marks, (std::vector<uint8_t>{0, 0, 0b001, 0b110, 0b100, 0b011, 0, 0}));
}

TEST(Shapes, ABuilderGathersAPrimitiveForEachMaterial)
{
    enum class Paint : Index { red, blue };
    Primitive marked = quad(1.0F, 1.0F);
    marked.edge_marks = {1, 2};
    MeshBuilder post;
    post.add(Paint::blue, box({1.0F, 2.0F, 1.0F}));
    post.add(Paint::red, marked);
    post.add(Paint::red, sphere(0.5F), at({0.0F, 2.5F, 0.0F}));
    MeshBuilder fence;
    fence.add(post);
    fence.add(post, at({4.0F, 0.0F, 0.0F}, 90.0F));
    const Mesh mesh = fence.mesh("fence");
    EXPECT_EQ(mesh.name, "fence");
    ASSERT_EQ(mesh.primitives.size(), 3U);
    EXPECT_EQ(mesh.primitives[0].material, 0U);
    EXPECT_TRUE(mesh.primitives[0].edge_marks.empty());
    EXPECT_EQ(mesh.primitives[1].material, 0U);
    EXPECT_EQ(mesh.primitives[1].edge_marks, (std::vector<uint8_t>{1, 2, 1, 2}));
    EXPECT_EQ(mesh.primitives[2].material, 1U);
    expect_within_percent(volume(mesh.primitives[2]), 4.0);
    EXPECT_NEAR(glm::distance(mesh.primitives[1].normals.back(), glm::vec3(1.0F, 0.0F, 0.0F)), 0.0F, 1e-6F);
}

} // namespace
} // namespace estampe::shapes
