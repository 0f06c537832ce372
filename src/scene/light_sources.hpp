// SPDX-License-Identifier: MIT
#pragma once

// What light and bake both work out. What leaves a lamp or spot, and what comes of it: light/local_light.glsl
// for the processor. Where the sun stands in the sky of a place on earth, and what is left of its light on
// the way through the air: plain functions of numbers; angles in radians but for latitude and longitude, in
// degrees.

#include <string>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// What a spot lights, by the angular falloff of KHR_lights_punctual.
struct SpotBeam {
    SpotShape shape = SpotShape::cone;
    glm::vec3 direction{0.0F, -1.0F, 0.0F}; ///< unit
    glm::vec3 side{1.0F, 0.0F, 0.0F}; ///< pyramids: unit, square to the beam, across two of the four sides
    float cone_scale = 1.0F;          ///< saturate(cos(angle) * scale + offset) squared
    float cone_offset = 0.0F;
};

/// The share of its light that a spot sends along a unit vector.
[[nodiscard]] float share_along(const SpotBeam& beam, const glm::vec3& along);

/// The share of a lamp's light that comes to where the distance squared is `distance_2`. By the inverse
/// square it reaches zero at the range; a range of 0 is none.
[[nodiscard]] float weakened(LightFalloff falloff, float range_m, float distance_2);

/// A day of the Gregorian calendar.
struct Date {
    int year = 2026;
    int month = 6;
    int day = 21;
};

/// Reads "2026-06-21". Throws Error, naming `where` it stood, when that is no day of 1583 to 2999.
[[nodiscard]] Date parse_date(const std::string& text, const std::string& where = "");

struct SunPosition {
    double azimuth_rad = 0.0;            ///< from north over east, 0 to 2 pi
    double elevation_rad = 0.0;          ///< of the centre above the horizon, as if there were no air
    double declination_rad = 0.0;        ///< above the celestial equator
    double equation_of_time_hours = 0.0; ///< how far a sundial is ahead of a clock of mean time
};

/// The sun over a place at a moment of universal time; hours may lie beyond the day. Latitude is positive to
/// the north, longitude to the east. Within 0.01 degrees between 1900 and 2100.
/// Source  Meeus, "Astronomical Algorithms", 1991, chapters 24 and 27, as in NOAA's solar calculator
[[nodiscard]] SunPosition sun_position(const Date& date, double universal_hours, double latitude_deg,
                                       double longitude_deg);

/// The same at an hour of the sundial: at 12 the sun stands due south, or north.
[[nodiscard]] SunPosition sun_position_by_sundial(const Date& date, double hour, double latitude_deg);

/// How much higher the sun is seen than it stands, because air bends its light: half a degree at the horizon.
/// Source  Saemundsson, "Atmospheric Refraction", Sky and Telescope 1986
[[nodiscard]] double refraction_rad(double elevation_rad);

/// Red, green and blue that reach the ground from a sun at that height (as it is seen), as shares of what a
/// sun overhead sends; below the horizon as at it. `haze` is Angstrom's coefficient: 0 clean air, 0.06 a
/// clear day, 0.3 a dull one. Source  air mass: Kasten and Young 1989; air: Leckner 1978; haze: Angstrom 1929
[[nodiscard]] glm::dvec3 sunlight_through_air(double elevation_rad, double haze);

} // namespace estampe
