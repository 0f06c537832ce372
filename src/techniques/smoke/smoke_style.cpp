// SPDX-License-Identifier: MIT
#include "techniques/smoke/smoke_style.hpp"

#include "style/parameter.hpp"

namespace estampe::smoke {

const style::Table<SmokeStyle>& smoke_table()
{
    static const auto table =
        style::Table<SmokeStyle>("smoke",
                                 "Smoke, fire and clouds: simulated in boxes around objects without a mesh")
            .toggle("enabled", &SmokeStyle::enabled,
                    "Turns smoke on: smoke rises from the objects that smoke.objects names")
            .text("objects", &SmokeStyle::objects,
                  "Names of the objects without a mesh from which smoke rises, where * stands for any "
                  "letters. The smoke of each object fills a box above the object, 2 m wide before the "
                  "object is scaled.")
            .integer("cells", &SmokeStyle::cells, {16, 256}, "",
                     "Number of cells (small cubes) along the longest side of a smoke box, a power of two. "
                     "More shows finer smoke and is much slower.")
            .number("age_s", &SmokeStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long smoke has already risen before the picture or the first frame of a film. More "
                    "gives a taller column of smoke.")
            .number("source", &SmokeStyle::source, {0.02F, 1.0F}, "",
                    "Width of the place where smoke comes out, as a share of the box's width: more gives a "
                    "wider column")
            .number("amount_per_s", &SmokeStyle::amount_per_s, {0.0F, 100.0F}, "1/s",
                    "How quickly smoke gets dense at the place where it comes out: more gives thicker smoke")
            .number("rise_s", &SmokeStyle::rise_s, {0.2F, 100.0F}, "s",
                    "Approximate time in which smoke rises to the top of its box: less rises faster")
            .number("wind_m_per_s", &SmokeStyle::wind_m_per_s, {-1.0F, 100.0F}, "m/s",
                    "Speed of the wind around the smoke: more bends the column of smoke over, towards "
                    "wind.towards_deg. -1 takes the speed from wind.speed_m_per_s.")
            .number("curl", &SmokeStyle::curl, {0.0F, 4.0F}, "",
                    "Strength of the swirls in smoke: 0 adds none, more gives livelier curls")
            .toggle("obstacles", &SmokeStyle::obstacles,
                    "If true, smoke flows around solid objects in its box. Only the place of an object when "
                    "the smoke starts counts: smoke ignores later movement of the object.")
            .choice("solver", &SmokeStyle::solver,
                    {{"automatic", Solver::automatic},
                     {"spectral", Solver::spectral},
                     {"multigrid", Solver::multigrid},
                     {"jacobi", Solver::jacobi},
                     {"mass", Solver::mass}},
                    "How the pressure of the air in smoke is computed. spectral: exactly, without "
                    "objects; multigrid: around objects; jacobi: simplest, least exact; mass: no "
                    "pressure, air flows away from where it is dense; automatic: spectral or multigrid.")
            // Each round of Jacobi's iteration is one pass, or two passes in a step of advection-reflection.
            // A graph has room for 240 passes of smoke.
            .integer("jacobi_passes", &SmokeStyle::jacobi_passes, {1, 100}, "",
                     "How often the simplest method (jacobi) repeats its computation of the air's pressure. "
                     "More lets smoke swirl more truly and is slower. Only used when smoke.solver is jacobi.")
            .choice("advection", &SmokeStyle::advection,
                    {{"automatic", Advection::automatic},
                     {"linear", Advection::linear},
                     {"cubic", Advection::cubic},
                     {"maccormack", Advection::maccormack}},
                    "How the air carries smoke along in the simulation. linear: fast, but blurs the smoke; "
                    "cubic: sharper; maccormack: sharp at little cost; automatic: maccormack.")
            .choice("stepping", &SmokeStyle::stepping,
                    {{"project", Stepping::project}, {"reflect", Stepping::reflect}},
                    "How the smoke simulation advances in time. project: quick, but loses some swirls; "
                    "reflect: keeps swirls alive and takes twice as long.")
            .number("life_s", &SmokeStyle::life_s, {0.1F, 1000.0F}, "s",
                    "How long smoke lasts: about a third of the smoke is left after this time")
            .number("fuel_per_s", &SmokeStyle::fuel_per_s, {0.0F, 100.0F}, "1/s",
                    "How quickly fuel rises with the smoke and burns where the air is warm: more gives "
                    "larger flames. 0 gives no fire.")
            .number("burn_s", &SmokeStyle::burn_s, {0.02F, 100.0F}, "s",
                    "Time in which about two thirds of the fuel of a fire burns: more gives higher flames. "
                    "Only used when smoke.fuel_per_s is above 0.")
            .number("burn_heat", &SmokeStyle::burn_heat, {0.0F, 10.0F}, "",
                    "Heat of burning fuel, which makes the smoke rise: more heat makes smoke rise faster. "
                    "Only used when smoke.fuel_per_s is above 0.")
            .number("soot", &SmokeStyle::soot, {0.0F, 10.0F}, "",
                    "Amount of smoke from burning fuel: 0 burns without smoke, more gives darker, sootier "
                    "fire. Only used when smoke.fuel_per_s is above 0.")
            .number("explodes_above", &SmokeStyle::explodes_above, {0.0F, 100.0F}, "",
                    "Warmth above which air expands suddenly, as in an explosion; 0 never. Where smoke comes "
                    "out, the air has a warmth of up to 2; smoke.blast_heat is in the same unit.")
            .number("explosion_per_s", &SmokeStyle::explosion_per_s, {0.1F, 100.0F}, "1/s",
                    "How suddenly air that is too warm expands: more gives a shorter, harder blast. Only "
                    "used when smoke.explodes_above is above 0.")
            .number("blast_at_s", &SmokeStyle::blast_at_s, {-1.0F, 1e6F}, "s",
                    "Time in a film at which air gets hot where smoke comes out, and explodes. -1 gives no "
                    "blast. Only used when smoke.explodes_above is above 0.")
            .number(
                "blast_heat", &SmokeStyle::blast_heat, {0.0F, 100.0F}, "",
                "Warmth that the air gets at smoke.blast_at_s: more gives a larger explosion. The volume of "
                "hot air grows by the factor smoke.blast_heat divided by smoke.explodes_above.")
            .number("humidity", &SmokeStyle::humidity, {0.0F, 10.0F}, "",
                    "Amount of water in the air that rises with smoke, which turns into a cloud higher up. "
                    "More gives a denser cloud, 0 gives no cloud.")
            .number(
                "cloud_base", &SmokeStyle::cloud_base, {0.0F, 1.0F}, "",
                "Height at which water in the rising air turns into a cloud, as a share of the box's height. "
                "In warm air, the cloud forms higher up. Only used when smoke.humidity is above 0.")
            .number(
                "humidity_outside", &SmokeStyle::humidity_outside, {0.0F, 1.0F}, "",
                "How damp the air around the smoke is, as a share of smoke.humidity. Less lets a cloud dry "
                "up at its edges, more keeps the cloud large. Only used when smoke.humidity is above 0.")
            .number("latent_heat", &SmokeStyle::latent_heat, {0.0F, 10.0F}, "",
                    "Heat that is set free where water in smoke turns into a cloud: more makes the cloud "
                    "rise higher. Only used when smoke.humidity is above 0.")
            .number(
                "thickness", &SmokeStyle::thickness, {0.1F, 100.0F}, "",
                "How opaque smoke is. Less looks like thin mist, more looks solid. At 1, dense smoke a tenth "
                "as deep as its box hides two thirds of the things behind it; at 6, nearly everything.")
            .toggle("puffs", &SmokeStyle::puffs,
                    "If true, smoke is drawn as round puffs, as in comics. If false, smoke is drawn with the "
                    "simulated shape.")
            .number("puff", &SmokeStyle::puff, {0.02F, 1.0F}, "",
                    "Distance from one puff of smoke to the next, as a share of the box's width. Less gives "
                    "more and smaller puffs. Only used when smoke.puffs is true.")
            .choice("sampling", &SmokeStyle::sampling,
                    {{"rays", Sampling::rays}, {"axis", Sampling::axis}, {"view", Sampling::view}},
                    "Where the density of smoke is measured along each line of sight. rays: at equal "
                    "distances; axis: on planes of the smoke's grid; view: on planes that face the camera.")
            .number("step", &SmokeStyle::step, {0.1F, 4.0F}, "",
                    "Distance between points where smoke is measured, in cells of its grid: less is smoother "
                    "and slower")
            .number("scatter", &SmokeStyle::scatter, {0.0F, 1.0F}, "",
                    "How far the points where smoke is measured are shifted at random. More turns visible "
                    "bands in thin smoke into fine grain. Only used when smoke.sampling is rays.")
            .number("edge", &SmokeStyle::edge, {0.02F, 0.98F}, "",
                    "Opacity of smoke at which its outline is drawn: less draws the outline farther out")
            .choice("medium", &SmokeStyle::medium,
                    {{"wash", Medium::wash}, {"strokes", Medium::strokes}, {"both", Medium::both}},
                    "How the shade of smoke is drawn. wash: in flat colours; strokes: with hatching; both: "
                    "in colours and with hatching.")
            .color("color", &SmokeStyle::color, "Colour of smoke where light falls on it")
            .color("shade_color", &SmokeStyle::shade_color,
                   "Colour of smoke in shade, where the light level is below smoke.shade_below")
            .color("deep_color", &SmokeStyle::deep_color,
                   "Colour of smoke in deep shade, where the light level is below smoke.deep_below")
            .number("opacity", &SmokeStyle::opacity, {0.0F, 1.0F}, "",
                    "How much the colour of smoke covers the things behind the smoke. 0 draws only outlines "
                    "and strokes, 1 is opaque.")
            .number("shade_below", &SmokeStyle::shade_below, {0.0F, 1.0F}, "",
                    "Light level below which smoke takes the colour smoke.shade_color: more gives larger "
                    "shaded areas")
            .number("deep_below", &SmokeStyle::deep_below, {0.0F, 1.0F}, "",
                    "Light level below which smoke takes the colour smoke.deep_color: more gives larger dark "
                    "areas")
            .number("form", &SmokeStyle::form, {0.0F, 1.0F}, "",
                    "How smoke is shaded. 0 shades by the light that comes through the smoke, 1 shades each "
                    "puff as a round form.")
            .number("line_mm", &SmokeStyle::line_mm, {0.0F, 5.0F}, "mm",
                    "Width of the outlines of smoke: more is bolder. Outlines are wider in shade. 0 draws no "
                    "outlines.")
            .number("stroke_mm", &SmokeStyle::stroke_mm, {0.02F, 5.0F}, "mm",
                    "Width of the hatching strokes in smoke: more is bolder. Only used when smoke.medium is "
                    "strokes or both.")
            .number("darkness", &SmokeStyle::darkness, {0.0F, 1.0F}, "",
                    "Darkness of the hatching strokes where smoke lies in full shade: 0 draws no strokes. "
                    "Only used when smoke.medium is strokes or both.")
            .toggle("shaded", &SmokeStyle::shaded, "If true, the shadows of other objects fall on the smoke")
            .number(
                "shadow", &SmokeStyle::shadow, {0.0F, 1.0F}, "",
                "Darkness of the shadow that smoke throws in sunlight: 0 throws none, 1 is physically right")
            .number("glow", &SmokeStyle::glow, {0.0F, 100.0F}, "",
                    "Brightness of the flickering light from the fire below the smoke. 1 lights a surface "
                    "near the edge of the smoke's box as brightly as the main light. 0 gives no light.")
            .color("glow_color", &SmokeStyle::glow_color, "Colour of the light from the fire below the smoke")
            .number("flame", &SmokeStyle::flame, {0.0F, 10.0F}, "",
                    "How dense flames look for the amount of fuel that burns: less is pale, more is solid. 0 "
                    "draws no flames. Only used when smoke.fuel_per_s is above 0.")
            .color("flame_color", &SmokeStyle::flame_color, "Colour in which flames are painted");
    return table;
}

} // namespace estampe::smoke
