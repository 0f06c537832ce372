// SPDX-License-Identifier: MIT
// A sheet of one vase, which the documentation shows: of few triangles, the normal map, of few triangles with
// the map, and with all its relief.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/normal_map.hpp>
#include <estampe/renderer.hpp>

#include "golden/golden.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/bake/normals/test_support.hpp"

namespace estampe {
namespace {

/// Points of the vase's outline: distance from the axis, and height.
constexpr std::array<glm::dvec2, 12> outline{{{0.22, 0.0},
                                              {0.23, 0.04},
                                              {0.16, 0.1},
                                              {0.22, 0.2},
                                              {0.38, 0.36},
                                              {0.5, 0.58},
                                              {0.53, 0.78},
                                              {0.46, 0.96},
                                              {0.28, 1.1},
                                              {0.17, 1.24},
                                              {0.19, 1.4},
                                              {0.28, 1.5}}};

/// A point of the outline, which runs through all its points: `at` counts them.
glm::dvec2 outline_at(double at)
{
    const auto last = static_cast<int>(outline.size()) - 1;
    const int i = std::clamp(static_cast<int>(std::floor(at)), 0, last - 1);
    const auto point = [&](int k) { return outline[static_cast<size_t>(std::clamp(k, 0, last))]; };
    const double t = at - i;
    const glm::dvec2 a = point(i - 1);
    const glm::dvec2 b = point(i);
    const glm::dvec2 c = point(i + 1);
    const glm::dvec2 d = point(i + 2);
    return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t +
                  (3.0 * b - a - 3.0 * c + d) * t * t * t);
}

/// 0 below `from`, 1 above `to`, and smooth between them.
double rise(double from, double to, double x)
{
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// A band of meanders: 1 on its ridges, 0 beside them.
double meander(double x, double y)
{
    constexpr std::array<std::string_view, 7> rows{"#######.", "#.....#.", "#.###.#.", "#.#.#.#.",
                                                   "#.#...#.", "#.#####.", "#......."};
    const auto at = [&](int column, int row) {
        const bool is_inside = row >= 0 && row < static_cast<int>(rows.size());
        const auto k = static_cast<size_t>((column % 8 + 8) % 8);
        return is_inside && rows[static_cast<size_t>(row)][k] == '#' ? 1.0 : 0.0;
    };
    const double u = x * 8.0 - 0.5;
    const double v = y * static_cast<double>(rows.size()) - 0.5;
    const auto column = static_cast<int>(std::floor(u));
    const auto row = static_cast<int>(std::floor(v));
    const double s = u - column;
    const double t = v - row;
    const double mean = (1.0 - t) * ((1.0 - s) * at(column, row) + s * at(column + 1, row)) +
                        t * ((1.0 - s) * at(column, row + 1) + s * at(column + 1, row + 1));
    return rise(0.3, 0.7, mean);
}

/// Height of the relief in metres: lobes, a band of meanders between rings, leaves, and rings at neck and
/// lip.
double relief_m(double turn, double at)
{
    const auto round = [](double x) { return std::sqrt(std::max(0.0, 1.0 - x * x)); };
    const auto ring = [&](double middle, double half) { return round((at - middle) / half); };
    const double lobe = std::abs(std::cos(18.0 * std::numbers::pi * turn));
    const double lobes =
        0.035 * std::sqrt(lobe) * rise(2.9, 3.3, at) * (1.0 - rise(4.75, 4.85, at + 0.3 * (1.0 - lobe)));
    const double band = at > 5.2 && at < 6.5 ? 0.022 * meander(14.0 * turn, (6.5 - at) / 1.3) : 0.0;
    const double across = 2.0 * std::abs(20.0 * turn - std::floor(20.0 * turn) - 0.5);
    const double along = (at - 6.95) / 1.35;
    const double half = along > 0.0 && along < 1.0 ? 0.95 * std::sqrt(1.0 - along) : 0.0;
    const double leaf = across < half
                            ? 0.028 * round(across / half) * rise(0.0, 0.15, along) -
                                  0.012 * std::exp(-300.0 * across * across) * rise(0.0, 0.15, along)
                            : 0.0;
    return lobes + band + leaf + 0.018 * (ring(5.05, 0.09) + ring(6.75, 0.09)) +
           0.025 * (ring(8.75, 0.15) + ring(9.2, 0.1)) + 0.02 * ring(10.8, 0.18);
}

glm::dvec3 place_of(double turn, double at, double relief)
{
    const glm::dvec2 point = outline_at(at);
    const glm::dvec2 along = outline_at(at + 1e-3) - outline_at(at - 1e-3);
    const glm::dvec2 out = glm::normalize(glm::dvec2(along.y, -along.x));
    const double radius = point.x + relief * out.x;
    const double angle = bake::testing::turn_rad * turn;
    return {radius * std::sin(angle), point.y + relief * out.y, radius * std::cos(angle)};
}

Scene vase(uint32_t columns, uint32_t rows, bool has_relief)
{
    const double last = static_cast<double>(outline.size()) - 1.0;
    const auto place = [&](double u, double v) {
        return place_of(u, last * v, has_relief ? relief_m(u, last * v) : 0.0);
    };
    Scene scene = test::scene_of(bake::testing::patch(columns, rows, [&](double u, double v) {
        constexpr double step = 1e-4;
        const glm::dvec3 normal = glm::normalize(
            glm::cross(place(u + step, v) - place(u - step, v), place(u, v + step) - place(u, v - step)));
        return bake::testing::SurfacePoint{place(u, v), normal, {u, 1.0 - v}};
    }));
    scene.materials[0].base_color = {0.82F, 0.62F, 0.45F, 1.0F};
    return scene;
}

TEST(BakedNormalsGolden, AVaseOfFewTrianglesWithItsRelief)
{
    constexpr uint32_t width = 212;
    constexpr uint32_t height = 300;
    const Scene plain = vase(16, 22, false);
    const Scene detailed = vase(800, 560, true);
    const Image map = bake_normals(plain, detailed, {.size = 1024, .distance_m = 0.1}).map;
    Scene mapped = plain;
    mapped.textures.push_back({.image = map});
    mapped.materials[0].normal_texture.texture = 0;

    Style style;
    style.set("paper.height_mm=79");
    style.set("paper.margin_mm=0");
    style.set("picture.ground=false");
    style.set("light.sun_azimuth_deg=-65");
    style.set("light.sun_elevation_deg=35");
    style.set("tone.contrast=1.3");
    const Camera camera{.eye = {0.0, 1.35, 4.2}, .target = {0.0, 0.75, 0.0}, .vertical_fov_rad = 0.42};
    const auto drawn = [&](const Scene& scene) {
        Renderer& renderer = test::shared_renderer();
        renderer.set_scene(scene);
        return renderer.render(camera, style, {.width = width, .height = height, .samples = 4});
    };
    Image shown{.width = width, .height = height, .rgba = {}};
    for (uint32_t y = 0; y < height; ++y) { // the map, without filter
        for (uint32_t x = 0; x < width; ++x) {
            const size_t row = static_cast<size_t>(y) * map.height / height;
            const auto texel =
                map.rgba.begin() + static_cast<std::ptrdiff_t>(4 * (row * map.width + x * map.width / width));
            shown.rgba.insert(shown.rgba.end(), texel, texel + 4);
        }
    }
    test::expect_matches_golden(test::sheet_of({drawn(plain), shown, drawn(mapped), drawn(detailed)}, 4),
                                "baked-normals");
}

} // namespace
} // namespace estampe
