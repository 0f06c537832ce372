// SPDX-License-Identifier: MIT
#include "techniques/ink/ink_style.hpp"

#include "style/parameter.hpp"

namespace estampe::ink {

using style::within;

const style::Table<InkStyle>& ink_table()
{
    static const auto table =
        style::Table<InkStyle>("ink",
                               "Flowing ink: ink that runs out of the drawing in thin threads and swirls")
            .toggle("enabled", &InkStyle::enabled,
                    "Turns flowing ink on: ink runs out of the drawing in thin threads and swirls")
            .choice("follow", &InkStyle::follow,
                    {{"page", Follow::page},
                     {"turn", Follow::turn},
                     {"advance", Follow::advance},
                     {"around", Follow::around},
                     {"surface", Follow::surface}},
                    "What flowing ink moves with when the camera moves. page: the page; turn: the far "
                    "background; advance: a plane ahead, which grows as the camera nears it; around: a cube "
                    "around the eye; surface: the surfaces below the ink.")
            .choice("source", &InkStyle::source,
                    {{"strokes", Source::strokes}, {"light", Source::light}, {"things", Source::things}},
                    "Where flowing ink comes from. strokes: dark strokes and lines; light: brightly lit "
                    "surfaces; things: all visible objects.")
            .text("objects", &InkStyle::objects,
                  "Objects from which ink flows, as name patterns separated by commas, where * stands for "
                  "any letters. Example: \"Fox, Tower*\".")
            .number("threshold", &InkStyle::threshold, {0.0F, 0.99F}, "",
                    "Weakest stroke or light from which ink flows: more leaves fewer source spots")
            .number(
                "amount_per_s", &InkStyle::amount_per_s, {0.0F, 1000.0F}, "1/s",
                "How quickly ink comes out of a source spot of flowing ink: more gives denser threads of ink")
            .number("spot_mm", &InkStyle::spot_mm, {0.05F, 20.0F}, "mm",
                    "Radius of the source spots of flowing ink, at most half of ink.spacing_mm: more gives "
                    "wider threads of ink, about as wide as the spots")
            .number(
                "spacing_mm", &InkStyle::spacing_mm, {0.2F, 200.0F}, "mm",
                "Distance from one source spot of flowing ink to the next: less gives more threads of ink")
            .number("spot_s", &InkStyle::spot_s, {0.1F, 1000.0F}, "s",
                    "How long ink flows from a source spot before another spot replaces it: more gives "
                    "longer threads of ink")
            .number("wind_mm_per_s", &InkStyle::wind_mm_per_s, {-1.0F, 500.0F}, "mm/s",
                    "Speed of the wind that carries all flowing ink over the page: more carries ink farther. "
                    "-1 takes speed and direction from section wind, as the camera sees that wind.")
            .number("wind_deg", &InkStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Direction on the page towards which the wind carries flowing ink: 0 is right, 90 is up. "
                    "Not used when ink.wind_mm_per_s is -1.")
            .number("swirl_mm", &InkStyle::swirl_mm, {1.0F, 1000.0F}, "mm",
                    "Size of the largest swirls in flowing ink. A low value gives small curls, a high value "
                    "gives wide bends.")
            .number("swirl_mm_per_s", &InkStyle::swirl_mm_per_s, {0.0F, 500.0F}, "mm/s",
                    "Speed of the swirls in flowing ink: 0 keeps threads of ink straight, more curls them up")
            .number(
                "turn_s", &InkStyle::turn_s, {0.1F, 1000.0F}, "s",
                "Time in which a swirl of flowing ink changes into another: less is restless, more is calm")
            .number("solved", &InkStyle::solved, {0.0F, 1.0F}, "",
                    "How far simulated water moves flowing ink: 0 moves ink along smooth artificial swirls, "
                    "1 moves ink with simulated water that the swirls stir, with real eddies")
            .choice("solver", &InkStyle::solver,
                    {{"automatic", Solver::automatic},
                     {"multigrid", Solver::multigrid},
                     {"jacobi", Solver::jacobi},
                     {"mass", Solver::mass}},
                    "How the pressure of simulated water below flowing ink is computed. multigrid: exactly; "
                    "jacobi: simplest, least exact; mass: from where water piles up, without loss of water; "
                    "automatic: multigrid. Only used with ink.solved above 0.")
            .integer("jacobi_passes", &InkStyle::jacobi_passes, {1, 400}, "",
                     "Number of passes of the Jacobi solver per step of the water: more makes the water less "
                     "compressible and is slower. Only used when ink.solver is jacobi.")
            .file("flow_map", &InkStyle::flow_map,
                  "Picture whose colours give the direction in which flowing ink moves: red moves ink to the "
                  "right and green down. A value of 0.5 does not move ink.")
            .number("flow_mm_per_s", &InkStyle::flow_mm_per_s, {0.0F, 500.0F}, "mm/s",
                    "Speed of flowing ink where ink.flow_map has full red or green: more moves ink faster. "
                    "Only used with ink.flow_map.")
            .number("drag", &InkStyle::drag, {0.0F, 1.0F}, "",
                    "How much flowing ink moves along with the moving object on which the ink lies: 0 not at "
                    "all, 1 fully. Not used when ink.follow is surface, where ink always moves along fully.")
            .number("zone.blow_mm_per_s", within(&InkStyle::zone, &ZoneStyle::blow_mm_per_s),
                    {-10000.0F, 10000.0F}, "mm/s",
                    "Speed at which a zone blows flowing ink along the -z axis of its object. Example of a "
                    "zone: [object.\"Fan\".ink] zone.blow_mm_per_s = 20.")
            .number("zone.turn_deg_per_s", within(&InkStyle::zone, &ZoneStyle::turn_deg_per_s),
                    {-10000.0F, 10000.0F}, "deg/s",
                    "Speed at which a zone turns flowing ink around its object, clockwise on the page. "
                    "Example of a zone: [object.\"Eddy\".ink] zone.turn_deg_per_s = 90.")
            .number("zone.give", within(&InkStyle::zone, &ZoneStyle::give), {0.0F, 1.0F}, "",
                    "How much ink flows out of a zone: 0 gives none, more gives denser ink. Example of a "
                    "zone: [object.\"Well\".ink] zone.give = 1.")
            .number(
                "zone.amount", within(&InkStyle::zone, &ZoneStyle::amount), {0.0F, 100.0F}, "",
                "Factor on the flowing ink that strokes release in a zone: 0 releases none, more is denser. "
                "Example of a zone: [object.\"Calm\".ink] zone.amount = 0.")
            .number("life_s", &InkStyle::life_s, {0.05F, 1000.0F}, "s",
                    "How long wet flowing ink lasts: about a third is left after this time")
            .number("soak", &InkStyle::soak, {0.0F, 1.0F}, "",
                    "How much of the fading wet ink stays in the paper as a dry stain: 0 leaves no stain, 1 "
                    "leaves all ink as a stain")
            .number("stain_s", &InkStyle::stain_s, {0.05F, 10000.0F}, "s",
                    "How long dry stains of ink last: about a third is left after this time")
            .color("color", &InkStyle::color, "Colour of flowing ink where the ink is dense")
            .color("thin_color", &InkStyle::thin_color, "Colour of flowing ink where the ink is thin")
            .number("opacity", &InkStyle::opacity, {0.0F, 1.0F}, "",
                    "How much flowing ink covers the drawing below: 0 is invisible, 1 is opaque where the "
                    "ink is dense")
            .number("sharpness", &InkStyle::sharpness, {0.0F, 1.0F}, "",
                    "Edges of flowing ink: 0 ends in soft mist, 1 gives threads with crisp edges")
            .number("edge", &InkStyle::edge, {0.0F, 1.0F}, "",
                    "How much darker flowing ink is at its edge than in the middle, as in dried watercolour: "
                    "0 is flat, more gives a dark rim")
            .number(
                "granulation", &InkStyle::granulation, {0.0F, 1.0F}, "",
                "How much flowing ink settles in the hollows of the paper: 0 is smooth, 1 shows the grain")
            .number("budget", &InkStyle::budget, {0.001F, 1.0F}, "",
                    "Largest share of the page that flowing ink covers: less keeps the page emptier. Less "
                    "and less ink flows from the source spots as this share comes near.")
            .toggle("spills", &InkStyle::spills, "If true, flowing ink may run over the margin of the page")
            .number("age_s", &InkStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long ink has already flowed before a still picture or the first frame of a film: "
                    "more gives longer threads of ink")
            .number("steps_per_s", &InkStyle::steps_per_s, {1.0F, 240.0F}, "1/s",
                    "Smallest number of simulation steps per second of flowing ink: less is quicker to "
                    "compute and gives rougher swirls")
            .number("cell_mm", &InkStyle::cell_mm, {0.05F, 10.0F}, "mm",
                    "Size of a cell of the grid on which ink flows, at least one pixel: less gives finer "
                    "threads of ink and is slower")
            .number(
                "oversize", &InkStyle::oversize, {1.0F, 3.0F}, "",
                "Size of the grid of flowing ink, as a factor of the page: more keeps ink farther outside "
                "the view, so that the ink can come back. Only used when ink.follow is turn or advance.")
            .by_object({"zone.blow_mm_per_s", "zone.turn_deg_per_s", "zone.give", "zone.amount"});
    return table;
}

} // namespace estampe::ink
