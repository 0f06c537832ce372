// SPDX-License-Identifier: MIT
// Each preset draws a picture of its own.
#include <cmath>
#include <map>
#include <string>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>
#include <estampe/style.hpp>
#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

/// Mean difference of two pictures of one size, 0 (equal) to 1.
double difference(const Image& a, const Image& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        sum += std::abs(static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i])) / 255.0;
    }
    return sum / static_cast<double>(a.rgba.size());
}

TEST(PresetPictures, DifferFromEachOther)
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 48, 24));
    test::add_object(scene, shapes::box({1.0F, 2.0F, 1.0F}), glm::vec3(0.6F, 0.4F, 0.3F), {1.8, 0.0, -0.6});
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Camera camera{.eye = {2.5, 1.8, 5.0}, .target = {0.7, 0.0, 0.0}};
    const RenderSettings page{.width = 240, .height = 180};

    std::map<std::string, Image> pictures{{"none", renderer.render(camera, Style(), page)}};
    for (const std::string& preset : Style::presets()) {
        const Image picture = renderer.render(camera, Style::load(preset), page);
        for (const auto& [other, drawn] : pictures) {
            EXPECT_GT(difference(picture, drawn), 0.01) << preset << " and " << other;
        }
        pictures.emplace(preset, picture);
    }
}

} // namespace
} // namespace estampe
