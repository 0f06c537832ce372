// SPDX-License-Identifier: MIT
// Ground under a moving eye and a changing wind: its motion vectors are right, and its strokes do not swim.
#include <cmath>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace estampe {
namespace {

constexpr uint32_t motion_width_px = 160;
constexpr uint32_t motion_height_px = 90;

Scene wandering_dunes()
{
    Scene scene{.materials = {Material{}}};
    scene.terrain = Terrain(parse_terrain(
        "[terrain]\nheight = '2 * fbm(80, octaves = 3) + downwind(dunes(40, 5, celerity = 1))'\n"
        "[mesh]\ncell_m = 0.25\ncells = 128\nreach_m = 2000\n[ripples]\nheight_m = 0\n",
        "test.toml"));
    return scene;
}

/// Shows only light on the ground, without shadows.
Style unshadowed_light_alone()
{
    Style style;
    for (const char* const setting :
         {"hatch.enabled=false", "contour.enabled=false", "sky.enabled=false", "paper.margin_mm=0",
          "paper.grain=0", "paper.granulation=0", "light.source=sun", "light.sun_azimuth_deg=70",
          "light.sun_elevation_deg=30", "light.shadows=false", "haze.enabled=false"}) {
        style.set(setting);
    }
    return style;
}

double tone_at(const Image& image, int x, int y)
{
    const auto column = static_cast<size_t>(std::clamp(x, 0, static_cast<int>(image.width) - 1));
    const auto row = static_cast<size_t>(std::clamp(y, 0, static_cast<int>(image.height) - 1));
    return image.rgba[(row * image.width + column) * 4] / 255.0;
}

/// How far a tone is outside the range of the tones around a place in a picture.
double beyond(const Image& image, const glm::dvec2& place_px, double wanted)
{
    const glm::ivec2 corner(glm::floor(place_px - 0.5));
    double least = 1.0;
    double most = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double found = tone_at(image, corner.x + (i & 1), corner.y + (i >> 1));
        least = std::min(least, found);
        most = std::max(most, found);
    }
    return std::max(least - wanted, wanted - most);
}

/// An eye moves over dunes. Each picture, reprojected to the eye before, equals the former picture except
/// where ground was hidden.
TEST(TerrainMotion, GroundDoesNotSwimUnderAMovingEye)
{
    const Scene scene = wandering_dunes();
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    RenderSettings settings{.width = motion_width_px, .height = motion_height_px};
    const auto camera_at = [&](int step) {
        const glm::dvec2 at(0.31 * step, 0.17 * step);
        const double eye_m = 9.0 + 0.02 * step;
        return Camera{.eye = {at.x, eye_m, at.y}, .target = {at.x + 8.0, eye_m - 1.5, at.y + 3.0}};
    };
    Image before = renderer.render(camera_at(0), unshadowed_light_alone(), settings);
    double most = 0.0;
    for (int step = 1; step <= 25; ++step) {
        settings.motion_since = Moment{camera_at(step - 1), 0.0};
        const Image now = renderer.render(camera_at(step), unshadowed_light_alone(), settings);
        const Motion& motion = renderer.motion();
        size_t seen = 0;
        size_t swimming = 0;
        for (uint32_t y = 0; y < motion_height_px; ++y) {
            for (uint32_t x = 0; x < motion_width_px; ++x) {
                const glm::dvec4 moved(motion.pixels[size_t{y} * motion_width_px + x]);
                const glm::dvec2 then = glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(moved);
                if (moved.w == 0.0 || moved.z == 0.0 || glm::any(glm::lessThan(then, glm::dvec2(1.0))) ||
                    glm::any(
                        glm::greaterThan(then, glm::dvec2(motion_width_px - 1.0, motion_height_px - 1.0)))) {
                    continue;
                }
                ++seen;
                const double wanted = tone_at(now, static_cast<int>(x), static_cast<int>(y));
                swimming += beyond(before, then, wanted) > 0.05 ? 1U : 0U;
            }
        }
        EXPECT_GT(seen, motion_width_px * motion_height_px / 3) << step;
        EXPECT_LT(static_cast<double>(swimming), 0.005 * static_cast<double>(seen)) << step;
        most = std::max(most, static_cast<double>(swimming) / static_cast<double>(seen));
        before = now;
    }
    RecordProperty("greatest share that swims", std::to_string(most));
}

/// Projects a place to pixels of the page, for an upright camera.
glm::dvec2 projected(const Camera& camera, const glm::dvec3& place)
{
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::dvec3 up = glm::cross(right, ahead);
    const glm::dvec3 away = place - camera.eye;
    const double scale =
        0.5 * motion_height_px / (std::tan(0.5 * camera.vertical_fov_rad) * glm::dot(away, ahead));
    return {0.5 * motion_width_px + scale * glm::dot(away, right),
            0.5 * motion_height_px - scale * glm::dot(away, up)};
}

glm::dvec3 ground_ray(const Camera& camera, const glm::dvec2& place_px)
{
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const double span = std::tan(0.5 * camera.vertical_fov_rad) / (0.5 * motion_height_px);
    return glm::normalize(ahead + right * (span * (place_px.x - 0.5 * motion_width_px)) -
                          glm::cross(right, ahead) * (span * (place_px.y - 0.5 * motion_height_px)));
}

/// Wind moves the dunes and the eye moves too: every pixel's motion vector agrees with the graph.
TEST(TerrainMotion, IsThatOfTheGraph)
{
    const Scene scene = wandering_dunes();
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Camera then{.eye = {0.0, 10.0, 0.0}, .target = {8.0, 8.0, 3.0}};
    const Camera now{.eye = {0.1, 10.05, 0.2}, .target = {8.1, 8.0, 3.2}};
    const double time_s = 4.0;
    const double passed_s = 1.0;
    static_cast<void>(renderer.render(now, unshadowed_light_alone(),
                                      {.width = motion_width_px,
                                       .height = motion_height_px,
                                       .time_s = time_s,
                                       .motion_since = Moment{then, time_s - passed_s}}));
    const Motion& motion = renderer.motion();
    size_t seen = 0;
    size_t wrong = 0;
    double moved_most = 0.0;
    for (uint32_t y = 0; y < motion_height_px; y += 3) {
        for (uint32_t x = 0; x < motion_width_px; x += 3) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const auto hit = scene.terrain->hit(now.eye, ground_ray(now, pixel), 60.0, time_s);
            if (!hit) {
                continue;
            }
            const HeightSample sample = scene.terrain->sample(hit->x, hit->z, time_s);
            const glm::dvec3 was = *hit - glm::dvec3(0.0, passed_s * sample.rate_m_per_s, 0.0);
            const glm::dvec2 expected = pixel - projected(then, was);
            const glm::dvec2 found(motion.pixels[size_t{y} * motion_width_px + x]);
            const double still = glm::length(pixel - projected(then, *hit) - expected);
            moved_most = std::max(moved_most, still);
            ++seen;
            wrong += glm::length(found - expected) > 0.05 + 0.02 * glm::length(expected) ? 1U : 0U;
        }
    }
    EXPECT_GT(seen, 400U);
    EXPECT_GT(moved_most, 0.5) << "the wind's part of it is seen";
    EXPECT_LT(static_cast<double>(wrong), 0.02 * static_cast<double>(seen));
}

} // namespace
} // namespace estampe
