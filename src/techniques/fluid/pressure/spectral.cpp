// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "gpu/upload.hpp"
#include "shaders/fluid_columns_comp.hpp"
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
    return 2 + log_of(std::max(grid.cells.x, grid.cells.y));
}

class Transform {
public:
    Transform(gpu::Graph& graph, const Grid& grid, gpu::BufferId angles)
        : graph_(graph), grid_(grid), angles_(angles)
    {
    }

    [[nodiscard]] gpu::BufferId add(const char* name, const gpu::Shader& shader, gpu::BufferId numbers,
                                    uint32_t axis, uint32_t bits)
    {
        const uint32_t length = grid_.cells[static_cast<int>(axis)];
        const uint32_t pairs = grid_.cells[1 - static_cast<int>(axis)] / 2;
        const uint32_t at_once = std::clamp(shared::fluid_transform_pairs / length, 1U, pairs);
        auto pass = graph_.compute(name, shader);
        pass.sample(numbers, gpu::Format::r32f).sample(angles_, gpu::Format::rg32ui);
        const gpu::BufferId out =
            pass.write(graph_.buffer("fluid/waves", {.size_bytes = sizeof(float) * grid_.cell_count()}));
        pass.push(shared::FluidTransform{.width = grid_.cells.x,
                                         .height = grid_.cells.y,
                                         .log_length = log_of(length),
                                         .log_pairs = log_of(at_once),
                                         .log_turn = log_turn_of(grid_),
                                         .share = 1.0F / static_cast<float>(length)})
            .variant(grid_bits(grid_) | bits |
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
    return !grid.is_volume() && std::has_single_bit(grid.cells.x) && std::has_single_bit(grid.cells.y);
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
    const gpu::BufferId rows =
        transform.add("fluid/rows", shaders::fluid_rows_comp, equation.divergence, 0, 0);
    const gpu::BufferId waves = transform.add("fluid/columns", shaders::fluid_columns_comp, rows, 1, 0);
    return transform.add("fluid/rows back", shaders::fluid_rows_comp, waves, 0, shared::fluid_bit_reversed);
}

} // namespace estampe::fluid
