// SPDX-License-Identifier: MIT
#pragma once

// Lets plain GLSL of src/shaders be compiled as C++, so that a test can call the very functions that the
// shaders call: include the .glsl inside a namespace that has `using namespace estampe::test::glsl`.

#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace estampe::test::glsl {

using namespace glm; // NOLINT(google-build-using-namespace): GLSL's names are the point
using uint = uint32_t;

} // namespace estampe::test::glsl
