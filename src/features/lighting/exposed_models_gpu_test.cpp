// SPDX-License-Identifier: MIT
// Lens and shutter on models in the folder ESTAMPE_MODELS, if that is set.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>

#include "support/exposures.hpp"
#include "support/gpu_device.hpp"

namespace estampe {
namespace {

constexpr RenderSettings model_page{.width = 320, .height = 180};
constexpr uint32_t sample_count = 8; // gives the tested picture as smooth edges as the mean of many

Style flat(std::initializer_list<std::string> more)
{
    Style style;
    for (const char* assignment : {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : more) {
        style.set(assignment);
    }
    return style;
}

std::optional<Scene> model(const char* name)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    return folder != nullptr ? std::optional(load_scene(std::filesystem::path(folder) / name)) : std::nullopt;
}

/// Compares the lens with the mean of pictures over its aperture. It is focused on the scene's centre; the
/// aperture is 1/40 of that distance.
void compare_lens(const char* name, bool has_ink)
{
    const std::optional<Scene> scene = model(name);
    if (!scene) {
        return;
    }
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(*scene);
    const ScenePose pose = pose_scene(*scene, 0.0);
    const Camera camera = framing_camera(*scene, pose, 16.0 / 9.0);
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const double focus_m = glm::dot(scene_bounds(*scene, pose).center() - camera.eye, ahead);
    const double aperture_m = focus_m / 40.0;
    const std::string drawn = has_ink ? "hatch.enabled=true" : "hatch.enabled=false";
    const std::string lined = has_ink ? "contour.enabled=true" : "contour.enabled=false";
    const std::string focal = fmt::format("lens.focal_mm={}", std::min(1e3 * aperture_m, 1900.0));
    const std::string stop =
        fmt::format("lens.f_number={}", std::min(1e3 * aperture_m, 1900.0) / (1e3 * aperture_m));
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::dvec3 above = glm::cross(right, ahead);
    constexpr int count = 256;
    const test::Exposure truth = test::mean_of(count, [&](int i) {
        const double away_m = 0.5 * aperture_m * std::sqrt((i + 0.5) / count);
        const double turn = i * glm::pi<double>() * (3.0 - std::sqrt(5.0));
        Camera moved = camera;
        moved.eye += away_m * (std::cos(turn) * right + std::sin(turn) * above);
        moved.target = camera.eye + focus_m * ahead;
        return renderer.render(test::shifted_in_pixel(moved, i * 7 % count, model_page.height),
                               flat({drawn, lined}), model_page);
    });
    const auto decibels = [&](const char* mode) {
        const Style style =
            flat({drawn, lined, "lens.enabled=true", mode, focal, stop, "lens.largest_mm=60"});
        RenderSettings smooth = model_page;
        smooth.samples = sample_count;
        return test::psnr_db(test::exposure_of(renderer.render(camera, style, smooth)), truth);
    };
    fmt::print("{}{}: gather {:.1f} dB, separable {:.1f}, mips {:.1f}, sums {:.1f}, none {:.1f}\n", name,
               has_ink ? ", with ink" : "", decibels("lens.enabled=true"), decibels("lens.mode=separable"),
               decibels("lens.mode=mips"), decibels("lens.mode=sums"), decibels("lens.enabled=false"));
    EXPECT_GE(decibels("lens.enabled=true"), has_ink ? 25.0 : 30.0);
}

TEST(ExposedModels, AreBlurredAsByALens)
{
    for (const char* name : {"sampleroom.gltf", "FlightHelmet/FlightHelmet.gltf"}) {
        compare_lens(name, false);
        compare_lens(name, true);
    }
}

TEST(ExposedModels, AreBlurredAsByAShutter)
{
    const std::optional<Scene> scene = model("Fox.glb");
    if (!scene) {
        return;
    }
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(*scene);
    constexpr Index running = 2;
    constexpr double middle_s = 0.3;
    constexpr double exposure_s = 0.5 / 24.0;
    const Camera camera = framing_camera(*scene, pose_scene(*scene, middle_s, running), 16.0 / 9.0);
    const auto at = [](double time_s) {
        RenderSettings settings = model_page;
        settings.time_s = time_s;
        settings.animation = running;
        return settings;
    };
    for (const bool has_ink : {false, true}) {
        const std::string drawn = has_ink ? "hatch.enabled=true" : "hatch.enabled=false";
        const std::string lined = has_ink ? "contour.enabled=true" : "contour.enabled=false";
        constexpr int count = 64;
        const test::Exposure truth = test::mean_of(count, [&](int i) {
            return renderer.render(test::shifted_in_pixel(camera, i * 7 % count, model_page.height),
                                   flat({drawn, lined}),
                                   at(middle_s + exposure_s * ((i + 0.5) / count - 0.5)));
        });
        RenderSettings smooth = at(middle_s);
        smooth.samples = sample_count;
        const auto decibels = [&](const char* mode) {
            return test::psnr_db(test::exposure_of(renderer.render(
                                     camera, flat({drawn, lined, "motion_blur.enabled=true", mode}), smooth)),
                                 truth);
        };
        fmt::print("Fox{}: tiles {:.1f} dB, own {:.1f}, none {:.1f}\n", has_ink ? ", with ink" : "",
                   decibels("motion_blur.enabled=true"), decibels("motion_blur.mode=own"),
                   decibels("motion_blur.enabled=false"));
        EXPECT_GE(decibels("motion_blur.enabled=true"), has_ink ? 25.0 : 30.0);
    }
}

} // namespace
} // namespace estampe
