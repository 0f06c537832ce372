// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

namespace estampe::occlusion {

/// How it is found: from the depths on the page, between all vertices, or as a mask of depth.
enum class Method : uint8_t { horizon, discs, unsharp };

/// What occlusion is let into: light from everywhere, all light, or nothing but its own mask.
enum class Feeds : uint8_t { ambient, tone, layer };

struct OcclusionStyle {
    bool drawn = false;
    Method method = Method::horizon;
    Feeds feeds = Feeds::ambient;
    float radius_m = 0.0F;
    float reach_mm = 25.0F;
    float thickness = 0.5F;
    float strength = 1.0F;
};

inline const style::Table<OcclusionStyle>& occlusion_table()
{
    static const auto table =
        style::Table<OcclusionStyle>("occlusion", "Corners and what lies close together are darker")
            .toggle("drawn", &OcclusionStyle::drawn, "Whether there is any")
            .choice(
                "method", &OcclusionStyle::method,
                {{"horizon", Method::horizon}, {"discs", Method::discs}, {"unsharp", Method::unsharp}},
                "From what is seen about each pixel; between discs at all vertices, seen or not, for fine "
                "meshes; or no light at all, but what lies behind what is about it is darker")
            .choice("feeds", &OcclusionStyle::feeds,
                    {{"ambient", Feeds::ambient}, {"tone", Feeds::tone}, {"layer", Feeds::layer}},
                    "What it darkens: the light from everywhere and the fill, all light, or nothing: then "
                    "it is there in layers alone")
            .number("radius_m", &OcclusionStyle::radius_m, {0.0F, 1e6F}, "m",
                    "How far off a thing may be that counts, less and less up to there; 0: a fifth of the "
                    "scene's radius")
            .number("reach_mm", &OcclusionStyle::reach_mm, {0.1F, 200.0F}, "mm",
                    "The same on the page: where the radius is longer there, it is cut to this")
            .number("thickness", &OcclusionStyle::thickness, {0.01F, 4.0F}, "",
                    "How thick things are taken to be, since only one side is seen: a share of the radius")
            .number("strength", &OcclusionStyle::strength, {0.0F, 8.0F}, "",
                    "1 is what shuts out light; more is darker in corners");
    return table;
}

} // namespace estampe::occlusion
