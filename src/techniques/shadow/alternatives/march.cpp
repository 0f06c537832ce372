// SPDX-License-Identifier: MIT
#include "techniques/shadow/alternatives/march.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/height_march_comp.hpp"
#include "shaders/height_soften_comp.hpp"
#include "techniques/shadow/alternatives/march.glsl.h"

namespace estampe::shadow {

namespace {

shared::MarchConstants march_constants(const HeightShadowInputs& in, const HeightFields& fields,
                                       const HeightShadowStyle& style)
{
    shared::MarchConstants march{
        .size = fields.size,
        .sunwards = glm::vec2(fields.sunwards),
        .rise = std::min(static_cast<float>(std::tan(fields.elevation_rad)), steepest_slope),
        .step_count = style.march_steps,
        .field_count = fields.count};
    for (uint32_t i = 0; i < fields.count; ++i) {
        march.texel_m[i] = in.texel_m[i];
        march.blur_texels[i] = style.blur_m / in.texel_m[i];
    }
    return march;
}

} // namespace

gpu::ImageId add_march(gpu::Graph& graph, const HeightShadowInputs& in, const HeightFields& fields,
                       const HeightShadowStyle& style)
{
    auto pass = graph.compute("height shadow/march", shaders::height_march_comp);
    pass.sample(in.height, gpu::Sampling::linear);
    const gpu::ImageId hard = pass.write(height_result(graph, "height shadow/hard", fields));
    pass.push(march_constants(in, fields, style)).dispatch_over(fields.size.x, fields.size.y, fields.count);
    return add_blur(graph, in, fields, style, hard);
}

gpu::ImageId add_blur(gpu::Graph& graph, const HeightShadowInputs& in, const HeightFields& fields,
                      const HeightShadowStyle& style, gpu::ImageId shares)
{
    for (uint32_t side = 0; side < 2 && style.blur_m > 0.0F; ++side) {
        auto blur = graph.compute("height shadow/soften", shaders::height_soften_comp);
        blur.sample(shares);
        shares = blur.write(height_result(graph, "height shadow", fields));
        blur.variant(side);
        blur.push(march_constants(in, fields, style))
            .dispatch_over(fields.size.x, fields.size.y, fields.count);
    }
    return shares;
}

} // namespace estampe::shadow
