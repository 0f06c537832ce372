// SPDX-License-Identifier: MIT
// Lines along dune brinks, seen from above, compared with the breaks in the graph's slope.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace estampe {
namespace {

constexpr RenderSettings crest_page{.width = 320, .height = 240};
constexpr double crest_wind_deg = 25.0;
constexpr double cell_m = 0.25;
const glm::dvec2 along_wind(std::cos(crest_wind_deg* std::numbers::pi / 180.0),
                            std::sin(crest_wind_deg* std::numbers::pi / 180.0));

Scene crested_dunes()
{
    Scene scene{.materials = {Material{}}};
    scene.terrain = Terrain(parse_terrain("[terrain]\nheight = 'dunes(6, 0.8, meander = 0.2)'\n"
                                          "[wind]\ntowards_deg = 65\n"
                                          "[mesh]\ncells = 128\ncell_m = 0.25\n",
                                          "test.toml"));
    return scene;
}

/// Sees only the finest ring of the ground.
const Camera crest_camera{.eye = {1.0, 9.0, 2.0}, .target = {5.0, 0.0, 5.0}, .vertical_fov_rad = 0.87};

/// Direction from the eye through a place on the page.
glm::dvec3 crest_ray(const glm::vec2& page_mm, const VectorDrawing& drawing)
{
    const glm::dvec3 forward = glm::normalize(crest_camera.target - crest_camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double half = std::tan(0.5 * crest_camera.vertical_fov_rad);
    const double x = (page_mm.x - 0.5 * drawing.width_mm) / (0.5 * drawing.height_mm);
    const double y = (page_mm.y - 0.5 * drawing.height_mm) / (0.5 * drawing.height_mm);
    return glm::normalize(forward + half * (x * right - y * up));
}

/// Slope downwards along the wind.
double fall(const Terrain& terrain, const glm::dvec2& place)
{
    return -glm::dot(terrain.sample(place.x, place.y).slope, along_wind);
}

VectorDrawing drawn_crests(const Scene& scene, const std::vector<std::string>& assignments)
{
    Style style;
    for (const char* const setting : {"hatch.enabled=false", "paper.margin_mm=0", "contour.wobble_mm=0"}) {
        style.set(setting);
    }
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    return renderer.draw_strokes(crest_camera, style, crest_page);
}

std::vector<glm::dvec2> crest_places(const Scene& scene, const VectorDrawing& drawing)
{
    std::vector<glm::dvec2> places;
    for (const VectorStroke& stroke : drawing.strokes) {
        for (size_t i = 0; stroke.kind == StrokeKind::crest && i < stroke.points.size(); ++i) {
            const auto hit =
                scene.terrain->hit(crest_camera.eye, crest_ray(stroke.points[i].page_mm, drawing), 60.0);
            if (hit) {
                places.emplace_back(hit->x, hit->z);
            }
        }
    }
    return places;
}

TEST(TerrainCrests, LieWhereTheSlopeBreaks)
{
    const Scene scene = crested_dunes();
    const std::vector<glm::dvec2> places = crest_places(scene, drawn_crests(scene, {}));
    ASSERT_GT(places.size(), 50U);
    size_t astray = 0;
    for (const glm::dvec2& place : places) {
        const bool rises = fall(*scene.terrain, place - 2.0 * cell_m * along_wind) < 0.2;
        const bool slides = fall(*scene.terrain, place + 2.0 * cell_m * along_wind) > 0.4;
        astray += rises && slides ? 0 : 1;
    }
    EXPECT_LE(astray, places.size() / 50);
}

TEST(TerrainCrests, MissNoBrink)
{
    const Scene scene = crested_dunes();
    const std::vector<glm::dvec2> places = crest_places(scene, drawn_crests(scene, {}));
    const glm::dvec2 across(-along_wind.y, along_wind.x);
    size_t brinks = 0;
    size_t missed = 0;
    for (int row = -24; row <= 24; ++row) {
        for (int step = -160; step < 160; ++step) {
            const glm::dvec2 place = glm::dvec2(5.0, 5.0) + 0.1 * row * across + 0.02 * step * along_wind;
            const bool begins =
                fall(*scene.terrain, place) < 0.3 && fall(*scene.terrain, place + 0.02 * along_wind) >= 0.3;
            if (!begins || fall(*scene.terrain, place + cell_m * along_wind) < 0.4) {
                continue;
            }
            ++brinks;
            missed += std::ranges::none_of(
                places, [&](const glm::dvec2& seen) { return glm::distance(seen, place) < 2.0 * cell_m; });
        }
    }
    ASSERT_GT(brinks, 20U);
    EXPECT_LE(missed, brinks / 20);
}

TEST(TerrainCrests, AreLeftToTheStyle)
{
    const Scene scene = crested_dunes();
    EXPECT_TRUE(crest_places(scene, drawn_crests(scene, {"contour.crest.enabled=false"})).empty());
    EXPECT_TRUE(crest_places(scene, drawn_crests(scene, {"contour.crest.angle_deg=60"})).empty());
}

} // namespace
} // namespace estampe
