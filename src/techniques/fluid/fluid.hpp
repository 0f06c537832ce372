// SPDX-License-Identifier: MIT
#pragma once

// Fluid simulation on a grid: a divergence-free velocity advects (moves along) itself and quantities such as
// density.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/mass/mass.hpp"
#include "techniques/fluid/matter/matter.hpp"
#include "techniques/fluid/motion/motion.hpp"
#include "techniques/fluid/pressure/expansion.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

enum class Stepping : uint8_t {
    project, ///< each step advects, adds forces and projects (removes divergence)
    /// Advection-reflection: two half steps, with the velocity reflected between the two; second order, at
    /// twice the cost.
    reflect
};

/// Settings of a fluid step; every member may change from step to step.
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

/// Handles to the fluid's fields after the steps that were added to a graph.
struct FluidFields {
    /// Velocity in metres per second; component number i is in layer i * depth + z, on faces.
    gpu::ImageId velocity;
    gpu::ImageId unprojected; ///< the velocity before the last projection, for measuring the remaining error
    Solids solids;
    /// Quantities at cell centres; channel number i is in layer i * depth + z.
    std::optional<gpu::ImageId> quantities = {};
    /// Mass of each cell in units of 1 / 65536, if the fluid has a mass.
    std::optional<gpu::BufferId> mass = {};
    /// Outflow that the last projection left because hot fluid expands; none with Solver::mass.
    std::optional<Swelling> swelling = {};
};

/// A fluid simulation on the GPU. Deterministic: equal start, style and steps give bit-identical fields on
/// one device.
class Fluid {
public:
    /// Creates a fluid. `velocity` and `quantities` are laid out as in FluidFields, row by row in each layer;
    /// an empty span means all zeros. Throws std::logic_error for an invalid grid or a span of the wrong
    /// size.
    Fluid(gpu::Device& device, const Grid& grid, uint32_t channels = 0, std::span<const float> velocity = {},
          std::span<const float> quantities = {});

    /// Adds `count` simulation steps to a graph. Call add_steps() once per graph. Throws std::logic_error for
    /// more than most_steps() or for a step without length.
    [[nodiscard]] FluidFields add_steps(gpu::Graph& graph, const FluidStyle& style, uint32_t count);

    /// The pressure solver that a simulation step with `style` uses.
    [[nodiscard]] Solver solver_of(const FluidStyle& style) const
    {
        return solver_for(grid_, trusted(style.projection).solver, are_solid());
    }

    /// The number of simulation steps that fit into one graph, at least one.
    [[nodiscard]] uint32_t most_steps(const FluidStyle& style) const;

    /// Checks the spectral solver on a random equation, because some drivers compute the solver's transforms
    /// wrongly. If the residual is above 1e-3, `automatic` uses multigrid from then on. Returns the residual,
    /// or 0 if the grid has no spectral solver. Call check_spectral() once before the first step.
    double check_spectral(gpu::Device& device, gpu::Executor& executor);

    /// Sets obstacles and sources from the next step on. Obstacles and sources keep moving with their
    /// velocities as steps pass. Throws std::logic_error for more than 64 of both together.
    void set_shapes(std::span<const Shape> obstacles, std::span<const Source> sources)
    {
        shapes_.set(obstacles, sources);
    }

    /// Marks cells that are solid permanently: one flag per cell, row by row and layer by layer; an empty
    /// span clears all marks. Throws std::logic_error if the number of flags is wrong. No graph may be
    /// running.
    void set_standing(gpu::Device& device, std::span<const uint8_t> cells);

    /// Gives the fluid a mass for Solver::mass: one number per cell, or 1 everywhere if `mass` is empty.
    /// Throws std::logic_error if the number of masses is wrong. No graph may be running.
    void set_mass(gpu::Device& device, std::span<const float> mass = {});

    /// Gives the fluid a mass of 1 per cell if the solver of `style` needs a mass and the fluid has no mass.
    /// Drops the mass if the solver needs none. No graph may be running.
    void ensure_mass(gpu::Device& device, const FluidStyle& style);

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
    std::array<gpu::Image, 2> quantities_; ///< double buffer of the quantities; empty without channels
    uint32_t newest_quantities_ = 0;
    Shapes shapes_;
    gpu::Buffer solids_;   ///< per cell, one word: the obstacle that contains it, or 0
    gpu::Buffer standing_; ///< per cell, one word: whether it is solid permanently; or empty
    gpu::Buffer angles_;
    std::optional<MassField> mass_;
    bool are_standing_ = false;
    bool is_spectral_right_ = true;
};

// Copies of a fluid's fields for the CPU, for tests and measurements.

/// Leaves an image in the layout that gpu::import_uploaded() expects in later graphs.
void hand_on(gpu::Graph& graph, gpu::ImageId image);

/// Adds a copy of all layers of `image`, in order, to a buffer. Leaves the image in the layout that
/// gpu::import_uploaded() expects in later graphs.
[[nodiscard]] gpu::BufferId add_layers_copy(gpu::Graph& graph, gpu::ImageId image);

/// Runs `graph` with an added copy of all layers of `image`, and returns the copied numbers.
[[nodiscard]] std::vector<float> run_and_read(gpu::Device& device, gpu::Executor& executor, gpu::Graph& graph,
                                              gpu::ImageId image);

/// The mass of each cell, for Fluid::set_mass(); empty if the fluid has none. Exact below 256.
[[nodiscard]] std::vector<float> run_and_read_mass(gpu::Device& device, gpu::Executor& executor,
                                                   Fluid& fluid);

} // namespace estampe::fluid
