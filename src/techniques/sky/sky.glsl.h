// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SKY_GLSL_H
#define ESTAMPE_SKY_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint sky_has_tiles = 1U << 0U; // variant bit of sky.comp: only those of a list are painted
SHARED_CONSTANT uint sky_has_depth = 1U << 1U; // and nothing where something near is seen

struct SkyConstants {
    vec3 horizon_color;
    float stroke_width_px;
    vec3 zenith_color;
    float darkness; // of the strokes at the zenith, away from the sun
    vec3 towards_sun;
    vec3 high_color; // of the band above
    float high_rad;  // height of the middle of its edge
    vec3 low_color;
    float low_rad;
    vec3 disc_color;
    float disc_rad; // half the disc's width; 0 is none
    vec3 towards_disc;
    float disc_lit; // share of its width that shines
    float steps;    // flat tones; 0 is an even grade
    float far_m;    // from the eye: of the variant that knows of depth
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
