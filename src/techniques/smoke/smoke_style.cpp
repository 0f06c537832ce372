// SPDX-License-Identifier: MIT
#include "techniques/smoke/smoke_style.hpp"

#include "style/parameter.hpp"

namespace estampe::smoke {

const style::Table<SmokeStyle>& smoke_table()
{
    static const auto table =
        style::Table<SmokeStyle>("smoke", "Smoke that rises from objects without a mesh")
            .toggle("drawn", &SmokeStyle::drawn, "Whether there is any")
            .text(
                "objects", &SmokeStyle::objects,
                "The objects whose boxes it fills, 2 m wide each way in their own space, from the middle of "
                "a box's floor on: a pattern")
            .integer("cells", &SmokeStyle::cells, {16, 256}, "",
                     "Cells along the longest side of the box, a power of two")
            .number("age_s", &SmokeStyle::age_s, {0.0F, 60.0F}, "s",
                    "How long it has risen in a picture that stands for itself, and in the first of a film")
            .number("source", &SmokeStyle::source, {0.02F, 1.0F}, "",
                    "Radius of where it comes from, beside half the box's width")
            .number("amount_per_s", &SmokeStyle::amount_per_s, {0.0F, 100.0F}, "1/s",
                    "How quickly it gets dense there")
            .number("rise_s", &SmokeStyle::rise_s, {0.2F, 100.0F}, "s",
                    "How long it takes to the top of the box, about")
            .number("wind_m_s", &SmokeStyle::wind_m_s, {0.0F, 100.0F}, "m/s", "Speed of the air outside")
            .number("wind_deg", &SmokeStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Where to: 0 is along +z, 90 along +x")
            .number("curl", &SmokeStyle::curl, {0.0F, 4.0F}, "", "How much its swirls are fed")
            .toggle("obstacles", &SmokeStyle::obstacles,
                    "Whether it flows around what stands in its box, as that stands when it starts")
            .choice(
                "solver", &SmokeStyle::solver,
                {{"automatic", Solver::automatic},
                 {"spectral", Solver::spectral},
                 {"multigrid", Solver::multigrid},
                 {"jacobi", Solver::jacobi}},
                "How the air's pressure is found: automatic is spectral, directly, where nothing stands in "
                "the box, and else multigrid")
            .choice("advection", &SmokeStyle::advection,
                    {{"automatic", Advection::automatic},
                     {"linear", Advection::linear},
                     {"cubic", Advection::cubic},
                     {"maccormack", Advection::maccormack}},
                    "How what the air carries is looked up: linear blurs, automatic is maccormack")
            .choice("stepping", &SmokeStyle::stepping,
                    {{"project", Stepping::project}, {"reflect", Stepping::reflect}},
                    "Whether the air loses swirls to its steps, or keeps them at twice the price")
            .number("life_s", &SmokeStyle::life_s, {0.1F, 1000.0F}, "s",
                    "After this long a third of it is left")
            .number("fuel_per_s", &SmokeStyle::fuel_per_s, {0.0F, 100.0F}, "1/s",
                    "How quickly fuel comes there with it, which burns where it is warm; 0: none")
            .number(
                "burn_s", &SmokeStyle::burn_s, {0.02F, 100.0F}, "s",
                "After this long in a fire a third of the fuel is left: the longer, the higher flames are")
            .number("burn_heat", &SmokeStyle::burn_heat, {0.0F, 10.0F}, "",
                    "Heat of a unit of fuel that burns, by which it rises")
            .number("soot", &SmokeStyle::soot, {0.0F, 10.0F}, "", "Smoke of a unit of fuel that burns")
            .number("humidity", &SmokeStyle::humidity, {0.0F, 10.0F}, "",
                    "Water in the air that rises, as dense as smoke where all of it is cloud; 0: none")
            .number("cloud_base", &SmokeStyle::cloud_base, {0.0F, 1.0F}, "",
                    "Height from which on that becomes cloud, beside the box's; where it is warm, higher")
            .number("humidity_outside", &SmokeStyle::humidity_outside, {0.0F, 1.0F}, "",
                    "Water in the air outside, beside that in what rises; no more than makes no cloud there")
            .number("latent_heat", &SmokeStyle::latent_heat, {0.0F, 10.0F}, "",
                    "Heat of a unit of water that becomes cloud, by which that billows")
            .number("thickness", &SmokeStyle::thickness, {0.1F, 100.0F}, "",
                    "Optical depth of a tenth of the box's width of dense smoke")
            .toggle("puffs", &SmokeStyle::puffs, "Whether it is drawn as puffs; else as it is")
            .number("puff", &SmokeStyle::puff, {0.02F, 1.0F}, "",
                    "From one puff to the next, beside the box's width")
            .choice("sampling", &SmokeStyle::sampling,
                    {{"rays", Sampling::rays}, {"axis", Sampling::axis}, {"view", Sampling::view}},
                    "Where it is looked up: along rays, on planes of the grid, on planes that face the eye")
            .number("step", &SmokeStyle::step, {0.1F, 4.0F}, "", "From one look-up to the next, in cells")
            .number(
                "scatter", &SmokeStyle::scatter, {0.0F, 1.0F}, "",
                "How far look-ups stray within their step, along rays: noise in place of bands in thin smoke")
            .number("edge", &SmokeStyle::edge, {0.02F, 0.98F}, "", "Opacity at which its outline runs")
            .choice("medium", &SmokeStyle::medium,
                    {{"wash", Medium::wash}, {"strokes", Medium::strokes}, {"both", Medium::both}},
                    "What its shade is drawn with")
            .color("color", &SmokeStyle::color, "Paint where it is lit")
            .color("shade_color", &SmokeStyle::shade_color, "And in shade")
            .color("deep_color", &SmokeStyle::deep_color, "And in deep shade")
            .number("opacity", &SmokeStyle::opacity, {0.0F, 1.0F}, "",
                    "How far its paint covers what is behind")
            .number("shade_below", &SmokeStyle::shade_below, {0.0F, 1.0F}, "",
                    "Share of the light under which it is in shade")
            .number("deep_below", &SmokeStyle::deep_below, {0.0F, 1.0F}, "", "And in deep shade")
            .number("form", &SmokeStyle::form, {0.0F, 1.0F}, "",
                    "How far its light follows the form of each puff, beside what comes through the smoke")
            .number("line_mm", &SmokeStyle::line_mm, {0.0F, 5.0F}, "mm",
                    "Width of the line around a puff, wider in shade")
            .number("stroke_mm", &SmokeStyle::stroke_mm, {0.02F, 5.0F}, "mm", "Width of a stroke")
            .number("darkness", &SmokeStyle::darkness, {0.0F, 1.0F}, "", "Ink of strokes in full shade")
            .toggle("shaded", &SmokeStyle::shaded, "Whether the scene's shadow falls on it")
            .number("shadow", &SmokeStyle::shadow, {0.0F, 1.0F}, "",
                    "How much of the sun its shadow takes from the scene; 0: it throws none")
            .number(
                "glow", &SmokeStyle::glow, {0.0F, 100.0F}, "",
                "Light of the fire that it rises from, half the box's width away, beside a bright surface's")
            .color("glow_color", &SmokeStyle::glow_color, "Colour of that light")
            .number("flame", &SmokeStyle::flame, {0.0F, 10.0F}, "",
                    "How much of it there is to a unit of fuel that burns; 0: none is seen")
            .color("flame_color", &SmokeStyle::flame_color, "Paint of flames")
            .integer("seed", &SmokeStyle::seed, {0, 1000000}, "", "Another number, other puffs");
    return table;
}

} // namespace estampe::smoke
