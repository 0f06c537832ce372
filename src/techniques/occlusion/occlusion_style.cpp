// SPDX-License-Identifier: MIT
#include "techniques/occlusion/occlusion_style.hpp"

#include "style/parameter.hpp"

namespace estampe::occlusion {

const style::Table<OcclusionStyle>& occlusion_table()
{
    static const auto table =
        style::Table<OcclusionStyle>("occlusion", "Corners and what lies close together are darker")
            .toggle("drawn", &OcclusionStyle::drawn, "Whether there is any")
            .choice(
                "method", &OcclusionStyle::method,
                {{"horizon", Method::horizon},
                 {"discs", Method::discs},
                 {"splats", Method::splats},
                 {"uv", Method::uv},
                 {"unsharp", Method::unsharp}},
                "From what is seen about each pixel; between discs at all vertices, seen or not, for fine "
                "meshes; by those discs at each pixel (splats), or at each texel of a map that lies on all "
                "surfaces (uv), kept until something moves; or no light at all, but what lies behind "
                "what is about it is darker")
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
                    "1 is what shuts out light; more is darker in corners")
            .number("bleeding", &OcclusionStyle::bleeding, {0.0F, 4.0F}, "",
                    "Of discs, splats and uv: how much light what hides throws back in the colour of its "
                    "vertices and material; 1 is as much as a surface in even light does")
            .integer("texels", &OcclusionStyle::texels, {64, 4096}, "texels",
                     "Of uv: the map's side. Surfaces lie in it as their own coordinates lay them, or as "
                     "charts that are cut");
    return table;
}

} // namespace estampe::occlusion
