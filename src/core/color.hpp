// SPDX-License-Identifier: MIT
#pragma once

// Colour conversion: sRGB encoding and luminance.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include <glm/glm.hpp>

namespace estampe {

/// Relative luminance of a linear Rec. 709 colour. shaders/color.glsl has the same formula.
[[nodiscard]] inline float luminance(const glm::vec3& linear)
{
    return glm::dot(linear, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

/// Decodes an sRGB component (IEC 61966-2-1) to a linear value, both from 0 to 1.
template <std::floating_point T>
[[nodiscard]] T linear_from_srgb(T encoded)
{
    return encoded <= T(0.04045) ? encoded / T(12.92) : std::pow((encoded + T(0.055)) / T(1.055), T(2.4));
}

/// Encodes a linear value as an sRGB component, both from 0 to 1.
template <std::floating_point T>
[[nodiscard]] T srgb_from_linear(T linear)
{
    return linear <= T(0.0031308) ? linear * T(12.92) : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

/// Makes a table with the linear value of each sRGB byte.
template <std::floating_point T>
[[nodiscard]] std::array<T, 256> linear_of_srgb_bytes()
{
    std::array<T, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        table[i] = linear_from_srgb(static_cast<T>(i) / T(255));
    }
    return table;
}

} // namespace estampe
