// SPDX-License-Identifier: MIT
#pragma once

// Light computations that the renderer and the light baking share. Lamps and spots: the emitted share and the
// falloff, as a CPU version of light/local_light.glsl. The sun: its position in the sky at a place on earth,
// and its colour after passing through the air. Angles are in radians, except latitude and longitude, which
// are in degrees.

#include <string>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// The angular falloff of a spot light, as in KHR_lights_punctual.
struct SpotBeam {
    SpotShape shape = SpotShape::cone;
    glm::vec3 direction{0.0F, -1.0F, 0.0F}; ///< direction of the beam, a unit vector
    /// Only for pyramids: unit vector perpendicular to the beam and to two sides of the pyramid.
    glm::vec3 side{1.0F, 0.0F, 0.0F};
    /// Factor on the cosine in the light share saturate(cos(angle) * scale + offset) squared.
    float cone_scale = 1.0F;
    float cone_offset = 0.0F;
};

/// Returns the share of a spot light's full intensity, 0 to 1, that it emits in the direction of the unit
/// vector `along`.
[[nodiscard]] float share_along(const SpotBeam& beam, const glm::vec3& along);

/// Returns the share of a lamp's light that reaches a point at a distance. `distance_2` is the squared
/// distance. Inverse-square falloff reaches zero at the distance `range_m`; if `range_m` is 0, the range is
/// unlimited.
[[nodiscard]] float weakened(LightFalloff falloff, float range_m, float distance_2);

/// A day of the Gregorian calendar.
struct Date {
    int year = 2026;
    int month = 6;
    int day = 21;
};

/// Parses a date such as "2026-06-21". Throws Error, with `where` as its place, when the text is not a date
/// of the years 1583 to 2999.
[[nodiscard]] Date parse_date(const std::string& text, const std::string& where = "");

struct SunPosition {
    double azimuth_rad = 0.0;            ///< direction of the sun, clockwise from north, 0 to 2 pi
    double elevation_rad = 0.0;          ///< height of the sun's centre above the horizon, without refraction
    double declination_rad = 0.0;        ///< angle of the sun above the celestial equator
    double equation_of_time_hours = 0.0; ///< time on a sundial minus mean time on a clock
};

/// Computes the position of the sun as seen from a place at a moment of universal time. Hours may be outside
/// 0 to 24. Latitude is positive to the north, longitude to the east. The error is below 0.01 degrees between
/// 1900 and 2100. Source: Meeus, "Astronomical Algorithms", 1991, chapters 24 and 27, as in NOAA's solar
/// calculator
[[nodiscard]] SunPosition sun_position(const Date& date, double universal_hours, double latitude_deg,
                                       double longitude_deg);

/// Computes the position of the sun at an hour of solar time. At 12 the sun is due south, or due north in the
/// southern hemisphere.
[[nodiscard]] SunPosition sun_position_by_sundial(const Date& date, double hour, double latitude_deg);

/// Returns the angle by which refraction in the air raises the apparent height of the sun above
/// `elevation_rad`. The angle is half a degree at the horizon. Source: Saemundsson, "Atmospheric Refraction",
/// Sky and Telescope 1986
[[nodiscard]] double refraction_rad(double elevation_rad);

/// Returns the red, green and blue sunlight at the ground for an apparent height of the sun, relative to the
/// light of a sun overhead. Below the horizon the values at the horizon apply. `haze` is Angstrom's turbidity
/// coefficient: 0 for clean air, 0.06 for a clear day, 0.3 for a dull day. Sources: air mass: Kasten and
/// Young 1989; air: Leckner 1978; haze: Angstrom 1929
[[nodiscard]] glm::dvec3 sunlight_through_air(double elevation_rad, double haze);

} // namespace estampe
