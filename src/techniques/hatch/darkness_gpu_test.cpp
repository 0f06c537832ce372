// SPDX-License-Identifier: MIT
// Darkness of strokes, for surfaces and light that the tests set pixel by pixel.
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

/// Darkness of a white wall in a light of 0.8; its left half is occluded.
std::vector<float> darkness_of(const shared::ToneConstants& tone)
{
    const auto globals = features::frame_globals({}, {}, glm::dvec3(0.0), {.size_px = darkness_px});
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    auto draw = test::Layer::words(darkness_px, [](glm::uvec2) { return 1U; });
    auto depth = test::Layer::depth(darkness_px, [](glm::uvec2) { return 0.01F; });
    auto color = test::Layer::root_color(darkness_px, [](glm::uvec2 pixel) {
        return glm::vec4(1.0F, 1.0F, 1.0F, pixel.x < darkness_px.x / 2 ? dark_open : 1.0F);
    });
    auto light = test::Layer::color(darkness_px, [](glm::uvec2) { return glm::vec4(0.8F); });
    auto screen = test::Layer::root_color(glm::uvec2(1), [](glm::uvec2) { return glm::vec4(0.0F); });
    gpu::Graph graph;
    const auto drawn = draw.in(graph);
    const auto darkness = add_darkness(graph,
                                       {.frame = gpu::import_whole(graph, "frame", frame),
                                        .draw = drawn,
                                        .depth = depth.in(graph),
                                        .normal = drawn,
                                        .color = color.in(graph),
                                        .coordinate = drawn,
                                        .footprint = drawn,
                                        .light = light.in(graph),
                                        .screen = screen.in(graph),
                                        .tone = tone,
                                        .size_px = darkness_px},
                                       {});
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

} // namespace
} // namespace estampe::hatch
