// SPDX-License-Identifier: MIT
#pragma once

// The sun's shadow on a field of heights, cast by the field itself, with the penumbra of a sun that is a
// disc. Exact where a shadow map has no texels left: ground out to the horizon.

#include <glm/glm.hpp>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/shadow/heightfield/height_shadow.glsl.h"

namespace estampe::shadow {

enum class HeightMethod : uint8_t {
    sweep,   ///< lines that walk away from the sun; the whole field at a constant cost a texel
    pyramid, ///< a search towards the sun over a pyramid of greatest heights, texel by texel
    march    ///< a ray to the sun's centre for each texel, then a blur
};

struct HeightShadowStyle {
    HeightMethod method = HeightMethod::sweep;
    int march_steps = 512;
    float march_blur_texels = 2.0F;
};

/// Between two texels, for each of the fields that are worked out together.
using FieldTexels = InlineVector<float, shared::height_fields_most>;

struct HeightShadowInputs {
    gpu::ImageId height;             ///< r32f or r16f, metres; fields of one size, one under another
    FieldTexels texel_m;             ///< of each field
    glm::dvec3 towards_sun;          ///< unit; x along the field's rows, y up, z down its columns
    double sun_radius_rad = 0.00465; ///< half the angle that the disc takes; above 0
    shared::FieldSector wanted{};    ///< pyramid: other texels of what is written are not set
};

/// How much of the sun's disc each texel sees: 1 all of it, 0 none. Between texels the ground is linear;
/// beyond its field it is level and low, so that a sun under the horizon lights nothing.
///
/// Writes  r16f of the size of `height`
/// Throws  std::logic_error for fields of less than 2 x 2 or more than 16384 x 16384 texels, for none, and
///         for more than one by march
/// Cost    sweep: two steps a texel, whatever the light; one thread a line, so large fields fill a device
///         best, as do several fields at once. Pyramid: a third more memory and about as many texels to look
///         at as the way to what throws the shadow has digits; low suns cost more. March: `march_steps` a
///         texel in the light
/// Source  Timonen and Westerholm, "Scalable Height Field Self-Shadowing", Eurographics 2010 (sweep); Snyder
///         and Nowrouzezahrai, "Fast Soft Self-Shadowing on Dynamic Height Fields", EGSR 2008 (pyramid);
///         Zanuttini, "Recherches en rendu non réaliste temps réel", 2008 (march)
[[nodiscard]] gpu::ImageId add_height_shadow(gpu::Graph& graph, const HeightShadowInputs& in,
                                             const HeightShadowStyle& style = {});

/// How far the horizon stands above the sun's centre, in radians, negative below: r16f, finest near 0. Read
/// between texels by linear filtering and given to `share_of_disc` of shaders/sun_disc.glsl, divided by the
/// sun's radius, it draws edges finer than texels. By sweep, or by pyramid; march, which knows no horizon, is
/// an std::logic_error. By pyramid no farther from the sun's centre than 0.15 rad, or 16 of its radii. Costs
/// as add_height_shadow.
[[nodiscard]] gpu::ImageId add_height_horizon(gpu::Graph& graph, const HeightShadowInputs& in,
                                              const HeightShadowStyle& style = {});

} // namespace estampe::shadow
