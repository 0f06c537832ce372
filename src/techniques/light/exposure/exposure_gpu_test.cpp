// SPDX-License-Identifier: MIT
// Exposure by the page against percentiles that the test computes by sorting.
#include <cmath>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/light/exposure/exposure.hpp"

namespace estampe::light {
namespace {

constexpr glm::uvec2 exposed_px(64, 40);

/// A page whose light grows from left to right over `stops` around `middle`; the upper half is background.
struct Page {
    float middle = 1.0F;
    float stops = 4.0F;
};

float light_at(const Page& page, glm::uvec2 pixel)
{
    const float along = static_cast<float>(pixel.x) / static_cast<float>(exposed_px.x - 1) - 0.5F;
    return page.middle * std::exp2(along * page.stops);
}

/// Settings as in ExposureInputs.
struct Metering {
    bool adapts = true;
    float compensation_stops = 0.0F;
    float most_change_stops = -1.0F;
};

/// Exposes pages one after another with one ExposureMemory.
class Eye {
public:
    /// How many stops the page was brightened.
    float look_at(const Page& page, const Metering& how = {})
    {
        auto light = test::Layer::color(exposed_px,
                                        [&](glm::uvec2 pixel) { return glm::vec4(light_at(page, pixel)); });
        auto draw = test::Layer::words(exposed_px,
                                       [](glm::uvec2 pixel) { return pixel.y < exposed_px.y / 2 ? 0U : 1U; });
        gpu::Graph graph;
        const ExposureInputs in{.light = light.in(graph),
                                .draw = draw.in(graph),
                                .state = gpu::import_whole(graph, "state", state_),
                                .adapts = how.adapts,
                                .compensation_stops = how.compensation_stops,
                                .most_change_stops = how.most_change_stops,
                                .size_px = exposed_px};
        const auto exposed = test::run_and_read_colors(graph, add_exposure(graph, in).light);
        const glm::uvec2 lit(exposed_px.x / 2, exposed_px.y - 1);
        const glm::uvec2 empty(exposed_px.x / 2, 0);
        EXPECT_NEAR(exposed[lit.x].x, light_at(page, empty), 2e-3F * light_at(page, empty));
        return std::log2(exposed[lit.y * exposed_px.x + lit.x].x / light_at(page, lit));
    }

private:
    gpu::Buffer state_ =
        gpu::upload_buffer(test::shared_device(), "state", std::vector<shared::ExposureState>(1));
};

TEST(Exposure, BringsTheWellLitPartsToOne)
{
    // The mean from the 70th to the 90th percentile of a linear ramp is the 80th.
    for (const Page page : {Page{1.0F, 4.0F}, Page{30.0F, 2.0F}, Page{0.002F, 6.0F}}) {
        const float key_stops = std::log2(page.middle) + 0.3F * page.stops;
        EXPECT_NEAR(Eye().look_at(page), -key_stops, 0.13F);
        EXPECT_NEAR(Eye().look_at(page, {.compensation_stops = 1.5F}), 1.5F - key_stops, 0.13F);
    }
}

TEST(Exposure, AdaptsAtItsSpeed)
{
    Eye eye;
    const float at_first = eye.look_at({.middle = 1.0F});
    const Metering slow{.most_change_stops = 0.5F};
    EXPECT_NEAR(eye.look_at({.middle = 8.0F}, slow), at_first - 0.5F, 5e-3F);
    EXPECT_NEAR(eye.look_at({.middle = 8.0F}, slow), at_first - 1.0F, 5e-3F);
    EXPECT_NEAR(eye.look_at({.middle = 8.0F}, {.most_change_stops = 9.0F}), at_first - 3.0F, 5e-3F);
    EXPECT_NEAR(eye.look_at({.middle = 1.0F}), at_first, 5e-3F);
}

TEST(Exposure, FurtherSamplesKeepIt)
{
    Eye eye;
    const float at_first = eye.look_at({.middle = 1.0F});
    EXPECT_NEAR(eye.look_at({.middle = 8.0F}, {.adapts = false}), at_first, 2e-3F);
    EXPECT_NEAR(eye.look_at({.middle = 8.0F}), at_first - 3.0F, 5e-3F);
}

} // namespace
} // namespace estampe::light
