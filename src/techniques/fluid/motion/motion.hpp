// SPDX-License-Identifier: MIT
#pragma once

// What moves a velocity before it is projected: advection, viscosity and forces.

#include <cstdint>
#include <optional>

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// How what the flow carries is looked up where it came from.
enum class Advection : uint8_t {
    automatic, ///< cubic in planes, MacCormack in volumes, where splines go through 64 nodes
    linear,    ///< between the nearest nodes: blurs
    cubic,     ///< by Catmull-Rom splines through four nodes along each axis
    maccormack ///< linear, corrected by half of what it loses on the way back
};

/// What is carried, and in what.
struct Carried {
    gpu::ImageId velocity; ///< carries
    gpu::ImageId field;    ///< is carried; for components of velocity the velocity itself, or another one
    gpu::ImageId target;   ///< is overwritten with what is carried
    uint32_t channels = 0; ///< of quantities; 0 for a velocity
    std::optional<gpu::ImageId> ways = {}; ///< from add_ways(), where another field goes them too
};

/// What MacCormack's scheme has found before it corrects.
struct ThereAndBack {
    gpu::ImageId ways;
    gpu::ImageId field;
    gpu::ImageId advected; ///< `field`, carried once
};

/// What `automatic` stands for.
[[nodiscard]] Advection advection_for(const Grid& grid, Advection advection);

/// Passes of add_advection(), without those of ways that are there already.
[[nodiscard]] uint32_t passes_of_advection(const Grid& grid, Advection advection);

/// The ways of what is in the middle of cells, back and forth, in `time_s`: what MacCormack's scheme goes by.
[[nodiscard]] gpu::ImageId add_ways(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity, float time_s);

/// The first part of MacCormack's scheme; of `carried` the target is not written.
[[nodiscard]] ThereAndBack add_there(gpu::Graph& graph, const Grid& grid, const Carried& carried,
                                     float time_s);

/// `carried.field` after `time_s`, in `carried.target`. Velocities in metres a second. Throws
/// std::logic_error for quantities by MacCormack's scheme: add_corrected_matter() does that.
[[nodiscard]] gpu::ImageId add_advection(gpu::Graph& graph, const Grid& grid, Advection advection,
                                         const Carried& carried, float time_s);

/// Stages that diffusion takes to be stable: 2 for little viscosity, more with the root of it. `share` is
/// viscosity times time over the square of a cell's side. Throws std::logic_error above 63.
[[nodiscard]] uint32_t diffusion_stages(const Grid& grid, float share);

struct Diffusion {
    float viscosity_m2_s = 0.0F;
    glm::vec3 acceleration_m_s2{
        0.0F}; ///< everywhere: what walls hold back at once must not be added afterwards
    float time_s = 0.0F;
};

/// `velocity` after it.
[[nodiscard]] gpu::ImageId add_diffusion(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                                         const Diffusion& diffusion);

struct ForceStyle {
    glm::vec3 acceleration_m_s2{0.0F}; ///< everywhere
    float friction_per_s = 0.0F;       ///< share of the speed that is lost, at first
    float lift_m_s2 = 0.0F;            ///< up y, by a unit of temperature
    float weight_m_s2 = 0.0F;          ///< down y, by a unit of density
    /// Feeds the vortices with so much of the speed that they have within a cell, each second.
    float confinement_per_s = 0.0F;
    Rim rim; ///< where what moves takes up `outside_m_per_s`
    glm::vec3 outside_m_per_s{0.0F};

    bool operator==(const ForceStyle&) const = default;
};

/// `velocity` after `time_s` of forces; itself when there are none. Without `quantities` nothing is light or
/// heavy.
[[nodiscard]] gpu::ImageId add_forces(gpu::Graph& graph, const Grid& grid, const ForceStyle& style,
                                      gpu::ImageId velocity, std::optional<gpu::ImageId> quantities,
                                      float time_s);

} // namespace estampe::fluid
