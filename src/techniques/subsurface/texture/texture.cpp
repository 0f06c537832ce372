// SPDX-License-Identifier: MIT
#include "techniques/subsurface/texture/texture.hpp"

#include <cmath>

#include "shaders/texture_blur_comp.hpp"
#include "shaders/texture_page_comp.hpp"
#include "shaders/texture_source_comp.hpp"
#include "shaders/texture_surface_comp.hpp"

namespace estampe::subsurface {
namespace {

/// The d of the profile, in texels, whose tail the widest of so many blurs holds.
float most_spread_tx(uint32_t levels)
{
    return 0.25F * static_cast<float>(std::sqrt((std::exp2(2.0 * levels) - 1.0) / 3.0));
}

uint32_t levels_for(float spread_tx)
{
    uint32_t levels = 1;
    while (levels < shared::most_texture_levels && most_spread_tx(levels) < spread_tx) {
        ++levels;
    }
    return levels;
}

shared::TextureConstants texture_constants(const TextureInputs& in)
{
    return {
        .size = in.size, .most_tx = most_spread_tx(levels_for(in.most_spread_tx)), .level = 0, .is_last = 0U};
}

gpu::ImageId map_image(gpu::Graph& graph, const TextureInputs& in, const char* name, gpu::Format format)
{
    return graph.image(name, {.width = in.size, .height = in.size, .format = format});
}

} // namespace

TextureSurface add_texture_surface(gpu::Graph& graph, const TextureInputs& in)
{
    auto pass = graph.compute("subsurface/texels", shaders::texture_surface_comp);
    pass.sample(in.map_texels).sample(in.map_corners, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices).sample(in.draws).sample(in.materials);
    const gpu::ImageId draw = pass.write(map_image(graph, in, "subsurface/map draw", gpu::Format::r32ui));
    const gpu::ImageId normal =
        pass.write(map_image(graph, in, "subsurface/map normal", gpu::Format::rg32ui));
    const gpu::ImageId points = pass.write(map_image(graph, in, "subsurface/points", gpu::Format::rgba32f));
    pass.push(texture_constants(in)).dispatch_over(in.size, in.size);
    return {draw, normal, points};
}

TextureLight add_texture_scatter(gpu::Graph& graph, const TextureInputs& in, const TextureSurface& surface,
                                 gpu::ImageId light)
{
    shared::TextureConstants constants = texture_constants(in);
    const uint32_t levels = levels_for(in.most_spread_tx);
    const auto image = [&](const char* name) { return map_image(graph, in, name, gpu::Format::rgba32f); };
    auto source = graph.compute("subsurface/map source", shaders::texture_source_comp);
    source.sample(surface.draw).sample(surface.points).sample(light);
    source.sample(in.looks, gpu::Format::rgba32f);
    source.sample(in.look_of_draw.value_or(in.looks), gpu::Format::r32ui);
    source.variant(in.look_of_draw ? shared::subsurface_has_looks : 0U);
    gpu::ImageId blurred = source.write(image("subsurface/map light"));
    const gpu::ImageId spread = source.write(image("subsurface/map spread"));
    gpu::ImageId sum = source.write(image("subsurface/map sum"));
    source.push(constants).dispatch_over(in.size, in.size);
    for (uint32_t level = 0; level < levels; ++level) {
        constants.level = static_cast<int>(level);
        constants.is_last = level + 1 == levels ? 1U : 0U;
        for (const bool is_upright : {false, true}) {
            auto pass = graph.compute(is_upright ? "subsurface/map columns" : "subsurface/map rows",
                                      shaders::texture_blur_comp);
            pass.sample(spread).sample(surface.points).sample(blurred).sample(sum);
            pass.variant(is_upright ? shared::subsurface_is_upright : 0U);
            blurred = pass.write(image("subsurface/map blurred"));
            const gpu::ImageId next_sum = pass.write(
                is_upright ? image("subsurface/map sum")
                           : graph.image("subsurface/no map sum",
                                         {.width = 1, .height = 1, .format = gpu::Format::rgba32f}));
            pass.push(constants).dispatch_over(in.size, in.size);
            sum = is_upright ? next_sum : sum;
        }
    }
    return {spread, sum};
}

gpu::ImageId add_texture_page(gpu::Graph& graph, const TextureInputs& in, const TextureLight& spread,
                              gpu::BufferId frame, gpu::BufferId visibility, gpu::ImageId light,
                              glm::uvec2 size_px)
{
    auto pass = graph.compute("subsurface/map page", shaders::texture_page_comp);
    pass.uniform(frame).sample(visibility, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices).sample(in.map_corners, gpu::Format::rg32ui);
    pass.sample(spread.spread).sample(spread.sum);
    const gpu::ImageId result = pass.modify(light);
    pass.push(texture_constants(in)).dispatch_over(size_px.x, size_px.y);
    return result;
}

} // namespace estampe::subsurface
