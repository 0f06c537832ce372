// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <estampe/vector_drawing.hpp>

namespace estampe::frame {

/// The parts of a stroke that lie on the page. A closed one that leaves it falls into open ones; nothing for
/// a stroke without length.
[[nodiscard]] std::vector<VectorStroke> clipped(const VectorStroke& stroke, const glm::vec2& page_mm);

} // namespace estampe::frame
