// SPDX-License-Identifier: MIT
#include "techniques/terrain/slabs/slabs.hpp"

#include "style/parameter.hpp"

namespace estampe::terrain {

const style::Table<SlabStyle>& slab_table()
{
    static const auto table =
        style::Table<SlabStyle>("slabs", "Dunes of sand that the wind moves in slabs")
            .number("cell_m", &SlabStyle::cell_m, {0.05F, 20.0F}, "m", "Side of a cell")
            .number("slab_m", &SlabStyle::slab_m, {0.01F, 2.0F}, "m",
                    "Height of a slab; a tenth of a cell holds the angle of repose well")
            .number("depth_m", &SlabStyle::depth_m, {0.0F, 100.0F}, "m",
                    "Sand on the rock, spread evenly; little of it makes lone dunes, much a sea")
            .number("wind_deg", &SlabStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Where the wind blows to, from the field's x towards its y; dunes are best along an axis")
            .number("wind_spread_deg", &SlabStyle::wind_spread_deg, {0.0F, 90.0F}, "deg",
                    "How far it turns to either side from step to step")
            .number("hop_cells", &SlabStyle::hop_cells, {0.25F, 32.0F}, "cells", "How far a slab hops")
            .number("speedup_per_m", &SlabStyle::speedup_per_m, {0.0F, 1.0F}, "1/m",
                    "How much farther for each metre above the sand's depth; makes gentle windward slopes")
            .number("lift_share", &SlabStyle::lift_share, {0.0F, 1.0F}, "",
                    "Share of the cells that the wind tries to lift a slab from in a step")
            .number("stay_on_sand", &SlabStyle::stay_on_sand, {0.01F, 1.0F}, "",
                    "Share of the slabs that stay where they touch sand")
            .number("stay_on_rock", &SlabStyle::stay_on_rock, {0.01F, 1.0F}, "",
                    "The same where there is none")
            .number("lee_deg", &SlabStyle::lee_deg, {1.0F, 60.0F}, "deg",
                    "Fall of the line from a crest under which there is no wind")
            .number("repose_deg", &SlabStyle::repose_deg, {5.0F, 60.0F}, "deg",
                    "Angle beyond which sand slides")
            .integer("slides", &SlabStyle::slides, {0, 64}, "",
                     "How often it may slide in a step; four let it slide in every direction once")
            .integer("smooth_cells", &SlabStyle::smooth_cells, {0, 8}, "cells",
                     "How far heights are smoothed when they are handed out, so that slabs are no stairs")
            .integer("seed", &SlabStyle::seed, {0, 1000000}, "", "Another desert for each");
    return table;
}

} // namespace estampe::terrain
