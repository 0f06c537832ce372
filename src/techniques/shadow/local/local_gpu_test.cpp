// SPDX-License-Identifier: MIT
// Compares shadows of spots and lamps with ray tracing.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/files.hpp"
#include "support/scenes.hpp"

namespace estampe::shadow {
namespace {

constexpr glm::uvec2 page_px(160, 120);
constexpr uint32_t lamp_map_size = 256;

struct Lamp {
    glm::dvec3 position{0.0};
    glm::dvec3 target{0.0};
    double half_angle_rad = 0.0; ///< 0: omnidirectional
    double range_m = 40.0;
};

shared::LightRecord record_of(const Lamp& lamp, const glm::dvec3& anchor)
{
    shared::LightRecord record{};
    record.position = glm::vec3(lamp.position - anchor);
    record.range_m = static_cast<float>(lamp.range_m);
    record.color = glm::vec3(record.range_m * record.range_m / 80.0F);
    record.groups = 0xffffffffU;
    record.type = shared::light_point;
    if (lamp.half_angle_rad > 0.0) {
        record.type = shared::light_spot;
        record.direction = glm::vec3(glm::normalize(lamp.target - lamp.position));
        const double outer = std::cos(lamp.half_angle_rad);
        record.cone_scale = static_cast<float>(1.0 / (std::cos(0.9 * lamp.half_angle_rad) - outer));
        record.cone_offset = static_cast<float>(-outer) * record.cone_scale;
    }
    return record;
}

struct LampVerdict {
    size_t compared = 0;
    size_t shadowed = 0;
    size_t wrongly_dark = 0; ///< acne, or a shadow that is too wide
    size_t wrongly_lit = 0;  ///< leaks, or a shadow detached from its caster

    [[nodiscard]] double wrong_share() const
    {
        return static_cast<double>(wrongly_dark + wrongly_lit) / static_cast<double>(compared);
    }
};

/// Whether rays from places within `radius_m` around the point, on the point's plane, agree about the lamp.
bool is_inside(const test::EmbreeScene& rays, const glm::dvec3& point, const glm::dvec3& normal,
               const Lamp& lamp, double radius_m)
{
    const glm::dvec3 helper = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(helper, normal));
    const glm::dvec3 up = glm::cross(normal, right);
    const bool blocked = rays.is_between(point, lamp.position);
    for (int k = 0; k < 12; ++k) {
        const double angle = 0.5236 * k;
        const glm::dvec3 aside =
            radius_m * (k % 2 == 0 ? 1.0 : 0.5) * (std::cos(angle) * right + std::sin(angle) * up);
        if (rays.is_between(point + aside, lamp.position) != blocked) {
            return false;
        }
    }
    // Points that touch the caster are near an edge too.
    return rays.is_between(point + radius_m * normal, lamp.position) == blocked;
}

/// Traces rays for every pixel that faces the lamp, except for a band of two texels around the shadow's edge.
LampVerdict compare_lamp(const Scene& scene, const Camera& camera, const Lamp& lamp,
                         RasterPath path = RasterPath::hardware)
{
    test::Drawing drawing(scene, camera, page_px);
    drawing.path = path;
    const shared::LightRecord record = record_of(lamp, drawing.layout.anchor);
    const auto dark = drawing.light({.records = {record}, .local_shadow_size = lamp_map_size});
    const auto lit = drawing.light({.records = {record}});
    const auto surface = drawing.surface();
    const test::EmbreeScene rays(scene);
    // A spot that is too wide for one map has six, like an omnidirectional lamp.
    const bool has_one_map = lamp.half_angle_rad > 0.0 && lamp.half_angle_rad < 1.1;
    const double half_side = has_one_map ? std::tan(lamp.half_angle_rad) : 1.0;
    LampVerdict verdict;
    for (size_t i = 0; i < dark.size(); ++i) {
        const glm::dvec3 normal(surface.smooth_normal[i]);
        if (surface.draw[i] == 0 || lit[i].x <= 1e-3F) {
            continue;
        }
        const size_t column = i % page_px.x;
        const size_t row = i / page_px.x;
        const glm::dvec2 at_px(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        glm::dvec3 point =
            drawing.point_at(at_px, static_cast<double>(surface.depth[i])) + drawing.layout.anchor;
        const glm::dvec3 way = lamp.position - point;
        const double facing = glm::dot(normal, glm::normalize(way));
        if (facing < 0.03) {
            continue;
        }
        // On a slanted surface, a texel's footprint is longer than the lamp sees it.
        const double texel_m = 2.0 * half_side * glm::length(way) / lamp_map_size;
        point += normal * (0.05 * texel_m);
        if (!is_inside(rays, point, normal, lamp, 2.0 * texel_m / std::max(facing, 0.2))) {
            continue;
        }
        const bool blocked = rays.is_between(point, lamp.position);
        const bool is_dark = dark[i].x < 0.5F * lit[i].x;
        ++verdict.compared;
        verdict.shadowed += blocked ? 1U : 0U;
        verdict.wrongly_dark += is_dark && !blocked ? 1U : 0U;
        verdict.wrongly_lit += !is_dark && blocked ? 1U : 0U;
    }
    return verdict;
}

void expect_agreement(const LampVerdict& verdict, const std::string& what, size_t least_compared = 5000)
{
    EXPECT_LE(verdict.wrong_share(), 0.01)
        << what << ": of " << verdict.compared << " pixels " << verdict.wrongly_dark << " wrongly dark, "
        << verdict.wrongly_lit << " wrongly lit";
    EXPECT_GT(verdict.compared, least_compared) << what;
    EXPECT_GT(verdict.shadowed, least_compared / 20) << what;
    std::printf("%s: %.4f wrong\n", what.c_str(), verdict.wrong_share());
}

/// A box with an open front, and two bodies in it.
Scene room()
{
    Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F));
    test::add_object(scene, shapes::box({4.0F, 0.1F, 4.0F}), glm::vec3(1.0F), {0.0, 4.0, 0.0});
    test::add_object(scene, shapes::box({4.0F, 4.0F, 0.1F}), glm::vec3(1.0F), {0.0, 0.0, -2.0});
    test::add_object(scene, shapes::box({0.1F, 4.0F, 4.0F}), glm::vec3(1.0F), {-2.0, 0.0, 0.0});
    test::add_object(scene, shapes::box({0.1F, 4.0F, 4.0F}), glm::vec3(1.0F), {2.0, 0.0, 0.0});
    test::add_object(scene, shapes::box({0.9F, 2.0F, 0.9F}), glm::vec3(1.0F), {-0.7, 0.0, -0.6});
    scene.nodes.back().transform.rotation = glm::angleAxis(0.35, glm::dvec3(0, 1, 0));
    test::add_object(scene, shapes::sphere(0.5F, 96, 48), glm::vec3(1.0F), {0.8, 0.5, 0.5});
    return scene;
}

Scene columns()
{
    Scene scene = test::scene_of(shapes::plane(14.0F, 14.0F));
    for (int i = 0; i < 8; ++i) {
        const double angle = 0.785398 * i;
        test::add_object(scene, shapes::box({0.4F, 3.0F, 0.4F}), glm::vec3(1.0F),
                         {3.5 * std::cos(angle), 0.0, 3.5 * std::sin(angle)});
        scene.nodes.back().transform.rotation = glm::angleAxis(0.4 * i, glm::dvec3(0, 1, 0));
    }
    test::add_object(scene, shapes::torus(1.0F, 0.3F), glm::vec3(1.0F), {0.0, 0.8, 0.0});
    return scene;
}

const Camera into_room{.eye = {0.0, 2.0, 9.0}, .target = {0.0, 2.0, 0.0}, .vertical_fov_rad = 0.6};
const Camera over_columns{.eye = {5.0, 8.0, 9.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.7};

TEST(LocalShadow, ALampAgreesWithRays)
{
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        expect_agreement(compare_lamp(room(), into_room, {.position = {0.1, 3.5, 0.2}}, path),
                         "lamp in a room");
    }
    expect_agreement(compare_lamp(columns(), over_columns, {.position = {0.3, 2.2, 0.4}}),
                     "lamp among columns");
    expect_agreement(compare_lamp(columns(), over_columns, {.position = {-2.0, 4.5, 1.0}}),
                     "lamp over columns");
}

TEST(LocalShadow, ASpotAgreesWithRays)
{
    expect_agreement(
        compare_lamp(room(), into_room,
                     {.position = {1.4, 3.6, 1.6}, .target = {-0.6, 0.0, -0.8}, .half_angle_rad = 0.6}),
        "spot in a room", 3000);
    expect_agreement(
        compare_lamp(columns(), over_columns,
                     {.position = {6.0, 4.0, 2.0}, .target = {0.0, 0.5, 0.0}, .half_angle_rad = 0.7}),
        "spot on columns", 3000);
    expect_agreement(
        compare_lamp(columns(), over_columns,
                     {.position = {0.5, 1.6, 2.0}, .target = {0.4, 0.0, 2.0}, .half_angle_rad = 1.4}),
        "wide spot", 3000);
}

TEST(LocalShadow, FacesOfACubeMeetWithoutASeam)
{
    // The inside of a sphere around a lamp, where all six maps meet, is fully lit.
    Scene scene = test::scene_of(shapes::sphere(2.0F, 128, 64));
    test::Drawing drawing(scene, {.eye = {0.3, 0.2, 0.1}, .target = {1.5, 0.9, 1.4}, .vertical_fov_rad = 2.2},
                          page_px);
    auto record = record_of({.position = {0.05, -0.1, 0.02}}, drawing.layout.anchor);
    const auto dark = drawing.light({.records = {record}, .local_shadow_size = lamp_map_size});
    const auto lit = drawing.light({.records = {record}});
    size_t differing = 0;
    for (size_t i = 0; i < dark.size(); ++i) {
        differing += dark[i].x < 0.999F * lit[i].x ? 1U : 0U;
    }
    EXPECT_EQ(differing, 0U);
}

TEST(LocalShadow, NoLightLeaksBetweenFacesOfACube)
{
    // The lamp is inside a closed sphere inside a larger sphere. The larger sphere is completely dark.
    Scene scene = test::scene_of(shapes::sphere(2.0F, 128, 64));
    test::add_object(scene, shapes::sphere(0.25F, 64, 32), glm::vec3(1.0F), {0.05, -0.1, 0.02});
    test::Drawing drawing(scene, {.eye = {0.3, 0.2, 0.1}, .target = {1.5, 0.9, 1.4}, .vertical_fov_rad = 2.2},
                          page_px);
    const auto record = record_of({.position = {0.05, -0.1, 0.02}}, drawing.layout.anchor);
    const auto dark = drawing.light({.records = {record}, .local_shadow_size = lamp_map_size});
    const auto lit = drawing.light({.records = {record}});
    size_t leaking = 0;
    size_t seen = 0;
    for (size_t i = 0; i < dark.size(); ++i) {
        seen += lit[i].x > 0.0F ? 1U : 0U;
        leaking += dark[i].x > 0.001F * lit[i].x ? 1U : 0U;
    }
    EXPECT_EQ(leaking, 0U);
    EXPECT_GT(seen, dark.size() / 2);
}

TEST(LocalShadow, WhatLiesBehindASpotThrowsNone)
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::box({3.0F, 0.2F, 3.0F}), glm::vec3(1.0F), {0.0, 3.0, 0.0});
    const Camera camera{.eye = {0.0, 2.0, 8.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.7};
    const Lamp lamp{.position = {0.0, 2.9, 0.0}, .target = {0.1, 0.0, 0.0}, .half_angle_rad = 0.8};
    test::Drawing drawing(scene, camera, page_px);
    const auto record = record_of(lamp, drawing.layout.anchor);
    const auto dark = drawing.light({.records = {record}, .local_shadow_size = lamp_map_size});
    const auto lit = drawing.light({.records = {record}});
    EXPECT_EQ(dark, lit);
}

TEST(LocalShadow, AgreesWithRaysOnTheSquare)
{
    const Scene scene = load_scene(test::square_scene());
    const ScenePose pose = pose_scene(scene, 0.0);
    const Camera camera = scene_camera(scene, pose, "square");
    // The point that the camera looks at, between its eye and its target.
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 middle(camera.eye.x + 14.0 * ahead.x, 0.0, camera.eye.z + 14.0 * ahead.z);
    expect_agreement(
        compare_lamp(scene, camera, {.position = middle + glm::dvec3(0.0, 5.0, 0.0), .range_m = 80.0}),
        "lamp on the square", 3000);
    expect_agreement(compare_lamp(scene, camera,
                                  {.position = middle + glm::dvec3(6.0, 8.0, 6.0),
                                   .target = middle + glm::dvec3(-3.0, 0.0, -6.0),
                                   .half_angle_rad = 0.7,
                                   .range_m = 80.0}),
                     "spot on the square", 2000);
}

TEST(LocalShadow, AgreesWithRaysOnModels)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    if (folder == nullptr) {
        return;
    }
    for (const char* name : {"sampleroom.gltf", "CornellBox"}) {
        std::filesystem::path path = std::filesystem::path(folder) / name;
        if (std::filesystem::is_directory(path)) {
            for (const auto& entry : std::filesystem::directory_iterator(path)) {
                const auto extension = entry.path().extension();
                path =
                    extension == ".obj" || extension == ".gltf" || extension == ".glb" ? entry.path() : path;
            }
        }
        const Scene scene = load_scene(path);
        const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0));
        const Camera camera = framing_camera(scene, pose_scene(scene, 0.0), 4.0 / 3.0);
        const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
        expect_agreement(compare_lamp(scene, camera,
                                      {.position = bounds.center() + half * glm::dvec3(0.1, 0.35, 0.15),
                                       .range_m = 10.0 * glm::length(half)}),
                         name, 3000);
    }
}

} // namespace
} // namespace estampe::shadow
