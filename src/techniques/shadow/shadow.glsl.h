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
    // Transform from anchor space (relative to a nearby origin) to the map's clip space; reversed z: 1 is
    // nearest to the sun.
    mat4 clip_from_anchor;
    vec3 right;    // direction of the map's x axis, perpendicular to the sun
    float texel_m; // longer side of a texel in metres; in a clipmap, of the finest level
    vec3 down;
    float depth_m;     // distance along the sun's direction that clip z from 0 to 1 covers
    vec2 texels_per_m; // texels per metre along the map's x and y
    uint size;         // texels per side of the map; 0 means no shadow
    float sun_slope;   // tangent of the sun's angular radius
    uint level_count;  // number of clipmap levels; 0 means a single map
    float pixel_m; // size of a pixel at distance 1 from the eye, or at any distance in parallel projection
    float fade;    // 1: the shadow fades towards the edge of the last clipmap level
    vec2 window_low[sun_levels];
    vec2 warp; // for a perspective map: clip y is warp.x - warp.y / w, w the homogeneous coordinate
};

// A square of texels of a clipmap level; the side of the square and of the level are powers of two. The first
// column of the square is a multiple of 4. The depth picture that is drawn for the square starts at
// `first_texel`.
struct MixedSquare {
    uvec2 low; // lowest texel of the square, in two's complement
    // Bits 0-7: log2 of the square's side; bits 8-15: log2 of the level's side; from bit 16: level number.
    uint sizes;
    uint first_texel;
};

struct SunVerticesConstants {
    vec3 right; // the map's x axis, multiplied by texels per metre
    uint vertex_count;
    vec3 down;
    vec4 depth_row; // the row of the sun's clip matrix that gives z
};

// Shadow maps of one local light: one map along a spot's beam, or six along the axes of anchor space
// (relative to a nearby origin). The six maps are stored one after another, in the order +x -x +y -y +z -z. A
// texel holds the near distance `near_m` divided by the surface's distance along the map's axis.
struct LocalShadow {
    vec3 right;       // in a spot's map, the direction in which the column number grows
    float scale;      // half the map's side at distance 1 from the light is 1 / scale
    vec3 down;        // in a spot's map, the direction in which the row number grows
    uint first_texel; // index of the first texel in the buffer of all local shadow maps
    vec3 along;       // axis of a spot's map, from the light along the beam
    uint size;        // texels per side of each map
    float near_m;
    uint is_cube;
    float radius_m; // radius of the luminous sphere in metres; 0 is a point light
    uint unused;    // unused; pads the record to 16 words
};

// Shape and direction of the teeth (small strokes) along shadow edges.
struct EdgeProfile {
    float amplitude_px; // length of a tooth to either side of the shadow edge, in pixels of the page
    float width_px;     // width of the lines that carry the teeth (small strokes); sets the spacing of teeth
    float darkness;
    float variety; // variation of the lengths of teeth (small strokes): 0 all equal, 1 some hardly visible
    vec3 axis_0;   // axis across the first set of wave-shaped teeth (strokes at a shadow's edge)
    uint seed;
    vec3 axis_1;    // axis across the second set of wave-shaped teeth (strokes at a shadow's edge)
    vec3 axis_2;    // axis across the third set of wave-shaped teeth, only at edges of lamps' shadows
    vec2 flat_axis; // axis across the strokes of the hatching's first layer, whose ends are the teeth
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
