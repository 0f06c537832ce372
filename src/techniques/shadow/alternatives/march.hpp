// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/shadow/heightfield/height_fields.hpp"

namespace estampe::shadow {

/// A simpler alternative to add_height_shadow(): one ray to the sun's centre per texel, then a blur of equal
/// width everywhere.
///
/// Cost    three dispatches; up to `march_steps` samples per lit texel
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, chapter 4
[[nodiscard]] gpu::ImageId add_march(gpu::Graph& graph, const HeightShadowInputs& in,
                                     const HeightFields& fields, const HeightShadowStyle& style);

/// Blurs the shares of the sun's visible disc in each height field with a Gaussian of the deviation
/// `style.blur_m`. The blur of a field reads no other field. Returns `shares` itself for a blur of 0. Cost:
/// two dispatches, for each texel, a dispatch reads the texels within 2.5 deviations to either side.
[[nodiscard]] gpu::ImageId add_blur(gpu::Graph& graph, const HeightShadowInputs& in,
                                    const HeightFields& fields, const HeightShadowStyle& style,
                                    gpu::ImageId shares);

} // namespace estampe::shadow
