// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FIELD_SECTOR_GLSL_H
#define ESTAMPE_FIELD_SECTOR_GLSL_H
// What is wanted of fields of heights that are worked out together: the texels on the inner sides of two
// lines.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// A texel is within where dot(side, texel) + offset is not below 0, of both lines. Zeros let all in.
struct FieldSector {
    vec2 sides[2];   // square to the lines, inwards
    vec2 offsets[5]; // of both lines, for each field
};

#ifdef __cplusplus
} // namespace estampe::shared
#else
bool is_within(FieldSector sector, uint field, uvec2 texel)
{
    vec2 at = vec2(texel);
    vec2 inside = vec2(dot(sector.sides[0], at), dot(sector.sides[1], at)) + sector.offsets[field];
    return all(greaterThanEqual(inside, vec2(0.0)));
}
#endif

#endif
