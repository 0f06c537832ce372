// SPDX-License-Identifier: MIT
#include "features/common/shared_sections.hpp"

namespace estampe::features {

wind::WindStyle wind_over(const std::optional<Terrain>& terrain, const wind::WindStyle& style)
{
    wind::WindStyle result = style;
    if (style.from == wind::WindSource::automatic && terrain) {
        const TerrainWind& over_ground = terrain->description().wind;
        result.speed_m_per_s = over_ground.speed_m_per_s;
        result.towards_deg = over_ground.towards_deg;
    }
    return result;
}

const StyleTables& with_shared_sections(const StyleTables& style, const std::optional<Terrain>& terrain,
                                        StyleTables& room)
{
    const wind::WindStyle over = wind_over(terrain, style.wind);
    const wind::Wind wind{.speed_m_per_s = over.speed_m_per_s, .towards_deg = over.towards_deg};
    const haze::HazeStyle& haze = style.haze;
    if (wind == wind::Wind() && over == style.wind && haze.tint == 0.0F && haze.hatching == 1.0F) {
        return style;
    }
    if (&room != &style) {
        room = style;
    }
    room.wind = over;
    room.hatch.wind = wind;
    room.clouds.wind = wind;
    room.smoke.wind = wind;
    room.particles.wind = wind;
    room.wash.air = room.haze.tint;
    room.wash.air_color = room.haze.tint_color;
    room.wash.air_distance_m = room.haze.tint_distance_m;
    room.hatch.fade = room.haze.hatching;
    room.hatch.fade_distance_m = room.haze.hatching_distance_m;
    return room;
}

} // namespace estampe::features
