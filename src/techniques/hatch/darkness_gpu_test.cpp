// SPDX-License-Identifier: MIT
// Darkness of strokes, for surfaces and light that the tests set pixel by pixel.
#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/hatch/hatch.hpp"

namespace estampe::hatch {
namespace {

constexpr glm::uvec2 darkness_px(32, 16);
constexpr float dark_open = 102.0F / 255.0F; // visibility under occlusion on the left half

/// Darkness of a wall of a grey in a light of `lit`; its left half is occluded. With `style`, the wall's
/// columns turn away from the sun, are in shadow, in half shadow and lit, and so on; its lower half is level.
std::vector<float> darkness_of(const shared::ToneConstants& tone, const HatchStyle& style = {},
                               bool has_sun = false, uint32_t ground_draw = UINT32_MAX, float lit = 0.8F,
                               float grey = 1.0F, const glm::vec3& upper = {0, 0, 1},
                               std::optional<float> to_things_px = {})
{
    const auto globals = features::frame_globals({}, {}, glm::dvec3(0.0), {.size_px = darkness_px});
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    auto draw = test::Layer::words(darkness_px, [](glm::uvec2) { return 1U; });
    auto depth = test::Layer::depth(darkness_px, [](glm::uvec2) { return 0.01F; });
    auto color = test::Layer::root_color(darkness_px, [&](glm::uvec2 pixel) {
        return glm::vec4(glm::vec3(grey), pixel.x < darkness_px.x / 2 ? dark_open : 1.0F);
    });
    auto light = test::Layer::color(darkness_px, [&](glm::uvec2) { return glm::vec4(lit); });
    auto screen = test::Layer::root_color(glm::uvec2(1), [](glm::uvec2) { return glm::vec4(0.0F); });
    constexpr std::array<float, 4> suns{-1.0F, 0.0F, 0.5F, 1.0F};
    auto sun = test::Layer::depth(darkness_px, [&](glm::uvec2 pixel) { return suns.at(pixel.x % 4); });
    auto normal = test::Layer::normals(darkness_px, [&](glm::uvec2 pixel) {
        return pixel.y < darkness_px.y / 2 ? upper : glm::vec3(0, 1, 0);
    });
    auto halo = test::Layer::coverage((darkness_px + 6U) / 4U,
                                      [&](glm::uvec2) { return to_things_px.value_or(0.0F); });
    gpu::Graph graph;
    const auto drawn = draw.in(graph);
    const auto darkness = add_darkness(graph,
                                       {.frame = gpu::import_whole(graph, "frame", frame),
                                        .draw = drawn,
                                        .depth = depth.in(graph),
                                        .normal = normal.in(graph),
                                        .color = color.in(graph),
                                        .coordinate = drawn,
                                        .footprint = drawn,
                                        .light = light.in(graph),
                                        .sun = has_sun ? std::optional(sun.in(graph)) : std::nullopt,
                                        .ground_draws = {UINT32_MAX, ground_draw},
                                        .halo = to_things_px ? std::optional(halo.in(graph)) : std::nullopt,
                                        .screen = screen.in(graph),
                                        .tone = tone,
                                        .pixels_per_mm = 2.0F,
                                        .size_px = darkness_px},
                                       style);
    return test::run_and_read_coverage(graph, darkness.image);
}

void expect_halves(const std::vector<float>& darkness, float left, float right)
{
    for (uint32_t i = 0; i < darkness.size(); ++i) {
        EXPECT_NEAR(darkness[i], i % darkness_px.x < darkness_px.x / 2 ? left : right, 1e-3F) << i;
    }
}

TEST(Darkness, DeepensWhereOcclusionKeepsLightOff)
{
    shared::ToneConstants tone{.exposure = 1.0F, .gamma = 1.0F, .contrast = 1.0F, .ceiling = 1.0F};
    expect_halves(darkness_of(tone), 0.2F, 0.2F);
    tone.occlusion = 1.0F;
    expect_halves(darkness_of(tone), 1.0F - 0.8F * dark_open, 0.2F);
    tone.occlusion = 0.5F;
    expect_halves(darkness_of(tone), 1.0F - 0.8F * 0.5F * (1.0F + dark_open), 0.2F);
}

TEST(Darkness, HasMoreOrFewerLayersByTheCauseOfShade)
{
    const shared::ToneConstants tone{.exposure = 1.0F, .gamma = 1.0F, .contrast = 1.0F, .ceiling = 1.0F};
    const HatchStyle style{.form_shade = 3.0F, .cast_shade = 2.0F, .ground_shade = 0.5F};
    const auto inked = [](float layers) { return 1.0F - std::pow(0.3F, layers); };
    const std::array<float, 4> layers{3.0F, 2.0F, 1.5F, 1.0F};
    const std::vector<float> walls = darkness_of(tone, style, true, UINT32_MAX, 0.3F);
    const std::vector<float> ground = darkness_of(tone, style, true, 0, 0.3F);
    for (uint32_t i = 0; i < walls.size(); ++i) {
        const bool is_level = i / darkness_px.x >= darkness_px.y / 2;
        const float upright = layers.at(i % 4);
        EXPECT_NEAR(walls[i], inked(is_level ? 0.5F * upright : upright), 1e-3F) << i;
        // The ground has no form of its own, however its triangles lie.
        EXPECT_NEAR(ground[i], inked(0.5F * (i % 4 == 0 ? 2.0F : upright)), 1e-3F) << i;
    }
    expect_halves(darkness_of(tone, style), 0.2F, 0.2F); // without a sun, no shade has a cause
    const std::vector<float> lamplit = darkness_of(tone, {.form_shade = 9.0F, .ground_shade = 1.0F}, true);
    expect_halves(lamplit, 0.2F, 0.2F); // where lamps shine, there is no shade, wherever the sun is
    expect_halves(darkness_of(tone, {.form_shade = 1.0F, .ground_shade = 1.0F}, true), 0.2F, 0.2F);
}

TEST(Darkness, HasMoreLayersInShadeOnUndersides)
{
    const shared::ToneConstants tone{.exposure = 1.0F, .gamma = 1.0F, .contrast = 1.0F, .ceiling = 1.0F};
    const HatchStyle style{.form_shade = 1.5F, .cast_shade = 1.2F, .ground_shade = 1.0F, .under_shade = 2.0F};
    const auto inked = [](float layers) { return 1.0F - std::pow(0.3F, layers); };
    const std::array<float, 4> of_walls{1.5F, 1.2F, 1.1F, 1.0F};
    const std::array<float, 4> of_undersides{3.0F, 2.4F, 1.7F, 1.0F};
    const auto walls = darkness_of(tone, style, true, UINT32_MAX, 0.3F);
    const auto undersides = darkness_of(tone, style, true, UINT32_MAX, 0.3F, 1.0F, {0, -1, 0});
    for (uint32_t i = 0; i < darkness_px.x * darkness_px.y / 2; ++i) {
        EXPECT_NEAR(walls[i], inked(of_walls.at(i % 4)), 1e-3F) << i;
        EXPECT_NEAR(undersides[i], inked(of_undersides.at(i % 4)), 1e-3F) << i;
    }
}

TEST(Darkness, ThinsOutAroundThingsOnLitGround)
{
    const shared::ToneConstants tone{.exposure = 1.0F, .gamma = 1.0F, .contrast = 1.0F, .ceiling = 1.0F};
    const HatchStyle style{
        .form_shade = 1.0F, .cast_shade = 1.0F, .ground_shade = 1.0F, .under_shade = 1.01F, .halo_mm = 4.0F};
    for (const float away_px : {0.0F, 2.0F, 4.0F, 8.0F, 20.0F}) {
        const float share = std::min(away_px / 8.0F, 1.0F);
        const float left = share * share * (3.0F - 2.0F * share);
        // A wall above, level ground below. A darkness of 0.7 is shade where the sun does not reach.
        const auto found = darkness_of(tone, style, true, UINT32_MAX, 0.3F, 1.0F, {0, 0, 1}, away_px);
        const std::array<float, 4> in_sun{1.0F, 1.0F, 0.5F * (1.0F + left), left};
        for (uint32_t i = 0; i < found.size(); ++i) {
            const bool is_level = i / darkness_px.x >= darkness_px.y / 2;
            EXPECT_NEAR(found[i], is_level ? 0.7F * in_sun.at(i % 4) : 0.7F, 1e-3F) << i;
        }
        // The ground counts as open whatever its normals; without a sun, what is light is no shade.
        for (const float dark : darkness_of(tone, style, false, 0, 0.8F, 1.0F, {0, 0, 1}, away_px)) {
            EXPECT_NEAR(dark, 0.2F * left, 1e-3F);
        }
    }
}

TEST(Darkness, LayersOfShadeDoNotBlackenADarkMaterial)
{
    const shared::ToneConstants tone{
        .exposure = 1.0F, .gamma = 1.0F, .contrast = 1.0F, .ceiling = 1.0F, .local_value = 1.0F};
    const HatchStyle style{.form_shade = 2.0F, .cast_shade = 2.0F, .ground_shade = 1.0F};
    const float on_white = 1.0F - 0.4F * 0.4F; // two layers of the darkness 0.6
    for (const uint32_t root : {255U, 153U, 51U}) {
        const float grey = static_cast<float>(root * root) / (255.0F * 255.0F);
        const auto wall = darkness_of(tone, style, true, UINT32_MAX, 0.4F, grey);
        for (uint32_t i = 0; i < wall.size(); ++i) {
            const float own = 1.0F - 0.4F * grey;
            if (i % 4 < 2) { // in shade
                EXPECT_NEAR(wall[i], std::max(own, on_white), 2e-3F) << grey << ", " << i;
            } else if (i % 4 == 3) {
                EXPECT_NEAR(wall[i], own, 2e-3F) << grey << ", " << i;
            }
        }
    }
}

} // namespace
} // namespace estampe::hatch
