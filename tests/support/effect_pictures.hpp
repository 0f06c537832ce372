// SPDX-License-Identifier: MIT
#pragma once

// Functions shared by tests of effects in whole pictures.

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "support/gpu_device.hpp"

namespace estampe::test {

/// A style with paper without grain, and without ground and lines. `more` and then `assignments` change it.
[[nodiscard]] inline Style effect_style(std::initializer_list<const char*> more,
                                        const std::vector<std::string>& assignments)
{
    Style style;
    for (const char* flat : {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0",
                             "picture.ground=false", "contour.enabled=false"}) {
        style.set(flat);
    }
    for (const char* assignment : more) {
        style.set(assignment);
    }
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

/// Whether the name of a pass of the last picture contains `name`.
[[nodiscard]] inline bool has_pass(const char* name)
{
    return shared_renderer().graph_dot().find(name) != std::string::npos;
}

/// Number of pixels that differ between two pictures.
[[nodiscard]] inline size_t changed_pixels(const Image& a, const Image& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        count += std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]) ? 0 : 1;
    }
    return count;
}

/// Largest difference of any byte between a picture of 240 x 180 pixels and this picture drawn in tiles.
[[nodiscard]] inline int most_between_tiles(const Camera& camera, const Style& style, uint32_t tile_px)
{
    RenderSettings settings{.width = 240, .height = 180};
    const Image whole = shared_renderer().render(camera, style, settings);
    settings.tile_px = tile_px;
    const Image tiled = shared_renderer().render(camera, style, settings);
    int most = 0;
    for (size_t i = 0; i < whole.rgba.size(); ++i) {
        most = std::max(most, std::abs(int{whole.rgba[i]} - int{tiled.rgba[i]}));
    }
    return most;
}

} // namespace estampe::test
