// SPDX-License-Identifier: MIT
// Adjacency across edges, compared with a search through all edges, on regular and irregular surfaces.
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "techniques/contour/chains/mesh/feature_chains.hpp"

namespace estampe::contour {
namespace {

/// A TriangleSoup that owns its data.
struct Soup {
    std::vector<glm::uvec4> triangles;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<uint32_t> bodies;
    std::vector<uint32_t> materials;
    std::vector<uint8_t> edge_marks; ///< empty, or as in TriangleSoup

    void add(const Primitive& primitive, uint32_t body = 0, uint32_t material = 0)
    {
        const auto first = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), primitive.positions.begin(), primitive.positions.end());
        normals.insert(normals.end(), primitive.normals.begin(), primitive.normals.end());
        normals.resize(positions.size(), glm::vec3(0.0F, 1.0F, 0.0F));
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            triangles.emplace_back(first + primitive.indices[i], first + primitive.indices[i + 1],
                                   first + primitive.indices[i + 2], 7U);
            bodies.push_back(body);
            materials.push_back(material);
        }
    }

    [[nodiscard]] EdgeMesh build() const
    {
        return build_edge_mesh({triangles, positions, positions, normals, bodies, materials, edge_marks});
    }
};

Primitive triangles_of(std::vector<glm::vec3> positions, std::vector<uint32_t> indices)
{
    Primitive primitive;
    primitive.positions = std::move(positions);
    primitive.indices = std::move(indices);
    return primitive;
}

/// The two positions that a side joins, for a slow search.
using Places = std::pair<std::array<float, 3>, std::array<float, 3>>;

Places places_of(const EdgeMesh& mesh, const Soup& soup, uint32_t side)
{
    const auto place = [&](uint32_t corner) {
        const glm::vec3 p = soup.positions[mesh.triangles[side >> 2U][static_cast<int>(corner % 3)]];
        return std::array{p.x, p.y, p.z};
    };
    const auto a = place(side & 3U);
    const auto b = place((side & 3U) + 1);
    return {std::min(a, b), std::max(a, b)};
}

/// Expects every edge of two triangles to join them, and every other edge to join none.
void expect_adjacency(const Soup& soup)
{
    const EdgeMesh mesh = soup.build();
    std::map<Places, std::vector<uint32_t>> sides;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            sides[places_of(mesh, soup, side_of(t, k))].push_back(side_of(t, k));
        }
    }
    size_t wrong = 0;
    for (const auto& [places, around] : sides) {
        for (const uint32_t side : around) {
            const uint32_t beyond = mesh.neighbors[side >> 2U][static_cast<int>(side & 3U)];
            const uint32_t expected = around.size() != 2  ? no_side
                                      : around[0] == side ? around[1]
                                                          : around[0];
            wrong += beyond != expected ? 1U : 0U;
        }
    }
    EXPECT_EQ(wrong, 0U);
}

TEST(EdgeMesh, JoinsTrianglesAsASearchDoes)
{
    Soup closed;
    closed.add(shapes::sphere(1.0F, 24, 12), 0); // the sphere's seam has every vertex twice
    closed.add(shapes::torus(2.0F, 0.5F, 24, 12), 1);
    closed.add(shapes::box({1.0F, 2.0F, 3.0F}), 2);
    closed.add(shapes::plane(4.0F, 4.0F, 6), 3);
    // The poles of the sphere have triangles without area, which join nothing.
    Soup sound;
    for (size_t t = 0; t < closed.triangles.size(); ++t) {
        const glm::uvec4& c = closed.triangles[t];
        if (closed.positions[c.x] != closed.positions[c.y] &&
            closed.positions[c.y] != closed.positions[c.z] &&
            closed.positions[c.z] != closed.positions[c.x]) {
            sound.triangles.push_back(c);
            sound.bodies.push_back(0);
            sound.materials.push_back(0);
        }
    }
    sound.positions = closed.positions;
    sound.normals = closed.normals;
    expect_adjacency(sound);
}

TEST(EdgeMesh, JoinsRandomSoupsAsASearchDoes)
{
    std::mt19937 random(3);
    for (int run = 0; run < 200; ++run) {
        Soup soup;
        for (uint32_t i = 0; i < 12; ++i) {
            soup.positions.emplace_back(static_cast<float>(i), static_cast<float>(i * i % 5), 0.0F);
            soup.normals.emplace_back(0.0F, 0.0F, 1.0F);
        }
        std::set<std::set<uint32_t>> used;
        for (int t = 0; t < 14; ++t) {
            const glm::uvec3 c(random() % 12, random() % 12, random() % 12);
            if (c.x != c.y && c.y != c.z && c.z != c.x && used.insert({c.x, c.y, c.z}).second) {
                soup.triangles.emplace_back(c, 0U);
                soup.bodies.push_back(0);
                soup.materials.push_back(0);
            }
        }
        expect_adjacency(soup);
    }
}

TEST(EdgeMesh, CountsATriangleThatIsThereTwiceOnce)
{
    Soup soup;
    soup.add(triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2, 1, 3, 2, 2, 1, 0}));
    const EdgeMesh mesh = soup.build();
    EXPECT_EQ(mesh.neighbors[0].y, side_of(1, 2));
    EXPECT_EQ(std::count_if(mesh.features.begin(), mesh.features.end(),
                            [](const FeatureEdge& f) { return f.kind == FeatureKind::border; }),
              4);
}

TEST(EdgeMesh, AnEdgeOfThreeTrianglesJoinsNoneAndIsAFeature)
{
    Soup soup;
    soup.add(
        triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {0, 1, 2, 1, 0, 3, 0, 1, 4}));
    const EdgeMesh mesh = soup.build();
    EXPECT_EQ(mesh.neighbors[0].x, no_side);
    EXPECT_EQ(mesh.neighbors[1].x, no_side);
    EXPECT_EQ(std::count_if(mesh.features.begin(), mesh.features.end(),
                            [](const FeatureEdge& f) { return f.fold_deg == 180.0F; }),
              1);
}

TEST(EdgeMesh, TurnsAllPiecesToTheSenseOfTheirNormals)
{
    Soup soup;
    Primitive plane = shapes::plane(4.0F, 4.0F, 6);
    for (size_t t = 0; t < plane.indices.size() / 3; t += 2) {
        std::swap(plane.indices[3 * t], plane.indices[3 * t + 1]); // reverses every other triangle
    }
    soup.add(plane);
    const EdgeMesh mesh = soup.build();
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_EQ(mesh.neighbors[t].w & neighbor_is_turned, (t % 2 == 0 ? 1U : 0U)) << t;
    }
}

TEST(EdgeMesh, BodiesShareNoEdgesAndMaterialsMakeBoundaries)
{
    const auto half = [](bool upper) {
        return upper ? triangles_of({{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2})
                     : triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
    };
    Soup apart;
    apart.add(half(false), 0);
    apart.add(half(true), 1);
    EXPECT_EQ(apart.build().neighbors[0].y, no_side);
    Soup materials;
    materials.add(half(false), 0, 0);
    materials.add(half(true), 0, 1);
    const EdgeMesh mesh = materials.build();
    EXPECT_EQ(mesh.neighbors[0].y, side_of(1, 2));
    EXPECT_EQ(std::count_if(mesh.features.begin(), mesh.features.end(),
                            [](const FeatureEdge& f) { return f.kind == FeatureKind::boundary; }),
              1);
}

TEST(EdgeMesh, HardEdgesAreWhereNormalsDiffer)
{
    Soup soup;
    soup.add(shapes::box({1.0F, 1.0F, 1.0F}));
    const EdgeMesh mesh = soup.build();
    EXPECT_EQ(mesh.hard_edges.size(), 12U);
    EXPECT_EQ(mesh.features.size(), 12U);
    for (const FeatureEdge& feature : mesh.features) {
        EXPECT_NEAR(feature.fold_deg, 90.0F, 1e-3F);
        EXPECT_TRUE(feature.is_split);
    }
}

FeatureChains strung(const Soup& soup, const FeatureChoice& choice = {})
{
    return string_features(soup.build(), soup.positions, choice);
}

TEST(FeatureChains, ABoxHasTwelveLinesOfOneEdge)
{
    Soup soup;
    soup.add(shapes::box({1.0F, 1.0F, 1.0F}));
    const FeatureChains chains = strung(soup);
    ASSERT_EQ(chains.chains.size(), 12U);
    for (const shared::FeatureChain& chain : chains.chains) {
        EXPECT_EQ(chain.point_count, 2U);
    }
    EXPECT_TRUE(chains.loose_edges.empty());
    EXPECT_EQ(strung(soup, {.crease_deg = 100.0F}).loose_edges.size(), 12U);
}

TEST(FeatureChains, RimsAreClosedAndGoOnceAround)
{
    Soup soup;
    soup.add(shapes::cylinder(1.0F, 2.0F, 32));
    const FeatureChains chains = strung(soup);
    ASSERT_EQ(chains.chains.size(), 2U);
    for (const shared::FeatureChain& chain : chains.chains) {
        EXPECT_EQ(chain.is_closed, 1U);
        EXPECT_EQ(chain.point_count, 33U);
        double length = 0.0;
        for (uint32_t i = chain.first_point; i + 1 < chain.first_point + chain.point_count; ++i) {
            length += static_cast<double>(glm::distance(soup.positions[chains.points[i].vertex],
                                                        soup.positions[chains.points[i + 1].vertex]));
        }
        EXPECT_NEAR(length, 64.0 * std::sin(3.14159265 / 32.0), 1e-4);
    }
}

TEST(FeatureChains, TheBorderOfASheetBreaksAtItsCorners)
{
    Soup soup;
    soup.add(shapes::plane(4.0F, 4.0F, 5));
    const FeatureChains chains = strung(soup);
    EXPECT_EQ(chains.chains.size(), 4U);
    EXPECT_EQ(chains.points.size(), 24U);
}

/// A box in which only the first side of the first triangle is marked; flat diagonals and folds are not.
TEST(FeatureChains, WhereEdgesAreMarkedNoOthersHaveLines)
{
    Soup soup;
    soup.add(shapes::box({1.0F, 1.0F, 1.0F}));
    soup.edge_marks.assign(soup.triangles.size(), 8);
    const EdgeMesh plain = soup.build();
    const auto diagonal = [&](size_t t) {
        const glm::uvec4& c = plain.triangles[t];
        uint32_t longest = 0;
        for (uint32_t k = 0; k < 3; ++k) {
            const auto length = [&](uint32_t i) {
                return glm::distance(soup.positions[c[static_cast<int>(i)]],
                                     soup.positions[c[static_cast<int>((i + 1) % 3)]]);
            };
            longest = length(k) > length(longest) ? k : longest;
        }
        return longest;
    };
    EXPECT_TRUE(strung(soup).chains.empty());
    EXPECT_EQ(strung(soup).loose_edges.size(), 12U);
    soup.edge_marks[0] |= static_cast<uint8_t>(1U << diagonal(0));
    soup.edge_marks[4] |= static_cast<uint8_t>(1U << (diagonal(4) + 1) % 3);
    const FeatureChains chains = strung(soup);
    ASSERT_EQ(chains.chains.size(), 2U);
    for (const shared::FeaturePoint& point : chains.points) {
        EXPECT_EQ(point.kind, shared::line_marked);
    }
    EXPECT_EQ(chains.loose_edges.size(), 11U);
    EXPECT_EQ(strung(soup, {.marked = false}).chains.size(), 12U);
    EXPECT_EQ(strung(soup, {.crease_deg = 1.0F, .marked = false}).chains.size(), 12U);
}

TEST(FeatureChains, OfAnEdgeBetweenWhatMarksAndWhatDoesNotNothingIsSaid)
{
    Soup soup;
    soup.add(triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 1}}, {0, 1, 2, 1, 0, 3}));
    soup.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0}};
    soup.edge_marks = {8, 0};
    const FeatureChoice no_borders{.borders = false};
    EXPECT_EQ(strung(soup, no_borders).chains.size(), 1U); // the fold of 90 degrees
    soup.edge_marks = {8, 8};
    EXPECT_TRUE(strung(soup, no_borders).chains.empty());
    soup.edge_marks = {8, 9};
    EXPECT_EQ(strung(soup, no_borders).points.at(0).kind, shared::line_marked);
}

TEST(FeatureChains, SmoothShadingHidesGentleFolds)
{
    Soup soup;
    soup.add(shapes::sphere(1.0F, 12, 6)); // folds of 30 degrees with smooth shading
    EXPECT_TRUE(strung(soup, {.crease_deg = 20.0F}).chains.empty());
}

/// A sphere with duplicate vertices along one meridian, offset by `gap` as a share of its size.
Soup ball_with_seam(float gap, float radius)
{
    Primitive ball = shapes::sphere(radius, 24, 12);
    const size_t count = ball.positions.size();
    size_t moved = 0;
    for (size_t v = 0; v < count; ++v) {
        for (size_t w = 0; w < v; ++w) {
            if (ball.positions[v] == ball.positions[w] && std::abs(ball.positions[v].y) < 0.99F * radius) {
                ball.positions[v] += glm::vec3(gap * radius, -gap * radius, gap * radius);
                ++moved;
                break;
            }
        }
    }
    EXPECT_GT(moved, 8U);
    Soup soup;
    soup.add(ball);
    return soup;
}

size_t border_count(const EdgeMesh& mesh)
{
    return static_cast<size_t>(std::ranges::count(mesh.features, FeatureKind::border, &FeatureEdge::kind));
}

TEST(EdgeMesh, VerticesThatMissEachOtherByRoundingAreOne)
{
    for (const float radius : {1e-3F, 1.0F, 4000.0F}) {
        EXPECT_EQ(border_count(ball_with_seam(0.0F, radius).build()), 0U);
        EXPECT_EQ(border_count(ball_with_seam(2e-7F, radius).build()), 0U) << radius;
        EXPECT_EQ(border_count(ball_with_seam(4e-6F, radius).build()), 0U) << radius;
        EXPECT_GT(border_count(ball_with_seam(1e-3F, radius).build()), 0U) << "that is a gap";
    }
}

TEST(EdgeMesh, DetailFinerThanTheToleranceStays)
{
    Soup soup;
    soup.add(shapes::sphere(1.0F, 12, 6));
    const float fine = 0.2F * weld_tolerance;
    soup.add(triangles_of(
        {{2.0F, 0.0F, 0.0F}, {2.0F + fine, 0.0F, 0.0F}, {2.0F, fine, 0.0F}, {2.0F + fine, fine, 0.0F}},
        {0, 1, 2, 2, 1, 3}));
    const EdgeMesh mesh = soup.build();
    const size_t last = mesh.triangles.size() - 2;
    EXPECT_EQ(mesh.neighbors[last][1], side_of(static_cast<uint32_t>(last + 1), 0));
    std::set<uint32_t> points;
    for (size_t t = last; t < last + 2; ++t) {
        for (int k = 0; k < 3; ++k) {
            points.insert(mesh.points[mesh.triangles[t][k]]);
        }
    }
    EXPECT_EQ(points.size(), 4U);
}

TEST(EdgeMesh, VerticesThatJointsTakeApartStayApart)
{
    Soup soup;
    soup.add(triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}));
    soup.add(triangles_of({{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2}));
    std::vector<glm::vec3> placed = soup.positions;
    for (size_t v = 3; v < 6; ++v) {
        placed[v].x += 5.0F;
    }
    const EdgeMesh together = soup.build();
    EXPECT_EQ(border_count(together), 4U);
    const EdgeMesh apart = build_edge_mesh(
        {soup.triangles, placed, soup.positions, soup.normals, soup.bodies, soup.materials, soup.edge_marks});
    EXPECT_EQ(border_count(apart), 6U);
}

} // namespace
} // namespace estampe::contour
