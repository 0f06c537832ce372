// SPDX-License-Identifier: MIT
// Baked normal maps of detailed surfaces whose normals are known.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "scene/gltf/test_file.hpp"
#include "support/folder.hpp"
#include "techniques/bake/normals/corners.hpp"
#include "techniques/bake/normals/test_support.hpp"

namespace estampe::bake::testing {
namespace {

using test::scene_of;

/// A primitive with changed texture coordinates.
Primitive with_uvs(Primitive primitive, const std::function<glm::vec2(glm::vec2)>& change)
{
    for (glm::vec2& uv : primitive.uvs[0]) {
        uv = change(uv);
    }
    return primitive;
}

/// Largest distance between the normals of a map of the unit square and `wanted`, a function of the UVs.
double worst_of(const Image& map, const std::function<glm::dvec3(double, double)>& wanted)
{
    double worst = 0.0;
    for (uint32_t y = 0; y < map.height; ++y) {
        for (uint32_t x = 0; x < map.width; ++x) {
            worst = std::max(worst, glm::distance(texel_of(map, x, y),
                                                  wanted((x + 0.5) / map.width, (y + 0.5) / map.height)));
        }
    }
    return worst;
}

std::string error_of(const Scene& plain, const Scene& detailed, const NormalBakeSettings& settings)
{
    try {
        static_cast<void>(bake_normals(plain, detailed, settings));
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(BakedNormals, OfWavesAreTheirDerivative)
{
    double worst = 0.0;
    for (const TangentFrame frame : {TangentFrame::of_triangle, TangentFrame::of_vertices}) {
        for (const uint32_t samples : {1U, 2U, 3U}) {
            const BakedNormals baked =
                bake_normals(scene_of(square()), scene_of(waves()),
                             {.size = 128, .samples = samples, .distance_m = 0.1, .frame = frame});
            EXPECT_EQ(baked.covered_texels, 128U * 128U);
            EXPECT_EQ(baked.missed_share, 0.0);
            EXPECT_EQ(baked.overlapping_share, 0.0) << "the diagonal runs through centres of samples";
            worst = std::max(worst,
                             worst_of(baked.map, [](double u, double v) { return wave_normal(u, 1.0 - v); }));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 0.008) << "rounding to bytes alone gives up to 0.007";
}

TEST(BakedNormals, FollowMirroredAndTurnedUvs)
{
    struct Case {
        std::function<glm::vec2(glm::vec2)> change;
        std::function<glm::dvec3(double, double)> wanted;
    };

    const Case cases[] = {
        {[](glm::vec2 uv) { return glm::vec2(1.0F - uv.x, uv.y); },
         [](double u, double v) { return wave_normal(1.0 - u, 1.0 - v) * glm::dvec3(-1.0, 1.0, 1.0); }},
        {[](glm::vec2 uv) { return glm::vec2(uv.x, 1.0F - uv.y); },
         [](double u, double v) { return wave_normal(u, v) * glm::dvec3(1.0, -1.0, 1.0); }},
        {[](glm::vec2 uv) { return glm::vec2(uv.y, 1.0F - uv.x); }, // u runs down the square, v to the left
         [](double u, double v) {
             const glm::dvec3 n = wave_normal(1.0 - v, 1.0 - u);
             return glm::dvec3(-n.y, n.x, n.z);
         }},
        // Outside 0 to 1 the texture repeats.
        {[](glm::vec2 uv) { return uv + glm::vec2(3.0F, -2.0F); },
         [](double u, double v) { return wave_normal(u, 1.0 - v); }}};
    for (const TangentFrame frame : {TangentFrame::of_triangle, TangentFrame::of_vertices}) {
        for (size_t i = 0; i < std::size(cases); ++i) {
            const BakedNormals baked =
                bake_normals(scene_of(with_uvs(square(), cases[i].change)), scene_of(waves()),
                             {.size = 64, .distance_m = 0.1, .frame = frame});
            EXPECT_EQ(baked.covered_texels, 64U * 64U) << i;
            EXPECT_LT(worst_of(baked.map, cases[i].wanted), 0.008) << i;
        }
    }
}

TEST(BakedNormals, GreenDownReversesGreen)
{
    const BakedNormals baked = bake_normals(scene_of(square()), scene_of(waves()),
                                            {.size = 64, .distance_m = 0.1, .is_green_down = true});
    EXPECT_LT(
        worst_of(baked.map,
                 [](double u, double v) { return wave_normal(u, 1.0 - v) * glm::dvec3(1.0, -1.0, 1.0); }),
        0.008);
}

/// Largest error of the normals of a low sphere with a baked map, at the centres of the texels that lie
/// within a triangle and between 60 degrees north and south.
double worst_on_globe(TangentFrame frame)
{
    constexpr uint32_t columns = 24;
    constexpr uint32_t rows = 12;
    constexpr uint32_t size = 256;
    const Scene low = scene_of(globe(columns, rows));
    const Image map = bake_normals(low, scene_of(globe(512, 256)),
                                   {.size = size, .samples = 1, .distance_m = 0.1, .frame = frame})
                          .map;
    const Corners corners = corners_of(low, pose_scene(low, 0.0, no_index), glm::dvec3(0.0),
                                       [](const PosedPrimitive&) { return 0; });
    const std::vector<glm::vec4> tangents = vertex_tangents(corners);
    double worst = 0.0;
    for (size_t triangle = 0; triangle < corners.count(); ++triangle) {
        const glm::dvec2 a(corners.uvs[3 * triangle]);
        const glm::dmat2 edges(glm::dvec2(corners.uvs[3 * triangle + 1]) - a,
                               glm::dvec2(corners.uvs[3 * triangle + 2]) - a);
        for (uint32_t y = size / 6; y < size * 5 / 6; ++y) {
            for (uint32_t x = 0; x < size; ++x) {
                const glm::dvec2 at = glm::inverse(edges) * (glm::dvec2(x + 0.5, y + 0.5) / double{size} - a);
                const glm::dvec3 weights(1.0 - at.x - at.y, at.x, at.y);
                if (std::min({weights.x, weights.y, weights.z}) < 1e-6) {
                    continue;
                }
                // The vertices of a unit sphere are their normals, so rays run through the centre.
                const glm::dvec3 radial = glm::normalize(between(corners.positions, triangle, weights));
                const glm::dmat3 axes = frame == TangentFrame::of_triangle
                                            ? triangle_frame(corners, triangle, radial)
                                            : vertex_frame(between(tangents, triangle, weights), radial);
                worst = std::max(worst, glm::distance(glm::normalize(axes * texel_of(map, x, y)), radial));
            }
        }
    }
    return worst;
}

TEST(BakedNormals, OfASphereAreRadial)
{
    const double of_triangle = worst_on_globe(TangentFrame::of_triangle);
    const double of_vertices = worst_on_globe(TangentFrame::of_vertices);
    RecordProperty("of_triangle", std::to_string(of_triangle));
    RecordProperty("of_vertices", std::to_string(of_vertices));
    EXPECT_LT(of_triangle, 0.008);
    EXPECT_LT(of_vertices, 0.008);
}

TEST(BakedNormals, VertexTangentsAreMeansOverTrianglesThatShareEdges)
{
    // Triangles around the origin, with UVs of 0 there.
    Primitive fan;
    const auto add = [&](const glm::vec2& a, const glm::vec2& b, const glm::vec2& uv_a,
                         const glm::vec2& uv_b) {
        for (const glm::vec2 p : {glm::vec2(0.0F), a, b}) {
            fan.indices.push_back(static_cast<uint32_t>(fan.positions.size()));
            fan.positions.emplace_back(p, 0.0F);
            fan.normals.emplace_back(0.0F, 0.0F, 1.0F);
        }
        fan.uvs[0].insert(fan.uvs[0].end(), {glm::vec2(0.0F), uv_a, uv_b});
    };
    add({1, 0}, {0, 1}, {1, 0}, {0, -1});     // upright
    add({0, 1}, {-1, 1}, {0, -1}, {1, -1});   // mirrored
    add({-1, -1}, {0, -1}, {1, -1}, {0, -1}); // upside down; shares only the vertex
    add({0, 1}, {-1, 1}, {0, -1}, {-1, -2});  // shares an edge with the first triangle, at half its angle
    const Scene scene = scene_of(fan);
    const std::vector<glm::vec4> tangents = vertex_tangents(corners_of(
        scene, pose_scene(scene, 0.0, no_index), glm::dvec3(0.0), [](const PosedPrimitive&) { return 0; }));
    // In the last triangle u = x and v = x - y, so u grows along (1, 1), where v does not change.
    const glm::vec3 slope = glm::normalize(glm::vec3(1.0F, 1.0F, 0.0F));
    const glm::vec3 mean = glm::normalize(2.0F * glm::vec3(1.0F, 0.0F, 0.0F) + slope);
    EXPECT_LT(glm::distance(tangents[0], glm::vec4(mean, 1.0F)), 1e-5F);
    EXPECT_LT(glm::distance(tangents[9], glm::vec4(mean, 1.0F)), 1e-5F);
    EXPECT_LT(glm::distance(tangents[3], glm::vec4(-1.0F, 0.0F, 0.0F, -1.0F)), 1e-5F);
    EXPECT_LT(glm::distance(tangents[6], glm::vec4(-1.0F, 0.0F, 0.0F, 1.0F)), 1e-5F);
}

TEST(BakedNormals, OfAnOctahedronAreThoseOfTheSphere)
{
    // Each face of the octahedron has a quarter of the height of the map.
    Primitive octahedron;
    const glm::vec3 axes[] = {{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}};
    for (uint32_t face = 0; face < 8; ++face) {
        const float side = face < 4 ? 1.0F : -1.0F;
        const glm::vec3 here = axes[face % 4];
        const glm::vec3 next = axes[(face + 1) % 4];
        const glm::vec2 corner(0.25F * static_cast<float>(face % 4), face < 4 ? 0.0F : 0.5F);
        const glm::vec3 corners[] = {
            {0.0F, side, 0.0F}, side > 0.0F ? here : next, side > 0.0F ? next : here};
        const glm::vec2 uvs[] = {{0.0F, 0.0F}, {0.0F, 0.25F}, {0.25F, 0.25F}};
        for (size_t k = 0; k < 3; ++k) {
            octahedron.indices.push_back(static_cast<uint32_t>(octahedron.positions.size()));
            octahedron.positions.push_back(corners[k]);
            octahedron.normals.push_back(corners[k]);
            octahedron.uvs[0].push_back(corner + uvs[k]);
        }
    }
    const Scene low = scene_of(octahedron);
    const Corners corners = corners_of(low, pose_scene(low, 0.0, no_index), glm::dvec3(0.0),
                                       [](const PosedPrimitive&) { return 0; });
    constexpr uint32_t size = 256;
    const BakedNormals baked =
        bake_normals(low, scene_of(globe(512, 256)), {.size = size, .distance_m = 0.5});
    EXPECT_EQ(baked.missed_share, 0.0);
    double worst = 0.0;
    for (size_t face = 0; face < 8; ++face) {
        for (uint32_t y = 2; y < size / 4; ++y) {
            for (uint32_t x = 2; x + 2 < y; ++x) {
                // Weights of a texel's centre in the right-angled triangle of the face.
                const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) / (size / 4.0);
                const glm::dvec3 weights(1.0 - at.y, at.y - at.x, at.x);
                const glm::dvec3 radial = glm::normalize(between(corners.positions, face, weights));
                const glm::dvec3 texel = texel_of(baked.map, x + static_cast<uint32_t>(face % 4) * size / 4,
                                                  y + (face < 4 ? 0 : size / 2));
                worst = std::max(
                    worst,
                    glm::distance(glm::normalize(triangle_frame(corners, face, radial) * texel), radial));
            }
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 0.008);
}

TEST(BakedNormals, DoNotDependOnTheNumberOfThreads)
{
    const Scene low = scene_of(globe(12, 6));
    const Scene high = scene_of(globe(64, 32));
    const Image usual = bake_normals(low, high, {.size = 128, .distance_m = 0.2}).map;
    Image alone;
    tbb::task_arena(1).execute(
        [&] { alone = bake_normals(low, high, {.size = 128, .distance_m = 0.2}).map; });
    EXPECT_EQ(usual, alone);
}

TEST(BakedNormals, WhereNoRayHitsAreFlat)
{
    // The plain square is twice as wide as the detail, which is tilted.
    const Primitive wide = patch(1, 1, [](double x, double y) {
        return SurfacePoint{{2.0 * x - 0.5, y, 0.0}, {0.0, 0.0, 1.0}, {x, 1.0 - y}};
    });
    Primitive tilted = square();
    std::ranges::fill(tilted.normals, glm::vec3(0.6F, 0.0F, 0.8F));
    const BakedNormals baked = bake_normals(scene_of(wide), scene_of(tilted), {.size = 64});
    EXPECT_NEAR(baked.missed_share, 0.5, 1e-9);
    EXPECT_NEAR(baked.distance_m, 0.02 * std::sqrt(5.0), 1e-6) << "2 % of the diagonal";
    EXPECT_EQ(texel_of(baked.map, 10, 30), glm::dvec3(128, 128, 255) / 127.5 - 1.0);
    // UVs twice as wide as high: u is drawn half as strong, so the map has twice the slope.
    EXPECT_LT(glm::distance(texel_of(baked.map, 30, 30), glm::normalize(glm::dvec3(1.2, 0.0, 0.8))), 0.008);
    EXPECT_EQ(bake_normals(scene_of(square()), scene_of(tilted), {.size = 16, .border = 0}).missed_share,
              0.0);
}

TEST(BakedNormals, TakeTheOuterFrontFaceWithinTheDistance)
{
    const auto layer = [](float z, const glm::vec3& normal, bool is_turned) {
        Primitive primitive = square();
        for (size_t i = 0; i < primitive.positions.size(); ++i) {
            primitive.positions[i].z = z;
            primitive.normals[i] = normal;
        }
        if (is_turned) {
            std::ranges::reverse(primitive.indices);
        }
        return primitive;
    };
    Scene stack;
    test::add_object(stack, layer(0.3F, {0.0F, 0.6F, 0.8F}, false), glm::vec3(1.0F));
    test::add_object(stack, layer(0.05F, {0.6F, 0.0F, -0.8F}, true), glm::vec3(1.0F)); // faces -z
    test::add_object(stack, layer(-0.02F, {0.6F, 0.0F, 0.8F}, false), glm::vec3(1.0F));
    const auto seen = [&](double distance_m) {
        return texel_of(bake_normals(scene_of(square()), stack, {.size = 16, .distance_m = distance_m}).map,
                        8, 8);
    };
    EXPECT_LT(glm::distance(seen(0.1), {0.6, 0.0, 0.8}), 0.008)
        << "the back of a sheet in front is no detail";
    EXPECT_LT(glm::distance(seen(0.4), {0.0, 0.6, 0.8}), 0.008)
        << "the outermost detail is the one that is seen";
    // A sheet that was modelled the wrong way round is drawn from both sides, so it counts.
    Scene sheet = scene_of(layer(0.0F, {0.6F, 0.0F, -0.8F}, true));
    const NormalBakeSettings settings{.size = 16, .distance_m = 0.1};
    EXPECT_LT(glm::distance(texel_of(bake_normals(scene_of(square()), sheet, settings).map, 8, 8),
                            {-0.6, 0.0, 0.8}),
              0.008);
    sheet.materials[0].double_sided = false;
    EXPECT_EQ(bake_normals(scene_of(square()), sheet, settings).missed_share, 1.0);
}

TEST(BakedNormals, RaysFanOutAtTheHardEdgesOfABox)
{
    const Scene box = scene_of(shapes::box({2.0F, 2.0F, 2.0F}));
    const Corners corners = corners_of(box, pose_scene(box, 0.0, no_index), {0.0, 1.0, 0.0},
                                       [](const PosedPrimitive&) { return 0; });
    const std::vector<glm::vec3> outward = smooth_normals(corners);
    ASSERT_EQ(outward.size(), 36U);
    for (size_t i = 0; i < outward.size(); ++i) {
        EXPECT_LT(glm::distance(outward[i], glm::normalize(corners.positions[i])), 1e-5F) << i;
    }
}

TEST(BakedNormals, OverlappingUvsAreCountedAndTheFirstTriangleWins)
{
    Scene two = scene_of(square());
    test::add_object(two, square(), glm::vec3(1.0F), {3.0, 0.0, 0.0});
    Scene detail;
    Primitive left = square();
    std::ranges::fill(left.normals, glm::vec3(0.6F, 0.0F, 0.8F));
    test::add_object(detail, left, glm::vec3(1.0F));
    test::add_object(detail, square(), glm::vec3(1.0F), {3.0, 0.0, 0.0});
    two.nodes[0].name = "left wall";
    two.nodes[1].name = "right wall";
    two.materials[1].name = "stone";
    const BakedNormals both = bake_normals(two, detail, {.size = 16});
    EXPECT_EQ(both.overlapping_share, 1.0);
    EXPECT_LT(glm::distance(texel_of(both.map, 8, 8), {0.6, 0.0, 0.8}), 0.008);
    const BakedNormals right = bake_normals(two, detail, {.size = 16, .object = "right*"});
    EXPECT_EQ(right.overlapping_share, 0.0);
    EXPECT_LT(glm::distance(texel_of(right.map, 8, 8), {0.0, 0.0, 1.0}), 0.008);
    EXPECT_EQ(bake_normals(two, detail, {.size = 16, .material = "stone"}).map, right.map);
    EXPECT_EQ(bake_normals(two, detail, {.size = 16, .distance_m = 0.1, .object = "left*"}).missed_share,
              0.0);
    EXPECT_EQ(error_of(two, detail, {.size = 16, .object = "roof"}),
              "no object has the name \"roof\"; there is \"left wall\", \"right wall\"");
    EXPECT_EQ(error_of(two, detail, {.size = 16, .material = "wood"}),
              "no material has the name \"wood\"; there is \"stone\"");
    EXPECT_EQ(error_of(two, detail, {.size = 16, .detailed_object = "x"}),
              "no object has the name \"x\"; no object has a name");
}

TEST(BakedNormals, EdgesThroughSamplesBelongToOneTriangle)
{
    // Seven by seven cells, whose edges run through the centres of texels.
    const Primitive grid = patch(7, 7, [](double x, double y) {
        return SurfacePoint{{x, y, 0.0}, {0.0, 0.0, 1.0}, {(56.0 * x + 4.5) / 64.0, (56.0 * y + 4.5) / 64.0}};
    });
    const BakedNormals baked =
        bake_normals(scene_of(grid), scene_of(square()), {.size = 64, .samples = 1, .distance_m = 0.1});
    EXPECT_EQ(baked.overlapping_share, 0.0);
    EXPECT_EQ(baked.covered_texels, 56U * 56U);
}

TEST(BakedNormals, AreExtendedByABorder)
{
    const Scene plain =
        scene_of(with_uvs(square(), [](glm::vec2 uv) { return 0.5F * uv + glm::vec2(0.5F, 0.25F); }));
    Primitive tilted = square();
    std::ranges::fill(tilted.normals, glm::vec3(0.6F, 0.0F, 0.8F));
    const auto at = [&](uint32_t border, uint32_t x, uint32_t y) {
        return texel_of(bake_normals(plain, scene_of(tilted), {.size = 64, .border = border}).map, x, y);
    };
    const glm::dvec3 flat = glm::dvec3(128, 128, 255) / 127.5 - 1.0;
    EXPECT_EQ(at(0, 31, 30), flat);
    EXPECT_EQ(at(4, 28, 30), at(0, 40, 30));
    EXPECT_EQ(at(4, 27, 30), flat);
    EXPECT_EQ(at(4, 3, 30), at(0, 40, 30)) << "the map repeats beyond its right edge";
    EXPECT_EQ(at(4, 4, 30), flat);
}

TEST(BakedNormals, TakeTheNormalMapOfTheDetail)
{
    Scene detail = scene_of(with_uvs(square(), [](glm::vec2 uv) { return glm::vec2(1.0F - uv.x, uv.y); }));
    detail.textures.push_back({.image = {.width = 1, .height = 1, .rgba = {204, 128, 230, 255}}});
    detail.materials[0].normal_texture.texture = 0;
    const BakedNormals baked = bake_normals(scene_of(square()), detail, {.size = 16});
    EXPECT_LT(glm::distance(texel_of(baked.map, 8, 8), {-0.6, 0.0, 0.8}), 0.015) << "its UVs are mirrored";
    // A ramp of two texels, filtered between them.
    detail.textures[0].image = {.width = 2, .height = 1, .rgba = {128, 128, 255, 255, 204, 128, 230, 255}};
    const BakedNormals ramp = bake_normals(scene_of(square()), detail, {.size = 32, .samples = 1});
    EXPECT_NEAR(texel_of(ramp.map, 16, 8).x, -0.3, 0.04);
}

TEST(BakedNormals, AreOfTheRestPose)
{
    // A mirrored and stretched node places both meshes; a skin of one joint moves the detail.
    Scene plain = scene_of(square());
    Scene detail = scene_of(waves());
    for (Scene* scene : {&plain, &detail}) {
        scene->nodes[0].transform.scale = {-1.0, 1.0, 2.0};
        scene->nodes[0].transform.translation = {1000.0, 5.0, 0.0};
    }
    // At twice the height, the slopes are twice as steep.
    const auto wanted = [](double u, double v) {
        const glm::dvec3 n = wave_normal(u, 1.0 - v);
        return glm::normalize(glm::dvec3(n.x, n.y, 0.5 * n.z));
    };
    const NormalBakeSettings settings{.size = 64, .distance_m = 0.2};
    EXPECT_LT(worst_of(bake_normals(plain, detail, settings).map, wanted), 0.008);
    Primitive& skinned = detail.meshes[0].primitives[0];
    skinned.joints_0.assign(skinned.positions.size(), glm::u16vec4(0));
    skinned.weights_0.assign(skinned.positions.size(), glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
    detail.skins.push_back({.joints = {1}, .joint_from_bind = {glm::mat4(1.0F)}});
    detail.nodes.push_back({.transform = detail.nodes[0].transform});
    detail.roots.push_back(1);
    detail.nodes[0].skin = 0;
    detail.nodes[0].transform = {};
    EXPECT_LT(worst_of(bake_normals(plain, detail, settings).map, wanted), 0.008);
}

TEST(BakedNormals, ComeBackThroughTheReaderOfGltf)
{
    const auto file_of = [](const Primitive& primitive) {
        gltf::TestFile file;
        file.document["scene"] = 0;
        file.document["scenes"] = {{{"nodes", {0}}}};
        file.document["nodes"] = {{{"mesh", 0}}};
        file.document["meshes"] = {{{"primitives", {{{"attributes", nlohmann::json::object()}}}}}};
        const auto floats = [](const auto& vectors) {
            std::vector<float> numbers;
            for (const auto& vector : vectors) {
                for (int k = 0; k < vector.length(); ++k) {
                    numbers.push_back(vector[k]);
                }
            }
            return numbers;
        };
        const int positions =
            file.add(floats(primitive.positions), "VEC3", {{"min", {-9, -9, -9}}, {"max", {9, 9, 9}}});
        const int normals = file.add(floats(primitive.normals), "VEC3");
        const int uvs = file.add(floats(primitive.uvs[0]), "VEC2");
        const int indices = file.add(primitive.indices, "SCALAR");
        file.attributes() = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}};
        file.primitive()["indices"] = indices;
        return file;
    };
    const test::Folder folder;
    const auto write = [&](const gltf::TestFile& file, const char* name) {
        const gltf::Bytes bytes = file.glb();
        std::ofstream(folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return load_scene(folder / name);
    };
    gltf::TestFile plain = file_of(square());
    const Scene detailed = write(file_of(waves()), "waves.glb");
    const BakedNormals baked =
        bake_normals(write(plain, "square.glb"), detailed, {.size = 64, .distance_m = 0.1});
    EXPECT_LT(worst_of(baked.map, [](double u, double v) { return wave_normal(u, 1.0 - v); }), 0.008);
    save_png(baked.map, folder / "waves.png");
    plain.document["images"] = {{{"uri", "waves.png"}}};
    plain.document["textures"] = {{{"source", 0}}};
    plain.document["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    plain.primitive()["material"] = 0;
    const Scene mapped = write(plain, "mapped.glb");
    EXPECT_EQ(mapped.textures.at(mapped.materials.at(0).normal_texture.texture).image, baked.map);
    // A square with this map is detail like the waves.
    const BakedNormals again = bake_normals(scene_of(square()), mapped, {.size = 64, .samples = 1});
    EXPECT_LT(worst_of(again.map, [](double u, double v) { return wave_normal(u, 1.0 - v); }), 0.016);
}

TEST(BakedNormals, MeshesAndSettingsThatDoNotServeAreRefused)
{
    const Scene high = scene_of(square());
    Primitive bare = square();
    bare.uvs[0].clear();
    Scene low = scene_of(bare);
    low.name = "low.obj";
    EXPECT_EQ(
        error_of(low, high, {}),
        "low.obj: has no UVs, so a normal map has no place on it; unwrap the mesh in a modelling program");
    EXPECT_EQ(error_of(scene_of(square()), high, {.uv_set = 1}),
              "has no second set of UVs; unwrap the mesh in a modelling program");
    EXPECT_EQ(error_of(scene_of(with_uvs(square(), [](glm::vec2) { return glm::vec2(0.5F); })), high, {}),
              "the UVs cover no texel of the map; unwrap the mesh in a modelling program");
    EXPECT_EQ(error_of(Scene{}, high, {}), "no triangles to make a normal map for");
    EXPECT_EQ(error_of(high, Scene{}, {}), "no triangles to take normals from");
    EXPECT_EQ(error_of(high, high, {.size = 8}), "the size 8 is out of range; allowed: 16 to 8192");
    EXPECT_EQ(error_of(high, high, {.samples = 9}),
              "the number of samples 9 is out of range; allowed: 1 to 8");
    EXPECT_EQ(error_of(high, high, {.border = 65}), "the border 65 is out of range; allowed: 0 to 64");
    EXPECT_EQ(error_of(high, high, {.uv_set = 2}), "the UV set 2 is out of range; allowed: 0 to 1");
    EXPECT_NE(error_of(high, high, {.distance_m = std::nan("")}), "no error");
    EXPECT_NE(error_of(high, high, {.distance_m = 0.0}), "no error");

    // A mesh of which only a part can be mapped loses the rest, and the result counts it.
    Scene mixed = scene_of(square());
    test::add_object(mixed, bare, glm::vec3(1.0F));
    test::add_object(mixed, with_uvs(square(), [](glm::vec2 uv) { return 100.0F * uv; }), glm::vec3(1.0F));
    test::add_object(mixed, with_uvs(square(), [](glm::vec2) { return glm::vec2(NAN); }), glm::vec3(1.0F));
    test::add_object(mixed, with_uvs(square(), [](glm::vec2 uv) { return glm::vec2(uv.x); }),
                     glm::vec3(1.0F));
    const BakedNormals baked = bake_normals(mixed, high, {.size = 16});
    EXPECT_EQ(baked.triangles, 10U);
    EXPECT_EQ(baked.triangles_without_uvs, 4U);
    EXPECT_EQ(baked.triangles_of_wild_uvs, 4U);
    EXPECT_EQ(baked.overlapping_share, 0.0);
}

} // namespace
} // namespace estampe::bake::testing
