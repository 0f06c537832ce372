// SPDX-License-Identifier: MIT
#include "techniques/tam/tam_style.hpp"

#include "style/parameter.hpp"

namespace estampe::tam {

const style::Table<TamStyle>& tam_table()
{
    static const auto table =
        style::Table<TamStyle>("tam", "Tonal art maps, nested strokes that `estampe tam` draws")
            .integer("size_px", &TamStyle::size_px, {32, 2048}, "px", "Side of the map, a power of two")
            .integer("tones", &TamStyle::tones, {4, 8}, "", "Number of darknesses")
            .number("lightest", &TamStyle::lightest, {0.02F, 0.5F}, "", "Ink of the lightest tone")
            .number("darkest", &TamStyle::darkest, {0.3F, 0.97F}, "", "Ink of the darkest tone")
            .number("curve", &TamStyle::curve, {0.25F, 4.0F}, "",
                    "Above 1 more of the tones are light, below 1 more are dark")
            .choice("tool", &TamStyle::tool,
                    {{"pen", Tool::pen},
                     {"pencil", Tool::pencil},
                     {"charcoal", Tool::charcoal},
                     {"burin", Tool::burin},
                     {"brush", Tool::brush}},
                    "What draws the strokes, unless --brush gives a picture of one")
            .number("width_px", &TamStyle::width_px, {1.0F, 24.0F}, "px", "Width of a stroke, in every level")
            .number("length_px", &TamStyle::length_px, {8.0F, 1000.0F}, "px",
                    "Length of a stroke in the level it is drawn for")
            .number("length_spread", &TamStyle::length_spread, {0.0F, 0.9F}, "",
                    "How much the lengths of strokes differ")
            .number("taper_px", &TamStyle::taper_px, {0.0F, 300.0F}, "px",
                    "Length over which a stroke thins to its end")
            .number("tip", &TamStyle::tip, {0.2F, 1.0F}, "", "Width at the very end, as a share")
            .number("pressure", &TamStyle::pressure, {0.0F, 0.8F}, "",
                    "How much the width varies along a stroke")
            .number("opacity", &TamStyle::opacity, {0.6F, 1.0F}, "", "Ink of one stroke")
            .number("grain", &TamStyle::grain, {0.0F, 1.0F}, "",
                    "How much paper shows through pencil and charcoal, and hairs part in a brush")
            .number("bow", &TamStyle::bow, {0.0F, 0.1F}, "",
                    "How far a stroke bends, as a share of its length")
            .number("wobble", &TamStyle::wobble, {0.0F, 0.1F}, "",
                    "How far a stroke strays from its bend, as a share of its length")
            .number("angle_deg", &TamStyle::angle_deg, {-180.0F, 180.0F}, "deg",
                    "Direction of the first layer; 0 runs along u")
            .number("angle_spread_deg", &TamStyle::angle_spread_deg, {0.0F, 45.0F}, "deg",
                    "How much directions differ within a layer")
            .integer("second_from", &TamStyle::second_from, {1, 9}, "",
                     "First tone that a second layer crosses; 9 for none")
            .number("second_deg", &TamStyle::second_deg, {-180.0F, 180.0F}, "deg",
                    "Turn of the second layer against the first")
            .integer("third_from", &TamStyle::third_from, {1, 9}, "",
                     "First tone that a third layer crosses; 9 for none")
            .number("third_deg", &TamStyle::third_deg, {-180.0F, 180.0F}, "deg",
                    "Turn of the third layer against the first")
            .integer("candidates", &TamStyle::candidates, {1, 1000}, "",
                     "Strokes tried for each that is kept; more are more even and take longer")
            .integer("seed", &TamStyle::seed, {0, 1000000}, "", "Another number, another hand")
            .by_surface_but({});
    return table;
}

} // namespace estampe::tam
