// SPDX-License-Identifier: MIT
#pragma once

// Drawings as SVG.

#include <string>

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

/// Text between quotes: what XML would take for its own is written out, what it cannot hold becomes a space
/// or a question mark.
[[nodiscard]] std::string escaped(const std::string& text);

/// As save_svg() writes it. Throws Error as that does, but names no file.
[[nodiscard]] std::string encode_svg(const VectorDrawing& drawing, const SvgSettings& settings);

} // namespace estampe::output
