// SPDX-License-Identifier: MIT
#include "techniques/screen/screen.hpp"

#include <algorithm>

#include "shaders/no_screen_comp.hpp"
#include "shaders/screen_comp.hpp"

namespace estampe::screen {
namespace {

Screen write_screen(gpu::Graph& graph, gpu::Pass& pass, glm::uvec2 size_px)
{
    const gpu::ImageId draw = pass.write(
        graph.image("screen/draw", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r32ui}));
    const gpu::ImageId color = pass.write(
        graph.image("screen/color", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba8}));
    return {draw, color};
}

} // namespace

Screen add_screen(gpu::Graph& graph, const ScreenInputs& in)
{
    auto pass = graph.compute("screen", shaders::screen_comp);
    pass.uniform(in.frame).read(in.solid_visibility).sample(in.triangles).sample(in.posed_vertices);
    pass.sample(in.draws).read(in.rest_vertices).sample(in.materials);
    for (const gpu::ImageId texture : in.textures) {
        pass.sample(texture, gpu::Sampling::linear_repeat);
    }
    for (size_t i = 0; i < most_layers; ++i) {
        pass.read(in.layers[std::min(i, in.layers.size() - 1)]);
    }
    const Screen screen = write_screen(graph, pass, in.size_px);
    pass.variant(in.texture_classes | static_cast<uint32_t>(in.layers.size() - 1) << 5U);
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return screen;
}

Screen add_no_screen(gpu::Graph& graph)
{
    auto pass = graph.compute("screen/none", shaders::no_screen_comp);
    const Screen screen = write_screen(graph, pass, glm::uvec2(1));
    pass.dispatch(1);
    return screen;
}

} // namespace estampe::screen
