// SPDX-License-Identifier: MIT
// The direction of strokes on the ground.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace estampe {
namespace {

constexpr RenderSettings stroke_page{.width = 128, .height = 128, .samples = 4};

/// `wind_deg` counts from +x towards +z, as directions in the picture do.
Scene windy_ground(const char* height, float wind_deg)
{
    Scene scene{.materials = {Material{}}};
    Terrain terrain(parse_terrain("[terrain]\nheight = '" + std::string(height) +
                                      "'\n[mesh]\ncells = 64\ncell_m = 1\n[ripples]\nheight_m = 0\n[wind]\n"
                                      "towards_deg = " +
                                      std::to_string(90.0F - wind_deg) + "\n",
                                  "test.toml"));
    scene.terrain = std::move(terrain);
    return scene;
}

/// A single layer of strokes in the shade, seen from above with +x to the right and +z down.
Image strokes_from_above(const Scene& scene, const char* coordinates)
{
    Style style;
    for (const char* const each :
         {"contour.enabled=false", "sky.enabled=false", "paper.margin_mm=0", "paper.grain=0",
          "paper.granulation=0", "haze.enabled=false", "paper.ink_break=0", "hatch.layers=1",
          "hatch.wobble_mm=0", "wash.strength=0", "drift.enabled=false", "light.sun_elevation_deg=90",
          "tone.exposure=0.4", "paper.height_mm=20", "hatch.gap_mm=0", "hatch.width_mm=0.8"}) {
        style.set(each);
    }
    style.set(std::string("hatch.coordinates=") + coordinates);
    Camera camera{.eye = {0.0, 50.0, 0.0}, .target = {0.0, 0.0, 0.0}, .up = {0.0, 0.0, -1.0}};
    camera.orthographic_half_height_m = 8.0;
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    return renderer.render(camera, style, stroke_page);
}

struct Direction {
    double degrees = 0.0;   ///< from +x towards +z, 0 to 180
    double coherence = 0.0; ///< 1 if all strokes are parallel
};

/// Direction from the structure tensor over a part of the picture, with Scharr differences, which favour no
/// direction.
Direction direction_of(const Image& image)
{
    double xx = 0.0;
    double yy = 0.0;
    double xy = 0.0;
    const auto grey = [&](uint32_t x, uint32_t y) {
        return static_cast<double>(image.rgba[4 * (y * image.width + x)]);
    };
    for (uint32_t y = 8; y + 8 < image.height; ++y) {
        for (uint32_t x = 8; x + 8 < image.width; ++x) {
            const auto along_x = [&](uint32_t row) { return grey(x + 1, row) - grey(x - 1, row); };
            const auto along_y = [&](uint32_t column) { return grey(column, y + 1) - grey(column, y - 1); };
            const double dx = 3.0 * along_x(y - 1) + 10.0 * along_x(y) + 3.0 * along_x(y + 1);
            const double dy = 3.0 * along_y(x - 1) + 10.0 * along_y(x) + 3.0 * along_y(x + 1);
            xx += dx * dx;
            yy += dy * dy;
            xy += dx * dy;
        }
    }
    const double across_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const double degrees = across_rad * 180.0 / std::numbers::pi + 90.0;
    const double strength = xx + yy;
    return {.degrees = std::fmod(degrees + 180.0, 180.0),
            .coherence = strength > 0.0 ? std::hypot(xx - yy, 2.0 * xy) / strength : 0.0};
}

/// Angle between two undirected lines.
double between_deg(double a_deg, double b_deg)
{
    const double apart = std::fmod(std::abs(a_deg - b_deg), 180.0);
    return std::min(apart, 180.0 - apart);
}

TEST(TerrainStrokes, LieAcrossTheWindOnLevelGround)
{
    for (const float wind_deg : {0.0F, 35.0F, 90.0F}) {
        const Direction direction = direction_of(strokes_from_above(windy_ground("0 * x", wind_deg), "auto"));
        EXPECT_LT(between_deg(direction.degrees, wind_deg + 90.0), 3.0) << "wind " << wind_deg;
        EXPECT_GT(direction.coherence, 0.7) << "wind " << wind_deg;
    }
}

/// Along a stroke, h - 0.3 w is constant, where h is the height and w the way downwind. If the ground falls
/// by s per metre across the wind, h = -s a, a stroke runs along (w, a) = (-s, 0.3).
TEST(TerrainStrokes, BendWithSlopes)
{
    const Direction direction = direction_of(strokes_from_above(windy_ground("-0.15 * z", 0.0F), "auto"));
    EXPECT_LT(between_deg(direction.degrees, std::atan2(0.3, -0.15) * 180.0 / std::numbers::pi), 3.0);
    EXPECT_GT(direction.coherence, 0.7);
}

/// Strokes that follow the solid ignore the wind.
TEST(TerrainStrokes, KeepToTheSolidWhereThatIsWanted)
{
    const Image north = strokes_from_above(windy_ground("0 * x", 0.0F), "solid");
    EXPECT_TRUE(north == strokes_from_above(windy_ground("0 * x", 70.0F), "solid"));
}

} // namespace
} // namespace estampe
