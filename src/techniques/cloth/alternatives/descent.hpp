// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace estampe::cloth {

inline constexpr uint32_t sweeps_of_descent = 4; ///< of block descent over all colours in a small step

} // namespace estampe::cloth
