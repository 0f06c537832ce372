// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

/// As save_svg() writes it. Throws Error as that does, but names no file.
[[nodiscard]] std::string encode_svg(const VectorDrawing& drawing, const SvgSettings& settings);

} // namespace estampe::output
