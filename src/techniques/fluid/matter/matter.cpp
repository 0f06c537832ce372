// SPDX-License-Identifier: MIT
#include "techniques/fluid/matter/matter.hpp"

#include <cmath>

#include "shaders/fluid_correct_matter_comp.hpp"
#include "shaders/fluid_matter_comp.hpp"

namespace estampe::fluid {
namespace {

struct MatterConstants {
    shared::FluidGrid grid;
    shared::FluidShapes shapes;
    shared::FluidMatter matter;
};

MatterConstants constants_of(const Grid& grid, const MatterStyle& style, const shared::FluidShapes& shapes)
{
    const auto kept = [&](float loss_per_s) { return std::exp(-loss_per_s * shapes.step_s); };
    return {.grid = grid_constants(grid),
            .shapes = shapes,
            .matter = {.density_kept = kept(style.fading_per_s),
                       .heat_kept = kept(style.cooling_per_s),
                       .burnt = 1.0F - kept(style.burning_per_s),
                       .ignition = style.ignition,
                       .heat_of_fuel = style.heat_of_fuel,
                       .smoke_of_fuel = style.smoke_of_fuel,
                       .condensed = 1.0F - kept(style.condensing_per_s),
                       .saturation = style.saturation,
                       .saturation_heat = style.saturation_growth,
                       .saturation_height = style.saturation_fall_per_m,
                       .latent_heat = style.latent_heat,
                       .rim_share = 1.0F - kept(style.rim.share_per_s),
                       .rim_cells = style.rim.breadth_m / grid.cell_m,
                       .outside_vapour = style.outside_vapour}};
}

uint32_t bits_of(const Grid& grid, const MatterStyle& style, uint32_t channels)
{
    const bool is_burning = style.burning_per_s > 0.0F && channels > shared::fluid_fuel;
    const bool is_condensing = style.condensing_per_s > 0.0F && channels > shared::fluid_cloud;
    return grid_bits(grid) | (channels <= uint32_t{shared::fluid_fuel} ? shared::fluid_bit_few : 0U) |
           (is_burning ? shared::fluid_bit_burning : 0U) |
           (is_condensing ? shared::fluid_bit_condensing : 0U);
}

} // namespace

gpu::ImageId add_matter(gpu::Graph& graph, const Grid& grid, const MatterStyle& style, gpu::BufferId shapes,
                        const shared::FluidShapes& constants, gpu::ImageId quantities)
{
    if (style == MatterStyle{} && constants.count == constants.obstacle_count) {
        return quantities;
    }
    auto pass = graph.compute("fluid/matter", shaders::fluid_matter_comp);
    pass.read(shapes);
    const gpu::ImageId changed = pass.modify(quantities);
    pass.push(constants_of(grid, style, constants)).variant(bits_of(grid, style, constants.channels));
    dispatch_over_cells(pass, grid);
    return changed;
}

gpu::ImageId add_corrected_matter(gpu::Graph& graph, const Grid& grid, const MatterStyle& style,
                                  gpu::BufferId shapes, const shared::FluidShapes& constants,
                                  const ThereAndBack& carried, gpu::ImageId target)
{
    auto pass = graph.compute("fluid/correct matter", shaders::fluid_correct_matter_comp);
    pass.read(shapes)
        .sample(carried.ways)
        .sample(carried.field, gpu::Sampling::linear_repeat)
        .sample(carried.advected, gpu::Sampling::linear_repeat);
    const gpu::ImageId quantities = pass.write(target);
    pass.push(constants_of(grid, style, constants)).variant(bits_of(grid, style, constants.channels));
    dispatch_over_cells(pass, grid);
    return quantities;
}

} // namespace estampe::fluid
