// SPDX-License-Identifier: MIT
// Pictures of a terrain: the same a million metres away, without a gap below the horizon, and with its shadow.
#include <cmath>
#include <numbers>

#include <estampe/error.hpp>
#include <gtest/gtest.h>

#include "scene/shapes.hpp"
#include "support/crawl.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings small{.width = 160, .height = 90};

Scene ground(const std::string& toml)
{
    Scene scene{.materials = {Material{}}};
    scene.terrain = Terrain(parse_terrain(toml, "test.toml"));
    return scene;
}

const std::string waves = "[terrain]\nheight = '2 * sine(32) + rotate(sine(16), 90)'\n[mesh]\ncells = 32\n";

Image draw(const Scene& scene, const Camera& camera, const std::vector<std::string>& settings = {},
           const RenderSettings& size = small)
{
    Renderer renderer(test::validated());
    renderer.set_scene(scene);
    return renderer.render(camera, test::style_of(settings), size);
}

Camera looking(const glm::dvec3& eye, double yaw_rad, double pitch)
{
    return {.eye = eye, .target = eye + glm::dvec3(std::cos(yaw_rad), pitch, std::sin(yaw_rad))};
}

/// Ground that repeats looks the same 1000 km on, to the byte, and steps of a millimetre do there what they do
/// here.
TEST(Terrain, DoesNotShakeAMillionMetresAway)
{
    const Scene scene = ground(waves);
    const glm::dvec3 far(1e6, 0.0, -2e6);
    Renderer here(test::validated());
    Renderer there(test::validated());
    here.set_scene(scene);
    there.set_scene(scene);
    const Style style = test::style_of({"sky.mode=paper"});
    for (int step = 0; step < 3; ++step) {
        const glm::dvec3 eye(3.0 + 0.001 * step, 5.0, 0.001 * step);
        EXPECT_EQ(here.render(looking(eye, 0.3, -0.3), style, small),
                  there.render(looking(eye + far, 0.3, -0.3), style, small))
            << step;
    }
}

/// Below the horizon there is ground at every pixel, from whatever place and in whatever direction.
TEST(Terrain, HasNoGaps)
{
    const Scene scene =
        ground("[terrain]\nheight = '8 * fbm(60) + dunes(40, 5)'\n[mesh]\ncells = 32\nreach_m = 4000\n");
    Renderer renderer(test::validated());
    renderer.set_scene(scene);
    // Ground that is drawn flat and black on a white page.
    const Style style = test::style_of({"sky.mode=paper", "hatch.drawn=false", "contour.drawn=false",
                                        "wash.strength=1", "paper.grain=0", "paper.margin_mm=0",
                                        "light.shadows=false", "light.ambient=0", "light.sun_lux=0"});
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 at(37.3 * i, 0.0, -91.7 * i);
        const double ground_m = scene.terrain->sample(at.x, at.z).height_m;
        const Image image =
            renderer.render(looking({at.x, ground_m + 30.0, at.z}, 0.7 * i, -1.2), style, small);
        const auto is_paper = [&](size_t pixel) { return image.rgba[pixel * 4] > 200; };
        size_t gaps = 0;
        for (size_t pixel = 0; pixel < size_t{small.width} * small.height; ++pixel) {
            gaps += is_paper(pixel) ? 1 : 0;
        }
        EXPECT_EQ(gaps, 0U) << i;
    }
}

} // namespace
} // namespace estampe
