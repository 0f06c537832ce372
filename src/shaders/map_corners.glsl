// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MAP_CORNERS
#define ESTAMPE_MAP_CORNERS

// Positions of triangle corners in the map (texture of all surfaces) of shaders/surface_map.glsl. Requires
// MAP_CORNERS_BINDING.

// Positions of corners in the map, three per triangle.
layout(binding = MAP_CORNERS_BINDING) uniform usamplerBuffer map_corners;

// Position of a corner in the map in texels, whose centres are at halves; negative if the triangle is not in
// the map.
vec2 map_corner_at(uint corner)
{
    return uintBitsToFloat(texelFetch(map_corners, int(corner)).xy);
}

vec2 place_in_map(uint triangle, vec3 weight)
{
    return mat3x2(map_corner_at(3u * triangle), map_corner_at(3u * triangle + 1u),
                  map_corner_at(3u * triangle + 2u)) *
           weight;
}

#endif
