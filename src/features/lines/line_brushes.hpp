// SPDX-License-Identifier: MIT
#pragma once

// The brushes of lines that a style asks for.

#include <array>
#include <optional>
#include <string>

#include "techniques/contour/chains/ink/brushes.hpp"
#include "techniques/contour/contour.hpp"

namespace estampe::features {

/// What the brushes of a style depend on.
struct BrushChoice {
    /// A name of contour::brush_names() or a path; empty, for the pen, where lines of that kind are not
    /// looked for.
    std::array<std::string, shared::line_kind_count> brush_of_kind;
    contour::BrushFit fit = contour::BrushFit::repeat;
    float dash_mm = 0.0F; ///< of hidden lines; 0 for none
    float gap_mm = 0.0F;
    float dash_width_mm = 0.0F;
    bool operator==(const BrushChoice&) const = default;
};

[[nodiscard]] BrushChoice brush_choice(const contour::ContourStyle& style);

/// Whether no kind of line has another brush than the pen.
[[nodiscard]] bool is_drawn_by_pen(const contour::ContourStyle& style);

/// Draws tools by the formulas of [tam](../techniques/tam/README.md), and reads pictures. Nothing when all is
/// drawn by the pen. Throws Error naming the file when it is no picture or has no ink. Cost: 20 ms a tool.
[[nodiscard]] std::optional<contour::BrushSet> load_brushes(const contour::ContourStyle& style);

/// The brushes of a renderer, loaded when the style asks for others.
class LineBrushes {
public:
    /// What the style's lines are drawn with; none where that is the pen alone. Throws as load_brushes()
    /// does.
    contour::BrushImages* ensure(gpu::Device& device, const contour::ContourStyle& style);

private:
    std::optional<contour::BrushImages> images_;
    std::optional<BrushChoice> choice_;
};

} // namespace estampe::features
