// SPDX-License-Identifier: MIT
#include "techniques/bake/bake.hpp"

#include <numbers>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "techniques/bake/test_support.hpp"

namespace estampe::bake {
namespace {

using testing::baked;
using testing::inside_out;
using testing::light_at;
using testing::light_on;
using testing::room_of;

BakeSettings quick(uint32_t bounces, uint32_t samples = 64)
{
    return {.size = 64, .samples = samples, .bounces = bounces, .smooth = false};
}

/// Mean light over all triangles, weighted by area.
glm::vec3 mean_light(const Scene& scene, const Lightmap& map)
{
    const StaticTriangles triangles = static_triangles(scene);
    glm::dvec3 sum(0.0);
    double area = 0.0;
    for (size_t i = 0; i < triangles.count(); ++i) {
        const glm::vec3* p = &triangles.positions[3 * i];
        const double own = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        sum += own * glm::dvec3(light_on(map, i));
        area += own;
    }
    return glm::vec3(sum / area);
}

/// Light after repeated reflection by a surface of albedo a: 1 + a + ... to the power n.
double series(double a, uint32_t n)
{
    double sum = 0.0;
    for (uint32_t k = 0; k <= n; ++k) {
        sum += std::pow(a, k);
    }
    return sum;
}

TEST(Bake, GlowInAClosedBoxIsTheTruncatedSeries)
{
    for (const uint32_t bounces : {0U, 1U, 4U}) {
        const Scene scene = room_of(inside_out(shapes::box({2.0F, 1.5F, 3.0F})), glm::vec3(0.5F, 0.7F, 0.9F),
                                    glm::vec3(0.4F, 1.0F, 2.0F));
        const Lightmap map = baked(scene, quick(bounces, 256));
        const glm::vec3 mean = mean_light(scene, map);
        const glm::dvec3 expected(0.4 * series(0.5, bounces), series(0.7, bounces),
                                  2.0 * series(0.9, bounces));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c], expected[c], 0.01 * expected[c]) << bounces;
            for (size_t i = 0; i < map.corners.size() / 3; ++i) {
                EXPECT_NEAR(light_on(map, i)[c], expected[c], 0.06 * expected[c]) << bounces;
            }
        }
    }
}

TEST(Bake, ALampInASphereLightsItByTheSeries)
{
    // Between any two points of a sphere the form factor is the same, so reflected light is uniform: u * (a +
    // a^2 + ...), where u = I / r^2 is the lamp's direct light.
    constexpr double albedo = 0.6;
    Scene scene = room_of(inside_out(shapes::sphere(2.0F, 64, 32)), glm::vec3(0.6F));
    for (const uint32_t bounces : {1U, 3U}) {
        BakeSettings settings = quick(bounces);
        settings.lamps = {{.kind = LampKind::point, .color = glm::vec3(4.0F)}};
        const double expected = 1.0 * (series(albedo, bounces) - 1.0);
        EXPECT_NEAR(mean_light(scene, baked(scene, settings)).y, expected, 0.01 * expected);
        settings.lamps[0].baked = true;
        EXPECT_NEAR(mean_light(scene, baked(scene, settings)).y, expected + 1.0, 0.01 * (expected + 1.0));
    }
}

TEST(Bake, AGlowingCapLightsItsSphereEvenly)
{
    // A cap of height h is h / 2r of the sphere; every point receives that share of the cap's radiance.
    Scene scene = room_of(inside_out(shapes::sphere(1.0F, 64, 48)), glm::vec3(0.5F));
    Primitive& all = scene.meshes[0].primitives[0];
    Primitive cap = all;
    cap.indices.clear();
    std::vector<uint32_t> rest;
    double cap_area = 0.0;
    double area = 0.0;
    for (size_t i = 0; i + 2 < all.indices.size(); i += 3) {
        const glm::vec3 a = all.positions[all.indices[i]];
        const glm::vec3 b = all.positions[all.indices[i + 1]];
        const glm::vec3 c = all.positions[all.indices[i + 2]];
        const bool is_cap = (a.y + b.y + c.y) / 3.0F > 0.8F;
        const double own = glm::length(glm::cross(b - a, c - a));
        area += own;
        cap_area += is_cap ? own : 0.0;
        for (size_t k = 0; k < 3; ++k) {
            (is_cap ? cap.indices : rest).push_back(all.indices[i + k]);
        }
    }
    all.indices = rest;
    cap.material = 1;
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].emissive = glm::vec3(3.0F);
    scene.meshes[0].primitives.push_back(cap);
    const double expected = 3.0 * cap_area / area * series(0.5, 2);
    const Lightmap map = baked(scene, quick(2));
    EXPECT_NEAR(mean_light(scene, map).y, expected, 0.01 * expected);
    double squares = 0.0;
    for (size_t i = 0; i < map.corners.size() / 3; ++i) {
        squares += std::pow(light_on(map, i).y / expected - 1.0, 2.0);
    }
    EXPECT_LT(std::sqrt(squares / (static_cast<double>(map.corners.size()) / 3.0)), 0.05);
}

TEST(Bake, AnOpenPlaneGetsTheSkyThatItFaces)
{
    Scene scene = test::scene_of(shapes::plane(2.0F, 2.0F));
    BakeSettings settings = quick(2, 1024);
    settings.size = 16;
    settings.sky = {0.2F, 0.4F, 0.8F};
    settings.ground = glm::vec3(0.1F);
    const glm::vec3 level = mean_light(scene, baked(scene, settings));
    EXPECT_NEAR(level.x, 0.2F, 1e-5F);
    EXPECT_NEAR(level.z, 0.8F, 1e-5F);
    for (const double lean_rad : {0.7, 1.5707963, 2.2}) {
        scene.nodes[0].transform.rotation = glm::angleAxis(lean_rad, glm::dvec3(0.0, 0.0, 1.0));
        const auto up = static_cast<float>(0.5 + 0.5 * std::cos(lean_rad));
        const glm::vec3 leaning = mean_light(scene, baked(scene, settings));
        EXPECT_NEAR(leaning.z, 0.8F * up + 0.1F * (1.0F - up), 0.008F) << lean_rad;
    }
}

TEST(Bake, TheSunOnAPlaneIsItsCosine)
{
    const Scene scene = test::scene_of(shapes::plane(2.0F, 2.0F));
    BakeSettings settings = quick(1, 4);
    settings.lamps = {{.direction = glm::normalize(glm::vec3(1.0F, 2.0F, 0.5F)), .baked = true}};
    EXPECT_NEAR(mean_light(scene, baked(scene, settings)).y, settings.lamps[0].direction.y, 1e-5F);
    settings.lamps[0].baked = false;
    EXPECT_EQ(mean_light(scene, baked(scene, settings)).y, 0.0F);
}

TEST(Bake, ManyLampsAreWorthTheirSum)
{
    const Scene scene = test::scene_of(shapes::plane(2.0F, 2.0F));
    BakeSettings settings = quick(0, 256);
    settings.smooth = true;
    double expected = 0.0;
    for (int i = 0; i < 20; ++i) {
        const glm::vec3 way = glm::normalize(glm::vec3(i - 10, 10, i % 3));
        settings.lamps.push_back(
            {.direction = way, .color = glm::vec3(0.05F * static_cast<float>(i)), .baked = true});
        expected += 0.05 * i * way.y;
    }
    EXPECT_NEAR(mean_light(scene, baked(scene, settings)).y, expected, 0.01 * expected);
}

/// Two rooms of one building, 4 x 2 x 2 m, with a wall at most 4 mm thick between them. Floor and ceiling are
/// continuous.
Scene two_cells()
{
    Scene scene = room_of(inside_out(shapes::box({4.0F, 2.0F, 2.0F})), glm::vec3(0.8F));
    Primitive wall = shapes::box({0.004F, 2.0F, 2.0F});
    wall.material = 0;
    scene.meshes.push_back({.primitives = {wall}});
    scene.nodes.push_back({.mesh = 1});
    scene.roots.push_back(1);
    return scene;
}

TEST(Bake, NoLightGoesThroughAThinWall)
{
    const Scene scene = two_cells();
    BakeSettings settings = quick(3, 32);
    settings.size = 128;
    settings.lamps = {
        {.kind = LampKind::point, .position = {-1.0F, 0.0F, 0.0F}, .color = glm::vec3(1.0F), .baked = true}};
    const Lightmap map = baked(scene, settings);
    const StaticTriangles triangles = static_triangles(scene);
    Bake bake(scene, settings);
    const float texel_m = 1.0F / bake.texels_per_m();
    int lit = 0;
    int dark = 0;
    for (size_t i = 0; i < triangles.count(); ++i) {
        for (float u = 0.02F; u < 1.0F; u += 0.04F) {
            for (float v = 0.02F; u + v < 1.0F; v += 0.04F) {
                const auto between = [&](const auto& corner) {
                    return (1.0F - u - v) * corner[0] + u * corner[1] + v * corner[2];
                };
                const glm::vec3 place = between(&triangles.positions[3 * i]);
                const float light = light_at(map.light, between(&map.corners[3 * i])).y;
                if (place.x > 0.002F + 1.5F * texel_m ||
                    (triangles.normals[3 * i].x > 0.9F && place.x > 0.0F)) {
                    EXPECT_EQ(light, 0.0F) << place.x << " " << place.y << " " << place.z;
                    ++dark;
                } else if (place.x < -1.5F * texel_m) {
                    EXPECT_GT(light, 0.05F);
                    ++lit;
                }
            }
        }
    }
    EXPECT_GT(lit, 500);
    EXPECT_GT(dark, 500);
}

TEST(Bake, MaskedLeavesLetRaysThrough)
{
    Scene scene = test::scene_of(shapes::plane(1.0F, 1.0F));
    test::add_object(scene, shapes::plane(400.0F, 400.0F), glm::vec3(0.0F), {0.0, 1.0, 0.0});
    BakeSettings settings = quick(0, 16);
    settings.sky = glm::vec3(1.0F);
    EXPECT_LT(light_on(baked(scene, settings), 0).y, 0.01F);
    scene.materials[1].alpha_mode = AlphaMode::mask;
    scene.materials[1].base_color.w = 0.2F;
    EXPECT_GT(light_on(baked(scene, settings), 0).y, 0.99F);
    scene.materials[1].alpha_mode = AlphaMode::blend;
    settings.samples = 512;
    EXPECT_NEAR(light_on(baked(scene, settings), 0).y, 0.8F, 0.06F);
}

TEST(Bake, ATexelInsideASolidTakesTheLightBesideIt)
{
    // A post stands in the floor. Texels below the post see only its back faces, and filtering must not let
    // them darken the floor around it.
    Scene scene = room_of(shapes::plane(2.0F, 2.0F), glm::vec3(0.5F));
    Primitive post = shapes::box({0.5F, 0.02F, 0.5F});
    scene.meshes.push_back({.primitives = {post}});
    scene.nodes.push_back({.transform = {.translation = {0.0, -0.01, 0.0}}, .mesh = 1});
    scene.roots.push_back(1);
    BakeSettings settings = quick(0, 16);
    settings.sky = glm::vec3(1.0F);
    const Lightmap map = baked(scene, settings);
    for (float x = 0.0F; x < 1.0F; x += 0.02F) {
        const glm::vec2 along = glm::mix(map.corners[0], map.corners[1], x);
        EXPECT_GT(light_at(map.light, along).y, 0.9F);
    }
    const glm::vec2 middle =
        0.5F * (map.corners[0] + map.corners[1] + map.corners[2] - 0.333F * map.corners[1]);
    EXPECT_GT(light_at(map.light, middle).y, 0.5F);
}

class BakeFiles : public ::testing::Test {
protected:
    static BakeSettings settings()
    {
        BakeSettings chosen = quick(2, 40);
        chosen.smooth = true;
        chosen.sky = glm::vec3(0.3F);
        chosen.lamps = {{.kind = LampKind::point, .position = {-1.0F, 0.5F, 0.0F}}};
        return chosen;
    }

    testing::Folder folder_;
};

TEST_F(BakeFiles, WorkTakenUpAgainGivesTheSameBytes)
{
    const Scene scene = two_cells();
    save_lightmap(baked(scene, settings()), folder_ / "whole.exr");
    {
        Bake first(scene, settings());
        ASSERT_TRUE(first.work(0.0));
        ASSERT_TRUE(first.work(0.0));
        EXPECT_GT(first.done(), 0.0);
        first.save_progress(folder_ / "part");
    }
    Bake second(scene, settings());
    ASSERT_TRUE(second.load_progress(folder_ / "part"));
    EXPECT_GT(second.done(), 0.0);
    while (second.work(0.0)) {
    }
    EXPECT_EQ(second.done(), 1.0);
    save_lightmap(second.map(), folder_ / "parts.exr");
    EXPECT_EQ(read_file(folder_ / "whole.exr"), read_file(folder_ / "parts.exr"));
}

TEST_F(BakeFiles, OneThreadGivesTheSameBytesAsMany)
{
    const Scene scene = two_cells();
    save_lightmap(baked(scene, settings()), folder_ / "many.exr");
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    save_lightmap(baked(scene, settings()), folder_ / "one.exr");
    EXPECT_EQ(read_file(folder_ / "many.exr"), read_file(folder_ / "one.exr"));
}

TEST_F(BakeFiles, ProgressOfOtherWorkIsNotTaken)
{
    Scene scene = two_cells();
    Bake bake(scene, settings());
    ASSERT_TRUE(bake.work(0.0));
    bake.save_progress(folder_ / "part");
    BakeSettings other = settings();
    other.seed = 2;
    EXPECT_FALSE(Bake(scene, other).load_progress(folder_ / "part"));
    EXPECT_FALSE(Bake(scene, settings()).load_progress(folder_ / "none"));
    Scene painted = scene;
    painted.materials[0].base_color = glm::vec4(0.1F);
    EXPECT_FALSE(Bake(painted, settings()).load_progress(folder_ / "part"));
    std::vector<std::byte> bytes = read_file(folder_ / "part");
    bytes.pop_back();
    write_file_atomically(folder_ / "part", bytes);
    EXPECT_FALSE(Bake(scene, settings()).load_progress(folder_ / "part"));
}

TEST(Bake, NothingThatStandsStillIsAnError)
{
    Scene scene = test::scene_of(shapes::plane(1.0F, 1.0F));
    scene.animations.push_back({.channels = {{.node = 0, .path = AnimatedPath::translation}}});
    EXPECT_THROW(Bake(scene, quick(1)), Error);
    scene.animations.clear();
    scene.materials[0].unlit = true;
    EXPECT_THROW(Bake(scene, quick(1)), Error);
}

} // namespace
} // namespace estampe::bake
