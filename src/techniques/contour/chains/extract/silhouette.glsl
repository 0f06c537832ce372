// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SILHOUETTE
#define ESTAMPE_SILHOUETTE

// Tells which surfaces face the eye. The results are `precise` (no fused multiply-add), because two shaders
// must compute exactly equal values. Requires before inclusion: `frame`, a FrameGlobals.

#include "shaders/scene.glsl.h"

// Direction from a point to the eye, not normalised.
vec3 way_to_eye(vec3 point)
{
    return frame.is_orthographic != 0u ? -frame.view_forward : frame.eye_anchor - point;
}

float exact_dot(vec3 a, vec3 b)
{
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

// Positive if the corners of the triangle are counter-clockwise as seen from the eye.
float facing_of(vec3 a, vec3 b, vec3 c)
{
    precise vec3 u = b - a;
    precise vec3 v = c - a;
    precise vec3 n = vec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    precise vec3 way = way_to_eye(a);
    return exact_dot(n, way);
}

// Direction of a packed normal; not normalised.
vec3 normal_direction(uint packed)
{
    ivec2 words = ivec2(int(packed) << 16, int(packed)) >> 16;
    precise vec2 e = vec2(words);
    precise float z = 32767.0 - abs(e.x) - abs(e.y);
    precise vec2 folded = vec2(32767.0) - abs(e.yx);
    vec2 signs = vec2(e.x >= 0.0 ? 1.0 : -1.0, e.y >= 0.0 ? 1.0 : -1.0);
    return vec3(z < 0.0 ? folded * signs : e, z);
}

// Positive if the smooth surface around a vertex faces the eye.
float facing_at(PosedVertex vertex)
{
    precise vec3 way = way_to_eye(vertex.position);
    vec3 n = normal_direction(vertex.normal);
    return exact_dot(n, way);
}

#endif
