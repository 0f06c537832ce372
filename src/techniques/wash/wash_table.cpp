// SPDX-License-Identifier: MIT
#include "techniques/wash/wash.hpp"

#include "style/parameter.hpp"

namespace estampe::wash {

const style::Table<WashStyle>& wash_table()
{
    static const auto table =
        style::Table<WashStyle>("wash", "Flat colour by material, cooler in shadow")
            .number("strength", &WashStyle::strength, {0.0F, 1.0F}, "",
                    "0 leaves the paper bare, 1 is full colour")
            .number("neutral", &WashStyle::neutral, {0.0F, 1.0F}, "",
                    "Share of the strength that greys are painted with")
            .number("saturation", &WashStyle::saturation, {0.0F, 1.0F}, "",
                    "0 paints greys alone, 1 the materials' colours")
            .number("detail", &WashStyle::detail, {0.0F, 1.0F}, "",
                    "0 is one flat colour a material, 1 its whole texture")
            .number("least", &WashStyle::least, {0.0F, 1.0F}, "",
                    "Brightness, as a share of white, that dark colours are lifted towards: strokes tell how "
                    "dark a thing is")
            .color("shadow_tint", &WashStyle::shadow_tint, "Laid over the colour in shadow")
            .number("shadow_from", &WashStyle::shadow_from, {0.0F, 1.0F}, "",
                    "Darkness at which shadow begins")
            .number("softness", &WashStyle::softness, {0.001F, 0.5F}, "",
                    "Half the width of that step, in darkness")
            .number("light_tint", &WashStyle::light_tint, {0.0F, 1.0F}, "",
                    "How far coloured light colours what it falls on")
            .number("air", &WashStyle::air, {0.0F, 1.0F}, "", "Share of the air's colour in the far distance")
            .color("air_color", &WashStyle::air_color, "Colour of the air")
            .number("air_distance_m", &WashStyle::air_distance_m, {0.001F, 1e6F}, "m",
                    "Distance by which half of the air's colour is reached")
            .by_surface_but({});
    return table;
}

} // namespace estampe::wash
