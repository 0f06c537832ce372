// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

#include "features/common/style_tables.hpp"
#include "techniques/bake/bake.hpp"

namespace estampe::frame {

/// The light that a lightmap is to hold.
struct BakedLight {
    uint32_t direct = 0; ///< bit mask of the kinds of lights whose direct light is baked, see BakedLights
    float sky = 1.0F;    ///< multiplies the style's ambient light
};

/// Fills `settings` with the light that a picture of `scene` in this style has: the scene's lamps, or the sun
/// or lamp that the style adds, and the ambient light as a sky.
void set_light(bake::BakeSettings& settings, const Scene& scene, const features::StyleTables& style,
               const BakedLight& wanted);

} // namespace estampe::frame
