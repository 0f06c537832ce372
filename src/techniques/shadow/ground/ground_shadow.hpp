// SPDX-License-Identifier: MIT
#pragma once

// The shadow of an endless ground on itself and on objects on the ground, in sunlight: height fields around
// the eye, with the horizon of each texel in the sun's direction.

#include <array>

#include "gpu/graph/graph.hpp"
#include "techniques/shadow/ground/ground_shadow.glsl.h"
#include "techniques/shadow/heightfield/height_shadow.hpp"

namespace estampe::shadow {

/// Position and texel size of all ground fields.
using GroundLevels = std::array<shared::GroundLevel, shared::ground_levels>;

/// Places ground fields of `size` texels per side around an eye. The finest field has texels of `texel_m`;
/// each next field is four times as coarse. Fields are shifted towards the sun, because occluders of sunlight
/// lie there. Fields follow the eye in steps of 16 texels.
[[nodiscard]] GroundLevels ground_levels_about(const glm::dvec2& eye_m, const glm::dvec2& anchor_m,
                                               const glm::dvec3& towards_sun, uint32_t size, double texel_m);

using LevelNumbers = InlineVector<uint32_t, shared::ground_levels>;

/// Describes which part of the ground and of the objects on it is visible.
struct GroundSight {
    /// Projection of the page; in parallel projection, all of the ground counts as visible.
    glm::mat4 clip_from_anchor{1.0F};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    double relief_m = 0.0; ///< height from the lowest ground to the highest visible object
};

/// The texels of the ground fields with the given `numbers` that lookups for visible points can reach: a
/// sector between two lines near the eye. If the eye looks steeply up or down, the sector contains all
/// texels.
[[nodiscard]] shared::FieldSector seen_sector(const GroundSight& sight, const GroundLevels& levels,
                                              const LevelNumbers& numbers);

/// The texels that lie towards the sun from `sector`. The heights of the sunward texels determine the
/// horizons of the texels in `sector`.
[[nodiscard]] shared::FieldSector sunward_of(const shared::FieldSector& sector,
                                             const glm::dvec3& towards_sun);

struct GroundFields {
    /// R32f, metres above the anchor (a nearby origin): stacked square fields, one per entry of `numbers`.
    gpu::ImageId height;
    LevelNumbers numbers;
    const GroundLevels& levels; ///< position and texel size of all fields, not only of `numbers`
    uint32_t size = 0;
    HeightShadowStyle style; ///< methods that blur store shares of the sun, not horizons
    /// For the pyramid method: texels to compute; texels outside are left unchanged.
    shared::FieldSector wanted{};
    /// Radius of the sun; determines how far from the sun horizons must be exact.
    float sun_radius_rad = 0.0F;
};

/// Adds passes that compute heights and horizons of some ground fields and store them in `kept`, which has
/// one word per texel, level by level. Cost: add_height_horizon() or, with methods that blur,
/// add_height_shadow(), and one small dispatch.
[[nodiscard]] gpu::BufferId add_ground_fields(gpu::Graph& graph, const GroundFields& fields,
                                              const glm::dvec3& towards_sun, gpu::BufferId kept);

struct GroundShareInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId depth;
    gpu::BufferId kept;
    GroundLevels levels;
    uint32_t size = 0;
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    float sun_radius_rad = 0.0F;
    HeightMethod method = HeightMethod::sweep; ///< method that computed the fields
    glm::uvec2 size_px{0};
};

/// Adds a pass that computes the share of the sun's disc that the ground leaves visible at each pixel, r16f;
/// 1 where no surface is.
///
/// Cost    one full-screen dispatch, twelve texels per pixel
/// Source  Timonen and Westerholm, "Scalable Height Field Self-Shadowing", Eurographics 2010
[[nodiscard]] gpu::ImageId add_ground_share(gpu::Graph& graph, const GroundShareInputs& in);

} // namespace estampe::shadow
