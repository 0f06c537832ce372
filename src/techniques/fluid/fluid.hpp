// SPDX-License-Identifier: MIT
#pragma once

// A fluid on a grid: a velocity that has no divergence, moves itself, and carries quantities.

#include <array>
#include <optional>
#include <span>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/motion/advection.hpp"
#include "techniques/fluid/motion/forces.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

enum class Stepping : uint8_t {
    project, ///< carry, force, project
    reflect  ///< the same in halves, with the velocity reflected between them: second order, twice the price
};

/// All of it may change from step to step.
struct FluidStyle {
    float step_s = 1.0F / 120.0F;
    Stepping stepping = Stepping::reflect;
    Advection velocity_advection = Advection::maccormack;
    Advection quantity_advection = Advection::maccormack;
    ProjectionStyle projection;
    float viscosity_m2_s = 0.0F;
    ForceStyle forces;
};

/// Handles to what a graph's steps leave.
struct FluidFields {
    gpu::ImageId velocity; ///< metres a second; layer i * depth + z holds component i, on faces
    std::optional<gpu::ImageId> quantities =
        {}; ///< layer i * depth + z holds channel i, in the middle of cells
};

/// The same start, style and steps give the same fields on the same device, bit for bit.
class Fluid {
public:
    /// `velocity` and `quantities` are laid out as FluidFields says, row by row in each layer; empty ones are
    /// zeros. Throws std::logic_error for what is no grid, and for a start of another size.
    Fluid(gpu::Device& device, const Grid& grid, uint32_t channels = 0, std::span<const float> velocity = {},
          std::span<const float> quantities = {});

    /// Adds so many steps. Once a graph; each step takes between 10 and 100 passes of the 256 that a graph
    /// has.
    [[nodiscard]] FluidFields add_steps(gpu::Graph& graph, const FluidStyle& style, uint32_t count);

    [[nodiscard]] const Grid& grid() const { return grid_; }

    [[nodiscard]] uint32_t channels() const { return channels_; }

private:
    struct Handles;

    void add_step(gpu::Graph& graph, const FluidStyle& style, Handles& handles);

    Grid grid_;
    uint32_t channels_;
    gpu::Image velocity_;
    std::array<gpu::Image, 2> quantities_; ///< by turns, none without channels
    uint32_t newest_quantities_ = 0;
    gpu::Buffer solids_;
    gpu::Buffer angles_;
};

} // namespace estampe::fluid
