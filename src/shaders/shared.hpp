// SPDX-License-Identifier: MIT
#pragma once

// Lets the headers named *.glsl.h compile as C++. These headers describe data that C++ and GLSL share. GLSL's
// type names become GLM's, and the scalar block layout that the shaders use is C++'s own. shaders/shared.glsl
// is the counterpart for GLSL.

#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#define SHARED_CONSTANT inline constexpr

namespace estampe::shared {

using glm::ivec2;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;

} // namespace estampe::shared
