// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "techniques/focus/focus.glsl.h"

namespace estampe::focus {

struct FocusStyle {
    bool enabled = false;
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

[[nodiscard]] const style::Table<FocusStyle>& focus_table();

/// The rectangle of the page inside the margin; y points down.
struct Window {
    glm::vec2 min_px{0.0F};
    glm::vec2 max_px{0.0F};
};

/// The point of the page to which focus lines converge.
[[nodiscard]] glm::vec2 middle_px(const FocusStyle& style, const Window& window);

/// Makes all focus lines of a picture; each extends beyond the window. Cost: linear in lines.
[[nodiscard]] std::vector<shared::FocusLine> focus_lines(const FocusStyle& style, const Window& window,
                                                         float pixels_per_mm, double time_s);

struct FocusInputs {
    gpu::BufferId lines; ///< buffer of shared::FocusLine
    uint32_t line_count = 0;
    glm::vec2 middle_px{0.0F};
    glm::uvec2 size_px{0};
};

/// Draws focus lines over `ink`, the layer of contours: square root of linear colour, coverage in alpha.
/// Where both have ink, the ink with more coverage wins. Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_focus(gpu::Graph& graph, const FocusInputs& in, const FocusStyle& style,
                                     gpu::ImageId ink);

} // namespace estampe::focus
