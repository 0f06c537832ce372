// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "techniques/contour/chains/mesh/line_paths.hpp"

namespace estampe::contour {

/// Makes one path of those whose ends meet in a corner that is mitred in pictures, so that their corner can
/// be mitred too: of all ends at one place those two that enclose the others, as joints.comp chooses, where
/// both are as wide to a tenth and of one ink. Where that closes a path, it starts in the middle of a stroke.
/// Cost: n log n in paths.
[[nodiscard]] std::vector<LinePath> join_paths(std::vector<LinePath> paths);

} // namespace estampe::contour
