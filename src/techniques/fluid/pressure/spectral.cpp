// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "gpu/upload.hpp"
#include "shaders/fluid_rows_comp.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {
namespace {

uint32_t log_of(uint32_t power_of_two)
{
    return static_cast<uint32_t>(std::countr_zero(power_of_two));
}

uint32_t log_turn_of(const Grid& grid)
{
    return 2 + log_of(std::max({grid.cells.x, grid.cells.y, grid.cells.z}));
}

uint32_t axis_bit(uint32_t axis)
{
    return axis == 2 ? shared::fluid_bit_along_z : axis == 1 ? shared::fluid_bit_along_y : 0U;
}

class Transform {
public:
    Transform(gpu::Graph& graph, const Grid& grid, gpu::BufferId angles)
        : graph_(graph), grid_(grid), angles_(angles)
    {
    }

    [[nodiscard]] gpu::BufferId add(const char* name, gpu::BufferId numbers, uint32_t axis, uint32_t bits)
    {
        const uint32_t length = grid_.cells[static_cast<int>(axis)];
        const auto pairs = static_cast<uint32_t>(grid_.cell_count() / length / 2);
        // Numbers of eight pairs side by side are 64 bytes in a row; more would leave fewer workgroups.
        constexpr uint32_t most_at_once = 8;
        const uint32_t at_once =
            std::min(std::clamp(shared::fluid_transform_pairs / length, 1U, pairs), most_at_once);
        auto pass = graph_.compute(name, shaders::fluid_rows_comp);
        pass.sample(numbers, gpu::Format::r32f).sample(angles_, gpu::Format::rg32ui);
        const gpu::BufferId out =
            pass.write(graph_.buffer("fluid/waves", {.size_bytes = sizeof(float) * grid_.cell_count()}));
        pass.push(shared::FluidTransform{.width = grid_.cells.x,
                                         .height = grid_.cells.y,
                                         .depth = grid_.cells.z,
                                         .log_length = log_of(length),
                                         .log_pairs = log_of(at_once),
                                         .log_turn = log_turn_of(grid_),
                                         .share = 1.0F / static_cast<float>(length)})
            .variant(grid_bits(grid_) | bits | axis_bit(axis) |
                     (length > shared::fluid_transform_pairs ? shared::fluid_bit_long : 0U))
            .dispatch(pairs / at_once);
        return out;
    }

private:
    gpu::Graph& graph_;
    const Grid& grid_;
    gpu::BufferId angles_;
};

} // namespace

bool is_spectral_possible(const Grid& grid)
{
    return std::has_single_bit(grid.cells.x) && std::has_single_bit(grid.cells.y) &&
           std::has_single_bit(grid.cells.z);
}

gpu::Buffer upload_angles(gpu::Device& device, const Grid& grid)
{
    std::vector<glm::vec2> angles(is_spectral_possible(grid) ? size_t{1} << log_turn_of(grid) : 1);
    for (size_t i = 0; i < angles.size(); ++i) {
        const double turned =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(angles.size());
        angles[i] = glm::vec2(std::cos(turned), std::sin(turned));
    }
    return gpu::upload_buffer(device, "fluid angles", angles);
}

gpu::BufferId add_spectral(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                           gpu::BufferId angles)
{
    Transform transform(graph, grid, angles);
    const uint32_t last = grid.dimensions() - 1;
    gpu::BufferId waves = equation.divergence;
    for (uint32_t axis = 0; axis < last; ++axis) {
        waves = transform.add("fluid/transform", waves, axis, 0);
    }
    waves = transform.add("fluid/divide", waves, last, shared::fluid_bit_dividing);
    for (uint32_t axis = last; axis > 0; --axis) {
        waves = transform.add("fluid/transform back", waves, axis - 1, shared::fluid_bit_reversed);
    }
    return waves;
}

} // namespace estampe::fluid
