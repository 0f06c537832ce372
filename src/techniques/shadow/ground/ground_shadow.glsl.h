// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_GROUND_SHADOW_GLSL_H
#define ESTAMPE_GROUND_SHADOW_GLSL_H
// Square fields (grids) of the ground's heights and horizons around the eye. Each field is four times as
// coarse as the previous field.
#ifdef __cplusplus
#include "shaders/field_sector.glsl.h"
namespace estampe::shared {
#else
#include "shaders/field_sector.glsl.h"
#endif

SHARED_CONSTANT uint ground_levels = 5U;

// Bit of the share pass's variant: fields hold the visible share of the sun in place of the horizon.
SHARED_CONSTANT uint ground_keeps_shares = 1U;

// One field of ground heights, in anchor space (relative to a nearby origin); `origin_m` is the centre of the
// field's first texel.
struct GroundLevel {
    vec2 origin_m;
    float texel_m;
};

// Constants for copying new ground fields into the buffer that is kept for later frames. The third coordinate
// of the dispatch selects the field.
struct GroundKeepConstants {
    uint size;
    uint level[5]; // level of detail of each height field; level 0 is the finest
    FieldSector wanted;
};

struct GroundShareConstants {
    GroundLevel levels[5];
    vec3 towards_sun;
    float radius_rad;
    uint size; // texels per side of a field
};

#ifdef __cplusplus
static_assert(sizeof(GroundShareConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
