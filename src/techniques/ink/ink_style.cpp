// SPDX-License-Identifier: MIT
#include "techniques/ink/ink_style.hpp"

#include "style/parameter.hpp"

namespace estampe::ink {

const style::Table<InkStyle>& ink_table()
{
    static const auto table =
        style::Table<InkStyle>("ink", "Ink that flows out of the drawing")
            .toggle("drawn", &InkStyle::drawn, "Whether there is any")
            .choice(
                "follow", &InkStyle::follow,
                {{"page", Follow::page},
                 {"turn", Follow::turn},
                 {"advance", Follow::advance},
                 {"around", Follow::around},
                 {"surface", Follow::surface}},
                "When the camera moves, ink stays on the page, turns with what is far, grows with what comes "
                "nearer, lies on a cube around the eye, or stays on what it was laid on")
            .choice("source", &InkStyle::source,
                    {{"strokes", Source::strokes}, {"light", Source::light}, {"things", Source::things}},
                    "What gives ink: dark strokes and lines, what is brightly lit, or all that is seen")
            .text("objects", &InkStyle::objects,
                  "Objects that give ink, as patterns with commas between them: \"Fox, Tower*\"")
            .number("threshold", &InkStyle::threshold, {0.0F, 0.99F}, "",
                    "Strokes and light weaker than this give none")
            .number("amount_per_s", &InkStyle::amount_per_s, {0.0F, 1000.0F}, "1/s",
                    "How fast a spot that gives ink fills up")
            .number("spot_mm", &InkStyle::spot_mm, {0.05F, 20.0F}, "mm",
                    "Radius of a spot that gives ink, at most half the spacing; threads are about as wide")
            .number("spacing_mm", &InkStyle::spacing_mm, {0.2F, 200.0F}, "mm", "From one spot to the next")
            .number("spot_s", &InkStyle::spot_s, {0.1F, 1000.0F}, "s",
                    "How long a spot gives ink before another one does")
            .number("wind_mm_s", &InkStyle::wind_mm_s, {0.0F, 500.0F}, "mm/s",
                    "Speed on the page at which all ink drifts")
            .number("wind_deg", &InkStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Where to: 0 is to the right, 90 is up")
            .number("swirl_mm", &InkStyle::swirl_mm, {1.0F, 1000.0F}, "mm", "Size of the largest swirls")
            .number("swirl_mm_s", &InkStyle::swirl_mm_s, {0.0F, 500.0F}, "mm/s", "Speed of the swirls")
            .number("turn_s", &InkStyle::turn_s, {0.1F, 1000.0F}, "s", "How long a swirl takes to change")
            .number("solved", &InkStyle::solved, {0.0F, 1.0F}, "",
                    "How far swirls are water that they stir, worked out, in place of themselves")
            .file("flow_map", &InkStyle::flow_map,
                  "Picture whose red and green say where ink flows, to the right and down: 0.5 is not at all")
            .number("flow_mm_s", &InkStyle::flow_mm_s, {0.0F, 500.0F}, "mm/s",
                    "Speed at the picture's full red or green")
            .number("drag", &InkStyle::drag, {0.0F, 1.0F}, "",
                    "How far a moving object takes the ink along that lies on it; on surfaces it takes all")
            .text(
                "zones", &InkStyle::zones,
                "What objects without a mesh do to the ink around them: \"Fan=blow:20, Well=give:1 turn:90\"")
            .number("life_s", &InkStyle::life_s, {0.05F, 1000.0F}, "s",
                    "After this long a third of the wet ink is left")
            .number("soak", &InkStyle::soak, {0.0F, 1.0F}, "",
                    "Share of what goes that stays in the paper, dry")
            .number("stain_s", &InkStyle::stain_s, {0.05F, 10000.0F}, "s",
                    "After this long a third of the dry ink is left")
            .color("color", &InkStyle::color, "Ink where there is much of it")
            .color("thin_color", &InkStyle::thin_color, "And where it is thin")
            .number("opacity", &InkStyle::opacity, {0.0F, 1.0F}, "", "How far it covers what lies under it")
            .number("sharpness", &InkStyle::sharpness, {0.0F, 1.0F}, "",
                    "Threads with edges, or soft ones that end in mist")
            .number("edge", &InkStyle::edge, {0.0F, 1.0F}, "", "How much darker its edge is than the middle")
            .number("granulation", &InkStyle::granulation, {0.0F, 1.0F}, "",
                    "How far it settles in the hollows of the paper")
            .number("budget", &InkStyle::budget, {0.001F, 1.0F}, "",
                    "Most of the page that it may cover: nearing that, less is given")
            .toggle("spills", &InkStyle::spills, "Whether it may flow over the margin of the page")
            .number("age_s", &InkStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long it has flowed in a picture that stands for itself, and in the first of a film")
            .number("steps_per_s", &InkStyle::steps_per_s, {1.0F, 240.0F}, "1/s",
                    "How often it moves on in a second, at least: less is quicker, and swirls are rougher")
            .number("cell_mm", &InkStyle::cell_mm, {0.05F, 10.0F}, "mm",
                    "Side of a cell of its grid, at least a pixel")
            .number("oversize", &InkStyle::oversize, {1.0F, 3.0F}, "",
                    "Size of its grid beside the page where it follows turn or advance")
            .integer("seed", &InkStyle::seed, {0, 1000000}, "", "Another number, other swirls");
    return table;
}

} // namespace estampe::ink
