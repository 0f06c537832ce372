// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIGHT_GLSL_H
#define ESTAMPE_LIGHT_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

// A light in anchor space, exposure multiplied in. Directional: `direction` points to it, `position` is
// unused.
struct LightRecord {
    vec3 position;
    float range_m;  // no light beyond it
    vec3 direction; // towards a directional light; along a spot's beam
    uint type;
    vec3 color;
    float cone_scale; // spots: saturate(cos(angle) * scale + offset) squared
    float cone_offset;
};

struct LightGlobals {
    vec3 sky_ambient;
    vec3 ground_ambient;
    uint directional_count; // these come first in the list; the first casts the shadow
    uint local_count;
    float falloff; // exponent of the cosine; 1 is Lambert's
};

#ifdef __cplusplus
static_assert(sizeof(LightRecord) == 52);
static_assert(sizeof(LightGlobals) == 36);
inline constexpr uint light_directional = 0;
inline constexpr uint light_point = 1;
inline constexpr uint light_spot = 2;
} // namespace estampe::shared
#else
#define LIGHT_SPOT 2u
#endif

#endif
