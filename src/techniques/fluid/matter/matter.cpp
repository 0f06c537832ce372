// SPDX-License-Identifier: MIT
#include "techniques/fluid/matter/matter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gpu/resources.hpp"
#include "shaders/fluid_correct_matter_comp.hpp"
#include "shaders/fluid_matter_comp.hpp"
#include "shaders/fluid_push_comp.hpp"
#include "shaders/fluid_solids_comp.hpp"

namespace estampe::fluid {
namespace {

shared::FluidShape as_shared(const Shape& shape)
{
    return {.centre_m = shape.centre_m,
            .radius_m = shape.radius_m,
            .half_m = shape.half_m,
            .angle_rad = shape.angle_rad,
            .speed = shape.velocity_m_per_s,
            .spin = shape.spin_rad_s};
}

shared::FluidShape as_shared(const Source& source)
{
    shared::FluidShape shape = as_shared(source.shape);
    shape.push = source.push_per_s;
    shape.least_density = source.least_density;
    shape.least_vapour = source.least_vapour;
    for (int i = 0; i < 4; ++i) {
        shape.gain[i] = source.gain_per_s[static_cast<size_t>(i)];
        shape.more_gain[i] = source.gain_per_s[static_cast<size_t>(i) + 4];
    }
    return shape;
}

} // namespace

Shape disc(glm::vec3 centre_m, float radius_m)
{
    return {.centre_m = centre_m, .radius_m = radius_m};
}

Shape box(glm::vec3 centre_m, glm::vec3 half_m, float angle_rad)
{
    return {.centre_m = centre_m, .half_m = half_m, .angle_rad = angle_rad};
}

Shape capsule(glm::vec3 centre_m, float length_m, float radius_m, float angle_rad)
{
    return {.centre_m = centre_m,
            .half_m = {0.5F * length_m, 0.0F, 0.0F},
            .radius_m = radius_m,
            .angle_rad = angle_rad};
}

Shapes::Shapes(gpu::Device& device)
    : buffer_(device, "fluid shapes", sizeof(shared::FluidShape) * shared::fluid_most_shapes,
              gpu::MemoryUse::upload)
{
}

void Shapes::set(std::span<const Shape> obstacles, std::span<const Source> sources)
{
    if (obstacles.size() + sources.size() > shared::fluid_most_shapes) {
        throw std::logic_error("a fluid has at most 64 obstacles and sources");
    }
    shapes_.clear();
    for (const Shape& obstacle : obstacles) {
        shapes_.push_back(as_shared(obstacle));
    }
    for (const Source& source : sources) {
        shapes_.push_back(as_shared(source));
    }
    obstacle_count_ = static_cast<uint32_t>(obstacles.size());
}

bool Shapes::are_pushing() const
{
    return std::ranges::any_of(std::span(shapes_).subspan(obstacle_count_),
                               [](const shared::FluidShape& source) { return source.push != 0.0F; });
}

void Shapes::advance(float time_s)
{
    for (shared::FluidShape& shape : shapes_) {
        shape.centre_m += time_s * shape.speed;
        shape.angle_rad += time_s * shape.spin;
    }
}

gpu::BufferId Shapes::upload(gpu::Graph& graph)
{
    std::ranges::copy(std::as_bytes(std::span(shapes_)), buffer_.mapped().begin());
    return gpu::import_whole(graph, "fluid/shapes", buffer_);
}

shared::FluidShapes Shapes::constants(const Grid& grid, float age_s, float step_s, uint32_t channels) const
{
    return {.cell_m = grid.cell_m,
            .age_s = age_s,
            .step_s = step_s,
            .obstacle_count = obstacle_count_,
            .count = static_cast<uint32_t>(shapes_.size()),
            .channels = channels};
}

Solids add_solids(gpu::Graph& graph, const Grid& grid, gpu::BufferId shapes,
                  const shared::FluidShapes& constants, gpu::BufferId standing, gpu::BufferId cells)
{
    const bool are_standing = graph.describe(standing).size_bytes >= sizeof(uint32_t) * grid.cell_count();
    auto pass = graph.compute("fluid/solids", shaders::fluid_solids_comp);
    pass.read(shapes).sample(standing, gpu::Format::r32ui);
    const Solids solids{.cells = pass.write(cells), .are_any = true};
    pass.push(WithGrid<shared::FluidShapes>{grid_constants(grid), constants})
        .variant(grid_bits(grid) | (are_standing ? shared::fluid_bit_standing : 0U));
    dispatch_over_cells(pass, grid);
    return solids;
}

gpu::ImageId add_push(gpu::Graph& graph, const Grid& grid, gpu::BufferId shapes,
                      const shared::FluidShapes& constants, const Solids& solids, gpu::ImageId velocity)
{
    auto pass = graph.compute("fluid/push", shaders::fluid_push_comp);
    pass.read(shapes).sample(solids.cells, gpu::Format::r32ui);
    const gpu::ImageId pushed = pass.modify(velocity);
    pass.push(WithGrid<shared::FluidShapes>{grid_constants(grid), constants})
        .variant(grid_bits(grid) | (solids.are_any ? shared::fluid_bit_solids : 0U));
    dispatch_over_cells(pass, grid);
    return pushed;
}

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
                       .outside_vapour = style.outside_vapour,
                       .expands_above = style.expands_above,
                       .excess_kept = kept(style.expansion_per_s)}};
}

uint32_t bits_of(const Grid& grid, const MatterStyle& style, uint32_t channels)
{
    const bool is_burning = style.burning_per_s > 0.0F && channels > shared::fluid_fuel;
    const bool is_condensing = style.condensing_per_s > 0.0F && channels > shared::fluid_cloud;
    return grid_bits(grid) | (channels <= uint32_t{shared::fluid_fuel} ? shared::fluid_bit_few : 0U) |
           (is_burning ? shared::fluid_bit_burning : 0U) |
           (is_expanding(style, channels) ? shared::fluid_bit_expanding : 0U) |
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
