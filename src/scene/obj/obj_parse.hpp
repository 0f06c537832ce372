// SPDX-License-Identifier: MIT
#pragma once

#include "scene/input/input.hpp"
#include "scene/obj/obj_data.hpp"

namespace estampe::obj {

/// Reads all lines of an OBJ file. Whatever they hold, corners of pieces are in range afterwards, and what
/// was not understood is counted. Memory: the arrays of the file's numbers, and twelve bytes for each corner
/// of a triangle. Cost: about 0.4 s for a million triangles.
[[nodiscard]] Data parse(Input& input);

} // namespace estampe::obj
