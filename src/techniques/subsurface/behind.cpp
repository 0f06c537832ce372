// SPDX-License-Identifier: MIT
#include "techniques/subsurface/behind.hpp"

#include <algorithm>

#include "shaders/behind_halve_comp.hpp"
#include "shaders/behind_inside_comp.hpp"
#include "shaders/behind_lay_comp.hpp"

namespace estampe::subsurface {
namespace {

/// The background, and itself in halves, quarters and so on.
std::vector<gpu::ImageId> add_halves(gpu::Graph& graph, const BehindInputs& in)
{
    std::vector<gpu::ImageId> levels{in.painted};
    glm::uvec2 size_px = in.common.size_px;
    for (size_t i = 1; i < shared::behind_levels; ++i) {
        size_px = glm::max((size_px + 1U) / 2U, glm::uvec2(1));
        auto pass = graph.compute("subsurface/halve", shaders::behind_halve_comp);
        pass.sample(levels.back());
        levels.push_back(pass.write(graph.image(
            "subsurface/halves", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba16f})));
        pass.dispatch_over(size_px.x, size_px.y);
    }
    return levels;
}

} // namespace

gpu::ImageId add_behind(gpu::Graph& graph, const BehindInputs& in, gpu::ImageId wash)
{
    const SubsurfaceInputs& common = in.common;
    auto inside = graph.compute("subsurface/clear", shaders::behind_inside_comp);
    inside.uniform(common.frame).sample(common.draw);
    inside.sample(common.looks, gpu::Format::rgba32f);
    inside.sample(common.look_of_draw.value_or(common.looks), gpu::Format::r32ui);
    inside.sample(in.triangles).sample(in.posed_vertices);
    inside.sample(in.background, gpu::Format::rg32ui);
    for (size_t i = 0; i < inside_layers; ++i) {
        inside.sample(in.inside[std::min(i, in.inside.size() - 1)], gpu::Format::rg32ui);
    }
    inside.sample(in.color);
    const gpu::ImageId clear = inside.write(
        graph.image("subsurface/clear",
                    {.width = common.size_px.x, .height = common.size_px.y, .format = gpu::Format::rgba32f}));
    const gpu::ImageId share = inside.write(
        graph.image("subsurface/share",
                    {.width = common.size_px.x, .height = common.size_px.y, .format = gpu::Format::r16f}));
    inside.variant(common.look_of_draw ? shared::subsurface_has_looks : 0U);
    inside.dispatch_over(common.size_px.x, common.size_px.y);

    const std::vector<gpu::ImageId> levels = add_halves(graph, in);
    auto lay = graph.compute("subsurface/behind", shaders::behind_lay_comp);
    lay.sample(clear).sample(share);
    for (const gpu::ImageId level : levels) {
        lay.sample(level, gpu::Sampling::linear);
    }
    const gpu::ImageId laid = lay.modify(wash);
    lay.push(common.reach_mm * common.pixels_per_mm / 3.0F);
    lay.dispatch_over(common.size_px.x, common.size_px.y);
    return laid;
}

} // namespace estampe::subsurface
