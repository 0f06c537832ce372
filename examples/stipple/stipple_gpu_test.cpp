// SPDX-License-Identifier: MIT
// Compares the dots' ink with the requested darkness.
#include "stipple.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "support/layers.hpp"

namespace estampe::stipple {
namespace {

constexpr glm::uvec2 size_px(192, 160);

std::vector<float> dots(const test::Painter<float>& darkness, const StippleStyle& style)
{
    auto tone = test::Layer::coverage(size_px, darkness);
    gpu::Graph graph;
    const StippleInputs inputs{.darkness = tone.in(graph), .pixels_per_mm = 8.0F, .size_px = size_px};
    return test::run_and_read_coverage(graph, add_stipple(graph, inputs, style));
}

TEST(Stipple, MeanInkIsTheDarknessAskedFor)
{
    for (const float spacing_mm : {0.3F, 0.9F, 2.0F}) {
        for (const float darkness : {0.0F, 0.02F, 0.1F, 0.25F, 0.5F}) {
            const std::vector<float> ink =
                dots([=](glm::uvec2) { return darkness; }, {.spacing_mm = spacing_mm, .jitter = 0.0F});
            const double mean =
                std::accumulate(ink.begin(), ink.end(), 0.0) / static_cast<double>(ink.size());
            EXPECT_NEAR(mean, darkness, 0.02 + 0.04 * darkness) << spacing_mm << " mm";
        }
    }
}

TEST(Stipple, DotsAreInkAndWhatIsBetweenIsPaper)
{
    const std::vector<float> ink = dots([](glm::uvec2) { return 0.3F; }, {.spacing_mm = 2.0F});
    const auto grey = std::ranges::count_if(ink, [](float value) { return value > 0.01F && value < 0.99F; });
    EXPECT_LT(static_cast<double>(grey), 0.2 * static_cast<double>(ink.size()));
    EXPECT_EQ(std::ranges::max(ink), 1.0F);
    EXPECT_EQ(std::ranges::min(ink), 0.0F);
}

TEST(Stipple, EachHalfOfThePageHasItsOwnTone)
{
    const std::vector<float> ink =
        dots([](glm::uvec2 pixel) { return pixel.x < size_px.x / 2 ? 0.4F : 0.0F; }, {.spacing_mm = 0.5F});
    double left = 0.0;
    double right = 0.0;
    for (size_t i = 0; i < ink.size(); ++i) {
        const size_t x = i % size_px.x;
        left += x < size_px.x / 2 ? ink[i] : 0.0;
        right += x > size_px.x / 2 + 4 ? ink[i] : 0.0; // dots at the edge extend over the edge
    }
    EXPECT_GT(left, 1000.0);
    EXPECT_EQ(right, 0.0);
}

} // namespace
} // namespace estampe::stipple
