// SPDX-License-Identifier: MIT
// Implements the public interface of styles and tonal art maps.
#include <cmath>
#include <filesystem>
#include <optional>
#include <variant>

#include <estampe/error.hpp>
#include <estampe/style.hpp>
#include <estampe/tonal_art_map.hpp>

#include "features/common/style_tables.hpp"
#include "style/parameter.hpp"
#include "style/schema.hpp"
#include "techniques/light/daylight.hpp"
#include "techniques/tam/files/map_files.hpp"
#include "techniques/tam/maker.hpp"
#include "techniques/tam/tonal_art_map.hpp"

namespace estampe {

namespace {

/// Returns the value of a style parameter; none for an unknown key.
std::optional<style::Value> value_of(const features::StyleTables& tables, std::string_view key)
{
    const auto [section, parameter] = features::style_schema().find(key);
    return parameter == nullptr ? std::nullopt : std::optional(parameter->get(section->place.in(&tables)));
}

} // namespace

Style::Style() : tables_(std::make_unique<features::StyleTables>()) {}

Style::~Style() = default;

Style::Style(const Style& other) : tables_(std::make_unique<features::StyleTables>(*other.tables_)) {}

Style::Style(Style&&) noexcept = default;

Style& Style::operator=(const Style& other)
{
    *tables_ = *other.tables_;
    return *this;
}

Style& Style::operator=(Style&&) noexcept = default;

Style Style::load(const std::string& name, const ReadScope& scope)
{
    Style style;
    features::limit_files(*style.tables_, scope);
    for (const std::string& part : style::parts_of(name)) {
        features::style_schema().read(*style.tables_, part, scope);
    }
    return style;
}

ReadScope Style::scope_of(const std::string& name)
{
    ReadScope scope;
    for (const std::string& part : style::parts_of(name)) {
        if (!style::preset_text(part)) {
            scope.folders.push_back(ReadScope::beside(part).folders.front());
        }
    }
    return scope;
}

void Style::limit_files(const ReadScope& scope)
{
    features::limit_files(*tables_, scope);
}

void Style::set(std::string_view assignment)
{
    features::style_schema().set(*tables_, assignment);
}

double Style::number(std::string_view key) const
{
    const std::optional<style::Value> value = value_of(*tables_, key);
    if (value && std::holds_alternative<float>(*value)) {
        return static_cast<double>(std::get<float>(*value));
    }
    if (value && std::holds_alternative<int64_t>(*value)) {
        return static_cast<double>(std::get<int64_t>(*value));
    }
    if (value && std::holds_alternative<bool>(*value)) {
        return std::get<bool>(*value) ? 1.0 : 0.0;
    }
    throw Error("is no number of a style", std::string(key), "estampe --help-style all lists them");
}

glm::vec3 Style::color(std::string_view key) const
{
    const std::optional<style::Value> value = value_of(*tables_, key);
    if (!value || !std::holds_alternative<glm::vec3>(*value)) {
        throw Error("is no colour of a style", std::string(key), "estampe --help-style all lists them");
    }
    return glm::vec3(style::srgb_from_linear(std::get<glm::vec3>(*value)));
}

std::string Style::text(std::string_view key) const
{
    const std::optional<style::Value> value = value_of(*tables_, key);
    if (!value || !std::holds_alternative<std::string>(*value)) {
        throw Error("is no choice or text of a style", std::string(key),
                    "estampe --help-style all lists them");
    }
    return std::get<std::string>(*value);
}

std::vector<std::filesystem::path> Style::files() const
{
    return features::style_schema().files(*tables_);
}

std::string Style::to_toml() const
{
    return features::style_schema().to_toml(*tables_);
}

SunBearing Style::sun_bearing() const
{
    const light::LightStyle& light = tables_->light;
    const bool throws = light.shadows;
    const style::AutoToggle ground = tables_->picture.ground;
    const std::optional<bool> on_blank_ground = ground == style::AutoToggle::automatic
                                                    ? std::nullopt
                                                    : std::optional(ground == style::AutoToggle::on);
    if (const auto daylight = light::daylight_of(tables_->sun)) {
        const glm::dvec3& towards = daylight->towards_sun;
        return {.azimuth_deg = glm::degrees(std::atan2(towards.x, towards.z)),
                .elevation_deg = glm::degrees(std::asin(towards.y)),
                .turns = false,
                .rules = true,
                .throws = throws,
                .on_blank_ground = on_blank_ground};
    }
    return {.azimuth_deg = light.sun_azimuth_deg,
            .elevation_deg = light.sun_elevation_deg,
            .turns = light.turn_sun,
            .rules = light.source == light::LightSource::sun,
            .throws = throws,
            .on_blank_ground = on_blank_ground};
}

double Style::window_aspect(uint32_t width, uint32_t height) const
{
    const paper::PaperStyle& paper = tables_->paper;
    const paper::Window window =
        paper::window_of(paper, paper.height_mm * static_cast<float>(width) / static_cast<float>(height));
    const glm::dvec2 size_mm(window.max_mm - window.min_mm);
    return size_mm.x / size_mm.y;
}

std::string Style::help(std::string_view section)
{
    return features::style_schema().help(section);
}

std::string Style::json_schema()
{
    return features::style_schema().json_schema();
}

std::string Style::about(const std::string& preset)
{
    const auto text = style::preset_text(preset);
    if (!text) {
        throw Error("there is no such preset", preset, "estampe styles lists them");
    }
    return std::string(text->substr(2, text->find('\n') - 2));
}

std::vector<std::string> Style::presets()
{
    return style::preset_names();
}

std::vector<std::string> Style::additions()
{
    return style::addition_names();
}

TonalArtMap draw_tonal_art_map(const Style& style, const Image* stroke)
{
    features::StyleTables room;
    return tam::make_map(features::with_drawing(style.tables(), room).tam, stroke);
}

PaintedMap load_tonal_art_map(const std::filesystem::path& path, const ReadScope& scope)
{
    return tam::read_map(path, scope);
}

void save_tonal_art_map(const TonalArtMap& map, const std::filesystem::path& path)
{
    tam::write_map(map, path);
}

bool is_map_folder(const std::filesystem::path& path)
{
    return tam::is_folder_name(path);
}

Image map_sheet(const TonalArtMap& map, const Style& style)
{
    tam::check_map(map, {});
    const paper::PaperStyle& page = style.tables().paper;
    return tam::preview_sheet(map, page.color, page.ink);
}

} // namespace estampe
