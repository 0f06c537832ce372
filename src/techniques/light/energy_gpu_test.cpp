// SPDX-License-Identifier: MIT
// Conservation of energy: light in simple scenes against analytic results.
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe::light {
namespace {

constexpr glm::uvec2 energy_px(96, 72);

/// A sphere seen from inside, with normals towards its centre.
test::Drawing inside_of_sphere(float radius_m)
{
    Primitive sphere = shapes::sphere(radius_m, 128, 64);
    for (glm::vec3& normal : sphere.normals) {
        normal = -normal;
    }
    for (size_t i = 0; i + 2 < sphere.indices.size(); i += 3) {
        std::swap(sphere.indices[i + 1], sphere.indices[i + 2]);
    }
    const Camera camera{
        .eye = {0.0, 0.0, 0.1}, .target = {0.3, 0.2, -1.0}, .vertical_fov_rad = 1.8, .near_m = 1e-3};
    return {test::scene_of(std::move(sphere)), camera, energy_px};
}

TEST(LightEnergy, ALampInTheMiddleOfASphereGivesIntensityOverRadiusSquared)
{
    const float radius_m = 3.0F;
    const float intensity = 40.0F;
    test::Drawing drawing = inside_of_sphere(radius_m);
    shared::LightRecord lamp{};
    lamp.type = shared::light_point;
    lamp.range_m = 1e4F;
    lamp.color = glm::vec3(intensity);
    const float wanted = intensity / (radius_m * radius_m);
    for (const glm::vec4& pixel : drawing.light({.records = {lamp}})) {
        EXPECT_NEAR(pixel.x, wanted, 0.01F * wanted);
    }
    // Falloff of the unit volume in Zanuttini's thesis: three quarters of the light are left at half the
    // range.
    lamp.type |= shared::light_unit_volume;
    lamp.range_m = 2.0F * radius_m;
    lamp.color = glm::vec3(2.0F);
    for (const glm::vec4& pixel : drawing.light({.records = {lamp}})) {
        EXPECT_NEAR(pixel.x, 1.5F, 0.015F);
    }
}

TEST(LightEnergy, AWhiteFurnaceIsEven)
{
    // Uniform light of 1 from all directions gives 1 on a surface in any orientation.
    test::Drawing drawing = inside_of_sphere(2.0F);
    for (const glm::vec4& pixel : drawing.light({.ambient = glm::vec3(1.0F)})) {
        EXPECT_NEAR(pixel.x, 1.0F, 0.01F);
    }
    // The same holds for very many suns, evenly spread over the sphere, each 4 pi / n of radiance 1, over pi.
    std::vector<shared::LightRecord> suns;
    const int count = 1500;
    for (int i = 0; i < count; ++i) {
        const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count);
        const float turn = 2.3999632F * static_cast<float>(i);
        const float around = std::sqrt(1.0F - y * y);
        shared::LightRecord sun{};
        sun.type = shared::light_directional;
        sun.direction = {around * std::cos(turn), y, around * std::sin(turn)};
        sun.color = glm::vec3(4.0F / static_cast<float>(count));
        suns.push_back(sun);
    }
    const uint32_t sun_count = static_cast<uint32_t>(suns.size());
    for (const glm::vec4& pixel : drawing.light({.records = suns, .directional_count = sun_count})) {
        EXPECT_NEAR(pixel.x, 1.0F, 0.01F);
    }
}

TEST(LightEnergy, LightAddsUpAndScalesBeforeTheToneCurve)
{
    test::Drawing drawing = inside_of_sphere(2.0F);
    shared::LightRecord lamp{};
    lamp.type = shared::light_point;
    lamp.position = {0.5F, -0.4F, 0.3F};
    lamp.range_m = 100.0F;
    lamp.color = {3.0F, 2.0F, 1.0F};
    shared::LightRecord other = lamp;
    other.position = {-0.9F, 0.2F, 0.1F};
    const auto one = drawing.light({.records = {lamp}});
    const auto two = drawing.light({.records = {other}});
    const auto both = drawing.light({.records = {lamp, other}});
    lamp.color *= 1000.0F;
    const auto brighter = drawing.light({.records = {lamp}});
    for (size_t i = 0; i < one.size(); ++i) {
        EXPECT_NEAR(both[i].y, one[i].y + two[i].y, 2e-3F * both[i].y);
        EXPECT_NEAR(brighter[i].z, 1000.0F * one[i].z, 2e-3F * brighter[i].z);
    }
}

} // namespace
} // namespace estampe::light
