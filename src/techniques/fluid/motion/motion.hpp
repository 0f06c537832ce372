// SPDX-License-Identifier: MIT
#pragma once

// Changes of a velocity before it is projected: advection, viscosity and forces.

#include <cstdint>
#include <optional>

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// Interpolation of a field at the point that the flow brings a value from.
enum class Advection : uint8_t {
    automatic, ///< cubic in 2D, MacCormack in 3D, where splines would need 64 nodes
    linear,    ///< between the nearest nodes; blurs
    cubic,     ///< Catmull-Rom splines through four nodes along each axis
    maccormack ///< linear, corrected by half of the error that advecting the result backwards shows
};

/// Input and output of an advection.
struct Carried {
    gpu::ImageId velocity;                 ///< the velocity that advects the field
    gpu::ImageId field;                    ///< the field that is advected; a velocity may advect itself
    gpu::ImageId target;                   ///< overwritten with the result
    uint32_t channels = 0;                 ///< number of quantities; 0 for a velocity
    std::optional<gpu::ImageId> ways = {}; ///< displacements from add_ways(), if another field uses them too
};

/// Result of the first part of MacCormack's scheme, before the correction.
struct ThereAndBack {
    gpu::ImageId ways;
    gpu::ImageId field;
    gpu::ImageId advected; ///< `field` after one advection
};

/// Resolves `automatic`.
[[nodiscard]] Advection advection_for(const Grid& grid, Advection advection);

/// Number of passes that add_advection() adds, without add_ways().
[[nodiscard]] uint32_t passes_of_advection(const Grid& grid, Advection advection);

/// Displacements of cell centres in `time_s`, backward and forward, for MacCormack's scheme.
[[nodiscard]] gpu::ImageId add_ways(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity, float time_s);

/// First part of MacCormack's scheme. Does not write `carried.target`.
[[nodiscard]] ThereAndBack add_there(gpu::Graph& graph, const Grid& grid, const Carried& carried,
                                     float time_s);

/// Returns `carried.field` after `time_s`, in `carried.target`. Velocities are in metres per second. Throws
/// std::logic_error for quantities with MacCormack's scheme: use add_corrected_matter().
[[nodiscard]] gpu::ImageId add_advection(gpu::Graph& graph, const Grid& grid, Advection advection,
                                         const Carried& carried, float time_s);

/// Number of stages that keep diffusion stable: 2 for a low viscosity, growing with its square root. `share`
/// is viscosity times time over the square of the cell size. Throws std::logic_error above 63.
[[nodiscard]] uint32_t diffusion_stages(const Grid& grid, float share);

struct Diffusion {
    float viscosity_m2_s = 0.0F;
    glm::vec3 acceleration_m_s2{
        0.0F}; ///< uniform force; part of diffusion, so that walls slow down the flow that it drives
    float time_s = 0.0F;
};

/// Returns `velocity` after viscous diffusion.
[[nodiscard]] gpu::ImageId add_diffusion(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                                         const Diffusion& diffusion);

struct ForceStyle {
    glm::vec3 acceleration_m_s2{0.0F}; ///< uniform force
    float friction_per_s = 0.0F;       ///< initial share of the speed that is lost
    float lift_m_s2 = 0.0F;            ///< along +y, per unit of temperature
    float weight_m_s2 = 0.0F;          ///< along -y, per unit of density
    /// Strength of vorticity confinement: share of a vortex's speed across one cell that it gains per second.
    float confinement_per_s = 0.0F;
    Rim rim; ///< layer in which the fluid approaches `outside_m_per_s`
    glm::vec3 outside_m_per_s{0.0F};

    bool operator==(const ForceStyle&) const = default;
};

/// Returns `velocity` after `time_s` of forces; returns `velocity` itself if there are none. Without
/// `quantities` there is no lift or weight.
[[nodiscard]] gpu::ImageId add_forces(gpu::Graph& graph, const Grid& grid, const ForceStyle& style,
                                      gpu::ImageId velocity, std::optional<gpu::ImageId> quantities,
                                      float time_s);

} // namespace estampe::fluid
