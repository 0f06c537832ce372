// SPDX-License-Identifier: MIT
// Lines as chains, compared with a search through all triangles and edges, and with known results for
// spheres.
#include "techniques/contour/chains/chains.hpp"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "features/lines/lines.hpp"
#include "scene/pose.hpp"
#include "scene/smooth_surface.hpp"
#include "support/drawing.hpp"
#include "support/scenes.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

using shared::ChainPoint;

/// Triangles that face an eye, computed on the CPU with the rounding of the shaders.
class Facing {
public:
    Facing(test::Drawing& drawing, const EdgeMesh& mesh)
        : posed_(drawing.posed()), mesh_(mesh), eye_(drawing.globals.eye_anchor)
    {
    }

    [[nodiscard]] bool is_front(uint32_t t) const
    {
        const glm::uvec4& c = mesh_.triangles[t];
        const glm::vec3 a = posed_[c.x].position;
        const glm::vec3 u = posed_[c.y].position - a;
        const glm::vec3 v = posed_[c.z].position - a;
        const glm::vec3 n(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
        return dot(n, eye_ - a) > 0.0F;
    }

    [[nodiscard]] bool faces(uint32_t vertex) const
    {
        const auto x = static_cast<float>(static_cast<int16_t>(posed_[vertex].normal & 0xffffU));
        const auto y = static_cast<float>(static_cast<int16_t>(posed_[vertex].normal >> 16U));
        const float z = 32767.0F - std::abs(x) - std::abs(y);
        glm::vec3 n(x, y, z);
        if (z < 0.0F) {
            n.x = (32767.0F - std::abs(y)) * (x >= 0.0F ? 1.0F : -1.0F);
            n.y = (32767.0F - std::abs(x)) * (y >= 0.0F ? 1.0F : -1.0F);
        }
        return dot(n, eye_ - posed_[vertex].position) >= 0.0F;
    }

private:
    static float dot(const glm::vec3& a, const glm::vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

    std::vector<shared::PosedVertex> posed_;
    const EdgeMesh& mesh_;
    glm::vec3 eye_;
};

/// Expects outlines exactly at the edges between a front-facing and a back-facing triangle.
void expect_edges_as_searched(const Scene& scene, const Camera& camera, const std::string& name)
{
    test::Drawing drawing(scene, camera, small_page_px);
    const EdgeMesh mesh = features::edge_mesh_of(drawing.layout);
    const auto lists = drawing.chains(
        {.silhouettes = Silhouettes::edges, .crease_deg = 180.0F, .intersection = {.enabled = false}});
    const Facing facing(drawing, mesh);
    size_t wrong_triangles = 0;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        wrong_triangles += bit(lists.facing, t) != facing.is_front(t) ? 1U : 0U;
    }
    EXPECT_EQ(wrong_triangles, 0U) << name;
    size_t expected = 0;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t beyond = mesh.neighbors[t][static_cast<int>(k)];
            const auto looks = [&](uint32_t triangle) {
                return facing.is_front(triangle) != ((mesh.neighbors[triangle].w & neighbor_is_turned) != 0);
            };
            const bool is_feature =
                std::any_of(mesh.features.begin(), mesh.features.end(), [&](const FeatureEdge& f) {
                    return f.kind == FeatureKind::boundary &&
                           (f.side == side_of(t, k) || f.other_side == side_of(t, k));
                });
            expected +=
                beyond != no_side && side_of(t, k) < beyond && !is_feature && looks(t) != looks(beyond >> 2U)
                    ? 1U
                    : 0U;
        }
    }
    size_t found = 0;
    for (const uint32_t word : lists.marks) {
        found += static_cast<size_t>(std::popcount(word));
    }
    EXPECT_EQ(found, expected) << name;
    EXPECT_EQ(lists.sizes[shared::list_segments].count, expected) << name;
    EXPECT_GT(expected, 0U) << name;
}

/// Expects smooth outlines exactly in the triangles with corners that face towards and away from the eye.
void expect_triangles_as_searched(const Scene& scene, const Camera& camera, const std::string& name)
{
    test::Drawing drawing(scene, camera, small_page_px);
    const EdgeMesh mesh = features::edge_mesh_of(drawing.layout);
    const auto lists = drawing.chains({});
    const Facing facing(drawing, mesh);
    size_t wrong = 0;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec4& c = mesh.triangles[t];
        const bool has_area = c.x != c.y && c.y != c.z && c.z != c.x;
        const bool is_crossed =
            has_area && (facing.faces(c.x) != facing.faces(c.y) || facing.faces(c.y) != facing.faces(c.z));
        wrong += bit(lists.marks, t) != is_crossed ? 1U : 0U;
    }
    EXPECT_EQ(wrong, 0U) << name;
}

/// A lathe shape with hard corners from 5 to 90 degrees.
Primitive faceted_vase()
{
    const std::vector<glm::vec2> profile{{0.0F, 0.0F}, {0.7F, 0.0F}, {0.8F, 0.3F},  {0.85F, 0.6F},
                                         {0.7F, 0.9F}, {0.4F, 1.2F}, {0.35F, 1.5F}, {0.6F, 1.55F},
                                         {0.6F, 1.7F}, {0.3F, 1.9F}, {0.25F, 2.2F}, {0.0F, 2.25F}};
    return shapes::lathe(profile, 20, 0.0F);
}

/// Expects outlines, where the shading breaks, exactly at the edges whose four normals do not all face the
/// same way, except for edges with a front only in the middle.
void expect_hard_edges_as_searched(const Primitive& thing)
{
    test::Drawing drawing(test::scene_of(thing), view_from_above(), small_page_px);
    const EdgeMesh mesh = features::edge_mesh_of(drawing.layout);
    const ContourStyle style{.crease_deg = 180.0F};
    const auto lists = drawing.chains(style);
    const Facing facing(drawing, mesh);
    const uint32_t first_item = 32 * ((static_cast<uint32_t>(mesh.triangles.size()) + 31) / 32);
    size_t wrong = 0;
    size_t outlines = 0;
    for (uint32_t i = 0; i < mesh.hard_edges.size(); ++i) {
        const auto faces = [&](uint32_t side, uint32_t step) {
            return facing.faces(mesh.triangles[side >> 2U][static_cast<int>(((side & 3U) + step) % 3U)]);
        };
        const glm::uvec2 edge = mesh.hard_edges[i];
        const bool a = faces(edge.x, 0);
        const bool b = faces(edge.x, 1);
        const bool beyond_a = faces(edge.y, 1);
        const bool beyond_b = faces(edge.y, 0);
        const bool is_split = a != b && beyond_a != beyond_b && a != beyond_a;
        const bool is_outline = !(a == b && a == beyond_a && a == beyond_b) && !is_split;
        wrong += bit(lists.marks, first_item + i) != is_outline ? 1U : 0U;
        outlines += is_outline ? 1U : 0U;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(outlines, 0U);
}

TEST(ContourChains, OutlinesAlongHardEdgesAreThoseOfASearch)
{
    expect_hard_edges_as_searched(banded_ring());
    expect_hard_edges_as_searched(shapes::cone(1.0F, 1.6F, 24));
    expect_hard_edges_as_searched(shapes::box({1.0F, 1.4F, 0.8F}));
}

TEST(ContourChains, OutlinesAreThoseOfASearch)
{
    expect_edges_as_searched(shapes_scene(), view_from_above(), "shapes");
    expect_triangles_as_searched(shapes_scene(), view_from_above(), "shapes");
}

/// Calls `look` for real models, if the machine has any.
void for_each_model(const std::function<void(const Scene&, const Camera&, const char*)>& look)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    for (const char* name :
         {"suzanne.gltf", "fandisk.obj", "teapot.gltf", "spot.obj", "stanford-bunny.obj", "Fox.glb",
          "FlightHelmet/FlightHelmet.gltf", "CesiumMan/glTF-Binary/CesiumMan.glb", "sampleroom.gltf",
          "CornellBox/CornellBox.glb", "MixedLightingExample/MixedLightingExample.gltf"}) {
        if (folder != nullptr && std::filesystem::exists(std::filesystem::path(folder) / name)) {
            const Scene scene = load_scene(std::filesystem::path(folder) / name);
            look(scene, framing_camera(scene, pose_scene(scene, 0.0, no_index), 4.0 / 3.0), name);
        }
    }
}

TEST(ContourChains, OutlinesOfModelsAreThoseOfASearch)
{
    for_each_model([](const Scene& scene, const Camera& camera, const char* name) {
        expect_triangles_as_searched(scene, camera, name);
        expect_edges_as_searched(scene, camera, name);
    });
}

/// The points of a chain.
struct Chain {
    std::vector<ChainPoint> points;
    bool is_closed = false;
};

std::vector<Chain> chains_of(const test::ChainLists& lists)
{
    std::vector<Chain> chains;
    for (size_t slot = 0; slot + 1 < lists.points_before.size(); ++slot) {
        const uint32_t first = lists.points_before[slot];
        const uint32_t end = lists.points_before[slot + 1];
        if (end > first) {
            chains.push_back({{lists.points.begin() + first, lists.points.begin() + end},
                              (lists.flags_of_slot[slot] & shared::chain_is_closed) != 0});
        }
    }
    return chains;
}

double length_of(const Chain& chain)
{
    double length = 0.0;
    for (size_t i = 0; i + 1 < chain.points.size(); ++i) {
        length += static_cast<double>(glm::distance(chain.points[i].anchor, chain.points[i + 1].anchor));
    }
    return length;
}

TEST(ContourChains, ASphereHasOneClosedLoopOfTheRightRadiusAndLength)
{
    constexpr double distance_m = 3.0;
    // 10,000 triangles, none of which has a corner exactly on the outline.
    const Scene scene = test::scene_of(subdivided(shapes::sphere(1.0F, 100, 51), 0));
    test::Drawing drawing(scene, test::front_camera(distance_m, 0.8), small_page_px);
    const std::vector<Chain> chains = chains_of(drawing.chains({}));
    ASSERT_EQ(chains.size(), 1U);
    EXPECT_TRUE(chains[0].is_closed);
    EXPECT_EQ(chains[0].points.front().anchor, chains[0].points.back().anchor);
    const double radius = std::sqrt(1.0 - 1.0 / (distance_m * distance_m));
    const double expected = 2.0 * std::numbers::pi * radius;
    EXPECT_NEAR(length_of(chains[0]), expected, 0.005 * expected);
    for (const ChainPoint& point : chains[0].points) {
        const glm::dvec3 p = glm::dvec3(point.anchor) + drawing.layout.anchor;
        EXPECT_NEAR(std::hypot(p.x, p.y), radius, 0.01);
        EXPECT_NEAR(p.z, 1.0 / distance_m, 0.02);
    }
}

double longest_edge_m(const EdgeMesh& mesh, const std::vector<shared::PosedVertex>& posed)
{
    float longest = 0.0F;
    for (const glm::uvec4& corners : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            longest = std::max(
                longest, glm::distance(posed[corners[k]].position, posed[corners[(k + 1) % 3]].position));
        }
    }
    return static_cast<double>(longest);
}

/// Expects complete chains: consecutive pieces meet, and none is longer than a triangle.
void expect_whole_chains(const Scene& scene, const Camera& camera, const ContourStyle& style)
{
    test::Drawing drawing(scene, camera, small_page_px);
    const double longest_m = longest_edge_m(features::edge_mesh_of(drawing.layout), drawing.posed());
    const auto lists = drawing.chains(style);
    const std::vector<Chain> chains = chains_of(lists);
    size_t pieces = 0;
    size_t jumps = 0;
    uint32_t feature_pieces = 0;
    for (const Chain& chain : chains) {
        pieces += chain.points.size() - 1;
        for (size_t i = 0; i + 1 < chain.points.size(); ++i) {
            const auto piece_m =
                static_cast<double>(glm::distance(chain.points[i].anchor, chain.points[i + 1].anchor));
            jumps += piece_m > 1.001 * longest_m ? 1U : 0U;
        }
        EXPECT_TRUE(!chain.is_closed || chain.points.front().anchor == chain.points.back().anchor);
        const uint32_t kind = chain.points[0].source >> 28U;
        feature_pieces += kind != shared::line_silhouette && kind != shared::line_intersection
                              ? static_cast<uint32_t>(chain.points.size() - 1)
                              : 0U;
    }
    EXPECT_EQ(jumps, 0U);
    EXPECT_EQ(pieces - feature_pieces, lists.sizes[shared::list_segments].count);
}

TEST(ContourChains, EachChainGoesOnFromPieceToPieceAndNoneIsMissing)
{
    expect_whole_chains(shapes_scene(), view_from_above(), {});
    for (const float crease_deg : {10.0F, 17.0F, 40.0F, 180.0F}) {
        expect_whole_chains(test::scene_of(faceted_vase()), view_from_above(), {.crease_deg = crease_deg});
        expect_whole_chains(test::scene_of(faceted_vase()),
                            {.eye = {0.4, -1.1, 4.0}, .target = {0.0, 1.0, 0.0}}, {.crease_deg = crease_deg});
    }
}

TEST(ContourChains, ChainsOfModelsGoOnFromPieceToPiece)
{
    for_each_model([](const Scene& scene, const Camera& camera, const char* name) {
        const testing::ScopedTrace trace(__FILE__, __LINE__, name);
        expect_whole_chains(scene, camera, {});
        expect_whole_chains(scene, camera, {.crease_deg = 180.0F});
    });
}

TEST(ContourChains, OnAClosedManifoldEveryOutlineCloses)
{
    const Scene scene = test::scene_of(subdivided(shapes::torus(1.0F, 0.45F, 30, 14), 1));
    for (const double height : {0.3, 1.1, 2.7}) {
        test::Drawing drawing(scene, {.eye = {0.4, height, 4.0}, .target = {0.0, 0.0, 0.0}}, small_page_px);
        for (const Silhouettes kind : {Silhouettes::smooth, Silhouettes::edges}) {
            const std::vector<Chain> chains =
                chains_of(drawing.chains({.silhouettes = kind, .crease_deg = 180.0F}));
            EXPECT_GE(chains.size(), 2U);
            for (const Chain& chain : chains) {
                EXPECT_TRUE(chain.is_closed);
            }
        }
    }
}

/// A closed limb of five uneven sides with averaged normals. Its normals fit the narrow sides, and not the
/// wide ones, which count as flat.
Primitive limb()
{
    constexpr std::array<float, 5> angles_deg{0.0F, 100.0F, 140.0F, 180.0F, 260.0F};
    constexpr std::array<float, 4> radii{0.25F, 0.45F, 0.4F, 0.2F};
    Primitive result;
    for (size_t ring = 0; ring < radii.size(); ++ring) {
        for (const float angle_deg : angles_deg) {
            const float angle = glm::radians(angle_deg);
            result.positions.emplace_back(radii.at(ring) * std::cos(angle),
                                          0.8F * static_cast<float>(ring) - 1.2F,
                                          radii.at(ring) * std::sin(angle));
        }
    }
    const auto bottom = static_cast<uint32_t>(result.positions.size());
    result.positions.insert(result.positions.end(), {{0.0F, -1.5F, 0.0F}, {0.0F, 1.5F, 0.0F}});
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        result.indices.insert(result.indices.end(), {a, b, c});
    };
    for (uint32_t i = 0; i < 5; ++i) {
        const uint32_t j = (i + 1) % 5;
        add(bottom, i, j);
        add(bottom + 1, 15 + j, 15 + i);
        for (uint32_t low = 0; low < 15; low += 5) {
            add(low + i, low + 5 + i, low + 5 + j);
            add(low + i, low + 5 + j, low + j);
        }
    }
    result.normals.resize(result.positions.size());
    for (size_t t = 0; t < result.indices.size(); t += 3) {
        const auto at = [&](size_t k) { return result.positions[result.indices[t + k]]; };
        for (size_t k = 0; k < 3; ++k) {
            result.normals[result.indices[t + k]] += glm::cross(at(1) - at(0), at(2) - at(0));
        }
    }
    for (glm::vec3& normal : result.normals) {
        normal = glm::normalize(normal);
    }
    return result;
}

TEST(ContourChains, OutlinesCloseWhereTheyPassFromSmoothPartsToHardEdges)
{
    for (const Primitive& thing :
         {limb(), banded_ring(), wound_backwards(banded_ring()), shapes::cone(1.0F, 1.6F, 24),
          shapes::cylinder(1.0F, 2.0F, 24), shapes::box({1.0F, 1.4F, 0.8F})}) {
        for (const double height : {-0.7, 0.2, 1.1, 2.7}) {
            test::Drawing drawing(test::scene_of(thing),
                                  {.eye = {0.4, height, 4.0}, .target = {0.0, 0.0, 0.0}}, small_page_px);
            const std::vector<Chain> chains = chains_of(drawing.chains({.crease_deg = 180.0F}));
            EXPECT_GE(chains.size(), 1U);
            EXPECT_LE(chains.size(), 4U);
            for (const Chain& chain : chains) {
                EXPECT_TRUE(chain.is_closed) << height;
            }
        }
    }
}

TEST(ContourChains, ArcLengthsAreThoseOfASerialSum)
{
    test::Drawing drawing(shapes_scene(), view_from_above(), small_page_px);
    const auto lists = drawing.chains({});
    const glm::dmat4 clip_from_anchor(drawing.globals.clip_from_anchor);
    const auto page = [&](const glm::vec3& anchor) {
        const glm::dvec4 clip = clip_from_anchor * glm::dvec4(anchor, 1.0);
        return (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(small_page_px);
    };
    double worst = 0.0;
    size_t compared = 0;
    for (size_t slot = 0; slot + 1 < lists.points_before.size(); ++slot) {
        const uint32_t begin = lists.points_before[slot];
        const uint32_t end = lists.points_before[slot + 1];
        const bool is_on_page = std::all_of(
            lists.points.begin() + begin, lists.points.begin() + end, [&](const ChainPoint& point) {
                const glm::dvec2 at = page(point.anchor);
                return at.x > 0.0 && at.y > 0.0 && at.x < small_page_px.x && at.y < small_page_px.y;
            });
        double serial = 0.0;
        for (uint32_t i = begin; is_on_page && i + 1 < end; ++i, ++compared) {
            serial += glm::distance(page(lists.points[i].anchor), page(lists.points[i + 1].anchor));
            const double scanned =
                static_cast<double>(lists.lengths_before[i + 1] - lists.lengths_before[begin]) /
                shared::length_unit_px;
            worst = std::max(worst, std::abs(scanned - serial) / std::max(serial, 1.0));
        }
    }
    EXPECT_GT(compared, 100U);
    EXPECT_LT(worst, 1e-3);
}

/// Compares the number of an outline's chains at several levels of subdivision.
void expect_stable_count(const Scene& cage, const std::vector<Camera>& views, uint32_t coarsest,
                         uint32_t finest)
{
    std::vector<double> counts;
    for (uint32_t level = coarsest; level <= finest; ++level) {
        Scene scene = cage;
        for (uint32_t i = 0; i < scene.meshes.size() && level > 0; ++i) {
            scene.meshes[i].primitives[0] = subdivided(cage.meshes[i].primitives[0], level);
        }
        size_t count = 0;
        for (const Camera& view : views) {
            const auto lists = test::Drawing(scene, view, small_page_px).chains({});
            for (size_t slot = 0; slot + 1 < lists.points_before.size(); ++slot) {
                const uint32_t first = lists.points_before[slot];
                const uint32_t end = lists.points_before[slot + 1];
                count +=
                    end > first && lists.points[first].source >> 28U == shared::line_silhouette ? 1U : 0U;
            }
        }
        counts.push_back(static_cast<double>(count));
    }
    for (const double count : counts) {
        EXPECT_NEAR(count, counts.back(), 0.15 * counts.back());
    }
}

TEST(ContourChains, AFinerMeshHasNoMoreChains)
{
    expect_stable_count(test::scene_of(shapes::torus(1.0F, 0.4F, 14, 8)),
                        {{.eye = {0.3, 1.1, 4.0}, .target = {0.0, 0.0, 0.0}}}, 2, 4);
    const char* folder = std::getenv("ESTAMPE_MODELS");
    if (folder != nullptr && std::filesystem::exists(std::filesystem::path(folder) / "suzanne.gltf")) {
        const Scene scene = load_scene(std::filesystem::path(folder) / "suzanne.gltf");
        const Camera camera = framing_camera(scene, pose_scene(scene, 0.0, no_index), 4.0 / 3.0);
        std::vector<Camera> views;
        for (const double turn : {-0.6, 0.0, 0.6, 2.5}) {
            const glm::dvec3 away = camera.eye - camera.target;
            views.push_back(camera);
            views.back().eye =
                camera.target + glm::dvec3(std::cos(turn) * away.x + std::sin(turn) * away.z, away.y,
                                           std::cos(turn) * away.z - std::sin(turn) * away.x);
        }
        expect_stable_count(scene, views, 0, 2);
    }
}

} // namespace
} // namespace estampe::contour
