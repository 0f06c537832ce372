// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/read_scope.hpp>
#include <estampe/scene.hpp>

namespace estampe {

namespace features {
struct StyleTables;
}

/// All drawing parameters of a picture: one value for every parameter of every technique.
///
/// A default-constructed style holds the default of every parameter. Copying is deep and cheap (a few
/// hundred bytes).
class Style {
public:
    Style();
    ~Style();
    Style(const Style&);
    Style(Style&&) noexcept;
    Style& operator=(const Style&);
    Style& operator=(Style&&) noexcept;

    /// Reads a style: a preset by its name, or a TOML file by its path. `name` may join several by '+', such
    /// as "comic+no-color"; each part overrides the parameters that it sets. Throws Error with
    /// file:line:column, the key, and the allowed values. For an unknown name or key, the Error also has the
    /// nearest known one.
    ///
    /// `scope` limits the files that are read: those of `name`, those that they extend, and, when a picture
    /// is drawn, all files that parameters name. Messages show no content of a file that is extended, because
    /// that file may be no style.
    [[nodiscard]] static Style load(const std::string& name, const ReadScope& scope = {});

    /// Returns the folders of the files that `name` names, as load() splits it, for a ReadScope that confines
    /// the style to them. Presets have no folder, so the scope has no limit if `name` names presets alone.
    /// Throws Error if `name` joins an empty part. Looks up which parts are existing files.
    [[nodiscard]] static ReadScope scope_of(const std::string& name);

    /// Limits the files that parameters name to `scope`, also those that set() has named.
    void limit_files(const ReadScope& scope);

    /// Applies one assignment of a style parameter, such as "hatch.contrast=12". Throws Error as load() does.
    void set(std::string_view assignment);

    /// Returns a numeric parameter by its key, such as "haze.reach_m"; a toggle is 0 or 1. Throws Error for
    /// an unknown key or a parameter of another type.
    [[nodiscard]] double number(std::string_view key) const;

    /// Returns a colour parameter by its key, such as "sky.horizon": sRGB components from 0 to 1. Throws
    /// Error as number() does.
    [[nodiscard]] glm::vec3 color(std::string_view key) const;

    /// Returns a choice or text parameter by its key, such as "light.metering". Throws Error as number()
    /// does.
    [[nodiscard]] std::string text(std::string_view key) const;

    /// Writes all parameters of the style as TOML. load() reads the TOML back to an equal style.
    [[nodiscard]] std::string to_toml() const;

    /// Returns the files that the style's parameters name, such as brushes and maps: files, or folders of
    /// files. The files need not exist.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

    /// Returns the direction of the style's sun, for framing_camera(). Throws Error if the style's date is
    /// not valid.
    [[nodiscard]] SunBearing sun_bearing() const;

    /// Returns the aspect (width / height) of the page without its margin, for framing_camera(). A camera's
    /// vertical field of view covers the page without its margin.
    [[nodiscard]] double window_aspect(uint32_t width, uint32_t height) const;

    /// Returns the manual of all parameters: name, type, range, default, unit and one line of help for each.
    /// `section` is the name of one section, such as "hatch"; empty for all sections. Throws Error if the
    /// style has no section of that name.
    [[nodiscard]] static std::string help(std::string_view section = {});

    /// Returns a JSON schema (2020-12) of all style parameters, with which editors complete and check style
    /// files.
    [[nodiscard]] static std::string json_schema();

    /// Names of the presets that load() accepts.
    [[nodiscard]] static std::vector<std::string> presets();

    /// Names of the additions that load() accepts after a preset, such as "no-color" in "comic+no-color".
    [[nodiscard]] static std::vector<std::string> additions();

    /// Returns one line that describes the look of a preset, or what an addition changes. Throws Error if no
    /// preset or addition has the name.
    [[nodiscard]] static std::string about(const std::string& preset);

    [[nodiscard]] const features::StyleTables& tables() const { return *tables_; }

    [[nodiscard]] features::StyleTables& tables() { return *tables_; }

private:
    std::unique_ptr<features::StyleTables> tables_;
};

} // namespace estampe
