// SPDX-License-Identifier: MIT
#include <estampe/style.hpp>

#include <cmath>

#include "frame/style_tables.hpp"
#include "style/presets.hpp"
#include "techniques/light/daylight.hpp"

namespace estampe {

Style::Style() : tables_(std::make_unique<frame::StyleTables>()) {}

Style::~Style() = default;

Style::Style(const Style& other) : tables_(std::make_unique<frame::StyleTables>(*other.tables_)) {}

Style::Style(Style&&) noexcept = default;

Style& Style::operator=(const Style& other)
{
    *tables_ = *other.tables_;
    return *this;
}

Style& Style::operator=(Style&&) noexcept = default;

Style Style::load(const std::string& file_or_preset)
{
    Style style;
    frame::sheet_of(*style.tables_).read(file_or_preset);
    return style;
}

void Style::set(std::string_view assignment)
{
    frame::sheet_of(*tables_).set(assignment);
}

std::string Style::to_toml() const
{
    frame::StyleTables copy = *tables_;
    return frame::sheet_of(copy).to_toml();
}

SunBearing Style::sun_bearing() const
{
    const light::LightStyle& light = tables_->light;
    if (const auto daylight = light::daylight_of(tables_->sun)) {
        const glm::dvec3& towards = daylight->towards_sun;
        return {.azimuth_deg = glm::degrees(std::atan2(towards.x, towards.z)),
                .elevation_deg = glm::degrees(std::asin(towards.y)),
                .turns = false,
                .rules = true};
    }
    return {.azimuth_deg = light.sun_azimuth_deg,
            .elevation_deg = light.sun_elevation_deg,
            .turns = light.turn_sun,
            .rules = light.source == light::LightSource::sun};
}

std::string Style::help()
{
    frame::StyleTables defaults;
    return frame::sheet_of(defaults).help();
}

std::vector<std::string> Style::presets()
{
    return style::preset_names();
}

} // namespace estampe
