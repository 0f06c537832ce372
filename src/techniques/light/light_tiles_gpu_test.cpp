// SPDX-License-Identifier: MIT
// Many lights: tiled culling must give the result of testing all lights, and must test only few lights.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe::light {
namespace {

constexpr glm::uvec2 tiled_px(160, 120);
const Camera tiled_camera{.eye = {0.0, 9.0, 5.0}, .vertical_fov_rad = 0.9};

/// Objects at several depths in front of a far floor, so that tiles have gaps in depth.
Scene deep_scene()
{
    Scene scene = test::scene_of(shapes::torus(2.0F, 0.7F));
    test::add_object(scene, shapes::plane(24.0F, 24.0F), glm::vec3(1.0F), {0.0, -4.0, 0.0});
    test::add_object(scene, shapes::sphere(0.6F), glm::vec3(1.0F), {0.0, 5.0, 2.0});
    for (int i = 0; i < 12; ++i) {
        test::add_object(scene, shapes::box({0.08F, 0.08F, 5.0F}), glm::vec3(1.0F),
                         {0.5 * i - 3.0, 3.0, 0.0});
    }
    return scene;
}

std::vector<shared::LightRecord> random_lights(size_t count, float range_m, float intensity)
{
    std::mt19937 random(7);
    const auto between = [&random](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    std::vector<shared::LightRecord> records;
    for (size_t i = 0; i < count; ++i) {
        shared::LightRecord record{};
        record.position = {between(-9.0F, 9.0F), between(-4.0F, 5.0F), between(-9.0F, 9.0F)};
        record.direction =
            glm::normalize(glm::vec3(between(-1.0F, 1.0F), between(-1.0F, 0.2F), between(-1.0F, 1.0F)));
        record.side = glm::normalize(glm::cross(record.direction, glm::vec3(0.3F, 0.9F, 0.1F)));
        record.range_m = between(0.4F, 1.0F) * range_m;
        record.color = glm::vec3(between(0.1F, 1.0F) * intensity);
        record.type = static_cast<uint32_t>(i % 3) + shared::light_point;
        record.type |= i % 5 == 0 ? shared::light_unit_volume : 0U;
        const float outer = std::cos(between(0.2F, 1.8F));
        record.cone_scale = 1.0F / std::max(0.05F, 1.0F - outer);
        record.cone_offset = -outer * record.cone_scale;
        records.push_back(record);
    }
    return records;
}

double cone_share(const shared::LightRecord& light, const glm::dvec3& beam)
{
    const uint32_t type = light.type & shared::light_type_mask;
    if (type == shared::light_point) {
        return 1.0;
    }
    double angle = std::acos(std::clamp(glm::dot(beam, glm::dvec3(light.direction)), -1.0, 1.0));
    if (type == shared::light_pyramid) {
        const glm::dvec3 side(light.side);
        const double along = glm::dot(beam, glm::dvec3(light.direction));
        angle = std::max(
            std::atan2(std::abs(glm::dot(beam, side)), along),
            std::atan2(std::abs(glm::dot(beam, glm::cross(side, glm::dvec3(light.direction)))), along));
    }
    return std::pow(std::clamp(std::cos(angle) * static_cast<double>(light.cone_scale) +
                                   static_cast<double>(light.cone_offset),
                               0.0, 1.0),
                    2.0);
}

/// Light of one lamp at a point, by the formulas.
double arriving_by_formulas(const shared::LightRecord& light, const glm::dvec3& point,
                            const glm::dvec3& normal)
{
    const glm::dvec3 to_light = glm::dvec3(light.position) - point;
    const double distance = glm::length(to_light);
    const double ratio = distance / static_cast<double>(light.range_m);
    const bool is_unit = (light.type & shared::light_unit_volume) != 0;
    const double falloff = is_unit ? std::max(0.0, 1.0 - ratio * ratio)
                                   : std::clamp(1.0 - std::pow(ratio, 4.0), 0.0, 1.0) / (distance * distance);
    return static_cast<double>(light.color.x) * falloff * cone_share(light, -to_light / distance) *
           std::max(0.0, glm::dot(normal, to_light / distance));
}

/// The largest error of a pixel, with light clamped to white, and the mean light.
struct Verdict {
    double worst = 0.0;
    double mean = 0.0;
};

Verdict compare_with_sum(test::Drawing& drawing, const std::vector<shared::LightRecord>& records)
{
    const auto light = drawing.light({.records = records});
    const auto surface = drawing.surface();
    Verdict verdict;
    for (size_t i = 0; i < light.size(); ++i) {
        if (surface.draw[i] == 0) {
            continue;
        }
        const glm::dvec3 point = drawing.point_seen(i, surface.depth[i]);
        double wanted = 0.0;
        for (const shared::LightRecord& record : records) {
            wanted += arriving_by_formulas(record, point, glm::dvec3(surface.shading_normal[i]));
        }
        verdict.mean += wanted / static_cast<double>(light.size());
        const double error = std::min(wanted, 1.0) - std::min(static_cast<double>(light[i].x), 1.0);
        verdict.worst = std::max(verdict.worst, std::abs(error));
    }
    return verdict;
}

TEST(LightTiles, AThousandLightsAreTheSumOfAll)
{
    test::Drawing drawing(deep_scene(), tiled_camera, tiled_px);
    const Verdict verdict = compare_with_sum(drawing, random_lights(1000, 3.0F, 0.2F));
    EXPECT_LT(verdict.worst, 1.0 / 255.0);
    EXPECT_GT(verdict.mean, 0.03);
}

TEST(LightTiles, TheSameWithoutListsAndInParallelProjection)
{
    const auto records = random_lights(60, 6.0F, 1.0F);
    test::Drawing few(deep_scene(), tiled_camera, tiled_px);
    EXPECT_LT(compare_with_sum(few, records).worst, 1.0 / 255.0);
    Camera parallel = tiled_camera;
    parallel.orthographic_half_height_m = 5.0;
    test::Drawing flat(deep_scene(), parallel, tiled_px);
    const Verdict verdict = compare_with_sum(flat, random_lights(300, 3.0F, 0.4F));
    EXPECT_LT(verdict.worst, 1.0 / 255.0);
    EXPECT_GT(verdict.mean, 0.02);
}

TEST(LightTiles, TilesChangeNothing)
{
    Camera parallel = tiled_camera;
    parallel.orthographic_half_height_m = 5.0;
    for (const Camera& camera : {tiled_camera, parallel}) {
        test::Drawing drawing(deep_scene(), camera, tiled_px);
        for (const size_t count : {50U, 1000U}) {
            const auto records = random_lights(count, 3.0F, 1.5F);
            const auto in_tiles = drawing.light({.records = records});
            const auto brute = drawing.light({.records = records, .looks_at_all = true});
            float worst = 0.0F;
            for (size_t i = 0; i < brute.size(); ++i) {
                worst = std::max(worst, std::abs(in_tiles[i].x - brute[i].x) / (1.0F + brute[i].x));
            }
            EXPECT_LT(worst, 1e-3F);
        }
    }
}

TEST(LightTiles, FewAreLookedAtThatDoNotReach)
{
    test::Drawing drawing(deep_scene(), tiled_camera, tiled_px);
    const auto visits = drawing.light({.records = random_lights(1000, 4.0F, 0.2F), .counts_visits = true});
    double looked_at = 0.0;
    double reach = 0.0;
    for (const glm::vec4& pixel : visits) {
        looked_at += static_cast<double>(pixel.x);
        reach += static_cast<double>(pixel.y);
    }
    const auto pixels = static_cast<double>(visits.size());
    RecordProperty("looked_at_per_pixel", std::to_string(looked_at / pixels));
    RecordProperty("reach_per_pixel", std::to_string(reach / pixels));
    EXPECT_GT(reach / pixels, 0.5);
    EXPECT_LT(looked_at / pixels, 45.0);
    EXPECT_LT(looked_at, 4.0 * reach); // tiles are a fifteenth of this small page
}

TEST(LightTiles, AGapInDepthLetsLightsThrough)
{
    // Bars in front of a far floor; the lights hang between them and reach neither.
    Scene scene = test::scene_of(shapes::plane(60.0F, 60.0F));
    for (int i = 0; i < 40; ++i) {
        test::add_object(scene, shapes::box({0.05F, 0.05F, 8.0F}), glm::vec3(1.0F),
                         {0.2 * i - 4.0, 20.0, 0.0});
    }
    const Camera camera{.eye = {0.0, 25.0, 0.1}, .vertical_fov_rad = 0.8};
    test::Drawing drawing(scene, camera, tiled_px);
    std::vector<shared::LightRecord> records = random_lights(100, 1.0F, 1.0F);
    for (shared::LightRecord& record : records) {
        record.position.y = 10.0F - static_cast<float>(drawing.layout.anchor.y);
    }
    double looked_at = 0.0;
    for (const glm::vec4& pixel : drawing.light({.records = records, .counts_visits = true})) {
        looked_at += static_cast<double>(pixel.x);
    }
    EXPECT_EQ(looked_at, 0.0);
}

TEST(LightTiles, LightBeyondWhatHalfFloatsHoldIsCutNotInfinite)
{
    test::Drawing drawing(deep_scene(), tiled_camera, tiled_px);
    const auto light = drawing.light({.records = random_lights(1000, 30.0F, 1e5F)});
    const float brightest = std::max_element(light.begin(), light.end(), [](const auto& a, const auto& b) {
                                return a.w < b.w;
                            })->w;
    EXPECT_GT(brightest, 60000.0F);
    EXPECT_TRUE(std::all_of(light.begin(), light.end(),
                            [](const glm::vec4& pixel) { return std::isfinite(pixel.w); }));
}

TEST(LightTiles, TheStrongestLightIsKept)
{
    test::Drawing drawing(deep_scene(), tiled_camera, tiled_px);
    auto records = random_lights(90, 12.0F, 2.0F);
    shared::LightRecord sun{};
    sun.type = shared::light_directional;
    sun.direction = {0.0F, 1.0F, 0.0F};
    sun.color = glm::vec3(0.3F);
    records.insert(records.begin(), sun);
    const auto kept = drawing.strongest_light({.records = records, .directional_count = 1});
    const auto surface = drawing.surface();
    size_t wrong = 0;
    size_t by_sun = 0;
    size_t by_lamp = 0;
    for (size_t i = 0; i < kept.size(); ++i) {
        if (surface.draw[i] == 0) {
            continue;
        }
        const glm::dvec3 point = drawing.point_seen(i, surface.depth[i]);
        const glm::dvec3 normal(surface.shading_normal[i]);
        double most = 0.3 * std::max(0.0, normal.y);
        glm::dvec3 towards(0.0);
        for (size_t k = 1; k < records.size(); ++k) {
            const double light = arriving_by_formulas(records[k], point, normal);
            towards = light > most ? glm::normalize(glm::dvec3(records[k].position) - point) : towards;
            most = std::max(most, light);
        }
        const bool is_lamp = towards != glm::dvec3(0.0);
        by_lamp += is_lamp ? 1U : 0U;
        by_sun += is_lamp ? 0U : 1U;
        wrong += glm::distance(glm::dvec3(kept[i]), towards) > 1e-3 ? 1U : 0U;
    }
    EXPECT_GT(by_sun, 500U);
    EXPECT_GT(by_lamp, 500U);
    EXPECT_LT(wrong, 20U); // pixels where two lights are equally strong
}

} // namespace
} // namespace estampe::light
