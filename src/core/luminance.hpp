// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace estampe {

/// Relative luminance of linear Rec. 709 colour; shaders/color.glsl has the same.
[[nodiscard]] inline float luminance(const glm::vec3& linear)
{
    return glm::dot(linear, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

} // namespace estampe
