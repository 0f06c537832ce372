// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

namespace estampe::style {

/// The linear colour of an sRGB-encoded one, components 0..1 (IEC 61966-2-1).
[[nodiscard]] glm::vec3 linear_from_srgb(const glm::dvec3& srgb);

/// The sRGB encoding of a linear colour, components 0..1.
[[nodiscard]] glm::dvec3 srgb_from_linear(const glm::vec3& linear);

/// The linear colour of 0xrrggbb in sRGB: `glm::vec3 ink = style::srgb(0x1b1a22);`
[[nodiscard]] glm::vec3 srgb(uint32_t rrggbb);

/// "#rrggbb" or "#rgb" in sRGB as a linear colour; nothing when `text` is not one.
[[nodiscard]] std::optional<glm::vec3> parse_color(std::string_view text);

/// The TOML value of a linear colour: "#rrggbb" in quotes when that says it exactly, else [r, g, b] in sRGB
/// with as many digits as read back to the same three floats.
[[nodiscard]] std::string format_color(const glm::vec3& linear);

} // namespace estampe::style
