// SPDX-License-Identifier: MIT
// Teeth and penumbrae of the sun's shadow: their properties, and a comparison with ray tracing.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/crawl.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/scenes.hpp"
#include "techniques/shadow/shadow_test_support.hpp"

namespace estampe::shadow {
namespace {

constexpr glm::uvec2 sun_px(240, 180);
constexpr uint32_t sun_map_size = 1024;
constexpr float sun_reach_px = 4.0F;

Scene canopy()
{
    Scene scene = test::scene_of(shapes::plane(12.0F, 12.0F));
    test::add_object(scene, shapes::box({4.0F, 0.1F, 4.0F}), glm::vec3(1.0F), {0.0, 4.0, 0.0});
    return scene;
}

/// Sees the canopy's shadow, but not the canopy.
Camera under_canopy(double aside_m = 0.0)
{
    return {.eye = {-3.0 + aside_m, 3.2, 5.5}, .target = {-2.0 + aside_m, 0.0, 0.0}, .vertical_fov_rad = 0.9};
}

const glm::dvec3 towards_high_sun = glm::normalize(glm::dvec3(0.5, 1.0, 0.2));

struct SunLit {
    std::vector<double> share; ///< share of the sun that arrives; 1 for the background
    std::vector<glm::dvec3> point;
};

SunLit lit_by_sun(const Scene& scene, const Camera& camera, const glm::dvec3& sun, const ShadowStyle& style,
                  const std::optional<HatchedLines>& lines = std::nullopt,
                  SunMapKind kind = SunMapKind::whole)
{
    test::Drawing drawing(scene, camera, sun_px);
    test::LightSetup setup{.records = {sun_record(sun)},
                           .directional_count = 1,
                           .shadow_size = sun_map_size,
                           .shadow = style,
                           .lines = lines,
                           .is_warped = kind == SunMapKind::warped};
    if (kind == SunMapKind::clipmap) {
        setup.clipmap = fit_clipmap(drawing.sun(sun, 2 * sun_map_size), 2 * sun_map_size, 0.01,
                                    drawing.pose.casters.radius());
    }
    const auto light = drawing.light(setup);
    const auto surface = drawing.surface();
    SunLit result;
    for (size_t i = 0; i < light.size(); ++i) {
        const double cosine = glm::dot(glm::dvec3(surface.smooth_normal[i]), sun);
        const bool faces = surface.draw[i] != 0 && cosine > 0.02;
        result.share.push_back(faces ? static_cast<double>(light[i].x) / cosine : 1.0);
        result.point.push_back(drawing.point_seen(i, surface.depth[i]) + drawing.layout.anchor);
    }
    return result;
}

double shadow_px(const SunLit& lit_by_sun)
{
    double sum = 0.0;
    for (const double share : lit_by_sun.share) {
        sum += 1.0 - share;
    }
    return sum;
}

/// Whether all pixels within `radius` pixels of a pixel have the same light.
bool is_even(const SunLit& lit_by_sun, size_t pixel, int radius)
{
    const auto x = static_cast<int>(pixel % sun_px.x);
    const auto y = static_cast<int>(pixel / sun_px.x);
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, static_cast<int>(sun_px.y) - 1); ++v) {
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, static_cast<int>(sun_px.x) - 1);
             ++u) {
            const size_t other = static_cast<size_t>(v) * sun_px.x + static_cast<size_t>(u);
            if ((u - x) * (u - x) + (v - y) * (v - y) <= radius * radius &&
                std::abs(lit_by_sun.share[other] - lit_by_sun.share[pixel]) > 0.01) {
                return false;
            }
        }
    }
    return true;
}

struct SunTeeth {
    const char* name;
    ShadowStyle style;
    std::optional<HatchedLines> lines;
};

std::vector<SunTeeth> all_sun_teeth()
{
    const ShadowStyle waves{
        .edge = Edge::waves, .edge_reach_mm = sun_reach_px, .edge_spacing_mm = 3.0F, .edge_variety = 0.5F};
    ShadowStyle strokes = waves;
    strokes.edge = Edge::strokes;
    return {{"waves", waves, std::nullopt}, {"strokes", strokes, HatchedLines{.width_mm = 1.5F}}};
}

TEST(ShadowEdge, TeethKeepTheShadowsAreaAndStayWithinTheirReach)
{
    const Scene scene = canopy();
    const SunLit plain = lit_by_sun(scene, under_canopy(), towards_high_sun, {});
    for (const SunTeeth& teeth : all_sun_teeth()) {
        const SunLit toothed = lit_by_sun(scene, under_canopy(), towards_high_sun, teeth.style, teeth.lines);
        const double change = shadow_px(toothed) / shadow_px(plain) - 1.0;
        size_t moved = 0;
        size_t too_far = 0;
        for (size_t i = 0; i < plain.share.size(); ++i) {
            const bool is_moved = std::abs(toothed.share[i] - plain.share[i]) > 0.3;
            moved += is_moved ? 1U : 0U;
            too_far += is_moved && is_even(plain, i, static_cast<int>(sun_reach_px) + 1) ? 1U : 0U;
        }
        fmt::print("{:8} area {:+.4f} of {:.0f} px, {} px moved\n", teeth.name, change, shadow_px(plain),
                   moved);
        EXPECT_LT(std::abs(change), 0.01) << teeth.name;
        EXPECT_EQ(too_far, 0U) << teeth.name;
        EXPECT_GT(moved, 100U) << teeth.name;
    }
}

TEST(ShadowEdge, WhatIsRoundOrFoldedThrowsNoTeethOnItself)
{
    // Fourteen smooth-shaded sides: the plane in which teeth move cuts into the body everywhere.
    Scene scene = test::scene_of(shapes::sphere(1.0F, 14, 9));
    const Camera camera{.eye = {0.6, 0.8, 3.2}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.8};
    const SunLit plain = lit_by_sun(scene, camera, towards_high_sun, {});
    for (const SunTeeth& teeth : all_sun_teeth()) {
        const SunLit toothed = lit_by_sun(scene, camera, towards_high_sun, teeth.style, teeth.lines);
        size_t darker = 0;
        for (size_t i = 0; i < plain.share.size(); ++i) {
            const bool is_lit = glm::dot(glm::normalize(plain.point[i]), towards_high_sun) > 0.3;
            darker += is_lit && is_even(plain, i, static_cast<int>(sun_reach_px) + 1) &&
                              toothed.share[i] < plain.share[i] - 0.1
                          ? 1U
                          : 0U;
        }
        EXPECT_EQ(darker, 0U) << teeth.name;
    }
}

TEST(ShadowEdge, TeethStayInPlaceWhileTheEyeMoves)
{
    const Scene scene = canopy();
    for (const SunTeeth& teeth : all_sun_teeth()) {
        double worst = 0.0;
        SunLit before = lit_by_sun(scene, under_canopy(), towards_high_sun, teeth.style, teeth.lines);
        for (int step = 1; step <= 6; ++step) {
            const Camera camera = under_canopy(0.1 * step);
            const SunLit now = lit_by_sun(scene, camera, towards_high_sun, teeth.style, teeth.lines);
            worst = std::max(worst, test::crawl(before, now, test::Drawing(scene, camera, sun_px)));
            before = now;
        }
        fmt::print("{:8} {:.4f} % of pixels change in a step of 0.1 m\n", teeth.name, 100.0 * worst);
        EXPECT_LT(worst, 0.005) << teeth.name;
    }
}

/// Share of a disc beyond a line that is `x` radii from its centre.
double disc_beyond(double x)
{
    const double held = std::clamp(x, -1.0, 1.0);
    return std::acos(held) / std::numbers::pi - held * std::sqrt(1.0 - held * held) / std::numbers::pi;
}

TEST(SunPenumbra, OfAWallIsThatOfADisc)
{
    constexpr double elevation = 0.5236;
    constexpr float radius_deg = 2.0F;
    const double radius = glm::radians(static_cast<double>(radius_deg));
    Scene scene = test::scene_of(shapes::plane(8.0F, 3.0F));
    test::add_object(scene, shapes::box({0.02F, 1.0F, 8.0F}), glm::vec3(1.0F), {0.01, 0.0, 0.0});
    const glm::dvec3 sun(std::cos(elevation), std::sin(elevation), 0.0);
    const Camera camera{.eye = {-1.7, 1.2, 0.1}, .target = {-1.75, 0.0, 0.0}, .vertical_fov_rad = 0.5};
    const SunLit soft = lit_by_sun(scene, camera, sun, {.sun_radius_deg = radius_deg});
    test::Drawing drawing(scene, camera, sun_px);
    const double texel_m = static_cast<double>(drawing.sun(sun, sun_map_size).texel_m) / std::sin(elevation);
    const double umbra = -1.0 / std::tan(elevation + radius);
    const double open = -1.0 / std::tan(elevation - radius);
    double worst = 0.0;
    double umbra_found = -10.0;
    double open_found = 0.0;
    for (size_t i = 0; i < soft.share.size(); ++i) {
        const double x = soft.point[i].x;
        if (std::abs(soft.point[i].z) < 0.6) {
            const double expected = disc_beyond((std::atan(-1.0 / x) - elevation) / radius);
            worst = std::max(worst, std::abs(soft.share[i] - expected));
            umbra_found = soft.share[i] > 0.5 / 32.0 ? std::max(umbra_found, x) : umbra_found;
            open_found = soft.share[i] < 1.0 - 0.5 / 32.0 ? std::min(open_found, x) : open_found;
        }
    }
    fmt::print(
        "umbra to {:.4f} m, {:.4f} found; open from {:.4f} m, {:.4f} found; a texel is {:.4f} m; worst "
        "share off by {:.3f}\n",
        umbra, umbra_found, open, open_found, texel_m, worst);
    // The light reaches the searched share this far before the end.
    const double least = 0.09 * 0.5 * (umbra - open);
    EXPECT_NEAR(umbra_found, umbra - least, texel_m);
    EXPECT_NEAR(open_found, open + least, texel_m);
    EXPECT_LT(worst, 0.08);
}

/// Visible share of the sun's disc, traced with 256 rays.
double traced_sun(const test::EmbreeScene& rays, const glm::dvec3& from, const glm::dvec3& sun, double radius)
{
    const glm::dvec3 right = glm::normalize(glm::cross(sun, glm::dvec3(0.1, 0.2, 0.9)));
    const glm::dvec3 up = glm::cross(right, sun);
    int open = 0;
    for (int i = 0; i < 256; ++i) {
        const double away = std::tan(radius) * std::sqrt((i + 0.5) / 256.0);
        const double angle = 2.399963229728653 * i;
        open += rays.is_blocked(from,
                                glm::normalize(sun + away * (right * std::cos(angle) + up * std::sin(angle))))
                    ? 0
                    : 1;
    }
    return open / 256.0;
}

TEST(SunPenumbra, AgreesWithRaysOverTheDisc)
{
    Scene scene = test::scene_of(shapes::plane(12.0F, 12.0F));
    test::add_object(scene, shapes::box({1.0F, 2.0F, 1.0F}), glm::vec3(1.0F), {-1.0, 0.0, 0.0});
    test::add_object(scene, shapes::box({3.0F, 0.4F, 1.0F}), glm::vec3(1.0F), {0.5, 0.0, 1.5});
    test::add_object(scene, shapes::box({0.2F, 3.0F, 0.2F}), glm::vec3(1.0F), {2.0, 0.0, -1.0});
    test::add_object(scene, shapes::torus(0.8F, 0.25F), glm::vec3(1.0F), {0.5, 2.5, 0.0});
    const test::EmbreeScene rays(scene);
    const Camera camera{.eye = {4.0, 6.0, 8.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.8};
    const auto whole = SunMapKind::whole;
    for (const auto& [radius_deg, kind] :
         {std::pair(0.27F, whole), std::pair(1.0F, whole), std::pair(3.0F, whole),
          std::pair(1.0F, SunMapKind::clipmap), std::pair(3.0F, SunMapKind::clipmap),
          std::pair(1.0F, SunMapKind::warped)}) {
        const SunLit soft =
            lit_by_sun(scene, camera, towards_high_sun, {.sun_radius_deg = radius_deg}, std::nullopt, kind);
        double error = 0.0;
        double compared = 0.0;
        double partly = 0.0;
        double partly_error = 0.0;
        for (size_t i = 0; i < soft.share.size(); i += 3) {
            if (soft.point[i].y > -0.01 && soft.point[i].y < 0.01) {
                const double share =
                    traced_sun(rays, soft.point[i] + glm::dvec3(0, 1e-4, 0), towards_high_sun,
                               glm::radians(static_cast<double>(radius_deg)));
                error += std::abs(soft.share[i] - share);
                compared += 1.0;
                const bool is_partly = share > 0.01 && share < 0.99;
                partly += is_partly ? 1.0 : 0.0;
                partly_error += is_partly ? std::abs(soft.share[i] - share) : 0.0;
            }
        }
        const char* name = kind == whole ? "whole" : kind == SunMapKind::clipmap ? "clipmap" : "warped";
        fmt::print("{}, {} degrees: mean error {:.4f}; in penumbrae {:.4f}, {:.0f} of {:.0f} px\n", name,
                   radius_deg, error / compared, partly_error / std::max(partly, 1.0), partly, compared);
        EXPECT_LT(error / compared, 0.04) << name;
        EXPECT_LT(partly_error / std::max(partly, 1.0), 0.04) << name;
        EXPECT_GT(compared, 5000.0);
    }
}

} // namespace
} // namespace estampe::shadow
