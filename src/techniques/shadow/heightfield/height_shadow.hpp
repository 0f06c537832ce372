// SPDX-License-Identifier: MIT
#pragma once

// The shadow of a height field on itself in sunlight, with the penumbra of a sun disc. The shadow is exact at
// any distance, where a shadow map would have too few texels.

#include <glm/glm.hpp>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/shadow/heightfield/height_shadow.glsl.h"

namespace estampe::shadow {

enum class HeightMethod : uint8_t {
    sweep,   ///< walks along lines away from the sun; constant cost per texel over the whole field
    pyramid, ///< searches from each texel towards the sun, over a pyramid of maximum heights
    march,   ///< traces a ray from each texel to the sun's centre, then blurs
    above    ///< blurs the shares of the sun that the method `pyramid` computes exactly, as an image of the
             ///< ground seen from straight above
};

/// Whether a method blurs shares of the sun, and therefore computes no horizons.
[[nodiscard]] constexpr bool blurs(HeightMethod method)
{
    return method == HeightMethod::march || method == HeightMethod::above;
}

struct HeightShadowStyle {
    HeightMethod method = HeightMethod::sweep;
    uint32_t march_steps = 512; ///< longest distance in texels at which ground throws a shadow
    float blur_m = 0.5F;        ///< standard deviation of the blur in the methods `march` and `above`

    bool operator==(const HeightShadowStyle&) const = default;
};

/// Distance between two texels in metres, for each of the fields that are computed together.
using FieldTexels = InlineVector<float, shared::height_fields_most>;

struct HeightShadowInputs {
    /// r32f or r16f image of heights in metres; fields of equal size are stacked vertically.
    gpu::ImageId height;
    FieldTexels texel_m; ///< texel size of each height field
    /// Unit vector towards the sun; x along the field's rows, y up, z down its columns.
    glm::dvec3 towards_sun;
    double sun_radius_rad = 0.00465; ///< half the angular diameter of the sun; above 0
    shared::FieldSector wanted{}; ///< only for the pyramid method: texels to compute; others are not written
};

/// Adds passes that compute the share of the sun's disc that each texel sees: 1 all of the disc, 0 none. The
/// ground is linear between texels. Beyond the field the ground is flat and low, so a sun below the horizon
/// lights nothing.
///
/// Writes  r16f of the size of `height`
/// Throws  std::logic_error for fields of less than 2 x 2 or more than 16384 x 16384 texels, and for no
///         field
/// Cost    sweep: two steps per texel at any sun direction; one thread per line, so large fields or several
///         fields at once use the device best. Pyramid: a third more memory; texel reads grow with the
///         logarithm of the distance to the occluder, so low suns cost more. March: up to `march_steps` per
///         lit texel
/// Source  Timonen and Westerholm, "Scalable Height Field Self-Shadowing", Eurographics 2010 (sweep); Snyder
///         and Nowrouzezahrai, "Fast Soft Self-Shadowing on Dynamic Height Fields", EGSR 2008 (pyramid);
///         Zanuttini, "Recherches en rendu non réaliste temps réel", 2008 (march, above)
[[nodiscard]] gpu::ImageId add_height_shadow(gpu::Graph& graph, const HeightShadowInputs& in,
                                             const HeightShadowStyle& style = {});

/// Adds passes that compute the height of the horizon above the sun's centre in radians, negative below:
/// r16f, most precise near 0. To draw shadow edges finer than texels, sample the image of horizons with
/// linear filtering, divide the value by the sun's radius, and pass the result to the function
/// `share_of_disc` of shaders/sun_disc.glsl. Supports sweep and pyramid; methods that blur have no horizon
/// and throw std::logic_error. With pyramid the values are limited to 0.15 rad or 16 sun radii from the sun's
/// centre. Costs as much as add_height_shadow().
[[nodiscard]] gpu::ImageId add_height_horizon(gpu::Graph& graph, const HeightShadowInputs& in,
                                              const HeightShadowStyle& style = {});

} // namespace estampe::shadow
