// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FIELD_SECTOR_GLSL_H
#define ESTAMPE_FIELD_SECTOR_GLSL_H
// The part of height fields that is computed, for several fields in one dispatch: the texels on the inner
// sides of two straight lines.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Two lines that bound the texels to compute. A texel is inside if `dot(side, texel) + offset` is at least 0
// for each of the two lines; `side` is a line's normal. If all values are zero, every texel is inside.
struct FieldSector {
    vec2 sides[2];   // normals of the two lines, pointing inside
    vec2 offsets[5]; // offsets of both lines, for each height field
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
