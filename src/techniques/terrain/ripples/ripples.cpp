// SPDX-License-Identifier: MIT
#include "techniques/terrain/ripples/ripples.hpp"

#include <cmath>

#include "shaders/ripples_comp.hpp"
#include "style/wind.hpp"
#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

std::optional<shared::RippleConstants> ripples_at(const TerrainDescription& terrain, uint32_t draw,
                                                  const glm::dvec3& anchor_m, double time_s)
{
    const TerrainRipples& ripples = terrain.ripples;
    if (ripples.height_m <= 0.0F) {
        return std::nullopt;
    }
    const double direction_rad =
        glm::radians(static_cast<double>(wind::from_x_deg(terrain.wind.towards_deg)));
    const glm::dvec2 wind(std::cos(direction_rad), std::sin(direction_rad));
    const glm::dvec2 place(anchor_m.x, anchor_m.z);
    const double along_m = glm::dot(place, wind) - static_cast<double>(ripples.drift_m_per_s) * time_s;
    const double across_m = wind.x * place.y - wind.y * place.x;
    const glm::dvec2 cell_m = static_cast<double>(ripples.wavelength_m) *
                              glm::dvec2(shared::ripple_cell_along, shared::ripple_cell_across);
    const glm::dvec2 at = glm::dvec2(along_m, across_m) / cell_m;
    const glm::dvec2 whole = glm::floor(at);
    return shared::RippleConstants{.wind = glm::vec2(wind),
                                   .rest = glm::vec2(at - whole),
                                   .cell = {wrapped_cells(whole.x), wrapped_cells(whole.y)},
                                   .wavelength_m = ripples.wavelength_m,
                                   .height_m = ripples.height_m,
                                   .meander = ripples.meander,
                                   .draw = draw};
}

gpu::ImageId add_ripples(gpu::Graph& graph, const RippleInputs& in, const shared::RippleConstants& ripples)
{
    auto pass = graph.compute("ripples", shaders::ripples_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth);
    const gpu::ImageId bent = pass.modify(in.normal);
    pass.push(ripples).dispatch_over(in.size_px.x, in.size_px.y);
    return bent;
}

} // namespace estampe::terrain
