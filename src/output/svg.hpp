// SPDX-License-Identifier: MIT
#pragma once

// Encodes drawings as SVG.

#include <string>

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

/// Escapes text for XML attributes; characters that XML cannot hold become a space or a question mark.
[[nodiscard]] std::string escaped(const std::string& text);

/// Encodes a drawing as the SVG file of save_svg(). Throws Error as save_svg() does, but without a file name.
[[nodiscard]] std::string encode_svg(const VectorDrawing& drawing, const SvgSettings& settings);

} // namespace estampe::output
