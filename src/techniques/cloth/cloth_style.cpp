// SPDX-License-Identifier: MIT
#include "techniques/cloth/cloth_style.hpp"

#include "style/parameter.hpp"

namespace estampe::cloth {

const style::Table<ClothStyle>& cloth_table()
{
    static const auto table =
        style::Table<ClothStyle>("cloth", "Cloth: sheets of fabric that hang, lie and blow in the wind")
            .number("settle_s", &ClothStyle::settle_s, {0.0F, 20.0F}, "s",
                    "How long cloth has already moved before the picture or the first frame of a film. 0 "
                    "shows cloth in its starting shape, more lets cloth hang and settle.")
            .number("effort", &ClothStyle::effort, {0.25F, 8.0F}, "",
                    "Number of steps in which the motion of cloth is computed, as a factor. More makes cloth "
                    "stretch less and takes longer to compute.")
            .number("rest_mm_per_s", &ClothStyle::rest_mm_per_s, {0.0F, 100.0F}, "mm/s",
                    "Speed below which cloth stops moving, after half a second in still air. More stops "
                    "cloth sooner, until something moves the cloth again. 0 never stops cloth.")
            .choice(
                "bodies", &ClothStyle::bodies,
                {{"capsules", ClothBodies::capsules}, {"depth", ClothBodies::depth}},
                "How cloth feels the body of an animated character. capsules: as a rounded cylinder around "
                "each bone; depth: by the front and back surfaces of the body, which is more exact.");
    return table;
}

} // namespace estampe::cloth
