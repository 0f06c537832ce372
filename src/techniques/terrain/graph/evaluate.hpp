// SPDX-License-Identifier: MIT
#pragma once

// A program run on the processor, by the very arithmetic of the shaders.

#include <span>

#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

/// (height, d/dx, d/dz, d/dt) at `local_m` from the origin that `places` were made for. `spacing_m`: what is
/// finer than a grid of it is left out; 0 for all. Cost: about 0.1 microseconds an instruction.
[[nodiscard]] glm::dvec4 evaluate(const Program& program, std::span<const PlaceWords> places,
                                  const glm::dvec2& local_m, double spacing_m = 0.0);

/// The same in the single precision of the GPU.
[[nodiscard]] glm::vec4 evaluate_single(const Program& program, std::span<const PlaceWords> places,
                                        const glm::vec2& local_m, float spacing_m = 0.0F);

/// What an instruction makes of constants: its inputs are numbers of instructions of `program`, not
/// registers.
[[nodiscard]] double evaluate_one(const Program& program, const Instruction& instruction);

} // namespace estampe::terrain
