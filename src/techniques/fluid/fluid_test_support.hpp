// SPDX-License-Identifier: MIT
#pragma once

// Fields for tests to start from and to read back: double precision, sampled at the grid's nodes.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "support/gpu_device.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::fluid {

/// Velocity as a function of the place in metres.
using Flow = std::function<glm::dvec3(glm::dvec3)>;

[[nodiscard]] inline glm::dvec3 place_of(const Grid& grid, uint32_t component, glm::uvec3 cell)
{
    glm::dvec3 place = glm::dvec3(cell) + 0.5;
    if (component < 3) {
        place[static_cast<int>(component)] -= 0.5;
    }
    return place * static_cast<double>(grid.cell_m);
}

template <class Value>
[[nodiscard]] std::vector<float> over_nodes(const Grid& grid, uint32_t channels, Value value)
{
    std::vector<float> numbers;
    for (uint32_t i = 0; i < channels; ++i) {
        for (uint32_t k = 0; k < grid.cell_count(); ++k) {
            const glm::uvec3 cell(k % grid.cells.x, k / grid.cells.x % grid.cells.y,
                                  k / (grid.cells.x * grid.cells.y));
            numbers.push_back(static_cast<float>(value(i, cell)));
        }
    }
    return numbers;
}

/// Square root of the sum of squares.
template <class Number>
[[nodiscard]] double norm(const std::vector<Number>& numbers)
{
    double sum = 0.0;
    for (const Number number : numbers) {
        sum += static_cast<double>(number) * static_cast<double>(number);
    }
    return std::sqrt(sum);
}

/// Samples `flow` on the faces of the grid.
[[nodiscard]] inline std::vector<float> velocity_of(const Grid& grid, const Flow& flow)
{
    return over_nodes(grid, grid.dimensions(), [&](uint32_t component, glm::uvec3 cell) {
        return flow(place_of(grid, component, cell))[static_cast<int>(component)];
    });
}

/// Runs `graph`, and returns all layers of an image that the graph makes, one after another.
[[nodiscard]] inline std::vector<float> run_and_read_layers(gpu::Graph& graph, gpu::ImageId image)
{
    return test::run_and_read_as<float>(graph, add_layers_copy(graph, image));
}

/// The velocity after `count` more steps, at most `at_once` per graph.
[[nodiscard]] inline std::vector<float> velocity_after(Fluid& fluid, const FluidStyle& style, uint32_t count,
                                                       uint32_t at_once = UINT32_MAX)
{
    for (uint32_t left = count;;) {
        const uint32_t now = std::min({left, at_once, fluid.most_steps(style)});
        left -= now;
        gpu::Graph graph;
        const FluidFields fields = fluid.add_steps(graph, style, now);
        if (left == 0) {
            return run_and_read_layers(graph, fields.velocity);
        }
        static_cast<void>(test::run_and_read(graph, add_layers_copy(graph, fields.velocity)));
    }
}

} // namespace estampe::fluid
