// SPDX-License-Identifier: MIT
#include "techniques/lens/alternatives/blurs.hpp"

#include "shaders/lens_across_comp.hpp"
#include "shaders/lens_levels_comp.hpp"

namespace estampe::lens {
namespace {

gpu::ImageId blurred_page(gpu::Graph& graph, const char* name, const shared::LensConstants& lens)
{
    return graph.image(name,
                       {.width = lens.size_px.x, .height = lens.size_px.y, .format = gpu::Format::rgba32ui});
}

} // namespace

gpu::ImageId add_separable(gpu::Graph& graph, gpu::ImageId page, const shared::LensConstants& lens)
{
    gpu::ImageId blurred = page;
    for (const uint32_t direction : {0U, shared::lens_is_down}) {
        auto pass = graph.compute("lens/across", shaders::lens_across_comp);
        pass.sample(blurred);
        blurred = pass.write(blurred_page(graph, "lens/across", lens));
        pass.variant(direction).push(lens).dispatch_over(lens.size_px.x, lens.size_px.y);
    }
    return blurred;
}

gpu::ImageId add_looked_up(gpu::Graph& graph, gpu::ImageId page, gpu::ImageId levels, bool is_sum,
                           const shared::LensConstants& lens)
{
    auto pass = graph.compute("lens/levels", shaders::lens_levels_comp);
    pass.sample(page).sample(levels);
    const gpu::ImageId blurred = pass.write(blurred_page(graph, "lens/blurred", lens));
    pass.variant(is_sum ? shared::lens_is_sum : 0U).push(lens).dispatch_over(lens.size_px.x, lens.size_px.y);
    return blurred;
}

} // namespace estampe::lens
