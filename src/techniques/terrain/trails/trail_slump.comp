// SPDX-License-Identifier: MIT
// One thread handles one block of 2 x 2 texels. Sand slides between the texels of the block where it is
// steeper than its angle of repose. Blocks begin at even or at odd texels of the ground, wherever the window
// is. Blocks across the edge of the window are left out.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) buffer Heights
{
    float height_m[];
};

layout(push_constant, scalar) uniform Constants
{
    TrailSlump slump;
};

#include "techniques/terrain/trails/trail_texels.glsl"

float sliding(float from, float to, float most)
{
    float difference = from - to;
    return sign(difference) * 0.5 * max(abs(difference) - most, 0.0);
}

void main()
{
    ivec2 near = 2 * ivec2(gl_GlobalInvocationID.xy) + ivec2(slump.skip_x, slump.skip_y);
    if (!is_within(slump.window, near + 1)) {
        return;
    }
    uint at[4] = {kept_at(slump.window, near), kept_at(slump.window, near + ivec2(1, 0)),
                  kept_at(slump.window, near + ivec2(0, 1)), kept_at(slump.window, near + 1)};
    vec4 before = vec4(height_m[at[0]], height_m[at[1]], height_m[at[2]], height_m[at[3]]);
    if (before == vec4(0.0)) {
        return;
    }
    vec4 h = before;
    float moved = sliding(h.x, h.w, slump.aslant_m);
    h.x -= moved;
    h.w += moved;
    moved = sliding(h.y, h.z, slump.aslant_m);
    h.y -= moved;
    h.z += moved;
    moved = sliding(h.x, h.y, slump.beside_m);
    h.x -= moved;
    h.y += moved;
    moved = sliding(h.z, h.w, slump.beside_m);
    h.z -= moved;
    h.w += moved;
    moved = sliding(h.x, h.z, slump.beside_m);
    h.x -= moved;
    h.z += moved;
    moved = sliding(h.y, h.w, slump.beside_m);
    h.y -= moved;
    h.w += moved;
    if (h != before) {
        height_m[at[0]] = h.x;
        height_m[at[1]] = h.y;
        height_m[at[2]] = h.z;
        height_m[at[3]] = h.w;
    }
}
