// SPDX-License-Identifier: MIT
#pragma once

// The sun's shadow of a ground without an end, on itself and on what stands on it: fields of heights about
// the eye, with the horizon that each texel has towards the sun.

#include <array>

#include "gpu/graph/graph.hpp"
#include "techniques/shadow/ground/ground_shadow.glsl.h"
#include "techniques/shadow/heightfield/height_shadow.hpp"

namespace estampe::shadow {

/// Where the fields lie.
using GroundLevels = std::array<shared::GroundLevel, shared::ground_levels>;

/// Fields of `size` texels a side about an eye, the finest of `texel_m`, each next of four times that. They
/// are moved towards the sun, where what throws shadows stands, and go along with the eye in steps of 16
/// texels.
[[nodiscard]] GroundLevels ground_levels_about(const glm::dvec2& eye_m, const glm::dvec2& anchor_m,
                                               const glm::dvec3& towards_sun, uint32_t size, double texel_m);

/// Numbers of levels.
using LevelNumbers = InlineVector<uint32_t, shared::ground_levels>;

/// What is seen of the ground, and of what stands on it.
struct GroundSight {
    glm::mat4 clip_from_anchor{1.0F}; ///< in perspective; in parallel projection all of the ground is wanted
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    double relief_m = 0.0; ///< between the lowest ground and the highest of what is seen
};

/// The texels that are looked up for it, in the fields of these numbers: two lines through about where the
/// eye is. All where it looks up or down.
[[nodiscard]] shared::FieldSector seen_sector(const GroundSight& sight, const GroundLevels& levels,
                                              const LevelNumbers& numbers);

/// The texels whose heights it takes to find the horizons of those.
[[nodiscard]] shared::FieldSector sunward_of(const shared::FieldSector& sector,
                                             const glm::dvec3& towards_sun);

struct GroundFields {
    gpu::ImageId height; ///< r32f, metres above the anchor: a square for each of `numbers`, one under another
    LevelNumbers numbers;
    const GroundLevels& levels; ///< all of them
    uint32_t size = 0;
    HeightMethod method = HeightMethod::sweep; ///< not the march
    shared::FieldSector wanted{};              ///< of a pyramid; other texels are kept as they were
    float sun_radius_rad = 0.0F;               ///< how far about the sun horizons are wanted hangs on it
};

/// Brings some fields of `kept`, a word a texel, level by level, up to date. Cost: that of
/// add_height_horizon(), and one small dispatch.
[[nodiscard]] gpu::BufferId add_ground_fields(gpu::Graph& graph, const GroundFields& fields,
                                              const glm::dvec3& towards_sun, gpu::BufferId kept);

struct GroundShareInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId depth;
    gpu::BufferId kept;
    GroundLevels levels;
    uint32_t size = 0;
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    float sun_radius_rad = 0.0F;
    glm::uvec2 size_px{0};
};

/// How much of the sun's disc the ground leaves to what is seen at each pixel, r16f; 1 where nothing is seen.
///
/// Cost    one full-screen dispatch, twelve texels a pixel
/// Source  Timonen and Westerholm, "Scalable Height Field Self-Shadowing", Eurographics 2010
[[nodiscard]] gpu::ImageId add_ground_share(gpu::Graph& graph, const GroundShareInputs& in);

} // namespace estampe::shadow
