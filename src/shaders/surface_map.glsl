// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SURFACE_MAP
#define ESTAMPE_SURFACE_MAP

// Texels of a map that lies on all surfaces, see features/common/surface_map.hpp. Wanted before:
// MAP_TEXELS_BINDING.

layout(binding = MAP_TEXELS_BINDING) uniform usamplerBuffer map_texels; // row by row

// What of the surface lies at the middle of a texel.
struct MapPoint {
    bool is_there;
    uint triangle;
    vec3 weight; // of its corners
};

uint map_texel_count()
{
    return uint(textureSize(map_texels));
}

MapPoint map_point_at(uint texel)
{
    uvec4 words = texelFetch(map_texels, int(texel));
    vec2 weights = uintBitsToFloat(words.yz);
    return MapPoint(words.x != 0u, max(words.x, 1u) - 1u, vec3(1.0 - weights.x - weights.y, weights));
}

#endif
