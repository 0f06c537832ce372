// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SURFACE_MAP
#define ESTAMPE_SURFACE_MAP

// Texels of a map (texture) of all surfaces; see features/common/surface_map.hpp. Requires
// MAP_TEXELS_BINDING.

layout(binding = MAP_TEXELS_BINDING) uniform usamplerBuffer map_texels; // texels of the map, row by row

// The surface point at the centre of a texel of the map.
struct MapPoint {
    bool is_there;
    uint triangle;
    vec3 weight; // barycentric weights of the triangle's corners
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
