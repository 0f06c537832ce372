// SPDX-License-Identifier: MIT
#include "techniques/particles/particle_style.hpp"

#include "style/parameter.hpp"

namespace estampe::particles {

const style::Table<ParticleStyle>& particle_table()
{
    static const auto table =
        style::Table<ParticleStyle>(
            "particles", "Particles: smoke, dust and sparks that come out of objects without a mesh")
            .text("emitters", &ParticleStyle::emitters,
                  "Names of objects without a mesh that send out particles, separated by commas. A * stands "
                  "for any letters. Particles leave along the object's +y axis.")
            .choice("look", &ParticleStyle::look,
                    {{"drawn", Look::drawn},
                     {"wash", Look::wash},
                     {"blots", Look::blots},
                     {"strokes", Look::strokes}},
                    "How particles are drawn. drawn: as one mass with an outline; wash: in soft colour; "
                    "blots: as blots of ink; strokes: as short strokes of ink.")
            .number("per_s", &ParticleStyle::per_s, {0.0F, 200.0F}, "1/s",
                    "Number of particles that each emitter sends out per second: more gives denser smoke, "
                    "dust or sparks")
            .number("life_s", &ParticleStyle::life_s, {0.05F, 100.0F}, "s",
                    "How long a particle lives before the particle disappears: more gives longer trails")
            .number("speed_m_per_s", &ParticleStyle::speed_m_per_s, {0.0F, 100.0F}, "m/s",
                    "Speed at which particles leave their emitter: more throws particles farther")
            .number("spread_deg", &ParticleStyle::spread_deg, {0.0F, 180.0F}, "deg",
                    "How far particles spread around the direction in which their emitter points. 0 is a "
                    "narrow jet, 90 fills a half sphere, 180 sends particles in all directions.")
            .number("lift_m_per_s2", &ParticleStyle::lift_m_per_s2, {-20.0F, 20.0F}, "m/s2",
                    "Upward acceleration of particles: above 0 particles rise like smoke, below 0 they fall "
                    "like sparks")
            .number("wind_m_per_s", &ParticleStyle::wind_m_per_s, {-1.0F, 100.0F}, "m/s",
                    "Speed of the wind that carries particles along, towards wind.towards_deg: more carries "
                    "them farther. -1 takes the speed from wind.speed_m_per_s.")
            .number("swirl_m_per_s", &ParticleStyle::swirl_m_per_s, {0.0F, 100.0F}, "m/s",
                    "Speed of the swirls that particles drift through: 0 gives smooth paths, more scatters "
                    "the particles")
            .number("swirl_m", &ParticleStyle::swirl_m, {0.01F, 1000.0F}, "m",
                    "Size of the swirls that particles drift through: less gives small curls, more gives "
                    "wide bends")
            .number("size_m", &ParticleStyle::size_m, {0.001F, 100.0F}, "m",
                    "Width of a particle when the particle leaves its emitter: more starts larger")
            .number("grown_m", &ParticleStyle::grown_m, {0.001F, 100.0F}, "m",
                    "Width of a particle at the end of its life: more than particles.size_m lets the "
                    "particle grow")
            .file_or_name("sheet", &ParticleStyle::sheet, {"smoke"},
                          "Picture of a particle, as a sprite sheet: a grid of frames that show the life of "
                          "a particle. White is where the particle is dense. The name smoke uses a simulated "
                          "puff of smoke. If empty, particles are ragged discs.")
            .integer(
                "rows", &ParticleStyle::rows, {1, 64}, "",
                "Number of rows of frames in the sprite sheet (grid of pictures) that particles.sheet names")
            .integer("columns", &ParticleStyle::columns, {1, 64}, "",
                     "Number of columns of frames in the sprite sheet (grid of pictures) that "
                     "particles.sheet names")
            .color("color", &ParticleStyle::color,
                   "Colour of particles. Only used when particles.look is drawn or wash.")
            .number("opacity", &ParticleStyle::opacity, {0.0F, 1.0F}, "",
                    "Opacity of a particle: 0 is invisible, 1 is dense")
            .number("outline_mm", &ParticleStyle::outline_mm, {0.0F, 10.0F}, "mm",
                    "Width of the outline around particles. Only used when particles.look is drawn.")
            .color("ink", &ParticleStyle::ink,
                   "Colour of the ink of particles: their outlines, blots or strokes")
            .number("soft_m", &ParticleStyle::soft_m, {0.001F, 100.0F}, "m",
                    "Distance in front of a surface over which particles fade out. More hides the hard edge "
                    "where particles cut into the surface.")
            .by_object_but({"emitters"});
    return table;
}

} // namespace estampe::particles
