// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "techniques/focus/focus.glsl.h"

namespace estampe::focus {

struct FocusStyle {
    bool drawn = false;
    float x = 0.5F;
    float y = 0.5F;
    float clear = 0.75F;
    float ragged = 0.35F;
    float width_mm = 1.3F;
    float spacing_mm = 2.6F;
    float bundles = 0.6F;
    glm::vec3 ink = style::srgb(0x0d0c10);
    float redraws_per_s = 0.0F;
    int seed = 1;
};

inline const style::Table<FocusStyle>& focus_table()
{
    static const auto table =
        style::Table<FocusStyle>("focus", "Focus lines, from the edge of the picture towards what matters")
            .toggle("drawn", &FocusStyle::drawn, "Whether there are any")
            .number("x", &FocusStyle::x, {-1.0F, 2.0F}, "",
                    "Where they point, as a share of the picture's width from its left")
            .number("y", &FocusStyle::y, {-1.0F, 2.0F}, "", "And of its height from above")
            .number("clear", &FocusStyle::clear, {0.0F, 3.0F}, "",
                    "Size of the oval they leave free, as a share of the picture's")
            .number("ragged", &FocusStyle::ragged, {0.0F, 1.0F}, "", "How much they differ in length")
            .number("width_mm", &FocusStyle::width_mm, {0.05F, 20.0F}, "mm",
                    "Width of a usual one at the edge")
            .number("spacing_mm", &FocusStyle::spacing_mm, {0.2F, 100.0F}, "mm",
                    "From one to the next at the edge, on average")
            .number("bundles", &FocusStyle::bundles, {0.0F, 1.0F}, "",
                    "How much they come in bundles with gaps between")
            .color("ink", &FocusStyle::ink, "Colour of their ink")
            .number("redraws_per_s", &FocusStyle::redraws_per_s, {0.0F, 60.0F}, "",
                    "How often they are drawn anew as time goes by; 0 leaves them as they are")
            .integer("seed", &FocusStyle::seed, {0, 1000000}, "", "Another number, another hand");
    return table;
}

/// The rectangle that is drawn on, y down.
struct Window {
    glm::vec2 min_px{0.0F};
    glm::vec2 max_px{0.0F};
};

/// What focus lines point at.
[[nodiscard]] glm::vec2 middle_px(const FocusStyle& style, const Window& window);

/// All lines of a picture; each reaches out of the window. Cost: linear in lines.
[[nodiscard]] std::vector<shared::FocusLine> focus_lines(const FocusStyle& style, const Window& window,
                                                         float pixels_per_mm, double time_s);

struct FocusInputs {
    gpu::BufferId lines; ///< shared::FocusLine
    uint32_t line_count = 0;
    glm::vec2 middle_px{0.0F};
    glm::uvec2 size_px{0};
};

/// Draws focus lines over `ink`, a layer as of contours: square root of linear colour, coverage in alpha.
/// Where both are the darker stands. Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_focus(gpu::Graph& graph, const FocusInputs& in, const FocusStyle& style,
                                     gpu::ImageId ink);

} // namespace estampe::focus
