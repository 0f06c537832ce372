// SPDX-License-Identifier: MIT
#pragma once

// A fluid on a grid: a velocity that has no divergence, moves itself, and carries quantities.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/matter/matter.hpp"
#include "techniques/fluid/motion/motion.hpp"
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
    Advection velocity_advection = Advection::automatic;
    Advection quantity_advection = Advection::automatic;
    ProjectionStyle projection;
    float viscosity_m2_s = 0.0F;
    ForceStyle forces;
    MatterStyle matter;
};

/// Handles to what a graph's steps leave.
struct FluidFields {
    gpu::ImageId velocity;    ///< metres a second; layer i * depth + z holds component i, on faces
    gpu::ImageId unprojected; ///< what the last projection was given, to measure what it left by
    Solids solids;
    /// Layer i * depth + z holds channel i, in the middle of cells.
    std::optional<gpu::ImageId> quantities = {};
};

/// The same start, style and steps give the same fields on the same device, bit for bit.
class Fluid {
public:
    /// `velocity` and `quantities` are laid out as FluidFields says, row by row in each layer; empty ones are
    /// zeros. Throws std::logic_error for what is no grid, and for a start of another size.
    Fluid(gpu::Device& device, const Grid& grid, uint32_t channels = 0, std::span<const float> velocity = {},
          std::span<const float> quantities = {});

    /// Adds so many steps; once a graph. More than most_steps(), or a step of no length, are an
    /// std::logic_error.
    [[nodiscard]] FluidFields add_steps(gpu::Graph& graph, const FluidStyle& style, uint32_t count);

    /// What solves for the pressure of a step now.
    [[nodiscard]] Solver solver_of(const FluidStyle& style) const
    {
        return solver_for(grid_, trusted(style.projection).solver, are_solid());
    }

    /// As many steps as one graph takes, at least one.
    [[nodiscard]] uint32_t most_steps(const FluidStyle& style) const;

    /// Solves a random equation directly, and goes by cycles from then on, where nothing else is asked for,
    /// when more than a thousandth of it is left: drivers have been seen to get transforms wrong. Returns
    /// what is left; 0 where there is no direct solver. Best done once, before the first step.
    double check_spectral(gpu::Device& device, gpu::Executor& executor);

    /// From the next step on; both move by themselves as steps pass. Throws std::logic_error for more than 64
    /// in all.
    void set_shapes(std::span<const Shape> obstacles, std::span<const Source> sources)
    {
        shapes_.set(obstacles, sources);
    }

    /// Cells that are solid for good, a flag each, row by row and layer by layer; none where there are none.
    /// Throws std::logic_error for another number of them. No graph may be running.
    void set_standing(gpu::Device& device, std::span<const uint8_t> cells);

    [[nodiscard]] const Grid& grid() const { return grid_; }

    [[nodiscard]] uint32_t channels() const { return channels_; }

private:
    struct Handles;
    class Step;

    [[nodiscard]] Handles import(gpu::Graph& graph);

    [[nodiscard]] bool are_solid() const { return are_standing_ || shapes_.are_solid(); }

    [[nodiscard]] ProjectionStyle trusted(const ProjectionStyle& style) const;

    Grid grid_;
    uint32_t channels_;
    gpu::Image velocity_;
    std::array<gpu::Image, 2> quantities_; ///< by turns, none without channels
    uint32_t newest_quantities_ = 0;
    Shapes shapes_;
    gpu::Buffer solids_;   ///< a word a cell
    gpu::Buffer standing_; ///< a word per cell of what stands still for good, or none
    gpu::Buffer angles_;
    bool are_standing_ = false;
    bool is_spectral_right_ = true;
};

// Fields of a fluid for the processor: tests and measurements read them.

/// Leaves an image as later graphs take it in, by gpu::import_uploaded.
void hand_on(gpu::Graph& graph, gpu::ImageId image);

/// Adds a copy of all layers of `image`, one after the other, and leaves the image as later graphs take it
/// in.
[[nodiscard]] gpu::BufferId add_layers_copy(gpu::Graph& graph, gpu::ImageId image);

/// Runs `graph` with a copy of all layers of `image`, and reads the copy.
[[nodiscard]] std::vector<float> run_and_read(gpu::Device& device, gpu::Executor& executor, gpu::Graph& graph,
                                              gpu::ImageId image);

} // namespace estampe::fluid
