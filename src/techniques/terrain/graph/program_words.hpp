// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

/// A program as height_program.glsl reads it.
struct ProgramWords {
    std::vector<uint32_t> words; ///< places, parameters, instructions
    uint32_t first_parameter = 0;
    uint32_t first_instruction = 0;
};

[[nodiscard]] ProgramWords program_words(const Program& program, const glm::dvec2& origin_m, double time_s);

} // namespace estampe::terrain
