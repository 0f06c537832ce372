// SPDX-License-Identifier: MIT
#include "techniques/shadow/heightfield/height_shadow.hpp"

#include "style/parameter.hpp"

namespace estampe::shadow {

const style::Table<HeightShadowStyle>& height_shadow_table()
{
    static const auto table =
        style::Table<HeightShadowStyle>("height_shadow", "The sun's shadow that a terrain throws on itself")
            .choice("method", &HeightShadowStyle::method,
                    {{"sweep", HeightMethod::sweep},
                     {"pyramid", HeightMethod::pyramid},
                     {"march", HeightMethod::march}},
                    "How it is found: by lines that sweep the field, by a search through a pyramid of "
                    "heights, or by a ray for each texel and a blur")
            .integer("march_steps", &HeightShadowStyle::march_steps, {1, 16384}, "texels",
                     "How far the ray of march goes at most")
            .number("march_blur_texels", &HeightShadowStyle::march_blur_texels, {0.0F, 32.0F}, "texels",
                    "Deviation of the blur of march; the other methods know the sun's size instead");
    return table;
}

} // namespace estampe::shadow
