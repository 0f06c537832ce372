// SPDX-License-Identifier: MIT
#include "techniques/cells/culling_style.hpp"

namespace estampe::cells {

const style::Table<CullingStyle>& culling_table()
{
    static const auto table =
        style::Table<CullingStyle>("culling", "Parts of the scene that are out of sight")
            .choice("cells", &CullingStyle::cells, {{"off", Culling::off}, {"portals", Culling::portals}},
                    "Leaves out rooms that no door or window shows, which changes only the time. off: draws "
                    "all rooms; portals: draws the rooms that the eye sees through openings. Only used for "
                    "scenes with cells and portals.");
    return table;
}

} // namespace estampe::cells
