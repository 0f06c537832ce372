// SPDX-License-Identifier: MIT
#include <estampe/style.hpp>

#include "frame/style_tables.hpp"
#include "style/presets.hpp"

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
