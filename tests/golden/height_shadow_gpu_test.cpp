// SPDX-License-Identifier: MIT
// A sheet of one field of dunes in a low sun, shaded in the three ways, which the documentation shows.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "golden/golden.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/shadow/heightfield/height_shadow.hpp"

namespace estampe {
namespace {

constexpr uint32_t heights_side = 256;
constexpr float texel_m = 0.5F;

/// Crests that wind, steep to the lee, and a tower.
float crests_and_tower(glm::vec2 p)
{
    const float bent = p.x + 9.0F * std::sin(p.y / 17.0F) + 4.0F * std::sin(p.y / 7.3F + p.x / 31.0F);
    const float phase = bent / 32.0F - std::floor(bent / 32.0F);
    const float slope = phase < 0.72F ? phase / 0.72F : (1.0F - phase) / 0.28F;
    const float crest = 5.0F * slope * slope * (1.0F + 0.4F * std::sin(p.y / 23.0F + 1.0F));
    const glm::vec2 to_tower = glm::abs(p - glm::vec2(84.0F, 40.0F));
    return std::max(to_tower.x, to_tower.y) < 2.0F ? crest + 14.0F : crest;
}

TEST(HeightShadowGolden, DunesInALowSun)
{
    const double azimuth = 0.35;
    const double elevation = 0.2;
    const glm::dvec3 towards_sun(std::cos(azimuth) * std::cos(elevation), std::sin(elevation),
                                 std::sin(azimuth) * std::cos(elevation));
    test::Layer height = test::Layer::depth({heights_side, heights_side}, [](glm::uvec2 texel) {
        return crests_and_tower(texel_m * glm::vec2(texel));
    });
    Image sheet{.width = 3 * heights_side, .height = heights_side};
    sheet.rgba.assign(4ULL * sheet.width * sheet.height, 255);
    uint32_t tile = 0;
    for (const auto method :
         {shadow::HeightMethod::sweep, shadow::HeightMethod::pyramid, shadow::HeightMethod::march}) {
        gpu::Graph graph;
        const gpu::ImageId seen = shadow::add_height_shadow(graph,
                                                            {.height = height.in(graph),
                                                             .texel_m = {texel_m},
                                                             .towards_sun = towards_sun,
                                                             .sun_radius_rad = 0.02},
                                                            {.method = method, .blur_m = 2.0F * texel_m});
        const std::vector<float> visible = test::run_and_read_coverage(graph, seen);
        for (uint32_t i = 0; i < heights_side * heights_side; ++i) {
            const glm::vec2 p = texel_m * glm::vec2(i % heights_side, i / heights_side);
            const float dx =
                crests_and_tower(p + glm::vec2(0.5F, 0.0F)) - crests_and_tower(p - glm::vec2(0.5F, 0.0F));
            const float dy =
                crests_and_tower(p + glm::vec2(0.0F, 0.5F)) - crests_and_tower(p - glm::vec2(0.0F, 0.5F));
            const float facing =
                std::max(glm::dot(glm::normalize(glm::vec3(-dx, 1.0F, -dy)), glm::vec3(towards_sun)), 0.0F);
            const float tone = std::pow(0.12F + 1.6F * visible[i] * facing, 1.0F / 2.2F);
            const size_t pixel = 4 * (static_cast<size_t>(i / heights_side) * sheet.width +
                                      tile * heights_side + i % heights_side);
            std::fill_n(sheet.rgba.begin() + static_cast<std::ptrdiff_t>(pixel), 3,
                        static_cast<uint8_t>(255.0F * std::min(tone, 1.0F)));
        }
        ++tile;
    }
    test::expect_matches_golden(sheet, "height-shadow");
}

} // namespace
} // namespace estampe
