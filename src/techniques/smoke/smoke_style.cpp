// SPDX-License-Identifier: MIT
#include "techniques/smoke/smoke_style.hpp"

#include "style/parameter.hpp"

namespace estampe::smoke {

const style::Table<SmokeStyle>& smoke_table()
{
    static const auto table =
        style::Table<SmokeStyle>("smoke",
                                 "Smoke, fire and clouds, simulated in boxes around objects without a mesh")
            .toggle("enabled", &SmokeStyle::enabled,
                    "Turns smoke on, at the objects that smoke.objects names")
            .text("objects", &SmokeStyle::objects,
                  "Objects without a mesh that smoke rises from, as a name pattern. Each fills a box, 2 m "
                  "wide each way in the object's own space, from the middle of the box's floor.")
            .integer("cells", &SmokeStyle::cells, {16, 256}, "",
                     "Number of cells along the longest side of a smoke box, a power of two: more is finer "
                     "and much slower")
            .number("age_s", &SmokeStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long smoke has risen already in a still picture, or in the first frame of a film")
            .number("source", &SmokeStyle::source, {0.02F, 1.0F}, "",
                    "Radius of the source of smoke, as a share of half the box's width: more gives a wider "
                    "column")
            .number("amount_per_s", &SmokeStyle::amount_per_s, {0.0F, 100.0F}, "1/s",
                    "How quickly smoke gets dense at its source: more gives thicker smoke")
            .number("rise_s", &SmokeStyle::rise_s, {0.2F, 100.0F}, "s",
                    "Time in which smoke rises to the top of its box, about: less rises faster")
            .number("wind_m_per_s", &SmokeStyle::wind_m_per_s, {0.0F, 100.0F}, "m/s",
                    "Speed of the wind around the smoke: more bends the column over")
            .number("wind_deg", &SmokeStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Bearing towards which the wind carries the smoke: 0 is +z, 90 is +x")
            .number("curl", &SmokeStyle::curl, {0.0F, 4.0F}, "",
                    "Strength of the swirls in smoke: 0 adds none, more gives livelier curls")
            .toggle("obstacles", &SmokeStyle::obstacles,
                    "If true, smoke flows around solid objects in its box, where they stand when the smoke "
                    "starts")
            .choice("solver", &SmokeStyle::solver,
                    {{"automatic", Solver::automatic},
                     {"spectral", Solver::spectral},
                     {"multigrid", Solver::multigrid},
                     {"jacobi", Solver::jacobi}},
                    "How the pressure of the air is solved. spectral: directly, for an empty box; multigrid: "
                    "around obstacles; jacobi: simplest, least exact; automatic: spectral if the box is "
                    "empty, else multigrid.")
            .choice("advection", &SmokeStyle::advection,
                    {{"automatic", Advection::automatic},
                     {"linear", Advection::linear},
                     {"cubic", Advection::cubic},
                     {"maccormack", Advection::maccormack}},
                    "How the air carries smoke. linear: fast, blurs; cubic: sharper; maccormack: sharp at "
                    "little cost; automatic: maccormack.")
            .choice("stepping", &SmokeStyle::stepping,
                    {{"project", Stepping::project}, {"reflect", Stepping::reflect}},
                    "How the simulation steps in time. project: loses some swirls; reflect: keeps swirls "
                    "alive and takes twice as long.")
            .number("life_s", &SmokeStyle::life_s, {0.1F, 1000.0F}, "s",
                    "Lifetime of smoke: about a third is left after this time")
            .number("fuel_per_s", &SmokeStyle::fuel_per_s, {0.0F, 100.0F}, "1/s",
                    "How quickly fuel rises with the smoke and burns where it is warm: more gives larger "
                    "flames. 0 gives no fire.")
            .number("burn_s", &SmokeStyle::burn_s, {0.02F, 100.0F}, "s",
                    "Time after which about a third of the fuel in a fire is left: longer gives higher "
                    "flames. Only used when smoke.fuel_per_s is above 0.")
            .number("burn_heat", &SmokeStyle::burn_heat, {0.0F, 10.0F}, "",
                    "Heat of burning fuel, which makes the smoke rise: more rises faster. Only used when "
                    "smoke.fuel_per_s is above 0.")
            .number("soot", &SmokeStyle::soot, {0.0F, 10.0F}, "",
                    "Smoke from burning fuel: 0 burns clean, more is sootier. Only used when "
                    "smoke.fuel_per_s is above 0.")
            .number("humidity", &SmokeStyle::humidity, {0.0F, 10.0F}, "",
                    "Water in the rising air, which turns into a cloud higher up: more gives a denser cloud. "
                    "0 gives no cloud.")
            .number("cloud_base", &SmokeStyle::cloud_base, {0.0F, 1.0F}, "",
                    "Height at which rising water turns into a cloud, as a share of the box's height. Warm "
                    "air turns higher up. Only used when smoke.humidity is above 0.")
            .number("humidity_outside", &SmokeStyle::humidity_outside, {0.0F, 1.0F}, "",
                    "Water in the air around, as a share of smoke.humidity: more keeps the cloud from drying "
                    "up. Only used when smoke.humidity is above 0.")
            .number("latent_heat", &SmokeStyle::latent_heat, {0.0F, 10.0F}, "",
                    "Heat from water that turns into a cloud: more makes the cloud billow higher. Only used "
                    "when smoke.humidity is above 0.")
            .number("thickness", &SmokeStyle::thickness, {0.1F, 100.0F}, "",
                    "How opaque smoke is: the optical depth of dense smoke a tenth of the box deep. Less is "
                    "thin mist, more is solid.")
            .toggle("puffs", &SmokeStyle::puffs,
                    "If true, smoke is drawn as round puffs, as in comics. If false, as the density that was "
                    "simulated.")
            .number("puff", &SmokeStyle::puff, {0.02F, 1.0F}, "",
                    "Distance from one puff of smoke to the next, as a share of the box's width: less gives "
                    "more and smaller puffs. Only used when smoke.puffs is true.")
            .choice("sampling", &SmokeStyle::sampling,
                    {{"rays", Sampling::rays}, {"axis", Sampling::axis}, {"view", Sampling::view}},
                    "Where the density of smoke is sampled. rays: in equal steps along each ray; axis: on "
                    "planes of the grid; view: on planes that face the eye.")
            .number(
                "step", &SmokeStyle::step, {0.1F, 4.0F}, "",
                "Distance from one sample of the smoke to the next, in cells: less is smoother and slower")
            .number("scatter", &SmokeStyle::scatter, {0.0F, 1.0F}, "",
                    "How far samples stray at random within their step: more turns bands in thin smoke into "
                    "noise. Only used when smoke.sampling is rays.")
            .number("edge", &SmokeStyle::edge, {0.02F, 0.98F}, "",
                    "Opacity at which the outline of smoke runs: less draws it farther out")
            .choice("medium", &SmokeStyle::medium,
                    {{"wash", Medium::wash}, {"strokes", Medium::strokes}, {"both", Medium::both}},
                    "What draws the shade of smoke. wash: flat colours; strokes: hatching; both: colours and "
                    "hatching.")
            .color("color", &SmokeStyle::color, "Colour of smoke where light falls on it")
            .color("shade_color", &SmokeStyle::shade_color,
                   "Colour of smoke in shade, where the light is below smoke.shade_below")
            .color("deep_color", &SmokeStyle::deep_color,
                   "Colour of smoke in deep shade, where the light is below smoke.deep_below")
            .number("opacity", &SmokeStyle::opacity, {0.0F, 1.0F}, "",
                    "How much the paint of smoke covers what lies behind: 0 leaves outlines and strokes "
                    "alone, 1 is opaque")
            .number("shade_below", &SmokeStyle::shade_below, {0.0F, 1.0F}, "",
                    "Light level below which smoke takes the shade colour: more gives larger shaded areas")
            .number("deep_below", &SmokeStyle::deep_below, {0.0F, 1.0F}, "",
                    "Light level below which smoke takes the deep-shade colour: more gives larger dark areas")
            .number("form", &SmokeStyle::form, {0.0F, 1.0F}, "",
                    "What shades smoke: 0 is the light that comes through the smoke, 1 is the round form of "
                    "each puff")
            .number("line_mm", &SmokeStyle::line_mm, {0.0F, 5.0F}, "mm",
                    "Width of the outlines of smoke, wider in shade. 0 draws none.")
            .number("stroke_mm", &SmokeStyle::stroke_mm, {0.02F, 5.0F}, "mm",
                    "Width of the hatching strokes in smoke. Only used when smoke.medium is strokes or both.")
            .number("darkness", &SmokeStyle::darkness, {0.0F, 1.0F}, "",
                    "Darkness of the hatching strokes in smoke that lies in full shade. Only used when "
                    "smoke.medium is strokes or both.")
            .toggle("shaded", &SmokeStyle::shaded, "If true, the scene's shadows fall on the smoke")
            .number(
                "shadow", &SmokeStyle::shadow, {0.0F, 1.0F}, "",
                "Darkness of the shadow that smoke throws in the sun: 0 throws none, 1 is physically right")
            .number("glow", &SmokeStyle::glow, {0.0F, 100.0F}, "",
                    "Brightness of the fire below the smoke, a lamp that flickers: 1 lights a surface half "
                    "the box's width away as brightly as the main light. 0 gives no light.")
            .color("glow_color", &SmokeStyle::glow_color, "Colour of the light from the fire below the smoke")
            .number("flame", &SmokeStyle::flame, {0.0F, 10.0F}, "",
                    "How dense flames are for the fuel that burns: less is pale, more is solid. 0 draws no "
                    "flames. Only used when smoke.fuel_per_s is above 0.")
            .color("flame_color", &SmokeStyle::flame_color, "Colour that flames are painted with");
    return table;
}

} // namespace estampe::smoke
