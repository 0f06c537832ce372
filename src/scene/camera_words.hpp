// SPDX-License-Identifier: MIT
#pragma once

// Reads cameras that are written as words, "eye=1,2,3 fov=35 ortho".

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

namespace estampe {

/// The words of one text, each "key=value" or a key alone. Numbers are read when they are asked for. Every
/// problem is an Error that shows the right form.
class CameraWords {
public:
    /// `form` says how the text is written, with an example, and outlives this object. `lone` are the keys
    /// that may stand without a value.
    CameraWords(const std::string& text, const char* form, std::initializer_list<std::string_view> keys,
                std::initializer_list<std::string_view> lone);

    /// Whether the key stands there, with a value or without.
    [[nodiscard]] bool has(std::string_view key) const;
    /// The number after the key; nothing if the key is missing or stands alone.
    [[nodiscard]] std::optional<double> number(std::string_view key) const;
    /// The three numbers after the key; nothing if it is missing.
    [[nodiscard]] std::optional<glm::dvec3> vector(std::string_view key) const;
    /// The vertical angle of view in degrees, checked; nothing if it is missing.
    [[nodiscard]] std::optional<double> fov_deg() const;
    /// Half the height of a parallel projection in metres, checked; nothing if it is missing.
    [[nodiscard]] std::optional<double> half_height_m() const;

    [[noreturn]] void refuse(const std::string& what) const;

private:
    [[nodiscard]] std::optional<std::string_view> value(std::string_view key) const;
    [[nodiscard]] double parse(std::string_view key, std::string_view digits) const;

    std::string text_;
    const char* form_;
    std::map<std::string, std::optional<std::string>, std::less<>> words_;
};

} // namespace estampe
