// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_EDGE_GLSL_H
#define ESTAMPE_EDGE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

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
static_assert(sizeof(EdgeLook) == 96);
} // namespace estampe::shared
#endif

#endif
