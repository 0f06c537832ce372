// SPDX-License-Identifier: MIT
#pragma once

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

} // namespace estampe::fluid
