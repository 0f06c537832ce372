// SPDX-License-Identifier: MIT
#include "techniques/cloth/cloth_style.hpp"

#include "style/parameter.hpp"

namespace estampe::cloth {

const style::Table<ClothStyle>& cloth_table()
{
    static const auto table =
        style::Table<ClothStyle>("cloth", "Cloth: sheets of fabric that hang, lie and blow in the wind")
            .number("settle_s", &ClothStyle::settle_s, {0.0F, 20.0F}, "s",
                    "How long cloth has already moved before a still picture or the first frame of a film: 0 "
                    "shows cloth in its starting shape, more lets it hang and settle")
            .number("effort", &ClothStyle::effort, {0.25F, 8.0F}, "",
                    "Number of simulation steps for cloth, as a factor: more makes cloth stretch less and "
                    "takes longer to compute")
            .number("rest_mm_per_s", &ClothStyle::rest_mm_per_s, {0.0F, 100.0F}, "mm/s",
                    "Speed below which cloth stops moving: after half a second below it in still air, cloth "
                    "rests until something moves the cloth. 0 lets no cloth rest.")
            .choice("bodies", &ClothStyle::bodies,
                    {{"capsules", ClothBodies::capsules}, {"depth", ClothBodies::depth}},
                    "Shape that cloth touches instead of an animated character's body. capsules: a rounded "
                    "cylinder around each bone; depth: the front and back surfaces of the body, which is "
                    "more exact.");
    return table;
}

} // namespace estampe::cloth
