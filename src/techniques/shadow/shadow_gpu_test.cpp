// SPDX-License-Identifier: MIT
// Compares the sun's shadow with ray tracing.
#include <cmath>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/scenes.hpp"
#include "techniques/shadow/shadow_test_support.hpp"

namespace estampe::shadow {
namespace {

constexpr glm::uvec2 shadow_page_px(160, 120);
constexpr uint32_t shadow_map_size = 512;

struct SunVerdict {
    size_t compared = 0;
    size_t shadowed = 0;
    size_t wrong = 0;
};

glm::dvec2 centre_of(size_t i)
{
    return {static_cast<double>(i % shadow_page_px.x) + 0.5, static_cast<double>(i / shadow_page_px.x) + 0.5};
}

/// Traces rays for every pixel that faces the sun, except for a band of two texels around the shadow's edge.
SunVerdict compare_sun(const Scene& scene, const Camera& camera, const glm::dvec3& towards_sun)
{
    test::Drawing drawing(scene, camera, shadow_page_px);
    const auto light = drawing.light(
        {.records = {sun_record(towards_sun)}, .directional_count = 1, .shadow_size = shadow_map_size});
    const auto surface = drawing.surface();
    const double texel_m = static_cast<double>(drawing.sun(towards_sun, shadow_map_size).texel_m);
    const glm::dvec3 right = glm::normalize(glm::cross(towards_sun, glm::dvec3(0.1, 0.2, 0.9)));
    const glm::dvec3 up = glm::cross(right, towards_sun);
    const test::EmbreeScene rays(scene);
    SunVerdict verdict;
    for (size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 normal(surface.smooth_normal[i]);
        const double cosine = glm::dot(normal, towards_sun);
        if (surface.draw[i] == 0 || cosine < 0.02) {
            continue;
        }
        const glm::dvec3 point = drawing.point_at(centre_of(i), static_cast<double>(surface.depth[i])) +
                                 drawing.layout.anchor + normal * (0.05 * texel_m);
        const bool blocked = rays.is_blocked(point, towards_sun);
        bool is_edge = false;
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 aside = right * std::cos(0.785398 * k) + up * std::sin(0.785398 * k);
            is_edge |= rays.is_blocked(point + normal * (2.0 * texel_m) + aside * (2.0 * texel_m),
                                       towards_sun) != blocked;
        }
        if (!is_edge) {
            ++verdict.compared;
            verdict.shadowed += blocked ? 1U : 0U;
            verdict.wrong += (static_cast<double>(light[i].x) < 0.5 * cosine) != blocked ? 1U : 0U;
        }
    }
    return verdict;
}

TEST(Shadow, AgreesWithRays)
{
    Scene scene = test::scene_of(shapes::plane(12.0F, 12.0F));
    test::add_object(scene, shapes::box({1.0F, 2.0F, 1.0F}), glm::vec3(1.0F), {-1.0, 0.0, 0.0});
    test::add_object(scene, shapes::box({3.0F, 0.4F, 1.0F}), glm::vec3(1.0F), {0.5, 0.0, 1.5});
    test::add_object(scene, shapes::box({0.2F, 3.0F, 0.2F}), glm::vec3(1.0F), {2.0, 0.0, -1.0});
    test::add_object(scene, shapes::torus(0.8F, 0.25F), glm::vec3(1.0F), {0.5, 2.5, 0.0});
    const Camera camera{.eye = {4.0, 6.0, 8.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.8};
    for (const glm::dvec3 sun :
         {glm::dvec3(0.5, 0.8, 0.3), glm::dvec3(-0.9, 0.35, 0.2), glm::dvec3(0.05, 1.0, 0.02)}) {
        const SunVerdict verdict = compare_sun(scene, camera, glm::normalize(sun));
        EXPECT_LT(static_cast<double>(verdict.wrong), 0.01 * static_cast<double>(verdict.compared))
            << verdict.wrong << " of " << verdict.compared;
        EXPECT_GT(verdict.shadowed, 200U);
        EXPECT_GT(verdict.compared, 8000U);
    }
}

TEST(Shadow, ARoundFormDoesNotShadowItself)
{
    const Scene scene = test::scene_of(shapes::sphere(1.0F, 96, 48));
    for (const glm::dvec3 sun : {glm::dvec3(1, 0.1, 0), glm::dvec3(0.3, 1, 0.2), glm::dvec3(-1, 0.5, -1)}) {
        const glm::dvec3 towards_sun = glm::normalize(sun);
        test::Drawing drawing(scene, test::front_camera(4.0, 0.6), shadow_page_px);
        const auto light = drawing.light(
            {.records = {sun_record(towards_sun)}, .directional_count = 1, .shadow_size = shadow_map_size});
        const auto surface = drawing.surface();
        size_t dark = 0;
        for (size_t i = 0; i < light.size(); ++i) {
            const double cosine = glm::dot(glm::dvec3(surface.smooth_normal[i]), towards_sun);
            dark += surface.draw[i] != 0 && cosine > 0.05 && static_cast<double>(light[i].x) < 0.95 * cosine
                        ? 1U
                        : 0U;
        }
        EXPECT_EQ(dark, 0U);
    }
}

TEST(Shadow, BeginsWhereTheBoxStandsAndEndsWhereItsTopFalls)
{
    Scene scene = test::scene_of(shapes::plane(8.0F, 8.0F));
    test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F));
    const glm::dvec3 towards_sun = glm::normalize(glm::dvec3(1, 1, 0));
    const Camera camera{.eye = {-1.4, 1.6, 0.1}, .target = {-1.0, 0.0, 0.0}, .vertical_fov_rad = 0.8};
    test::Drawing drawing(scene, camera, shadow_page_px);
    const auto light = drawing.light(
        {.records = {sun_record(towards_sun)}, .directional_count = 1, .shadow_size = shadow_map_size});
    const auto surface = drawing.surface();
    const double texel_m = static_cast<double>(drawing.sun(towards_sun, shadow_map_size).texel_m);
    size_t looked_at = 0;
    size_t lit = 0;
    for (size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 point =
            drawing.point_at(centre_of(i), static_cast<double>(surface.depth[i])) + drawing.layout.anchor;
        const bool is_floor = surface.draw[i] != 0 && surface.smooth_normal[i].y > 0.9F && point.y < 0.01;
        if (is_floor && point.x < -0.5 - 3.5 * texel_m && point.x > -1.5 + 4.0 * texel_m &&
            std::abs(point.z) < 0.45) {
            ++looked_at;
            lit += light[i].x > 0.05F ? 1U : 0U;
        }
    }
    EXPECT_GT(looked_at, 1000U);
    EXPECT_EQ(lit, 0U);
}

} // namespace
} // namespace estampe::shadow
