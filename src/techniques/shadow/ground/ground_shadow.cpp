// SPDX-License-Identifier: MIT
#include "techniques/shadow/ground/ground_shadow.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/ground_keep_comp.hpp"
#include "shaders/ground_share_comp.hpp"
#include "techniques/shadow/heightfield/height_shadow.hpp"

namespace estampe::shadow {

GroundLevels ground_levels_about(const glm::dvec2& eye_m, const glm::dvec2& anchor_m,
                                 const glm::dvec3& towards_sun, uint32_t size, double texel_m)
{
    const glm::dvec2 level_sun(towards_sun.x, towards_sun.z);
    const double length = glm::length(level_sun);
    const glm::dvec2 sunwards = length > 1e-9 ? level_sun / length : glm::dvec2(0.0);
    GroundLevels levels;
    for (uint32_t i = 0; i < levels.size(); ++i) {
        const double own_texel_m = texel_m * std::pow(4.0, i);
        const double extent_m = own_texel_m * size;
        const double step_m = 16.0 * own_texel_m;
        const glm::dvec2 middle = eye_m + 0.25 * extent_m * sunwards;
        const glm::dvec2 corner = step_m * glm::floor((middle - 0.5 * extent_m) / step_m);
        levels[i] = {.origin_m = glm::vec2(corner - anchor_m), .texel_m = static_cast<float>(own_texel_m)};
    }
    return levels;
}

gpu::BufferId add_ground_fields(gpu::Graph& graph, const GroundFields& fields, const glm::dvec3& towards_sun,
                                gpu::BufferId kept)
{
    FieldTexels texel_m;
    for (const uint32_t number : fields.numbers) {
        texel_m.push_back(fields.levels[number].texel_m);
    }
    const gpu::ImageId horizon =
        add_height_horizon(graph, {.height = fields.height, .texel_m = texel_m, .towards_sun = towards_sun},
                           {.method = fields.method});
    auto pass = graph.compute("ground/keep", shaders::ground_keep_comp);
    pass.sample(fields.height).sample(horizon);
    const gpu::BufferId result = pass.modify(kept);
    shared::GroundKeepConstants constants{.size = fields.size};
    std::ranges::copy(fields.numbers, constants.level);
    pass.push(constants).dispatch_over(fields.size, fields.size,
                                       static_cast<uint32_t>(fields.numbers.size()));
    return result;
}

gpu::ImageId add_ground_share(gpu::Graph& graph, const GroundShareInputs& in)
{
    shared::GroundShareConstants constants{.towards_sun = glm::vec3(in.towards_sun),
                                           .radius_rad = std::max(in.sun_radius_rad, 1e-4F),
                                           .size = in.size};
    std::ranges::copy(in.levels, constants.levels);
    auto pass = graph.compute("ground/share", shaders::ground_share_comp);
    pass.uniform(in.frame).sample(in.depth).sample(in.kept, gpu::Format::r32ui);
    const gpu::ImageId share = pass.write(graph.image(
        "ground/share", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return share;
}

} // namespace estampe::shadow
