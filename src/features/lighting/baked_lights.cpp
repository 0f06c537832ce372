// SPDX-License-Identifier: MIT
#include "features/lighting/baked_lights.hpp"

#include <estampe/lightmap.hpp>

#include "core/luminance.hpp"

namespace estampe::features {

uint32_t kind_of(const shared::LightRecord& record)
{
    const uint32_t type = record.type & shared::light_type_mask;
    return type == shared::light_directional ? baked_directional
           : type >= shared::light_spot      ? baked_spot
                                             : baked_point;
}

float make_room(light::Lighting& lighting, const std::optional<WornLight>& worn,
                const lightmap::LightmapStyle& style)
{
    if (!worn) {
        return 0.0F;
    }
    const WornLight& baked = *worn;
    std::erase_if(lighting.records,
                  [&](const shared::LightRecord& record) { return (kind_of(record) & baked.kinds) != 0; });
    lighting.directional_count = (baked.kinds & baked_directional) != 0 ? 0 : lighting.directional_count;
    const float scale = style.strength * (baked.exposure > 0.0F ? lighting.exposure / baked.exposure : 1.0F);
    if (!style.balance) {
        return scale;
    }
    // Well-lit places come to about one and the ambient light; now they come to one and the map.
    const float dimmed = (1.0F + luminance(lighting.ambient)) / (1.0F + scale * baked.level);
    lighting.ambient *= dimmed;
    for (shared::LightRecord& record : lighting.records) {
        record.color *= dimmed;
    }
    return scale * dimmed;
}

} // namespace estampe::features
