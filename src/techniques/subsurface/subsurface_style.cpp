// SPDX-License-Identifier: MIT
#include "techniques/subsurface/subsurface_style.hpp"

#include "style/parameter.hpp"

namespace estampe::subsurface {

const style::Table<SubsurfaceStyle>& subsurface_table()
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
            .number("sheet_m", &SubsurfaceStyle::sheet_m, {0.0F, 1e4F}, "m",
                    "How thick sheets are, which have no far side")
            .number("behind", &SubsurfaceStyle::behind, {0.0F, 1.0F}, "",
                    "How much is seen of what lies behind: 0 nothing, 1 all that the tint lets through")
            .number("behind_blur", &SubsurfaceStyle::behind_blur, {0.0F, 8.0F}, "",
                    "How much thickness blurs what lies behind: the blur's deviation in the scene by the "
                    "thickness of all that is looked through")
            .toggle(
                "transmission", &SubsurfaceStyle::transmission,
                "Whether what the file says is seen through (glTF's transmission and volume) is, where the "
                "style has no behind for it")
            .number("reach_mm", &SubsurfaceStyle::reach_mm, {0.1F, 200.0F}, "mm",
                    "How far light may spread on the page; what would go farther spreads less")
            .choice("space", &SubsurfaceStyle::space, {{"page", Space::page}, {"texture", Space::texture}},
                    "Where it spreads: on the page, between what is seen; or in a map that lies on all "
                    "surfaces, also from what is not seen")
            .integer("texels", &SubsurfaceStyle::texels, {64, 4096}, "texels", "Of texture: the map's side")
            .by_surface_but({"reach_mm", "space", "texels"});
    return table;
}

} // namespace estampe::subsurface
