// SPDX-License-Identifier: MIT
#pragma once

// The light of an hour: sun, dusk and moon over a place, as the style's sun says.

#include <optional>
#include <string>

#include "style/parameter.hpp"
#include "techniques/light/light.hpp"

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

struct Daylight {
    double elevation_rad = 0.0;            ///< of the sun as it is seen; below 0 when it is night
    glm::dvec3 towards_sun{0.0, 1.0, 0.0}; ///< where its light comes from: never lower than 3 degrees
    glm::dvec3 towards_moon{0.0, 1.0, 0.0};
    glm::vec3 sun{0.0F};     ///< 1 is a sun overhead; after it has set its glow, until 8 degrees under
    glm::vec3 moon{0.0F};    ///< from when the sun is 2 degrees under the horizon
    glm::vec3 ambient{1.0F}; ///< factor of the light from everywhere
};

/// The light of the style's place and hour; none where the sun stands by direction. Throws Error, naming the
/// key, for a date that is none.
[[nodiscard]] std::optional<Daylight> daylight_of(const SunStyle& style);

/// Puts sun, moon and fill in the place of the directional lights of `lighting`, at the strength of the hour:
/// exposure stays that of noon, so evenings are dark. Lamps stay as they are. Nothing changes in a room lit
/// by its own lamp, nor where the style asks for the scene's lights alone.
void set_daylight(Lighting& lighting, const Daylight& daylight, const LightStyle& style);

} // namespace estampe::light
