// SPDX-License-Identifier: MIT
#pragma once

// The natural light at a place on earth and a time of day: sun, dusk and moon, from the style's section
// `sun`.

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
    double elevation_rad = 0.0; ///< apparent elevation of the sun; negative at night
    /// Direction to the sun, the glow or the moon; never lower than 3 degrees.
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    glm::dvec3 towards_moon{0.0, 1.0, 0.0};
    glm::vec3 sun{0.0F};  ///< light of the sun, 1 if overhead; after sunset that of the glow, until 8 degrees
                          ///< below the horizon
    glm::vec3 moon{0.0F}; ///< light of the moon; 0 until the sun is 2 degrees below the horizon
    glm::vec3 ambient{1.0F}; ///< factor on the ambient light of the sky
};

/// The daylight at the style's place and hour; empty if the key `sun.by` is `direction`. Throws Error, naming
/// the key, for an invalid date.
[[nodiscard]] std::optional<Daylight> daylight_of(const SunStyle& style);

/// Replaces the directional lights of `lighting` with sun, moon and fill light, at the strength of the hour.
/// The exposure stays that of noon, so evenings are dark. Lamps stay. Changes nothing indoors under the
/// default lamp, or if the style uses only the scene's lights.
void set_daylight(Lighting& lighting, const Daylight& daylight, const LightStyle& style);

} // namespace estampe::light
