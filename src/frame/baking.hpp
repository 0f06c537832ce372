// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

#include "features/common/style_tables.hpp"
#include "techniques/bake/bake.hpp"

namespace estampe::frame {

/// Settings for the light that a lightmap will contain.
struct BakedLight {
    uint32_t direct = 0; ///< kinds of lights whose direct light is baked, as a bit mask of BakedLights
    float sky = 1.0F;    ///< factor on the style's ambient light
};

/// Fills `settings` with the light of a picture of `scene` in this style: the scene's lamps, or the sun or
/// lamp that the style adds, and the ambient light as light from the sky.
void set_light(bake::BakeSettings& settings, const Scene& scene, const features::StyleTables& style,
               const BakedLight& wanted);

} // namespace estampe::frame
