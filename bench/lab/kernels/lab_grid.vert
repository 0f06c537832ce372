// SPDX-License-Identifier: MIT
// A page divided into `a` by `a` squares of two triangles each, without an index buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_pixels.glsl"

layout(location = 0) out float across;

void main()
{
    uint square = uint(gl_VertexIndex) / 6u;
    uint corner = uint(gl_VertexIndex) % 6u;
    uvec2 at = uvec2(square % a, square / a) + uvec2(corner == 1u || corner == 2u || corner == 4u ? 1u : 0u,
                                                     corner >= 2u && corner != 3u ? 1u : 0u);
    vec2 place = vec2(at) / float(a);
    across = (variant & at_corners) != 0u ? worked_on(place.x) : place.x;
    gl_Position = vec4(2.0 * place - 1.0, 0.5, 1.0);
}
