// SPDX-License-Identifier: MIT
#include "techniques/raster/passes.hpp"

#include "shaders/fill_comp.hpp"
#include "techniques/raster/raster.glsl.h"

namespace estampe::raster {

gpu::BufferId add_clear(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId buffer)
{
    struct {
        uint32_t value;
        uint32_t quad_count;
    } constants{0, static_cast<uint32_t>(graph.describe(buffer).size_bytes / 16)};

    auto pass = graph.compute(name + "/clear", shaders::fill_comp);
    const gpu::BufferId cleared = pass.write(buffer);
    pass.push(constants).dispatch_items((constants.quad_count + 255) / 256 * 64);
    return cleared;
}

void bind_masks(gpu::Pass& pass, const RasterInputs& in)
{
    pass.sample(in.draws).read(in.rest_vertices).sample(in.materials);
    for (const gpu::ImageId texture : in.textures) {
        pass.sample(texture, gpu::Sampling::linear_repeat);
    }
}

uint32_t second_bits(const View& view)
{
    return view.second_from ? shared::draws_second | view.second_from->x << 1U | view.second_from->y << 2U
                            : 0U;
}

uint32_t mask_variant(const RasterInputs& in, const Batch& batch, const View& view)
{
    if (batch.masked) {
        return in.texture_classes;
    }
    return view.behind ? shared::draw_has_no_masks : 0U;
}

} // namespace estampe::raster
