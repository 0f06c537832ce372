// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SKY_GLSL_H
#define ESTAMPE_SKY_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct SkyConstants {
    vec3 horizon_color;
    float stroke_width_px;
    vec3 zenith_color;
    float darkness; // of the strokes at the zenith, away from the sun
    vec3 towards_sun;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
