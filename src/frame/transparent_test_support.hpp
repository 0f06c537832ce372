// SPDX-License-Identifier: MIT
#pragma once

// Shared by tests of pictures on transparent paper.

#include <initializer_list>

#include <estampe/renderer.hpp>

namespace estampe {

inline constexpr RenderSettings transparent_page{.width = 200, .height = 120};
inline const Camera transparent_camera{.eye = {3.0, 2.0, 5.0}, .target = {0.0, 0.5, 0.0}};

/// A style without paper grain, with further assignments.
[[nodiscard]] inline Style grainless_style(std::initializer_list<const char*> assignments)
{
    Style style;
    style.set("paper.grain=0");
    for (const char* const assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

} // namespace estampe
