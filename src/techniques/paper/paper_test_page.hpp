// SPDX-License-Identifier: MIT
#pragma once

// A page of layers that tests paint, and its composition on paper.

#include <optional>
#include <vector>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/paper/paper.hpp"

namespace estampe::paper {

/// The layers of a page; each is blank until a test paints it.
struct Layers {
    test::Painter<glm::vec4> wash = [](glm::uvec2) { return glm::vec4(1.0F); };
    test::Painter<float> hatch = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> lines = [](glm::uvec2) { return glm::vec4(0.0F); };
    test::Painter<float> sky_ink = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> light = [](glm::uvec2) { return glm::vec4(1.0F); };
    glm::uvec2 sky_size_px{1};
    bool has_sky = true;
};

/// Calls `add` with a graph and inputs, and returns the composed layers.
template <class Add>
auto made_of(const Layers& layers, glm::uvec2 size_px, float pixels_per_mm, const Add& add)
{
    const double height_mm = size_px.y / static_cast<double>(pixels_per_mm);
    const auto globals =
        features::frame_globals({}, {}, glm::dvec3(0.0), {.size_px = size_px, .page_height_mm = height_mm});
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    auto wash = test::Layer::color(size_px, layers.wash);
    auto hatch = test::Layer::coverage(size_px, layers.hatch);
    auto lines = test::Layer::root_color(size_px, layers.lines);
    auto sky_ink = test::Layer::coverage(layers.sky_size_px, layers.sky_ink);
    auto light = test::Layer::color(size_px, layers.light);
    gpu::Graph graph;
    const ComposeInputs inputs{.frame = gpu::import_whole(graph, "frame", frame),
                               .wash = wash.in(graph),
                               .hatch = hatch.in(graph),
                               .lines = lines.in(graph),
                               .sky_ink = sky_ink.in(graph),
                               .has_sky = layers.has_sky,
                               .light = light.in(graph),
                               .page_px = size_px,
                               .size_px = size_px};
    return add(graph, inputs);
}

/// Returns the whole picture, or the picture composed up to a stage.
inline std::vector<glm::vec4> compose(const Layers& layers, const PaperStyle& style, glm::uvec2 size_px,
                                      float pixels_per_mm = 3.0F, std::optional<Stage> stage = std::nullopt)
{
    return made_of(layers, size_px, pixels_per_mm, [&](gpu::Graph& graph, const ComposeInputs& inputs) {
        return stage
                   ? test::run_and_read_as<glm::vec4>(graph, add_compose_stage(graph, inputs, style, *stage))
                   : test::run_and_read_colors(graph, add_compose(graph, inputs, style));
    });
}

} // namespace estampe::paper
