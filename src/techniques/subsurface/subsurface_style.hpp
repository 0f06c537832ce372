// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

namespace estampe::subsurface {

/// Where light spreads: between pixels of the page, or between texels of a map that lies on all surfaces.
enum class Space : uint8_t { page, texture };

struct SubsurfaceStyle {
    bool drawn = false;
    float scatter_m = 0.004F;
    glm::vec3 scatter_color = style::srgb(0xffa58a);
    float depth_m = 0.02F;
    glm::vec3 tint = style::srgb(0xd95a3a);
    float strength = 1.0F;
    float sheet_m = 0.0F;
    float behind = 0.0F;
    float behind_blur = 0.5F;
    float behind_tint = 0.0F; ///< by the surface's own colour, of what a file says is seen through
    bool transmission = true;
    float reach_mm = 20.0F;
    Space space = Space::page;
    uint32_t texels = 512;
};

[[nodiscard]] const style::Table<SubsurfaceStyle>& subsurface_table();

} // namespace estampe::subsurface
