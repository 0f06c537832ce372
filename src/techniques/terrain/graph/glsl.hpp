// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "gpu/graph/graph.hpp"
#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

/// The program as a function of GLSL, `vec4 height_at(vec2 local_m, float spacing_m)`. Numbers stay in the
/// parameters, so that programs of the same form have the same text.
[[nodiscard]] std::string height_glsl(const Program& program);

/// A shader's text with the program in place of its HEIGHT_PROGRAM, compiled and optimised by the program
/// glslc. Texts that were compiled before are not compiled again; the words stay for as long as the process
/// runs. Any thread may call it. Throws Error when there is no glslc, or when it refuses the text. Cost of a
/// new text: 0.2 to 0.5 s.
[[nodiscard]] const gpu::Shader& compiled_with(const Program& program, const std::string& shader_name,
                                               const std::string& shader_text);

} // namespace estampe::terrain
