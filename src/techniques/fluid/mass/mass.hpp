// SPDX-License-Identifier: MIT
#pragma once

// Mass that is counted in whole units, so that advection conserves it exactly, even if the flow has
// divergence. A mass field of the fluid itself can replace the pressure solve: the fluid is then slightly
// compressible, and accelerates from cells with more mass towards cells with less.

#include <optional>
#include <span>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/motion/motion.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

enum class MassAdvection : uint8_t {
    forward,  ///< each cell distributes its mass over the cells around the point where the flow takes it
    both_ways ///< each cell claims mass from where the flow comes from; claims are limited to the existing
              ///< mass; unclaimed mass moves as with `forward`
};

/// A field of mass that a flow moves, in units of 1 / 65536 per cell. The sum of all cells is constant to the
/// unit. No cell is negative; a cell holds a mass of at most 65535. The result does not depend on the order
/// of threads.
class MassField {
public:
    /// Creates a field of mass. `mass` has one number from 0 to 32768 per cell; otherwise std::logic_error is
    /// thrown.
    MassField(gpu::Device& device, const Grid& grid, std::span<const float> mass);

    [[nodiscard]] gpu::BufferId import(gpu::Graph& graph);

    /// Stores the last result of add_mass_step() in a graph.
    void keep(gpu::Graph& graph, gpu::BufferId mass);

private:
    gpu::Buffer units_;
};

struct MassFlow {
    gpu::ImageId velocity;
    float time_s = 0.0F;
    MassAdvection advection = MassAdvection::both_ways;
};

/// Adds passes that move mass along `flow`, and returns the new mass. `mass` comes from MassField::import()
/// or from an earlier step.
[[nodiscard]] gpu::BufferId add_mass_step(gpu::Graph& graph, const Grid& grid, gpu::BufferId mass,
                                          const MassFlow& flow);

/// Input of add_spread(), which accelerates the fluid away from mass for `time_s`, as in a compressible gas.
/// The new velocity is written into `target`. `stiffness_m2_s2` is the square of the speed of sound where
/// cells have mass 1.
struct Spread {
    gpu::BufferId mass;
    gpu::ImageId velocity;
    gpu::ImageId target;
    std::optional<Solids> solids = {}; ///< solid cells: across their faces there is no acceleration
    float stiffness_m2_s2 = 0.0F;
    float time_s = 0.0F;
    /// Bulk viscosity: the speed of a face grows by a share, `damping`, of the difference in outflow between
    /// the face's two cells. Damps sound; stable up to 0.25 in 2D and 1/6 in 3D.
    float damping = 0.0F;
};

[[nodiscard]] gpu::ImageId add_spread(gpu::Graph& graph, const Grid& grid, const Spread& spread);

/// The fluid's own mass, 1 per cell at rest, and its velocity.
struct MassAndVelocity {
    gpu::BufferId mass;
    gpu::ImageId velocity;
};

/// Replaces a projection in a step of `time_s`: advects the mass with the velocity and accelerates the
/// velocity away from mass, in `mass_parts` parts of the step. The speed of sound is 0.4 cells per part, so
/// the fluid gets denser by a few percent where its speed reaches a cell per part. Returns the velocity in
/// `target`.
[[nodiscard]] MassAndVelocity add_mass_pressure(gpu::Graph& graph, const Grid& grid, const Solids& solids,
                                                const MassAndVelocity& start, gpu::ImageId target,
                                                float time_s);
inline constexpr uint32_t mass_parts = 8;

/// Number of passes of add_mass_pressure().
[[nodiscard]] uint32_t passes_of_mass_pressure();

/// Advects quantities with the method both_ways, in units of 1 / 65536, so that the sum of each quantity
/// stays the same to the unit. Quantities may be negative; quantities beyond 2048 are clamped. Returns
/// `carried.target`. `carried.ways` is not used.
[[nodiscard]] gpu::ImageId add_conserving_advection(gpu::Graph& graph, const Grid& grid,
                                                    const Carried& carried, float time_s);
inline constexpr uint32_t passes_of_conserving_advection = 8;

} // namespace estampe::fluid
