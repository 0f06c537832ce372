// SPDX-License-Identifier: MIT
#pragma once

// Shaders that take the place of built-in ones while the program runs, for whoever writes them.

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// From now on all devices draw with these words in place of the shader of that name; empty: with its own
/// again. Any thread may call it. The words stay for as long as the program runs.
void replace_shader(const std::string& name, std::vector<uint32_t> spirv);

/// The shader, or what replaces it. Throws Error, once, for a replacement that declares a binding that the
/// shader does not, in the same words: it is then dropped. Cost: nothing while nothing is replaced.
[[nodiscard]] Shader current_build(const Shader& shader);

} // namespace estampe::gpu
