// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

namespace estampe::subsurface {

struct SubsurfaceStyle {
    bool drawn = false;
    float scatter_m = 0.004F;
    glm::vec3 scatter_color = style::srgb(0xffa58a);
    float depth_m = 0.02F;
    glm::vec3 tint = style::srgb(0xd95a3a);
    float strength = 1.0F;
    float reach_mm = 20.0F;
};

inline const style::Table<SubsurfaceStyle>& subsurface_table()
{
    static const auto table =
        style::Table<SubsurfaceStyle>("subsurface", "Light that goes into things: skin, wax, leaves")
            .toggle("drawn", &SubsurfaceStyle::drawn, "Whether any does")
            .number("scatter_m", &SubsurfaceStyle::scatter_m, {0.0F, 1e4F}, "m",
                    "Measure of how far light spreads under the surface: half of it comes out within one "
                    "and a half of this; 0: where it went in")
            .color("scatter_color", &SubsurfaceStyle::scatter_color,
                   "How far each colour spreads, its channels times that")
            .number("depth_m", &SubsurfaceStyle::depth_m, {0.0F, 1e4F}, "m",
                    "Thickness that leaves the tint of white light from behind; 0: none comes through")
            .color("tint", &SubsurfaceStyle::tint, "What is left of white light at that thickness")
            .number("strength", &SubsurfaceStyle::strength, {0.0F, 8.0F}, "",
                    "Of the light that comes through; 1 is as much as falls on the other side")
            .number("reach_mm", &SubsurfaceStyle::reach_mm, {0.1F, 200.0F}, "mm",
                    "How far light may spread on the page; what would go farther spreads less")
            .by_surface_but({"reach_mm"});
    return table;
}

} // namespace estampe::subsurface
