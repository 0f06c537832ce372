// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

#include "features/common/style_tables.hpp"
#include "techniques/bake/bake.hpp"

namespace estampe::frame {

/// What of the light is asked for.
struct BakedLight {
    uint32_t direct = 0; ///< kinds of lights whose own light goes into the map, see BakedLights
    float sky = 1.0F;    ///< the style's ambient light is multiplied by this
};

/// Gives `settings` the light that a picture of `scene` in this style has: its lamps, or the sun or lamp that
/// it would get, and its ambient light as a sky.
void set_light(bake::BakeSettings& settings, const Scene& scene, const features::StyleTables& style,
               const BakedLight& wanted);

} // namespace estampe::frame
