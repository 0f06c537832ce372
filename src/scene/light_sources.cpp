// SPDX-License-Identifier: MIT
#include "scene/light_sources.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include <estampe/error.hpp>

namespace estampe {

float share_along(const SpotBeam& beam, const glm::vec3& along)
{
    float cosine = glm::dot(along, beam.direction);
    if (beam.shape == SpotShape::pyramid) {
        // The direction is outside the pyramid if the larger of the direction's angles to the pyramid's two
        // axes is too large.
        const float aside = std::max(std::abs(glm::dot(along, beam.side)),
                                     std::abs(glm::dot(along, glm::cross(beam.side, beam.direction))));
        cosine /= std::sqrt(std::max(cosine * cosine + aside * aside, 1e-12F));
    }
    const float cone = std::clamp(cosine * beam.cone_scale + beam.cone_offset, 0.0F, 1.0F);
    return cone * cone;
}

float weakened(LightFalloff falloff, float range_m, float distance_2)
{
    const float ratio = range_m > 0.0F ? distance_2 / (range_m * range_m) : 0.0F;
    return falloff == LightFalloff::unit_volume ? std::max(1.0F - ratio, 0.0F)
                                                : std::clamp(1.0F - ratio * ratio, 0.0F, 1.0F) / distance_2;
}

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double centuries_of_a_day = 1.0 / 36525.0;

int days_of(int year, int month)
{
    constexpr std::array<int, 12> days{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool is_leap_year = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return days.at(static_cast<size_t>(month - 1)) + (month == 2 && is_leap_year ? 1 : 0);
}

/// Returns the number of days from noon of 1 January 2000 to midnight at the start of the date (Meeus,
/// chapter 7).
double days_since_2000(const Date& date)
{
    const bool counts_to_last_year = date.month <= 2;
    const int year = date.year - (counts_to_last_year ? 1 : 0);
    const int month = date.month + (counts_to_last_year ? 12 : 0);
    const int century = year / 100;
    const double julian_day = std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) +
                              date.day + 2 - century + std::floor(century / 4.0) -
                              1524.5; // NOLINT(bugprone-integer-division): counted in whole centuries
    return julian_day - 2451545.0;
}

/// The part of the sun's position that is the same for all places on earth.
struct Course {
    double declination_rad;
    double equation_of_time_hours;
};

Course course(double centuries)
{
    const double t = centuries;
    const double mean_longitude = degree * (280.46646 + t * (36000.76983 + t * 0.0003032));
    const double anomaly = degree * (357.52911 + t * (35999.05029 - t * 0.0001537));
    const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
    const double centre =
        degree * (std::sin(anomaly) * (1.914602 - t * (0.004817 + t * 0.000014)) +
                  std::sin(2.0 * anomaly) * (0.019993 - t * 0.000101) + std::sin(3.0 * anomaly) * 0.000289);
    const double node = degree * (125.04 - 1934.136 * t);
    const double longitude = mean_longitude + centre - degree * (0.00569 + 0.00478 * std::sin(node));
    const double obliquity =
        degree * (23.0 + (26.0 + (21.448 - t * (46.815 + t * (0.00059 - t * 0.001813))) / 60.0) / 60.0 +
                  0.00256 * std::cos(node));
    const double y = std::pow(std::tan(0.5 * obliquity), 2.0);
    const double equation_rad = y * std::sin(2.0 * mean_longitude) - 2.0 * eccentricity * std::sin(anomaly) +
                                4.0 * eccentricity * y * std::sin(anomaly) * std::cos(2.0 * mean_longitude) -
                                0.5 * y * y * std::sin(4.0 * mean_longitude) -
                                1.25 * eccentricity * eccentricity * std::sin(2.0 * anomaly);
    return {std::asin(std::sin(obliquity) * std::sin(longitude)), equation_rad / (15.0 * degree)};
}

SunPosition seen_from(const Course& course, double hour_angle, double latitude_deg)
{
    const double latitude = degree * latitude_deg;
    const double declination = course.declination_rad;
    const double towards_south = std::cos(declination) * std::cos(hour_angle);
    const double up = std::sin(declination) * std::sin(latitude) + towards_south * std::cos(latitude);
    const double north = std::sin(declination) * std::cos(latitude) - towards_south * std::sin(latitude);
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double azimuth = std::atan2(east, north);
    return {.azimuth_rad = azimuth < 0.0 ? azimuth + 2.0 * std::numbers::pi : azimuth,
            .elevation_rad = std::atan2(up, std::hypot(north, east)),
            .declination_rad = declination,
            .equation_of_time_hours = course.equation_of_time_hours};
}

} // namespace

Date parse_date(const std::string& text, const std::string& where)
{
    const auto number = [&](size_t first, size_t length) {
        int value = -1;
        const char* const end = text.data() + first + length;
        return std::from_chars(text.data() + first, end, value).ptr == end ? value : -1;
    };
    Date date{.year = -1};
    if (text.size() == 10 && text[4] == '-' && text[7] == '-') {
        date = {number(0, 4), number(5, 2), number(8, 2)};
    }
    if (date.year < 1583 || date.year > 2999 || date.month < 1 || date.month > 12 || date.day < 1 ||
        date.day > days_of(date.year, date.month)) {
        throw Error("\"" + text + "\" is not a date", where,
                    "write year, month and day, of 1583 to 2999, as in 2026-06-21");
    }
    return date;
}

SunPosition sun_position(const Date& date, double universal_hours, double latitude_deg, double longitude_deg)
{
    const Course now = course((days_since_2000(date) + universal_hours / 24.0) * centuries_of_a_day);
    const double sundial = universal_hours + now.equation_of_time_hours + longitude_deg / 15.0;
    return seen_from(now, 15.0 * degree * (sundial - 12.0), latitude_deg);
}

SunPosition sun_position_by_sundial(const Date& date, double hour, double latitude_deg)
{
    const Course now = course((days_since_2000(date) + hour / 24.0) * centuries_of_a_day);
    return seen_from(now, 15.0 * degree * (hour - 12.0), latitude_deg);
}

double refraction_rad(double elevation_rad)
{
    // The formula has a pole at a lower elevation, so the elevation is clamped. Below the clamped range the
    // sun is not visible.
    const double deg = std::clamp(elevation_rad / degree, -1.0, 90.0);
    return std::max(degree * 1.02 / 60.0 / std::tan(degree * (deg + 10.3 / (deg + 5.11))), 0.0);
}

glm::dvec3 sunlight_through_air(double elevation_rad, double haze)
{
    constexpr glm::dvec3 wavelength_um(0.610, 0.550, 0.465);
    const double deg = std::clamp(elevation_rad / degree, 0.0, 90.0);
    const double air_mass = 1.0 / (std::sin(deg * degree) + 0.50572 * std::pow(deg + 6.07995, -1.6364));
    glm::dvec3 share(0.0);
    for (int i = 0; i < 3; ++i) {
        const double depth =
            0.008735 * std::pow(wavelength_um[i], -4.08) + haze * std::pow(wavelength_um[i], -1.3);
        share[i] = std::exp(-depth * std::max(air_mass - 1.0, 0.0));
    }
    return share;
}

} // namespace estampe
