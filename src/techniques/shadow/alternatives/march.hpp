// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/shadow/heightfield/height_fields.hpp"

namespace estampe::shadow {

/// add_height_shadow() by a ray to the sun's centre for each texel, and a blur of one width everywhere.
///
/// Throws  std::logic_error for more than one field
/// Cost    three dispatches; `march_steps` a texel in the light
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, chapter 4
[[nodiscard]] gpu::ImageId add_march(gpu::Graph& graph, const HeightShadowInputs& in,
                                     const HeightFields& fields, const HeightShadowStyle& style);

} // namespace estampe::shadow
