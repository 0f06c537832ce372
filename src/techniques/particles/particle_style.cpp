// SPDX-License-Identifier: MIT
#include "techniques/particles/particle_style.hpp"

#include "style/parameter.hpp"

namespace estampe::particles {

const style::Table<ParticleStyle>& particle_table()
{
    static const auto table =
        style::Table<ParticleStyle>("particles",
                                    "Particles: smoke, dust and sparks from objects without a mesh")
            .text("emitters", &ParticleStyle::emitters,
                  "Objects without a mesh that give particles along their own +y, as name patterns with "
                  "commas between them")
            .choice("look", &ParticleStyle::look,
                    {{"drawn", Look::drawn},
                     {"wash", Look::wash},
                     {"blots", Look::blots},
                     {"strokes", Look::strokes}},
                    "How particles are drawn. drawn: one mass with an outline; wash: soft colour; blots: "
                    "blots of ink; strokes: short strokes of ink.")
            .number("per_s", &ParticleStyle::per_s, {0.0F, 200.0F}, "1/s",
                    "Number of particles that each emitter gives per second")
            .number("life_s", &ParticleStyle::life_s, {0.05F, 100.0F}, "s",
                    "How long a particle lives before it is gone")
            .number("speed_m_per_s", &ParticleStyle::speed_m_per_s, {0.0F, 100.0F}, "m/s",
                    "Speed at which particles leave their emitter")
            .number("spread_deg", &ParticleStyle::spread_deg, {0.0F, 180.0F}, "deg",
                    "Largest angle between a particle's first direction and the emitter's: 0 is a jet, 90 a "
                    "half sphere, 180 every direction")
            .number("lift_m_per_s2", &ParticleStyle::lift_m_per_s2, {-20.0F, 20.0F}, "m/s2",
                    "Upward acceleration of particles: above 0 they rise like smoke, below 0 they fall like "
                    "sparks")
            .number("wind_m_per_s", &ParticleStyle::wind_m_per_s, {0.0F, 100.0F}, "m/s",
                    "Speed of the wind that carries particles along")
            .number("wind_deg", &ParticleStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Bearing towards which the wind carries particles: 0 is +z, 90 is +x")
            .number("swirl_m_per_s", &ParticleStyle::swirl_m_per_s, {0.0F, 100.0F}, "m/s",
                    "Speed of the swirls that particles drift through: 0 lets them fly smoothly, more "
                    "scatters them")
            .number("swirl_m", &ParticleStyle::swirl_m, {0.01F, 1000.0F}, "m",
                    "Size of the swirls that particles drift through")
            .number("size_m", &ParticleStyle::size_m, {0.001F, 100.0F}, "m",
                    "Width of a particle when it leaves its emitter")
            .number("grown_m", &ParticleStyle::grown_m, {0.001F, 100.0F}, "m",
                    "Width of a particle at the end of its life")
            .file_or_name("sheet", &ParticleStyle::sheet, {"smoke"},
                          "Picture of a particle as a sprite sheet of frames over its life, where white is "
                          "dense; or smoke, a simulated puff. An empty text gives ragged discs.")
            .integer("rows", &ParticleStyle::rows, {1, 64}, "",
                     "Number of rows of frames in the picture that particles.sheet names")
            .integer("columns", &ParticleStyle::columns, {1, 64}, "",
                     "Number of columns of frames in the picture that particles.sheet names")
            .color("color", &ParticleStyle::color,
                   "Colour of particles. Only used when particles.look is drawn or wash.")
            .number("opacity", &ParticleStyle::opacity, {0.0F, 1.0F}, "",
                    "Opacity of a particle: 0 is invisible, 1 is dense")
            .number("outline_mm", &ParticleStyle::outline_mm, {0.0F, 10.0F}, "mm",
                    "Width of the outline around particles. Only used when particles.look is drawn.")
            .color("ink", &ParticleStyle::ink,
                   "Colour of the ink of particles: their outlines, blots or strokes")
            .number(
                "soft_m", &ParticleStyle::soft_m, {0.001F, 100.0F}, "m",
                "Distance in front of a surface over which particles fade: more hides where they cut into it")
            .by_surface_but({"emitters"});
    return table;
}

} // namespace estampe::particles
