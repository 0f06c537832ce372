// SPDX-License-Identifier: MIT
#include "techniques/ink/ink_style.hpp"

#include "style/parameter.hpp"

namespace estampe::ink {

const style::Table<InkStyle>& ink_table()
{
    static const auto table =
        style::Table<InkStyle>("ink", "Flowing ink: ink that runs out of the drawing in threads and swirls")
            .toggle("enabled", &InkStyle::enabled,
                    "Turns flowing ink on: ink runs out of the drawing in threads and swirls")
            .choice("follow", &InkStyle::follow,
                    {{"page", Follow::page},
                     {"turn", Follow::turn},
                     {"advance", Follow::advance},
                     {"around", Follow::around},
                     {"surface", Follow::surface}},
                    "What flowing ink sticks to when the camera moves. page: the page; turn: the far "
                    "background; advance: a plane ahead, which grows as the camera nears it; around: a cube "
                    "around the eye; surface: the surfaces below the ink.")
            .choice("source", &InkStyle::source,
                    {{"strokes", Source::strokes}, {"light", Source::light}, {"things", Source::things}},
                    "What gives flowing ink. strokes: dark strokes and lines; light: brightly lit surfaces; "
                    "things: all visible objects.")
            .text("objects", &InkStyle::objects,
                  "Objects that give flowing ink, as name patterns with commas between them, where * stands "
                  "for any letters. Example: \"Fox, Tower*\".")
            .number("threshold", &InkStyle::threshold, {0.0F, 0.99F}, "",
                    "Weakest stroke or light that gives flowing ink: more leaves fewer sources")
            .number("amount_per_s", &InkStyle::amount_per_s, {0.0F, 1000.0F}, "1/s",
                    "How quickly a source spot of flowing ink fills up: more gives denser threads")
            .number("spot_mm", &InkStyle::spot_mm, {0.05F, 20.0F}, "mm",
                    "Radius of the spots that give flowing ink, at most half of ink.spacing_mm. Threads of "
                    "ink are about as wide.")
            .number("spacing_mm", &InkStyle::spacing_mm, {0.2F, 200.0F}, "mm",
                    "Distance from one source spot of flowing ink to the next: less gives more threads")
            .number("spot_s", &InkStyle::spot_s, {0.1F, 1000.0F}, "s",
                    "How long a spot gives flowing ink before another takes over: more gives longer threads")
            .number("wind_mm_per_s", &InkStyle::wind_mm_per_s, {0.0F, 500.0F}, "mm/s",
                    "Speed of the wind that carries all flowing ink over the page")
            .number("wind_deg", &InkStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Direction on the page towards which the wind carries flowing ink: 0 is right, 90 is up")
            .number(
                "swirl_mm", &InkStyle::swirl_mm, {1.0F, 1000.0F}, "mm",
                "Size of the largest swirls in flowing ink: less curls in small scrolls, more in wide bends")
            .number("swirl_mm_per_s", &InkStyle::swirl_mm_per_s, {0.0F, 500.0F}, "mm/s",
                    "Speed of the swirls in flowing ink: 0 leaves threads straight, more curls them up")
            .number("turn_s", &InkStyle::turn_s, {0.1F, 1000.0F}, "s",
                    "Time in which a swirl of flowing ink changes: less is restless, more is calm")
            .number("solved", &InkStyle::solved, {0.0F, 1.0F}, "",
                    "Share of simulated water in the swirls of flowing ink: 0 moves ink along smooth given "
                    "swirls, 1 along water that these stir, which sheds real eddies")
            .file(
                "flow_map", &InkStyle::flow_map,
                "Picture of directions that carry flowing ink: red to the right, green down, 0.5 not at all")
            .number(
                "flow_mm_per_s", &InkStyle::flow_mm_per_s, {0.0F, 500.0F}, "mm/s",
                "Speed of flowing ink where ink.flow_map has full red or green. Only used with ink.flow_map.")
            .number("drag", &InkStyle::drag, {0.0F, 1.0F}, "",
                    "How far ink that lies on a moving object is taken along: 0 not at all, 1 fully. Not "
                    "used when ink.follow is surface, which takes all of it.")
            .text("zones", &InkStyle::zones,
                  "Objects without a mesh that act on flowing ink around them: blow (mm/s along the object's "
                  "-z), turn (degrees per second), give, amount (strength 0 to 1). Example: \"Fan=blow:20, "
                  "Well=give:1 turn:90\".")
            .number("life_s", &InkStyle::life_s, {0.05F, 1000.0F}, "s",
                    "Lifetime of wet flowing ink: about a third is left after this time")
            .number("soak", &InkStyle::soak, {0.0F, 1.0F}, "",
                    "Share of the fading wet ink that stays in the paper as a dry stain: 0 leaves no stain")
            .number("stain_s", &InkStyle::stain_s, {0.05F, 10000.0F}, "s",
                    "Lifetime of dry stains of ink: about a third is left after this time")
            .color("color", &InkStyle::color, "Colour of flowing ink where the ink is dense")
            .color("thin_color", &InkStyle::thin_color, "Colour of flowing ink where the ink is thin")
            .number("opacity", &InkStyle::opacity, {0.0F, 1.0F}, "",
                    "How much flowing ink covers what lies below: 0 is invisible, 1 is opaque where the ink "
                    "is dense")
            .number("sharpness", &InkStyle::sharpness, {0.0F, 1.0F}, "",
                    "Edges of flowing ink: 0 ends in soft mist, 1 gives threads with crisp edges")
            .number("edge", &InkStyle::edge, {0.0F, 1.0F}, "",
                    "How much darker flowing ink is at its edge than in the middle, as dried watercolour: 0 "
                    "is flat")
            .number(
                "granulation", &InkStyle::granulation, {0.0F, 1.0F}, "",
                "How much flowing ink settles in the hollows of the paper: 0 is smooth, 1 shows the grain")
            .number("budget", &InkStyle::budget, {0.001F, 1.0F}, "",
                    "Largest share of the page that flowing ink covers: less keeps the page emptier. Sources "
                    "give less as ink nears this share.")
            .toggle("spills", &InkStyle::spills, "If true, flowing ink may run over the margin of the page")
            .number("age_s", &InkStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long ink has flowed already in a still picture, or in the first frame of a film: "
                    "more gives longer threads")
            .number("steps_per_s", &InkStyle::steps_per_s, {1.0F, 240.0F}, "1/s",
                    "Least number of simulation steps per second of flowing ink: less is quicker to compute, "
                    "with rougher swirls")
            .number(
                "cell_mm", &InkStyle::cell_mm, {0.05F, 10.0F}, "mm",
                "Side of a cell of the grid on which ink flows, at least one pixel: less is finer and slower")
            .number("oversize", &InkStyle::oversize, {1.0F, 3.0F}, "",
                    "Size of the grid of flowing ink, as a factor of the page: more keeps ink that leaves "
                    "the view for a while. Only used when ink.follow is turn or advance.");
    return table;
}

} // namespace estampe::ink
