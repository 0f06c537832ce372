// SPDX-License-Identifier: MIT
#include "techniques/light/daylight.hpp"

#include <algorithm>
#include <cmath>

#include "core/color.hpp"
#include "scene/light_sources.hpp"
#include "scene/view_analysis/surface_points.hpp"
#include "style/parameter.hpp"

namespace estampe::light {

const style::Table<SunStyle>& sun_table()
{
    static const auto table =
        style::Table<SunStyle>("sun", "Position of the sun by place, date and hour")
            .choice("by", &SunStyle::by, {{"direction", SunBy::direction}, {"place", SunBy::place}},
                    "How the position of the sun is set. direction: by the lights of the scene or by "
                    "light.sun_azimuth_deg; place: by date, hour and place on earth, instead of the scene's "
                    "own suns. With place, the sky takes the colours of the hour.")
            .number("latitude_deg", &SunStyle::latitude_deg, {-90.0F, 90.0F}, "deg",
                    "Latitude of the scene on earth: 0 is the equator, 90 the north pole, -90 the south "
                    "pole. Only used when sun.by is place.")
            .number("longitude_deg", &SunStyle::longitude_deg, {-180.0F, 180.0F}, "deg",
                    "Longitude of the scene on earth: above 0 is east of Greenwich, below 0 is west. Only "
                    "used when sun.clock is zone.")
            .text("date", &SunStyle::date,
                  "Date for which the path of the sun is computed: year, month and day, as in 2026-06-21. "
                  "Only used when sun.by is place.")
            .number("hour", &SunStyle::hour, {0.0F, 24.0F}, "h",
                    "Time of day in hours, with fractions: 17.5 is half past five in the afternoon. Only "
                    "used when sun.by is place.")
            .choice("clock", &SunStyle::clock, {{"sundial", Clock::sundial}, {"zone", Clock::zone}},
                    "What kind of time sun.hour is. sundial: solar time, with the sun highest at 12; zone: "
                    "the clock time of a time zone. Only used when sun.by is place.")
            .number("utc_offset_hours", &SunStyle::utc_offset_hours, {-14.0F, 14.0F}, "h",
                    "Hours by which local clocks are ahead of universal time (UTC): 1 is winter time in "
                    "Paris. Only used when sun.clock is zone.")
            .number("north_deg", &SunStyle::north_deg, {-360.0F, 360.0F}, "deg",
                    "Direction of north in the scene, seen from above: 0 is the +z axis, 90 is the +x axis. "
                    "East lies a quarter turn clockwise from north. Only used when sun.by is place.")
            .number("haze", &SunStyle::haze, {0.0F, 1.0F}, "",
                    "Haze in the air: more makes a low sun weaker and redder. 0 is clean air, 0.06 a clear "
                    "day, 0.3 a dull day. Only used when sun.by is place.")
            .number("warmth", &SunStyle::warmth, {0.0F, 1.0F}, "",
                    "How much sunlight takes on the colour of the air: 0 stays white, 1 is fully red in the "
                    "evening. Only used when sun.by is place.")
            .number("moon", &SunStyle::moon, {0.0F, 1.0F}, "",
                    "Brightness of moonlight, as a share of the light at noon: 0 is a moonless night. The "
                    "moon is full and stands opposite the sun. Only used when sun.by is place.");
    return table;
}

namespace {

constexpr double lowest_deg = 3.0;

glm::vec3 of_brightness_one(const glm::vec3& color)
{
    return color / std::max(luminance(color), 1e-6F);
}

/// Smooth step from 0 below `low` to 1 above `high`.
float between(double low, double high, double x)
{
    return static_cast<float>(glm::smoothstep(low, high, x));
}

SunPosition position_of(const SunStyle& style)
{
    const Date date = parse_date(style.date, "sun.date");
    return style.clock == Clock::sundial ? sun_position_by_sundial(date, style.hour, style.latitude_deg)
                                         : sun_position(date, style.hour - style.utc_offset_hours,
                                                        style.latitude_deg, style.longitude_deg);
}

/// Elevation of the light at dusk. After sunset the light comes from the sun's glow, which spreads upwards.
double height_of_glow(double elevation_deg)
{
    return elevation_deg > lowest_deg ? elevation_deg
                                      : lowest_deg + std::min(4.0 * std::max(-elevation_deg, 0.0), 25.0);
}

/// Strength and colour of the sun at an elevation. Eyes and paper compress the falling strength of a setting
/// sun, and the glow remains after sunset.
glm::vec3 sun_of(double elevation_deg, const SunStyle& style)
{
    const auto through = [&](double deg) {
        return glm::vec3(sunlight_through_air(glm::radians(deg), static_cast<double>(style.haze)));
    };
    const float strength = std::max(std::pow(luminance(through(elevation_deg)), 0.25F), 0.3F);
    // The last light after sunset is rosier than the red of the sun's disc.
    const glm::vec3 hue = of_brightness_one(through(std::max(elevation_deg, lowest_deg)));
    return strength * between(-8.0, 0.5, elevation_deg) * glm::mix(glm::vec3(1.0F), hue, style.warmth);
}

shared::LightRecord parallel_light(const glm::dvec3& towards, const glm::vec3& color)
{
    shared::LightRecord light{};
    light.type = shared::light_directional;
    light.direction = glm::vec3(towards);
    light.color = color;
    light.groups = 0xffffffffU;
    return light;
}

} // namespace

std::optional<Daylight> daylight_of(const SunStyle& style)
{
    if (style.by == SunBy::direction) {
        return std::nullopt;
    }
    const SunPosition position = position_of(style);
    Daylight day{.elevation_rad = position.elevation_rad + refraction_rad(position.elevation_rad)};
    const double deg = glm::degrees(day.elevation_rad);
    const double azimuth = glm::radians(static_cast<double>(style.north_deg)) - position.azimuth_rad;
    day.towards_sun = bearing(azimuth, glm::radians(height_of_glow(deg)));
    day.towards_moon = -bearing(azimuth, glm::radians(std::min(deg, -lowest_deg)));
    day.sun = sun_of(deg, style);
    day.moon = style.moon * between(2.0, 10.0, -deg) * of_brightness_one({0.5F, 0.85F, 1.8F});
    // At dusk nearly all light is ambient.
    const float dusk = between(-9.0, -1.0, deg) * (1.0F - between(0.0, 10.0, deg));
    day.ambient = glm::mix(0.55F * of_brightness_one({0.4F, 0.75F, 2.2F}),
                           of_brightness_one({0.96F, 1.0F, 1.08F}), between(-12.0, 0.0, deg)) *
                  (1.0F + dusk);
    return day;
}

void set_daylight(Lighting& lighting, const Daylight& daylight, const LightStyle& style)
{
    if (lighting.indoors || style.source == LightSource::scene) {
        return;
    }
    const float scale = std::exp2(style.exposure_stops) / (1.0F + style.fill);
    // A sun of brightness 0 is added too, so that an outdoor scene keeps its sky in a moonless night.
    std::vector records{parallel_light(daylight.towards_sun, scale * daylight.sun)};
    if (luminance(daylight.moon) > 0.0F) {
        records.push_back(parallel_light(daylight.towards_moon, scale * daylight.moon));
    }
    std::stable_sort(records.begin(), records.end(),
                     [](const shared::LightRecord& a, const shared::LightRecord& b) {
                         return luminance(a.color) > luminance(b.color);
                     });
    if (style.fill > 0.0F) {
        const glm::dvec3 key = glm::dvec3(records.front().direction);
        const double aside = std::atan2(key.x, key.z) + glm::radians(100.0);
        records.push_back(
            parallel_light(bearing(aside, glm::radians(20.0)), style.fill * records.front().color));
    }
    const auto first_lamp = lighting.records.begin() + lighting.directional_count;
    lighting.directional_count = static_cast<uint32_t>(records.size());
    lighting.towards_sun = glm::dvec3(records.front().direction);
    records.insert(records.end(), first_lamp, lighting.records.end());
    lighting.records = std::move(records);
    lighting.ambient *= daylight.ambient;
}

} // namespace estampe::light
