// SPDX-License-Identifier: MIT
// Light per point against the formulas.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe::light {
namespace {

constexpr glm::uvec2 lit_px(120, 90);
const Camera from_above{.eye = {0.0, 9.0, 5.0}, .vertical_fov_rad = 0.9};

Scene floor_scene()
{
    return test::scene_of(shapes::plane(40.0F, 40.0F));
}

shared::LightRecord point_light(const glm::vec3& place, float intensity, float range_m = 1e4F)
{
    shared::LightRecord record{};
    record.type = shared::light_point;
    record.position = place;
    record.range_m = range_m;
    record.color = glm::vec3(intensity);
    return record;
}

/// Light by KHR_lights_punctual, with Lambert's cosine.
double arriving(const shared::LightRecord& light, const glm::dvec3& point, const glm::dvec3& normal)
{
    const glm::dvec3 to_light = glm::dvec3(light.position) - point;
    const double distance = glm::length(to_light);
    const double window =
        std::clamp(1.0 - std::pow(distance / static_cast<double>(light.range_m), 4.0), 0.0, 1.0);
    return static_cast<double>(light.color.x) * window / (distance * distance) *
           std::max(0.0, glm::dot(normal, to_light / distance));
}

glm::dvec2 centre_of(size_t i)
{
    return {static_cast<double>(i % lit_px.x) + 0.5, static_cast<double>(i / lit_px.x) + 0.5};
}

/// Compares the light of each pixel on the floor y = 0 to `expected` of its position, within the rounding of
/// half floats.
template <class Expected>
void expect_on_floor(const test::Drawing& drawing, const std::vector<glm::vec4>& light, Expected expected)
{
    double worst = 0.0;
    double brightest = 0.0;
    for (size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 from = drawing.point_at(centre_of(i), 0.9);
        const glm::dvec3 way = drawing.point_at(centre_of(i), 0.1) - from;
        const double wanted = expected(from - way * (from.y / way.y));
        brightest = std::max(brightest, wanted);
        worst = std::max(worst, std::abs(static_cast<double>(light[i].x) - wanted) / (wanted + 0.05));
    }
    EXPECT_LT(worst, 4e-3);
    EXPECT_GT(brightest, 0.2);
}

TEST(Light, APointLightFallsOffWithSquareAndCosine)
{
    test::Drawing drawing(floor_scene(), from_above, lit_px);
    const auto record = point_light({1.0F, 2.0F, -0.5F}, 3.0F);
    const auto light = drawing.light({.records = {record}});
    expect_on_floor(drawing, light, [&](const glm::dvec3& p) { return arriving(record, p, {0, 1, 0}); });
    const auto twice_as_steep = drawing.light({.records = {record}, .falloff = 2.0F});
    expect_on_floor(drawing, twice_as_steep, [&](const glm::dvec3& p) {
        const double cosine = 2.0 / glm::distance(p, glm::dvec3(record.position));
        return arriving(record, p, {0, 1, 0}) * cosine;
    });
}

TEST(Light, ARangeEndsALightSmoothly)
{
    test::Drawing drawing(floor_scene(), from_above, lit_px);
    const auto record = point_light({0.0F, 1.5F, 0.0F}, 3.0F, 3.0F);
    expect_on_floor(drawing, drawing.light({.records = {record}}), [&](const glm::dvec3& p) {
        return arriving(record, p, {0, 1, 0});
    });
}

TEST(Light, ASpotLightsACone)
{
    Scene scene = floor_scene();
    scene.lights.push_back(
        {.type = LightType::spot, .intensity = 700.0F, .inner_cone_rad = 0.2F, .outer_cone_rad = 0.5F});
    const glm::dvec3 place(-1.0, 4.0, 0.5);
    const glm::dvec3 beam = glm::normalize(glm::dvec3(0.3, -1.0, -0.2));
    scene.nodes.push_back(
        {.transform = {.translation = place, .rotation = glm::quatLookAt(beam, glm::dvec3(0, 0, 1))},
         .light = 0});
    scene.roots.push_back(1);
    test::Drawing drawing(scene, from_above, lit_px);
    LightStyle style;
    style.source = LightSource::scene;
    auto lighting =
        gather_lights(scene, pose_scene(scene, 0.0), drawing.layout.bounds, drawing.layout.anchor, style);
    ASSERT_EQ(lighting.records.size(), 1U);
    ASSERT_EQ(lighting.directional_count, 0U);
    shared::LightRecord& record = lighting.records.front();
    record.color = glm::vec3(20.0F);
    record.range_m = 1e4F;
    const auto light = drawing.light({.records = lighting.records});
    expect_on_floor(drawing, light, [&](const glm::dvec3& p) {
        const double cosine = glm::dot(glm::normalize(p - place), beam);
        const double cone = std::clamp((cosine - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5)), 0.0, 1.0);
        return arriving(record, p, {0, 1, 0}) * cone * cone;
    });
}

TEST(Light, ManyLightsInTilesAreTheSumOfAll)
{
    Scene scene = test::scene_of(shapes::torus(2.0F, 0.7F));
    test::add_object(scene, shapes::plane(12.0F, 12.0F), glm::vec3(1.0F), {0.0, -1.0, 0.0});
    test::add_object(scene, shapes::sphere(0.6F), glm::vec3(1.0F), {0.0, 3.0, 0.0});
    test::Drawing drawing(scene, from_above, lit_px);
    std::mt19937 random(5);
    const auto between = [&random](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    std::vector<shared::LightRecord> records;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 place(between(-6.0F, 6.0F), between(-1.0F, 4.0F), between(-6.0F, 6.0F));
        records.push_back(point_light(place, between(0.05F, 0.5F), between(0.4F, 4.0F)));
    }
    const auto light = drawing.light({.records = records});
    const auto surface = drawing.surface();
    double worst = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < light.size(); ++i) {
        if (surface.draw[i] == 0) {
            continue;
        }
        const glm::dvec3 point = drawing.point_at(centre_of(i), static_cast<double>(surface.depth[i]));
        double wanted = 0.0;
        for (const auto& record : records) {
            wanted += arriving(record, point, glm::dvec3(surface.shading_normal[i]));
        }
        sum += wanted;
        worst =
            std::max(worst, std::abs(std::min(wanted, 1.0) - std::min(static_cast<double>(light[i].x), 1.0)));
    }
    EXPECT_LT(worst, 1.0 / 255.0);
    EXPECT_GT(sum / static_cast<double>(light.size()), 0.05);
}

TEST(Light, TheSunFollowsTheCosine)
{
    test::Drawing drawing(test::scene_of(shapes::sphere(2.0F, 64, 32)), from_above, lit_px);
    shared::LightRecord sun{};
    sun.type = shared::light_directional;
    sun.direction = glm::normalize(glm::vec3(1, 1, 0.3));
    sun.color = {1.0F, 0.5F, 0.25F};
    const auto light =
        drawing.light({.records = {sun}, .directional_count = 1, .ambient = glm::vec3(0.125F)});
    const auto surface = drawing.surface();
    for (size_t i = 0; i < light.size(); ++i) {
        const float cosine = std::max(glm::dot(surface.smooth_normal[i], sun.direction), 0.0F);
        if (surface.draw[i] != 0) {
            EXPECT_NEAR(light[i].x, 0.125F + cosine, 2e-3F);
            EXPECT_NEAR(light[i].z, 0.125F + 0.25F * cosine, 2e-3F);
        }
    }
}

TEST(Light, ALightBehindTheSurfaceLeavesTheAmbient)
{
    test::Drawing drawing(floor_scene(), from_above, lit_px);
    shared::LightRecord sun{};
    sun.type = shared::light_directional;
    sun.direction = glm::normalize(glm::vec3(0.2, -1, 0.1));
    sun.color = glm::vec3(1.0F);
    const auto light = drawing.light({.records = {sun, point_light({0, -1, 0}, 50.0F)},
                                      .directional_count = 1,
                                      .ambient = glm::vec3(0.25F)});
    for (const glm::vec4& pixel : light) {
        EXPECT_NEAR(pixel.x, 0.25F, 1e-3F);
        EXPECT_NEAR(pixel.w, 0.25F, 1e-3F);
    }
}

TEST(Light, UnlitIsOneAndEmissiveIsAdded)
{
    Scene scene = floor_scene();
    scene.materials[0].unlit = true;
    for (const glm::vec4& pixel :
         test::Drawing(scene, from_above, lit_px).light({.ambient = glm::vec3(0.25F)})) {
        EXPECT_EQ(pixel.x, 1.0F);
    }
    scene.materials[0].unlit = false;
    scene.materials[0].emissive = {0.5F, 2.0F, 0.0F};
    for (const glm::vec4& pixel :
         test::Drawing(scene, from_above, lit_px).light({.ambient = glm::vec3(0.25F)})) {
        EXPECT_NEAR(pixel.x, 0.75F, 1e-3F);
        EXPECT_NEAR(pixel.y, 2.25F, 2e-3F);
        EXPECT_NEAR(pixel.z, 0.25F, 1e-3F);
    }
}

} // namespace
} // namespace estampe::light
