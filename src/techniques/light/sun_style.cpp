// SPDX-License-Identifier: MIT
#include "techniques/light/sun_style.hpp"

#include "style/parameter.hpp"

namespace estampe::light {

const style::Table<SunStyle>& sun_table()
{
    static const auto table =
        style::Table<SunStyle>("sun", "The sun of a place on earth, through the day and the year")
            .choice("by", &SunStyle::by, {{"direction", SunBy::direction}, {"place", SunBy::place}},
                    "Where the sun stands: as the scene or light.sun_azimuth_deg say, or over the place "
                    "below, at the hour below; then it takes the place of the scene's directional lights, "
                    "and the sky's colours follow")
            .number("latitude_deg", &SunStyle::latitude_deg, {-90.0F, 90.0F}, "deg",
                    "Latitude of the place, positive to the north")
            .number("longitude_deg", &SunStyle::longitude_deg, {-180.0F, 180.0F}, "deg",
                    "Longitude of the place, positive to the east; for a clock of a zone")
            .text("date", &SunStyle::date, "The day: year, month and day, as in 2026-06-21")
            .number("hour", &SunStyle::hour, {0.0F, 24.0F}, "h", "The hour, with fractions")
            .choice("clock", &SunStyle::clock, {{"sundial", Clock::sundial}, {"zone", Clock::zone}},
                    "What tells the hour: a sundial, at 12 when the sun is highest, or a clock")
            .number("utc_offset_hours", &SunStyle::utc_offset_hours, {-14.0F, 14.0F}, "h",
                    "How far that clock is ahead of universal time")
            .number("north_deg", &SunStyle::north_deg, {-360.0F, 360.0F}, "deg",
                    "Bearing of north in the scene: 0 is +z, 90 +x; east is a quarter turn clockwise from it")
            .number("haze", &SunStyle::haze, {0.0F, 1.0F}, "",
                    "Haze in the air: 0 is clean, 0.06 a clear day, 0.3 a dull one; a low sun is weaker and "
                    "redder in it")
            .number("warmth", &SunStyle::warmth, {0.0F, 1.0F}, "",
                    "Share of the air's colour that the light takes on")
            .number("moon", &SunStyle::moon, {0.0F, 1.0F}, "",
                    "Light of the night, from a full moon across from the sun, as a share of noon's");
    return table;
}

} // namespace estampe::light
