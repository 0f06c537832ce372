// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace estampe {

/// Integer hash after O'Neill's PCG output permutation, as surveyed by Jarzynski and Olano, "Hash Functions
/// for GPU Rendering", JCGT 2020. The numbers of shaders/hash.glsl.
[[nodiscard]] constexpr uint32_t hash(uint32_t x)
{
    const uint32_t state = x * 747796405U + 2891336453U;
    const uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

} // namespace estampe
