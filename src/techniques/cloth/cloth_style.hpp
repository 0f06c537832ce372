// SPDX-License-Identifier: MIT
#pragma once

// What a style says of cloth, and of the wind that moves it.

#include "style/parameter.hpp"

namespace estampe::cloth {

enum class WindSource : uint8_t { automatic, style, smoke };

/// The wind that moves cloth.
struct WindStyle {
    WindSource from = WindSource::automatic;
    float speed_m_per_s = 4.0F;
    float blown_m = -1.0F;
    float direction_deg = 20.0F;
    float gustiness = 0.35F;
    float gust_m = 6.0F;
    float turbulence = 0.5F;
    float eddy_m = 1.2F;

    bool operator==(const WindStyle&) const = default;
};

/// What skinned bodies are to cloth.
enum class ClothBodies : uint8_t { capsules, depth };

/// How cloth is worked out.
struct ClothStyle {
    float settle_s = 3.0F;
    float effort = 1.0F;
    float rest_mm_per_s = 5.0F;
    ClothBodies bodies = ClothBodies::capsules;

    bool operator==(const ClothStyle&) const = default;
};

[[nodiscard]] const style::Table<WindStyle>& wind_table();

[[nodiscard]] const style::Table<ClothStyle>& cloth_table();

} // namespace estampe::cloth
