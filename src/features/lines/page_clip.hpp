// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <estampe/vector_drawing.hpp>

#include "techniques/paper/paper.hpp"

namespace estampe::features {

/// The parts of a stroke that lie within the window of the page. A closed one that leaves it falls into open
/// ones; nothing for a stroke without length.
[[nodiscard]] std::vector<VectorStroke> clipped(const VectorStroke& stroke, const paper::Window& window);

} // namespace estampe::features
