// SPDX-License-Identifier: MIT
#pragma once

// What tests of effects in whole pictures share.

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "support/gpu_device.hpp"

namespace estampe::test {

/// Paper without grain, nothing on the page but the scene, without lines; then `more`, then `assignments`.
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

/// Whether a pass of the last picture has `name` in its own.
[[nodiscard]] inline bool has_pass(const char* name)
{
    return shared_renderer().graph_dot().find(name) != std::string::npos;
}

/// How many pixels differ.
[[nodiscard]] inline size_t changed_pixels(const Image& a, const Image& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        count += std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]) ? 0 : 1;
    }
    return count;
}

/// Most that a byte of a picture of 240 x 180 pixels differs when it is drawn in tiles.
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
