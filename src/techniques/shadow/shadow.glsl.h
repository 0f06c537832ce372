// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADOW_GLSL_H
#define ESTAMPE_SHADOW_GLSL_H
// Data for lookups in the shadow maps of the sun and of local lights, and for the edges of shadows.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint sun_levels = 8U;

// Data for lookups in the sun's shadow map.
struct SunShadow {
    mat4 clip_from_anchor; // reversed z: 1 is nearest to the sun
    vec3 right;            // direction of the map's x, perpendicular to the sun; `down` is that of y
    float texel_m;         // longer side of a texel; in a clipmap, of the finest level
    vec3 down;
    float depth_m;     // depth that clip z from 0 to 1 covers
    vec2 texels_per_m; // along x and y
    uint size;         // texels per side; 0 means no shadow
    float sun_slope;   // tangent of the sun's angular radius
    uint level_count;  // levels of a clipmap; 0 is a single map
    float pixel_m;     // size of a pixel at distance 1; at any distance in parallel projection
    float fade;        // 1: the shadow fades towards the edge of the last level
    vec2 window_low[sun_levels];
    vec2 warp; // perspective map: clip y is warp.x - warp.y / w
};

// A square of a level; both sizes are powers of two. Its first column is a multiple of 4. The picture of the
// square starts at `first_texel`.
struct MixedSquare {
    uvec2 low;  // in two's complement
    uint sizes; // log2 of the square's side in bits 0-7, of the level's in 8-15; level number from bit 16
    uint first_texel;
};

struct SunVerticesConstants {
    vec3 right; // multiplied by texels per metre
    uint vertex_count;
    vec3 down;
    vec4 depth_row; // row of the sun's clip matrix that gives z
};

// Shadow maps of one local light: one along a spot's beam, or six along the axes of anchor space, +x -x +y -y
// +z -z, one after another. Texels hold near_m / w, where w is the distance along the map's axis.
struct LocalShadow {
    vec3 right;       // direction of growing columns in a spot's map
    float scale;      // half the map's side at distance 1 from the light is 1 / scale
    vec3 down;        // direction of growing rows in a spot's map
    uint first_texel; // position in the buffer of all maps
    vec3 along;       // axis of a spot's map
    uint size;        // texels per side
    float near_m;
    uint is_cube;
    float radius_m; // radius of the luminous sphere; 0 is a point light
    uint unused;    // pads the struct to 16 words
};

// Shape and direction of the teeth along shadow edges.
struct EdgeProfile {
    float amplitude_px; // reach of a tooth to either side of the edge, on the page
    float width_px;     // width of the lines that carry the teeth; determines the teeth's spacing
    float darkness;
    float variety; // 0: all teeth have the same length; 1: some hardly show
    vec3 axis_0;   // waves: axis across the first family of teeth; axis_1 is that of the second
    uint seed;
    vec3 axis_1;    // waves only
    vec3 axis_2;    // waves of lamps only
    vec2 flat_axis; // strokes only: axis of the hatching's first layer
    vec2 wind;
    vec2 ground_wind;
    vec3 towards_light;
    uint has_directions;
};

#ifdef __cplusplus
static_assert(sizeof(SunShadow) == 196);
static_assert(sizeof(LocalShadow) == 64);
static_assert(sizeof(EdgeProfile) == 96);
} // namespace estampe::shared
#endif

#endif
