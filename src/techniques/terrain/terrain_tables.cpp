// SPDX-License-Identifier: MIT
#include "techniques/terrain/terrain_tables.hpp"

#include "style/parameter.hpp"

namespace estampe::terrain {

const style::Table<TerrainLook>& look_table()
{
    static const auto table =
        style::Table<TerrainLook>("terrain", "The ground").color("color", &TerrainLook::color, "Of the sand");
    return table;
}

const style::Table<TerrainWind>& wind_table()
{
    static const auto table = style::Table<TerrainWind>("wind", "What dunes go along with")
                                  .number("direction_deg", &TerrainWind::direction_deg, {-360.0F, 360.0F},
                                          "deg", "Where it blows to: 0 is +x, 90 is +z")
                                  .number("speed_m_s", &TerrainWind::speed_m_s, {0.0F, 100.0F}, "m/s",
                                          "How fast; `wind` in heights");
    return table;
}

const style::Table<TerrainMeshing>& mesh_table()
{
    static const auto table =
        style::Table<TerrainMeshing>("mesh", "How the ground is cut into triangles")
            .choice(
                "method", &TerrainMeshing::method,
                {{"rings", TerrainMesh::rings}, {"grid", TerrainMesh::grid}, {"object", TerrainMesh::object}},
                "Nested grids about the eye, each twice as coarse as the one within; one even grid "
                "before the eye, turned by right angles; or an object of the scene, raised by the heights")
            .text("object", &TerrainMeshing::object, "The name of that object")
            .choice("update", &TerrainMeshing::update,
                    {{"moved", TerrainUpdate::moved},
                     {"always", TerrainUpdate::always},
                     {"still", TerrainUpdate::still}},
                    "When vertices are found anew: when eye or time have gone on, in every picture, or as if "
                    "time stood still")
            .number("cell_m", &TerrainMeshing::cell_m, {0.01F, 64.0F}, "m",
                    "Between vertices nearest to the eye; rounded to a power of two")
            .integer("cells", &TerrainMeshing::cells, {16, 2048}, "",
                     "Along a side of a ring or grid; rounded up to a multiple of 4")
            .number("reach_m", &TerrainMeshing::reach_m, {10.0F, 100000.0F}, "m",
                    "How far the rings go at least")
            .number("planet_radius_m", &TerrainMeshing::planet_radius_m, {0.0F, 1e7F}, "m",
                    "Of a ground that closes round itself; 0: it is flat");
    return table;
}

const style::Table<TerrainRipples>& ripples_table()
{
    static const auto table =
        style::Table<TerrainRipples>("ripples", "What the wind draws on sand, seen from near")
            .number("wavelength_m", &TerrainRipples::wavelength_m, {0.005F, 100.0F}, "m",
                    "From crest to crest")
            .number("height_m", &TerrainRipples::height_m, {0.0F, 10.0F}, "m",
                    "From trough to crest; 0: there are none")
            .number("meander", &TerrainRipples::meander, {0.0F, 1.0F}, "",
                    "0: straight and unbroken; 1: they wind, fork and end everywhere")
            .number("drift_m_s", &TerrainRipples::drift_m_s, {-1.0F, 1.0F}, "m/s",
                    "How fast they go with the wind");
    return table;
}

const style::Table<TerrainTrails>& trails_table()
{
    static const auto table =
        style::Table<TerrainTrails>("trails", "Footprints, and what is dragged over sand")
            .number("half_life_s", &TerrainTrails::half_life_s, {0.1F, 1e6F}, "s",
                    "Time after which the wind has filled half of a trail's depth")
            .number("repose_deg", &TerrainTrails::repose_deg, {5.0F, 80.0F}, "deg",
                    "Angle beyond which a rim slumps; damp sand stands steeper")
            .number("extent_m", &TerrainTrails::extent_m, {4.0F, 400.0F}, "m",
                    "Side of the square before the eye in which trails are seen, in 1,024 texels");
    return table;
}

} // namespace estampe::terrain
