// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "style/parameter.hpp"

namespace estampe::light {

enum class SunBy : uint8_t { direction, place };

enum class Clock : uint8_t { sundial, zone };

struct SunStyle {
    SunBy by = SunBy::direction;
    float latitude_deg = 44.84F;
    float longitude_deg = 11.62F;
    std::string date = "2026-06-21";
    float hour = 17.0F;
    Clock clock = Clock::sundial;
    float utc_offset_hours = 1.0F;
    float north_deg = 180.0F;
    float haze = 0.06F;
    float warmth = 0.6F;
    float moon = 0.45F;
};

[[nodiscard]] const style::Table<SunStyle>& sun_table();

} // namespace estampe::light
