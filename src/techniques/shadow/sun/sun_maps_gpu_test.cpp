// SPDX-License-Identifier: MIT
// Compares the kinds of sun maps: agreement with ray tracing, and texel sizes near and far.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/files.hpp"
#include "support/scenes.hpp"

namespace estampe::shadow {
namespace {

constexpr glm::uvec2 maps_px(192, 108);

struct Shot {
    const char* name;
    Scene scene;
    Camera camera;
    glm::dvec3 towards_sun;
};

Shot long_square()
{
    return {"long square",
            test::long_square(),
            {.eye = {-40.0, 1.7, 5.0}, .target = {-22.0, 0.0, -3.0}, .vertical_fov_rad = 0.8},
            glm::normalize(glm::dvec3(0.6, 0.5, 0.4))};
}

Shot example()
{
    Scene scene = load_scene(test::square_scene());
    const Camera camera = scene_camera(scene, pose_scene(scene, 0.0), "square");
    return {"example", std::move(scene), camera, glm::normalize(glm::dvec3(0.8, 0.35, 0.3))};
}

/// A map of one kind, drawn for a shot, and the size of its texels.
struct Map {
    const char* name;
    test::LightSetup setup;
    std::function<double(const glm::dvec3& point_anchor, double away_m)> texel_m;
    double reach_m = 1e9; ///< lateral distance from the eye, perpendicular to the sun
};

std::vector<Map> maps_of(const test::Drawing& drawing, const glm::dvec3& sun, double pixel_m, uint32_t size)
{
    shared::LightRecord record{};
    record.type = shared::light_directional;
    record.direction = glm::vec3(sun);
    record.color = glm::vec3(1.0F);
    const test::LightSetup setup{
        .records = {record}, .directional_count = 1, .falloff = 0.0F, .shadow_size = size};
    std::vector<Map> maps(4, {"whole", setup, {}});

    const auto whole_m = static_cast<double>(drawing.sun(sun, size).texel_m);
    maps[0].texel_m = [=](const glm::dvec3&, double) { return whole_m; };

    maps[1].name = "faded";
    const double reach_m = 30.0;
    maps[1].setup.clipmap = Clipmap{
        .view = drawing.sun(sun, size), .finest_m = 2.0 * reach_m / size, .size = size, .level_count = 1};
    maps[1].texel_m = [=](const glm::dvec3&, double) { return 2.0 * reach_m / size; };
    maps[1].reach_m = 0.8 * reach_m;

    maps[2].name = "clipmap";
    const Clipmap clipmap =
        fit_clipmap(drawing.sun(sun, size), size, 2.0 * pixel_m, drawing.pose.casters.radius());
    maps[2].setup.clipmap = clipmap;
    const Windows windows = windows_about(clipmap, glm::dvec3(drawing.globals.eye_anchor));
    maps[2].texel_m = [=](const glm::dvec3& point, double away_m) {
        double texel_m = clipmap.finest_m;
        for (uint32_t level = 0; level + 1 < clipmap.level_count; ++level, texel_m *= 2.0) {
            const glm::dvec2 at = glm::dvec2(glm::dot(point, glm::dvec3(clipmap.view.right)),
                                             glm::dot(point, glm::dvec3(clipmap.view.down))) /
                                      texel_m -
                                  glm::dvec2(windows[level]);
            if (2.0 * texel_m > pixel_m * away_m && std::min(at.x, at.y) > 3.0 &&
                std::max(at.x, at.y) < size - 3.0) {
                break;
            }
        }
        return texel_m;
    };

    maps[3].name = "warped";
    maps[3].setup.is_warped = true;
    const SunView warped = drawing.warped_sun(sun, size).view;
    maps[3].texel_m = [=](const glm::dvec3& point, double) {
        const double w = (glm::dmat4(warped.clip_from_anchor) * glm::dvec4(point, 1.0)).w;
        const glm::dvec2 extent_m(warped.extent_m);
        return std::max(extent_m.x * w, extent_m.y * w * w) / size;
    };
    return maps;
}

/// Results for the pixels in a range of distances.
struct MapVerdict {
    size_t compared = 0;
    size_t shadowed = 0;
    size_t wrong = 0;           ///< wrong pixels more than two texels from the edge
    size_t looked_at = 0;       ///< all pixels
    double error = 0.0;         ///< sum of the errors of light over all pixels
    std::vector<double> per_px; ///< size of a texel in pixels

    [[nodiscard]] double mean_error() const { return error / static_cast<double>(looked_at); }

    [[nodiscard]] double median_px()
    {
        const auto middle = per_px.begin() + static_cast<ptrdiff_t>(per_px.size() / 2);
        std::ranges::nth_element(per_px, middle);
        return *middle;
    }
};

struct Place {
    glm::dvec3 point{0.0}; ///< world space
    glm::dvec3 normal{0.0};
    double texel_m = 0.0;
};

bool is_near_an_edge(const test::EmbreeScene& rays, const Place& place, const glm::dvec3& sun, bool blocked)
{
    const glm::dvec3 right = glm::normalize(glm::cross(sun, glm::dvec3(0.1, 0.2, 0.9)));
    const glm::dvec3 up = glm::cross(right, sun);
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 aside = right * std::cos(0.785398 * k) + up * std::sin(0.785398 * k);
        if (rays.is_blocked(place.point + (place.normal + aside) * (2.0 * place.texel_m), sun) != blocked) {
            return true;
        }
    }
    return false;
}

/// Traces rays for every pixel between two distances that faces the sun.
MapVerdict compare_maps(const Shot& shot, const test::EmbreeScene& rays, test::Drawing& drawing,
                        const Map& map, double nearest_m, double farthest_m)
{
    const auto light = drawing.light(map.setup);
    const auto surface = drawing.surface();
    const glm::dvec3 forward = glm::normalize(shot.camera.target - shot.camera.eye);
    const double pixel_m = 2.0 * std::tan(0.5 * shot.camera.vertical_fov_rad) / maps_px.y;
    MapVerdict verdict;
    for (size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 normal(surface.smooth_normal[i]);
        if (surface.draw[i] == 0 || glm::dot(normal, shot.towards_sun) < 0.03) {
            continue;
        }
        const glm::dvec3 anchored = drawing.point_seen(i, surface.depth[i]);
        const glm::dvec3 way = anchored - glm::dvec3(drawing.globals.eye_anchor);
        const double away_m = glm::dot(way, forward);
        const double beside_m = glm::length(way - shot.towards_sun * glm::dot(way, shot.towards_sun));
        if (away_m < nearest_m || away_m > farthest_m || beside_m > map.reach_m) {
            continue;
        }
        Place place{.normal = normal, .texel_m = map.texel_m(anchored, away_m)};
        place.point = anchored + drawing.layout.anchor + normal * (0.05 * place.texel_m + 1e-4);
        const bool blocked = rays.is_blocked(place.point, shot.towards_sun);
        const auto share = static_cast<double>(light[i].x);
        ++verdict.looked_at;
        verdict.error += std::abs(share - (blocked ? 0.0 : 1.0));
        verdict.per_px.push_back(place.texel_m / (pixel_m * away_m));
        if (!is_near_an_edge(rays, place, shot.towards_sun, blocked)) {
            ++verdict.compared;
            verdict.shadowed += blocked ? 1U : 0U;
            verdict.wrong += (share < 0.5) != blocked ? 1U : 0U;
        }
    }
    return verdict;
}

double pixel_m_at_one(const Camera& camera)
{
    return 2.0 * std::tan(0.5 * camera.vertical_fov_rad) / maps_px.y;
}

TEST(SunMaps, AllAgreeWithRays)
{
    for (const Shot& shot : {long_square(), example()}) {
        const test::EmbreeScene rays(shot.scene);
        test::Drawing drawing(shot.scene, shot.camera, maps_px);
        for (const Map& map : maps_of(drawing, shot.towards_sun, pixel_m_at_one(shot.camera), 1024)) {
            const MapVerdict verdict = compare_maps(shot, rays, drawing, map, 0.0, 1e9);
            fmt::print("{}, {}: {} of {} wrong, {} in shadow\n", shot.name, map.name, verdict.wrong,
                       verdict.compared, verdict.shadowed);
            EXPECT_LE(static_cast<double>(verdict.wrong), 0.01 * static_cast<double>(verdict.compared))
                << shot.name << ", " << map.name;
            EXPECT_GT(verdict.compared, 2000U) << shot.name << ", " << map.name;
            EXPECT_GT(verdict.shadowed, 30U) << shot.name << ", " << map.name;
        }
    }
}

TEST(SunMaps, AgreeWithRaysOnModels)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    if (folder == nullptr) {
        return;
    }
    for (const char* name : {"sampleroom.gltf", "CornellBox/CornellBox.glb"}) {
        const std::filesystem::path path = std::filesystem::path(folder) / name;
        const Scene scene = load_scene(path);
        const Shot shot{name, scene, framing_camera(scene, pose_scene(scene, 0.0), 16.0 / 9.0),
                        glm::normalize(glm::dvec3(0.3, 0.45, 0.85))};
        const test::EmbreeScene rays(scene);
        test::Drawing drawing(scene, shot.camera, maps_px);
        for (const Map& map : maps_of(drawing, shot.towards_sun, pixel_m_at_one(shot.camera), 1024)) {
            const MapVerdict verdict = compare_maps(shot, rays, drawing, map, 0.0, 1e9);
            fmt::print("{}, {}: {} of {} wrong, {} in shadow\n", name, map.name, verdict.wrong,
                       verdict.compared, verdict.shadowed);
            EXPECT_LE(static_cast<double>(verdict.wrong), 0.01 * static_cast<double>(verdict.compared))
                << name << ", " << map.name;
        }
    }
}

TEST(SunMaps, AreFineWhereTheyPromiseToBe)
{
    const Shot shot = long_square();
    const test::EmbreeScene rays(shot.scene);
    test::Drawing drawing(shot.scene, shot.camera, maps_px);
    std::vector<double> error;
    for (const Map& map : maps_of(drawing, shot.towards_sun, pixel_m_at_one(shot.camera), 512)) {
        for (const auto& [nearest_m, farthest_m] : {std::pair(0.0, 15.0), std::pair(60.0, 1e9)}) {
            MapVerdict verdict = compare_maps(shot, rays, drawing, map, nearest_m, farthest_m);
            if (verdict.looked_at > 0) {
                fmt::print("{:8} {}: a texel is {:.2f} pixels, light is {:.4f} off\n", map.name,
                           nearest_m > 0.0 ? "far " : "near", verdict.median_px(), verdict.mean_error());
            }
            error.push_back(verdict.looked_at > 0 ? verdict.mean_error() : -1.0);
        }
    }
    // Near the eye, the single map is the coarsest.
    EXPECT_LT(error[2], 0.5 * error[0]);
    EXPECT_LT(error[4], 0.5 * error[0]);
    EXPECT_LT(error[6], 0.8 * error[0]);
    // Far away, a clipmap is at least as good.
    EXPECT_LE(error[5], error[1]);
}

} // namespace
} // namespace estampe::shadow
