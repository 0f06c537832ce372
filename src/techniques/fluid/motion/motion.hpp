// SPDX-License-Identifier: MIT
#pragma once

// Changes of a fluid's velocity before the velocity is made divergence-free: advection, viscosity and forces.

#include <cstdint>
#include <optional>

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// Interpolation of a field at the point from which the flow brings a value.
enum class Advection : uint8_t {
    automatic, ///< cubic in 2D, MacCormack in 3D, where splines would need 64 nodes
    linear,    ///< linear interpolation between the nearest nodes; blurs the field
    cubic,     ///< Catmull-Rom splines through four nodes along each axis
    maccormack ///< linear interpolation, then a correction by half the error that advecting the result
               ///< backwards shows
};

/// Input and output of an advection.
struct Carried {
    gpu::ImageId velocity; ///< the velocity that advects the field
    gpu::ImageId field;    ///< the field that is advected; a velocity may advect itself
    gpu::ImageId target;   ///< image that is overwritten with the advected field
    uint32_t channels = 0; ///< number of quantities; 0 for a velocity
    /// Displacements from add_ways(), if several fields share the displacements.
    std::optional<gpu::ImageId> ways = {};
};

/// Result of the first part of MacCormack's advection scheme, before the correction.
struct ThereAndBack {
    gpu::ImageId ways;
    gpu::ImageId field;
    gpu::ImageId advected; ///< `field` after one advection, not yet corrected
};

/// Replaces Advection::automatic by the method that is used for a grid.
[[nodiscard]] Advection advection_for(const Grid& grid, Advection advection);

/// Number of passes that add_advection() adds, without add_ways().
[[nodiscard]] uint32_t passes_of_advection(const Grid& grid, Advection advection);

/// Adds a pass that computes the displacements of cell centres in `time_s`, backward and forward, for
/// MacCormack's scheme.
[[nodiscard]] gpu::ImageId add_ways(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity, float time_s);

/// Adds the first part of MacCormack's advection scheme. Does not write `carried.target`.
[[nodiscard]] ThereAndBack add_there(gpu::Graph& graph, const Grid& grid, const Carried& carried,
                                     float time_s);

/// Adds passes that advect `carried.field` for `time_s` into `carried.target`, and returns that image.
/// Velocities are in metres per second. Throws std::logic_error for quantities with MacCormack's scheme: use
/// add_corrected_matter().
[[nodiscard]] gpu::ImageId add_advection(gpu::Graph& graph, const Grid& grid, Advection advection,
                                         const Carried& carried, float time_s);

/// Number of stages that keep viscous diffusion stable: 2 for a low viscosity, growing with the viscosity's
/// square root. `share` is viscosity times time over the square of the cell size. Throws std::logic_error
/// above 63 stages.
[[nodiscard]] uint32_t diffusion_stages(const Grid& grid, float share);

struct Diffusion {
    float viscosity_m2_s = 0.0F;
    glm::vec3 acceleration_m_s2{
        0.0F}; ///< uniform force; part of diffusion, so that walls slow down the flow that the force drives
    float time_s = 0.0F;
};

/// Adds passes that return `velocity` after viscous diffusion.
[[nodiscard]] gpu::ImageId add_diffusion(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                                         const Diffusion& diffusion);

struct ForceStyle {
    glm::vec3 acceleration_m_s2{0.0F}; ///< uniform force as acceleration, for example gravity
    float friction_per_s = 0.0F;       ///< share of the speed that friction removes per second, at the start
    float lift_m_s2 = 0.0F;            ///< acceleration along +y per unit of temperature
    float weight_m_s2 = 0.0F;          ///< acceleration along -y per unit of density
    /// Strength of vorticity confinement: speed that a vortex gains per second, as a share of the vortex's
    /// speed difference across one cell.
    float confinement_per_s = 0.0F;
    /// Further confinement of slow swirls. The surplus falls with the square of a swirl's speed: to nothing
    /// for swirls that turn by `most_turn_rad` in a step, and below, until faster swirls have no confinement
    /// at all. Only used in volumes, together with `confinement_per_s`.
    float surplus_per_s = 0.0F;
    Rim rim; ///< layer at open ends where the fluid approaches `outside_m_per_s`
    glm::vec3 outside_m_per_s{0.0F};

    bool operator==(const ForceStyle&) const = default;
};

/// Angle by which a swirl turns in a step, in radians, from which on it gets no surplus of confinement. The
/// midpoint rule moves a particle that turns by the angle a in a step outwards, by the factor
/// sqrt(1 + a^4 / 4). In a whole turn this makes 3 % at a third of a radian, but a factor of 2 at one radian,
/// where the paths leave the swirl and tear what the fluid carries into clumps.
inline constexpr float most_turn_rad = 1.0F / 3.0F;

/// Adds a pass that returns `velocity` after `time_s` of forces, or `velocity` itself if there are no forces.
/// Without `quantities` there is no lift or weight.
[[nodiscard]] gpu::ImageId add_forces(gpu::Graph& graph, const Grid& grid, const ForceStyle& style,
                                      gpu::ImageId velocity, std::optional<gpu::ImageId> quantities,
                                      float time_s);

} // namespace estampe::fluid
