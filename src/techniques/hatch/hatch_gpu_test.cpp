// SPDX-License-Identifier: MIT
// The main property of hatching: the mean ink on the page equals the target darkness at any distance.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "core/color.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr uint32_t side_px = 256;

/// A style in which only hatching marks the paper, and darkness is one minus light.
Style bare_hatching()
{
    Style style;
    for (const char* assignment : {"paper.color=#ffffff",
                                   "paper.ink=#000000",
                                   "paper.grain=0",
                                   "paper.ink_break=0",
                                   "paper.height_mm=36",
                                   "paper.margin_mm=0",
                                   "wash.strength=0",
                                   "contour.enabled=false",
                                   "sky.enabled=false",
                                   "picture.ground=false",
                                   "light.source=sun",
                                   "light.sun_azimuth_deg=0",
                                   "light.sun_elevation_deg=0",
                                   "light.ambient=0",
                                   "light.fill=0",
                                   "light.turn_sun=false",
                                   "light.shadows=false",
                                   "light.falloff=1",
                                   "tone.gamma=1",
                                   "tone.contrast=1",
                                   "tone.floor=0",
                                   "tone.ceiling=1",
                                   "tone.local_value=0",
                                   "hatch.black_above=2"}) {
        style.set(assignment);
    }
    return style;
}

/// A wall of 100 m that faces the camera, with UVs in metres.
Scene tall_wall()
{
    Primitive wall = shapes::quad(100.0F, 100.0F);
    return test::scene_of(std::move(wall));
}

double mean_ink(const Image& image)
{
    const size_t pixels = image.rgba.size() / 4;
    double sum = 0.0;
    for (size_t i = 0; i < pixels; ++i) {
        sum += 1.0 - linear_from_srgb(image.rgba[4 * i] / 255.0);
    }
    return sum / static_cast<double>(pixels);
}

double hatched_ink(Style style, double darkness, double distance_m)
{
    style.set(fmt::format("tone.exposure={}", std::max(1.0 - darkness, 0.05)));
    if (darkness > 0.95) {
        style.set("light.exposure_stops=-10");
        style.set(fmt::format("tone.exposure={}", std::max((1.0 - darkness) * 1024.0, 0.05)));
    }
    const Camera camera{.eye = {0.3, 50.0, distance_m}, .target = {0.3, 50.0, 0.0}, .vertical_fov_rad = 0.6};
    return mean_ink(test::shared_renderer().render(camera, style, {.width = side_px, .height = side_px}));
}

class HatchTone : public testing::TestWithParam<std::string> {};

TEST_P(HatchTone, MeanInkIsTheDarknessAskedFor)
{
    test::shared_renderer().set_scene(tall_wall());
    Style style = bare_hatching();
    style.set(GetParam());
    double worst = 0.0;
    for (const double distance_m : {1.0, 4.0, 16.0}) {
        double previous = -1.0;
        for (int step = 0; step <= 10; ++step) {
            const double darkness = 0.1 * step;
            const double ink = hatched_ink(style, darkness, distance_m);
            EXPECT_NEAR(ink, darkness, 0.03) << "at " << distance_m << " m";
            EXPECT_GT(ink, previous) << "darkness " << darkness << " at " << distance_m << " m";
            previous = ink;
            worst = std::max(worst, std::abs(ink - darkness));
        }
    }
    RecordProperty("worst_error", fmt::format("{:.4f}", worst));
    fmt::print("worst error of the mean ink: {:.4f}\n", worst);
}

INSTANTIATE_TEST_SUITE_P(Coordinates, HatchTone,
                         testing::Values("hatch.coordinates=uv", "hatch.coordinates=solid"));

} // namespace
} // namespace estampe
