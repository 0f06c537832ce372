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
                    "background; advance: a plane ahead, which grows as the camera comes near; around: a "
                    "cube around the camera; surface: the surfaces below the ink.")
            .choice("source", &InkStyle::source,
                    {{"strokes", Source::strokes}, {"light", Source::light}, {"things", Source::things}},
                    "Where flowing ink comes from. strokes: dark strokes and lines; light: brightly lit "
                    "surfaces; things: all visible objects.")
            .text("objects", &InkStyle::objects,
                  "Objects from which ink flows, as name patterns separated by commas, where * stands for "
                  "any letters. Example: \"Fox, Tower*\".")
            .number("threshold", &InkStyle::threshold, {0.0F, 0.99F}, "",
                    "Darkness of a stroke, or strength of light, from which ink flows: more leaves fewer "
                    "spots of ink")
            .number("amount_per_s", &InkStyle::amount_per_s, {0.0F, 1000.0F}, "1/s",
                    "How quickly ink flows out of its source spots in the drawing: more gives denser threads "
                    "of ink")
            .number("spot_mm", &InkStyle::spot_mm, {0.05F, 20.0F}, "mm",
                    "Radius of the spots from which ink flows, at most half of ink.spacing_mm. More gives "
                    "wider threads of ink, about as wide as the spots.")
            .number(
                "spacing_mm", &InkStyle::spacing_mm, {0.2F, 200.0F}, "mm",
                "Distance on the page between the spots from which ink flows: less gives more threads of ink")
            .number("spot_s", &InkStyle::spot_s, {0.1F, 1000.0F}, "s",
                    "How long ink flows from one spot before another spot replaces it: more gives longer "
                    "threads of ink")
            .number("wind_mm_per_s", &InkStyle::wind_mm_per_s, {-1.0F, 500.0F}, "mm/s",
                    "Speed of the wind that carries all flowing ink over the page: more carries ink farther. "
                    "-1 takes speed and direction from section wind, as the camera sees that wind.")
            .number("wind_deg", &InkStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Direction on the page in which the wind carries flowing ink: 0 is right, 90 is up. Not "
                    "used when ink.wind_mm_per_s is -1.")
            .number("swirl_mm", &InkStyle::swirl_mm, {1.0F, 1000.0F}, "mm",
                    "Size of the largest swirls in flowing ink. A low value gives small curls, a high value "
                    "gives wide bends.")
            .number("swirl_mm_per_s", &InkStyle::swirl_mm_per_s, {0.0F, 500.0F}, "mm/s",
                    "Speed of the swirls in flowing ink: 0 keeps threads of ink straight, more curls them up")
            .number(
                "turn_s", &InkStyle::turn_s, {0.1F, 1000.0F}, "s",
                "Time in which a swirl of flowing ink changes into another: less is restless, more is calm")
            .number(
                "solved", &InkStyle::solved, {0.0F, 1.0F}, "",
                "How much simulated water moves flowing ink, in place of smooth artificial swirls. 0: only "
                "the swirls move ink; 1: only the water moves ink, with real eddies (whirls).")
            .choice("solver", &InkStyle::solver,
                    {{"automatic", Solver::automatic},
                     {"multigrid", Solver::multigrid},
                     {"jacobi", Solver::jacobi},
                     {"mass", Solver::mass}},
                    "How the pressure of the water that moves ink is computed. multigrid: exactly; "
                    "jacobi: simplest, least exact; mass: no pressure, water flows away from where it "
                    "is dense; automatic: multigrid. Needs ink.solved above 0.")
            .integer("jacobi_passes", &InkStyle::jacobi_passes, {1, 400}, "",
                     "How often the simplest method (jacobi) repeats its computation of the water's "
                     "pressure. More lets the water that moves ink swirl more truly and is slower. Only used "
                     "when ink.solver is jacobi.")
            .file("flow_map", &InkStyle::flow_map,
                  "Picture whose colours set the direction in which flowing ink moves. Strong red moves ink "
                  "to the right, no red to the left; strong green down, no green up. Half red and half green "
                  "do not move ink.")
            .number("flow_mm_per_s", &InkStyle::flow_mm_per_s, {0.0F, 500.0F}, "mm/s",
                    "Speed of flowing ink where the picture ink.flow_map has full red or green: more moves "
                    "ink faster. Only used with ink.flow_map.")
            .number("drag", &InkStyle::drag, {0.0F, 1.0F}, "",
                    "How much flowing ink moves along with the moving object on which the ink lies: 0 not at "
                    "all, 1 fully. Not used when ink.follow is surface, where ink always moves along fully.")
            .number("zone.blow_mm_per_s", within(&InkStyle::zone, &ZoneStyle::blow_mm_per_s),
                    {-10000.0F, 10000.0F}, "mm/s",
                    "Speed at which a zone (a ball around an object without a mesh) blows flowing ink away. "
                    "The ink moves along the object's -z axis. Example: [object.\"Fan\".ink] "
                    "zone.blow_mm_per_s = 20.")
            .number("zone.turn_deg_per_s", within(&InkStyle::zone, &ZoneStyle::turn_deg_per_s),
                    {-10000.0F, 10000.0F}, "deg/s",
                    "Speed at which flowing ink turns around a zone (a ball around an object without a "
                    "mesh). Above 0 turns clockwise on the page. Example: [object.\"Eddy\".ink] "
                    "zone.turn_deg_per_s = 90.")
            .number("zone.give", within(&InkStyle::zone, &ZoneStyle::give), {0.0F, 1.0F}, "",
                    "How much ink flows out of a zone (a ball around an object without a mesh). 0 gives no "
                    "ink, more gives denser ink. Example: [object.\"Well\".ink] zone.give = 1.")
            .number(
                "zone.amount", within(&InkStyle::zone, &ZoneStyle::amount), {0.0F, 100.0F}, "",
                "Factor on the ink that flows out of strokes within a zone (a ball around an object without "
                "a mesh). 0 lets no ink out, more is denser. Example: [object.\"Calm\".ink] zone.amount = 0.")
            .number("life_s", &InkStyle::life_s, {0.05F, 1000.0F}, "s",
                    "How long wet flowing ink lasts: about a third is left after this time")
            .number("soak", &InkStyle::soak, {0.0F, 1.0F}, "",
                    "How much of the fading wet ink stays in the paper as a dry stain. 0 leaves no stain, 1 "
                    "leaves all of the ink.")
            .number("stain_s", &InkStyle::stain_s, {0.05F, 10000.0F}, "s",
                    "How long dry stains of ink last: about a third is left after this time")
            .color("color", &InkStyle::color, "Colour of flowing ink where the ink is dense")
            .color("thin_color", &InkStyle::thin_color, "Colour of flowing ink where the ink is thin")
            .number("opacity", &InkStyle::opacity, {0.0F, 1.0F}, "",
                    "How much flowing ink covers the drawing below: 0 is invisible, 1 is opaque where the "
                    "ink is dense")
            .number("sharpness", &InkStyle::sharpness, {0.0F, 1.0F}, "",
                    "Sharpness of the edges of flowing ink: 0 ends in soft mist, 1 gives threads with crisp "
                    "edges")
            .number("edge", &InkStyle::edge, {0.0F, 1.0F}, "",
                    "How much darker flowing ink is at its edge, as in dried watercolour. 0 is flat, more "
                    "gives a dark rim.")
            .number(
                "granulation", &InkStyle::granulation, {0.0F, 1.0F}, "",
                "How much flowing ink settles in the hollows of the paper: 0 is smooth, 1 shows the grain")
            .number("budget", &InkStyle::budget, {0.001F, 1.0F}, "",
                    "Largest share of the page that flowing ink covers: less keeps the page emptier. Less "
                    "and less ink flows out of the drawing as this share comes near.")
            .toggle("spills", &InkStyle::spills,
                    "If true, flowing ink runs over the margin of the page; if false, it stays in the frame")
            .number("age_s", &InkStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long ink has already flowed before the picture or the first frame of a film. More "
                    "gives longer threads of ink.")
            .number("steps_per_s", &InkStyle::steps_per_s, {1.0F, 240.0F}, "1/s",
                    "Smallest number of steps per second in which the motion of flowing ink is computed. "
                    "Less is quicker to compute and gives rougher swirls.")
            .number("cell_mm", &InkStyle::cell_mm, {0.05F, 10.0F}, "mm",
                    "Size of the cells (small squares) in which flowing ink is computed, at least one pixel. "
                    "Less gives finer threads of ink and is slower.")
            .number("oversize", &InkStyle::oversize, {1.0F, 3.0F}, "",
                    "Size of the area in which flowing ink is computed, as a factor of the page. More keeps "
                    "ink farther outside the view, so that this ink is still there when the camera turns "
                    "back. Only used when ink.follow is turn or advance.")
            .by_object({"zone.blow_mm_per_s", "zone.turn_deg_per_s", "zone.give", "zone.amount"});
    return table;
}

} // namespace estampe::ink
