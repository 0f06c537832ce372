// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace estampe::terrain {

/// A whole number of cells as shaders count them: beyond what 32 bits hold they go round.
[[nodiscard]] inline uint32_t wrapped_cells(double whole)
{
    return static_cast<uint32_t>(static_cast<int64_t>(std::fmod(whole, 4294967296.0)));
}

} // namespace estampe::terrain
