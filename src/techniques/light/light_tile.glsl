// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIGHT_TILE
#define ESTAMPE_LIGHT_TILE

// A tile of 8 x 8 pixels, and whether a local light reaches what is seen in it. Who includes this declares
// `FrameGlobals frame` and runs one group of 64 threads a tile.

#include "shaders/camera.glsl"
#include "techniques/light/local_light.glsl"

shared uint tile_nearest; // along the tile's axis, as ordered() has it
shared uint tile_farthest;
shared uint tile_slices;

// Numbers that order as the floats do, of either sign.
uint ordered(float x)
{
    uint bits = floatBitsToUint(x);
    return (bits >> 31) != 0u ? ~bits : bits | 0x80000000u;
}

float from_ordered(uint bits)
{
    return uintBitsToFloat((bits >> 31) != 0u ? bits & 0x7fffffffu : ~bits);
}

// What of the tile can be seen, for asking what lights reach it: a cone about the middle ray, or a cylinder
// in parallel projection, and the distances along it between which the visible points lie.
struct Tile {
    vec3 origin;
    vec3 axis;
    float radius_m; // at the origin
    float widening; // for each metre along the axis
    float nearest_m;
    float farthest_m;
};

// A slice of a tile's depth, 0 to 31 (a 2.5D depth mask).
uint slice_at(Tile tile, float along_m)
{
    float share = (along_m - tile.nearest_m) / max(tile.farthest_m - tile.nearest_m, 1e-6);
    return uint(clamp(32.0 * share, 0.0, 31.0));
}

// `from_px` is the tile's upper left pixel.
Tile find_tile(uvec2 from_px, bool sees, vec3 point)
{
    if (gl_LocalInvocationIndex == 0u) {
        tile_nearest = 0xffffffffu;
        tile_farthest = 0u;
        tile_slices = 0u;
    }
    barrier();
    vec2 corner = vec2(from_px);
    // As far as the scene is large, so that directions are well known.
    bool is_parallel = frame.is_orthographic != 0u;
    float depth = is_parallel ? 0.5 : min(frame.near_m / frame.scene_radius_m, 0.5);
    vec3 middle = anchor_at(frame, corner + 4.0, depth);
    Tile tile;
    tile.origin = is_parallel ? middle : frame.eye_anchor;
    tile.axis = is_parallel ? frame.view_forward : normalize(middle - frame.eye_anchor);
    float widest = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 to_corner = anchor_at(frame, corner + 8.0 * vec2(i & 1, i >> 1), depth) - tile.origin;
        float along = is_parallel ? 1.0 : dot(to_corner, tile.axis);
        widest = max(widest, length(cross(to_corner, tile.axis)) / along);
    }
    tile.radius_m = is_parallel ? widest : 0.0;
    tile.widening = is_parallel ? 0.0 : widest;
    float along_m = dot(point - tile.origin, tile.axis);
    if (sees) {
        atomicMin(tile_nearest, ordered(along_m));
        atomicMax(tile_farthest, ordered(along_m));
    }
    barrier();
    tile.nearest_m = from_ordered(tile_nearest);
    tile.farthest_m = from_ordered(tile_farthest);
    if (sees) {
        atomicOr(tile_slices, 1u << slice_at(tile, along_m));
    }
    barrier();
    return tile;
}

// Whether the light's sphere meets the tile in an occupied slice.
bool reaches(LightRecord light, Tile tile)
{
    vec4 reach = reach_of(light);
    vec3 from_origin = reach.xyz - tile.origin;
    float along_m = dot(from_origin, tile.axis);
    float aside_m = length(from_origin - along_m * tile.axis);
    float widest_at_m = max(min(along_m + reach.w, tile.farthest_m), 0.0);
    float gap_m = max(aside_m - tile.radius_m - tile.widening * widest_at_m, 0.0);
    float half_m = sqrt(max(reach.w * reach.w - gap_m * gap_m, 0.0));
    uint first = slice_at(tile, along_m - half_m);
    uint last = slice_at(tile, along_m + half_m);
    uint slices = (0xffffffffu >> (31u - last)) & (0xffffffffu << first);
    bool apart = along_m - half_m > tile.farthest_m || along_m + half_m < tile.nearest_m;
    return gap_m < reach.w && !apart && (slices & tile_slices) != 0u;
}

#endif
