// SPDX-License-Identifier: MIT
#pragma once

// Light computations shared by light and bake. Lamps and spots: the emitted share and the falloff, a CPU
// version of light/local_light.glsl. The sun: its position in the sky for a place on earth, and its light
// after passing through the air. Angles are in radians, except latitude and longitude, which are in degrees.

#include <string>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// The angular falloff of a spot, as in KHR_lights_punctual.
struct SpotBeam {
    SpotShape shape = SpotShape::cone;
    glm::vec3 direction{0.0F, -1.0F, 0.0F}; ///< unit
    glm::vec3 side{1.0F, 0.0F, 0.0F};       ///< pyramids: unit, perpendicular to the beam and to two sides
    float cone_scale = 1.0F;                ///< saturate(cos(angle) * scale + offset) squared
    float cone_offset = 0.0F;
};

/// The share of its light that a spot sends along a unit vector.
[[nodiscard]] float share_along(const SpotBeam& beam, const glm::vec3& along);

/// The share of a lamp's light that arrives at a distance whose square is `distance_2`. With inverse-square
/// falloff it reaches zero at `range_m`; a range of 0 is unlimited.
[[nodiscard]] float weakened(LightFalloff falloff, float range_m, float distance_2);

/// A day of the Gregorian calendar.
struct Date {
    int year = 2026;
    int month = 6;
    int day = 21;
};

/// Reads "2026-06-21". Throws Error, naming `where` as its place, when the text is not a date of the years
/// 1583 to 2999.
[[nodiscard]] Date parse_date(const std::string& text, const std::string& where = "");

struct SunPosition {
    double azimuth_rad = 0.0;            ///< clockwise from north, 0 to 2 pi
    double elevation_rad = 0.0;          ///< height of the sun's centre above the horizon, without refraction
    double declination_rad = 0.0;        ///< above the celestial equator
    double equation_of_time_hours = 0.0; ///< a sundial minus a clock of mean time
};

/// The position of the sun over a place at a moment of universal time; hours may lie outside 0 to 24.
/// Latitude is positive to the north, longitude to the east. The error is below 0.01 degrees between 1900 and
/// 2100.
/// Source  Meeus, "Astronomical Algorithms", 1991, chapters 24 and 27, as in NOAA's solar calculator
[[nodiscard]] SunPosition sun_position(const Date& date, double universal_hours, double latitude_deg,
                                       double longitude_deg);

/// The position of the sun at an hour of solar time: at 12 the sun stands due south, or due north.
[[nodiscard]] SunPosition sun_position_by_sundial(const Date& date, double hour, double latitude_deg);

/// How much refraction lifts the sun's apparent height above `elevation_rad`: half a degree at the horizon.
/// Source  Saemundsson, "Atmospheric Refraction", Sky and Telescope 1986
[[nodiscard]] double refraction_rad(double elevation_rad);

/// Red, green and blue that reach the ground from a sun at that apparent height, as shares of the light of a
/// sun overhead; below the horizon they keep their values at the horizon. `haze` is Angstrom's turbidity
/// coefficient: 0 clean air, 0.06 a clear day, 0.3 a dull one. Source  air mass: Kasten and Young 1989; air:
/// Leckner 1978; haze: Angstrom 1929
[[nodiscard]] glm::dvec3 sunlight_through_air(double elevation_rad, double haze);

} // namespace estampe
