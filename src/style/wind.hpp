// SPDX-License-Identifier: MIT
// The wind of a scene. Its code lies below the techniques because several of them read the wind: hatching,
// cloth, smoke, clouds, particles and flowing ink.
#pragma once

#include <cstdint>

#include "style/parameter.hpp"

namespace estampe::wind {

/// Source of the wind: the terrain, the style, or the air of the smoke. `automatic` means the terrain, or the
/// style if there is no terrain.
enum class WindSource : uint8_t { automatic, style, smoke };

/// Parameters of the section [wind] of a style: the wind of the scene.
struct WindStyle {
    WindSource from = WindSource::automatic;
    float speed_m_per_s = 4.0F;
    float blown_m = -1.0F;
    float towards_deg = 90.0F;
    float gustiness = 0.35F;
    float gust_m = 6.0F;
    float turbulence = 0.5F;
    float eddy_m = 1.2F;

    bool operator==(const WindStyle&) const = default;
};

[[nodiscard]] const style::Table<WindStyle>& wind_table();

/// The mean wind. The mean wind is copied to the sections of a style that have no wind of their own.
struct Wind {
    float speed_m_per_s = WindStyle().speed_m_per_s;
    /// Direction towards which the wind blows, in degrees: 0 is +z, 90 is +x.
    float towards_deg = WindStyle().towards_deg;

    bool operator==(const Wind&) const = default;
};

/// Converts the bearing `towards_deg` to an angle in degrees, measured from +x towards +z.
[[nodiscard]] inline float from_x_deg(float towards_deg)
{
    return 90.0F - towards_deg;
}

/// Returns the wind speed of a feature that has its own key for it: `own_m_per_s`, or the speed of `wind` if
/// `own_m_per_s` is negative.
[[nodiscard]] inline float speed_m_per_s(const Wind& wind, float own_m_per_s)
{
    return own_m_per_s < 0.0F ? wind.speed_m_per_s : own_m_per_s;
}

} // namespace estampe::wind
