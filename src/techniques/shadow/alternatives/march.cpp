// SPDX-License-Identifier: MIT
#include "techniques/shadow/alternatives/march.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shaders/height_march_comp.hpp"
#include "shaders/height_soften_comp.hpp"
#include "techniques/shadow/alternatives/march.glsl.h"

namespace estampe::shadow {

gpu::ImageId add_march(gpu::Graph& graph, const HeightShadowInputs& in, const HeightFields& fields,
                       const HeightShadowStyle& style)
{
    if (fields.count > 1) {
        throw std::logic_error("a march over heights takes one field at a time");
    }
    constexpr float deviations_taken_in = 2.5F;
    const float deviation = style.march_blur_texels;
    const shared::MarchConstants march{
        .size = fields.size,
        .sunwards = glm::vec2(fields.sunwards),
        .rise_m =
            in.texel_m.front() * std::min(static_cast<float>(std::tan(fields.elevation_rad)), steepest_slope),
        .step_count = static_cast<uint32_t>(style.march_steps),
        .blur_radius = static_cast<uint32_t>(std::ceil(deviations_taken_in * deviation)),
        .blur_falloff = deviation > 0.0F ? 0.5F / (deviation * deviation) : 0.0F};
    auto pass = graph.compute("height shadow/march", shaders::height_march_comp);
    pass.sample(in.height, gpu::Sampling::linear);
    gpu::ImageId result = pass.write(height_result(graph, "height shadow/hard", fields));
    pass.push(march).dispatch_over(fields.size.x, fields.size.y);
    for (uint32_t side = 0; side < 2 && march.blur_radius > 0; ++side) {
        auto blur = graph.compute("height shadow/soften", shaders::height_soften_comp);
        blur.sample(result);
        result = blur.write(height_result(graph, "height shadow", fields));
        blur.variant(side);
        blur.push(march).dispatch_over(fields.size.x, fields.size.y);
    }
    return result;
}

} // namespace estampe::shadow
