// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

namespace features {
struct StyleTables;
}

/// How a picture is drawn: every parameter of every technique, with a value.
///
/// A default-constructed style is the house's default. Copying is deep and cheap (a few hundred bytes).
class Style {
public:
    Style();
    ~Style();
    Style(const Style&);
    Style(Style&&) noexcept;
    Style& operator=(const Style&);
    Style& operator=(Style&&) noexcept;

    /// Reads a TOML file, or the preset of that name. Throws Error with file:line:column, the key, what is
    /// allowed, and the nearest known key for an unknown one.
    [[nodiscard]] static Style load(const std::string& file_or_preset);

    /// Applies one assignment, "hatch.contrast=12". Throws Error as load() does.
    void set(std::string_view assignment);

    /// The value of a number, by its key: "haze.reach_m"; of a toggle 0 or 1. Throws Error for a key that is
    /// none, or is of another type.
    [[nodiscard]] double number(std::string_view key) const;

    /// The same of a colour, sRGB of 0 to 1: "sky.horizon".
    [[nodiscard]] glm::vec3 color(std::string_view key) const;

    /// The same of a choice or a text: "light.metering".
    [[nodiscard]] std::string text(std::string_view key) const;

    /// Every parameter with its value, as a TOML text that load() reads back to an equal style.
    [[nodiscard]] std::string to_toml() const;

    /// Where its sun stands, for framing_camera(). Throws Error for a date that is none.
    [[nodiscard]] SunBearing sun_bearing() const;

    /// Width by height of what the page's margin leaves of a picture of this size, for framing_camera(). A
    /// camera's vertical field of view is that of this window.
    [[nodiscard]] double window_aspect(uint32_t width, uint32_t height) const;

    /// The manual of all parameters: name, type, range, default, unit and one line of help each.
    [[nodiscard]] static std::string help();

    /// All parameters as a JSON schema (2020-12), with which editors complete and check TOML files.
    [[nodiscard]] static std::string json_schema();

    /// Names of the presets that load() knows.
    [[nodiscard]] static std::vector<std::string> presets();

    /// What a preset looks like, in a line. Throws Error when there is none of that name.
    [[nodiscard]] static std::string about(const std::string& preset);

    [[nodiscard]] const features::StyleTables& tables() const { return *tables_; }

    [[nodiscard]] features::StyleTables& tables() { return *tables_; }

private:
    std::unique_ptr<features::StyleTables> tables_;
};

} // namespace estampe
