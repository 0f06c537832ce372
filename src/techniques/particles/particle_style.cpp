// SPDX-License-Identifier: MIT
#include "techniques/particles/particle_style.hpp"

#include "style/parameter.hpp"

namespace estampe::particles {

const style::Table<ParticleStyle>& particle_table()
{
    static const auto table =
        style::Table<ParticleStyle>("particles", "Smoke, dust and sparks from objects without a mesh")
            .text("emitters", &ParticleStyle::emitters,
                  "Objects that give particles along their own +y, as patterns between commas")
            .choice("look", &ParticleStyle::look,
                    {{"drawn", Look::drawn},
                     {"wash", Look::wash},
                     {"blots", Look::blots},
                     {"strokes", Look::strokes}},
                    "One mass with an outline, soft colour, blots of ink, or short strokes of ink")
            .number("per_s", &ParticleStyle::per_s, {0.0F, 200.0F}, "1/s", "How many each of them gives")
            .number("life_s", &ParticleStyle::life_s, {0.05F, 100.0F}, "s", "How long a particle lasts")
            .number("speed_mps", &ParticleStyle::speed_mps, {0.0F, 100.0F}, "m/s", "Speed at which it leaves")
            .number("spread_deg", &ParticleStyle::spread_deg, {0.0F, 180.0F}, "deg",
                    "How far off the emitter's direction it leaves at most")
            .number("lift_mps2", &ParticleStyle::lift_mps2, {-20.0F, 20.0F}, "m/s2",
                    "What it gains upwards, or falls")
            .number("wind_mps", &ParticleStyle::wind_mps, {0.0F, 100.0F}, "m/s",
                    "Speed of the wind that takes it along")
            .number("wind_deg", &ParticleStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Bearing the wind blows to: 0 is +z, 90 +x")
            .number("swirl_mps", &ParticleStyle::swirl_mps, {0.0F, 100.0F}, "m/s",
                    "Speed of swirls in the air")
            .number("swirl_m", &ParticleStyle::swirl_m, {0.01F, 1000.0F}, "m", "Size of a swirl")
            .number("size_m", &ParticleStyle::size_m, {0.001F, 100.0F}, "m", "Width of a new particle")
            .number("grown_m", &ParticleStyle::grown_m, {0.001F, 100.0F}, "m", "And of an old one")
            .file_or_name("sheet", &ParticleStyle::sheet, {"smoke"},
                          "Picture of rows and columns of frames, shown one after the other: white is dense; "
                          "or a puff of smoke that is worked out; without one particles are ragged discs")
            .integer("rows", &ParticleStyle::rows, {1, 64}, "", "Of a picture's sheet")
            .integer("columns", &ParticleStyle::columns, {1, 64}, "", "Of a picture's sheet")
            .color("color", &ParticleStyle::color, "Colour of drawn and soft ones")
            .number("opacity", &ParticleStyle::opacity, {0.0F, 1.0F}, "", "How dense a particle is")
            .number("outline_mm", &ParticleStyle::outline_mm, {0.0F, 10.0F}, "mm", "Width of drawn outlines")
            .color("ink", &ParticleStyle::ink, "Colour of outlines, blots and strokes")
            .number("soft_m", &ParticleStyle::soft_m, {0.001F, 100.0F}, "m",
                    "Before a surface it fades over so much")
            .integer("seed", &ParticleStyle::seed, {0, 1000000}, "", "Another number, other particles")
            .by_surface_but({"emitters"});
    return table;
}

} // namespace estampe::particles
