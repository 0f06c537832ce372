// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_LARGE
#define ESTAMPE_CLOTH_LARGE

// Inputs and outputs of one pass of a large sheet's step, with one thread per particle.
// Cloths::add_pass_of_step() binds the inputs and outputs for the passes of every solver.

#include "techniques/cloth/solids/cloth_met.glsl"

layout(scalar, binding = 12) buffer Places
{
    vec4 places[]; // position of each particle, and its inverse mass in w
};

layout(scalar, binding = 13) writeonly buffer Speeds
{
    vec4 speeds[]; // velocity of each particle, and the time for which it has been calm in w
};

layout(scalar, binding = 14) readonly buffer Pushes
{
    vec4 pushes[];
};

layout(binding = 15) uniform samplerBuffer predicted_texels;

layout(scalar, binding = 16) writeonly buffer Predicted
{
    vec4 predicted[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

vec4 predicted_at(uint local)
{
    return texelFetch(predicted_texels, int(sheet.first + local));
}

vec4 own_predicted(uint local)
{
    return predicted_at(local);
}

vec4 predicted_beside(uint local, ivec2 way, bool is_there)
{
    return predicted_at(is_there ? uint(int(local) + way.y * int(sheet.columns) + way.x) : local);
}

layout(binding = 17) uniform usamplerBuffer near_texels;

layout(scalar, binding = 18) readonly buffer Awake
{
    uint awake_in[];
};

layout(scalar, binding = 19) readonly buffer Began
{
    vec4 began[];
};

layout(scalar, binding = 20) readonly buffer Met
{
    uint met[]; // per workgroup: its bounding ball, and the bits of solids near the ball
};

layout(binding = 21) uniform usamplerBuffer torn_texels;

uvec2 torn_of(uint local)
{
    return texelFetch(torn_texels, int(sheet.first + local)).xy;
}

uvec4 near_of(uint local)
{
    return texelFetch(near_texels, int(sheet.first + local));
}

vec4 met_ball()
{
    uint at = gl_WorkGroupID.x * met_stride();
    return uintBitsToFloat(uvec4(met[at], met[at + 1u], met[at + 2u], met[at + 3u]));
}

uint met_solids(uint word)
{
    return met[gl_WorkGroupID.x * met_stride() + cloth_met_head + word];
}

#include "techniques/cloth/solver/cloth_awake.glsl"
#include "techniques/cloth/solver/cloth_move.glsl"

#endif
