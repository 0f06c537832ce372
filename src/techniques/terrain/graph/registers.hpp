// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

/// Instructions whose inputs are numbers of instructions before them, given registers, of which there are
/// few: each is free again after its last reader. Leaves out what `result`, the number of the last one that
/// is wanted, does not hang on. Throws Error with `where` when more values are alive at once than there are
/// registers. Cost: linear.
[[nodiscard]] std::vector<Instruction> with_registers(const std::vector<Instruction>& in_order,
                                                      uint32_t result, const std::string& where);

} // namespace estampe::terrain
