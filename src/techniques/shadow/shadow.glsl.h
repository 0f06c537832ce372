// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADOW_GLSL_H
#define ESTAMPE_SHADOW_GLSL_H
// Shadow maps of the sun and of local lights, and the edges of their shadows, as lookups need to know them.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint sun_levels = 8U;

// The sun's shadow map, as who looks it up needs to know it.
struct SunShadow {
    mat4 clip_from_anchor; // reversed z: 1 nearest to the sun
    vec3 right;            // directions of the map's x and y, both square to the sun
    float texel_m;         // the longer side of a texel; of a clipmap, the finest
    vec3 down;
    float depth_m;     // what clip z of 0 to 1 spans
    vec2 texels_per_m; // along x and y
    uint size;         // texels a side; 0: no shadow
    float sun_slope;   // tangent of the sun's angular radius
    uint level_count;  // of a clipmap; 0 for a single map
    float pixel_m;     // what a pixel spans at a distance of one; in parallel projection at any
    float fade;        // 1: shadow pales towards the edge of the last level
    vec2 window_low[sun_levels];
    vec2 warp; // of a map in perspective: clip y is warp.x - warp.y / w
};

// A square of a level, both of powers of two, and where a picture of it begins. Its first column is a
// multiple of 4.
struct MixedSquare {
    uvec2 low;  // as two's complement
    uint sizes; // logarithms: of the square's side in bits 0-7, of the level's in 8-15; the level above
    uint first_texel;
};

struct SunVerticesConstants {
    vec3 right; // times texels a metre
    uint vertex_count;
    vec3 down;
    vec4 depth_row; // of the sun's clip z
};

// The shadow maps of one local light: one map along a spot's beam, or six along the axes of anchor space,
// +x -x +y -y +z -z, one after another. Texels hold near_m / w, w being the distance along the map's axis.
struct LocalShadow {
    vec3 right;       // of a spot's map, towards its growing columns
    float scale;      // half the map's side, at distance 1 from the light, is 1 / scale
    vec3 down;        // of a spot's map, towards its growing rows
    uint first_texel; // in the buffer of all maps
    vec3 along;       // the axis of a spot's map
    uint size;        // texels a side
    float near_m;
    uint is_cube;
    float radius_m; // of the ball that glows; 0: a point
    uint unused;    // four texels of four words
};

// What the teeth of shadows' edges look like, and what they follow.
struct EdgeLook {
    float amplitude_px; // how far a tooth reaches to either side of the edge, on the page
    float width_px;     // of the lines that carry the teeth, and how dark they are: their spacing follows
    float darkness;
    float variety;  // 0: all teeth are as long; 1: some hardly show
    vec3 axis_0;    // waves: across the teeth of the first and of the second family
    uint seed;      // of the hatching
    vec3 axis_1;    // waves
    vec3 axis_2;    // waves of lamps
    vec2 flat_axis; // strokes: as the hatching's first layer has them
    vec2 wind;
    vec2 ground_wind;
    vec3 towards_light;
    uint has_directions;
};

#ifdef __cplusplus
static_assert(sizeof(SunShadow) == 196);
static_assert(sizeof(LocalShadow) == 64);
static_assert(sizeof(EdgeLook) == 96);
} // namespace estampe::shared
#endif

#endif
