// SPDX-License-Identifier: MIT
#pragma once

// Clouds painted for tests.

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "features/clouds/clouds.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/sky/clouds/clouds.hpp"
#include "techniques/sky/sky_test_support.hpp"

namespace estampe::sky {

struct Painted {
    std::vector<float> white; ///< share of a pixel that is cloud, if clouds have one tone
    std::vector<float> ink;
    std::vector<float> cover; ///< if it was requested
};

struct Painting {
    bool by_groups = false;
    bool keeps_cover = false;
};

/// Paints a plan over a black sky.
inline Painted paint(const View& view, const std::optional<CloudPlan>& plan, Painting how = {})
{
    const SkyStyle sky{.horizon = glm::vec3(0.0F), .zenith = glm::vec3(0.0F), .darkness = 0.0F};
    gpu::Device& device = test::shared_device();
    gpu::Buffer frame = gpu::upload_buffer(device, "frame", std::vector{view.globals()});
    features::Clouds clouds;
    clouds.upload(device, plan ? *plan : CloudPlan{.shapes = std::make_shared<CloudShapes>()});
    auto depth = test::Layer::depth(view.size_px, [&](glm::uvec2 pixel) { return view.depth_at(pixel); });
    const auto add = [&](gpu::Graph& graph) {
        const gpu::BufferId frame_id = gpu::import_whole(graph, "frame", frame);
        const Sky bare = add_sky(graph,
                                 {.frame = frame_id,
                                  .depth = depth.in(graph),
                                  .towards_sun = view.towards_sun,
                                  .drawn = true,
                                  .size_px = view.size_px},
                                 sky);
        return plan ? add_clouds(graph,
                                 {.frame = frame_id,
                                  .clouds = clouds.import(graph),
                                  .depth = depth.in(graph),
                                  .variant = plan->variant,
                                  .keeps_cover = how.keeps_cover,
                                  .size_px = view.size_px,
                                  .far_m = view.far_m,
                                  .by_groups = how.by_groups},
                                 bare)
                    : CloudedSky{bare, bare.ink};
    };
    gpu::Graph for_wash;
    gpu::Graph for_ink;
    Painted painted{.ink = test::run_and_read_coverage(for_ink, add(for_ink).sky.ink)};
    for (const glm::vec4& color : test::run_and_read_colors(for_wash, add(for_wash).sky.wash)) {
        painted.white.push_back(color.x);
    }
    if (how.keeps_cover) {
        gpu::Graph for_cover;
        painted.cover = test::run_and_read_coverage(for_cover, add(for_cover).cover);
    }
    return painted;
}

/// White clouds over a black sky, in the light of the view's sun.
inline Painted paint(const View& view, CloudStyle style, double time_s = 0.0, Painting how = {})
{
    style.color = glm::vec3(1.0F);
    CloudMemory memory;
    return paint(view,
                 plan_clouds(style,
                             {.eye_m = view.camera.eye,
                              .time_s = time_s,
                              .towards_sun = view.towards_sun,
                              .pixels_per_mm = view.pixels_per_mm},
                             memory),
                 how);
}

inline double mean(const std::vector<float>& values)
{
    double sum = 0.0;
    for (const float value : values) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(values.size());
}

/// Share of pixels in which two pictures differ by more than a tenth.
inline double differing(const std::vector<float>& a, const std::vector<float>& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        count += std::abs(a[i] - b[i]) > 0.1F ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(a.size());
}

} // namespace estampe::sky
