// SPDX-License-Identifier: MIT
#pragma once

// How much arithmetic a compiled shader does, counted in its SPIR-V.

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace estampe::gpu {

struct ShaderOps {
    /// Additions, multiplications and the like, on floats and whole numbers, of each component; a fused
    /// multiply-add is two, a square root or a sine one.
    uint64_t operations = 0;
    glm::uvec3 group{1U}; ///< threads of a workgroup
};

/// Counts what a thread comes by when no branch leaves anything out and each loop runs once, with
/// specialization constant 0 at `variant`: branches that this decides count on the side taken alone. Of
/// kernels that loop it is the least; of those that branch it may be more than is done. Throws
/// std::logic_error when the words are no SPIR-V.
///
/// Cost    linear in words, some 0.1 ms for a large shader
/// Source  Khronos, "SPIR-V Specification", version 1.6
[[nodiscard]] ShaderOps ops_of(std::span<const uint32_t> spirv, uint32_t variant);

} // namespace estampe::gpu
