// SPDX-License-Identifier: MIT
#include "techniques/lightmap/lightmap.hpp"

#include "style/parameter.hpp"

namespace estampe::lightmap {

const style::Table<LightmapStyle>& lightmap_table()
{
    static const auto table =
        style::Table<LightmapStyle>("lightmap", "Light worked out ahead, in scenes that have any")
            .number("strength", &LightmapStyle::strength, {0.0F, 10.0F}, "",
                    "Light of lightmaps is multiplied by this")
            .toggle("balance", &LightmapStyle::balance,
                    "Whether all light is dimmed by as much as lightmaps brighten what lights and ambient "
                    "light show");
    return table;
}

} // namespace estampe::lightmap
