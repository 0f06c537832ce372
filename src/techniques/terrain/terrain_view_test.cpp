// SPDX-License-Identifier: MIT
// Tests the automatic view of bare ground, by evaluating the graph itself.
#include <cmath>

#include <estampe/scene.hpp>
#include <estampe/terrain.hpp>
#include <gtest/gtest.h>

#include "techniques/terrain/graph/compile.hpp"

namespace estampe {
namespace {

constexpr const char* dunes_toml = R"toml([terrain]
height = "swell + great"
[nodes]
swell = "6 * fbm(600, octaves = 2)"
great = "warp(dunes(85, 10, meander = 0.35, variation = 0.9, crest = 150), 14 * noise(260), 0)"
[wind]
towards_deg = 70
)toml";

glm::dvec3 sun_at(double azimuth_rad, double elevation_rad)
{
    return {std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad),
            std::cos(elevation_rad) * std::cos(azimuth_rad)};
}

struct Shares {
    double ground = 0.0; ///< share of the picture
    double shade = 0.0;  ///< share of the ground
};

Shares seen(const Terrain& terrain, const Camera& camera, const glm::dvec3& towards_sun)
{
    constexpr int columns = 24;
    constexpr int rows = 14;
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double half_height = std::tan(0.5 * camera.vertical_fov_rad);
    int ground = 0;
    int shaded = 0;
    for (int i = 0; i < columns * rows; ++i) {
        const double x = (2.0 * (i % columns + 0.5) / columns - 1.0) * half_height * columns / rows;
        const double y = (2.0 * (i / columns + 0.5) / rows - 1.0) * half_height;
        const auto hit = terrain.hit(camera.eye, glm::normalize(ahead + x * right + y * up), 400.0);
        if (!hit) {
            continue;
        }
        ++ground;
        const bool faces = glm::dot(terrain.sample(hit->x, hit->z).normal(), towards_sun) > 0.0;
        const bool is_lit = faces && !terrain.hit(*hit + glm::dvec3(0.0, 0.2, 0.0), towards_sun, 120.0);
        shaded += is_lit ? 0 : 1;
    }
    return {static_cast<double>(ground) / (columns * rows),
            static_cast<double>(shaded) / std::max(ground, 1)};
}

TEST(TerrainView, HasLightAndShadeUnderASunThatComesFromUpwind)
{
    const Terrain terrain(parse_terrain(dunes_toml, "dunes.toml"));
    for (int i = -2; i <= 2; ++i) {
        const glm::dvec3 sun = sun_at(glm::radians(-110.0 + 20.0 * i), 0.28);
        const Camera camera = terrain_camera(terrain, 0.0, sun);
        const Shares shares = seen(terrain, camera, sun);
        EXPECT_GT(shares.shade, 0.15) << "sun " << i;
        EXPECT_LT(shares.shade, 0.6) << "sun " << i;
        EXPECT_GT(shares.ground, 0.45) << "sun " << i;
        EXPECT_LT(shares.ground, 0.95) << "sun " << i;
        EXPECT_NEAR(camera.eye.y - terrain.sample(camera.eye.x, camera.eye.z).height_m, 3.0, 0.5);
        EXPECT_NEAR(camera.target.y, terrain.sample(camera.target.x, camera.target.z).height_m, 0.5);
    }
}

TEST(TerrainView, LooksOverAPlainToo)
{
    const Terrain plain(parse_terrain("[terrain]\nheight = \"2\"\n", "plain.toml"));
    const Camera camera = terrain_camera(plain, 0.0, {0.0, 1.0, 0.0});
    EXPECT_NEAR(camera.eye.y, 5.0, 1e-9);
    EXPECT_NEAR(camera.target.y, 2.0, 1e-6);
    EXPECT_GT(glm::distance(camera.eye, camera.target), 10.0);
}

} // namespace
} // namespace estampe
