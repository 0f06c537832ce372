// SPDX-License-Identifier: MIT
// One thread per vertex sums the occlusion of the discs, and the light that they bounce onto the vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/unit.glsl"
#include "techniques/occlusion/alternatives/discs.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer posed_vertices;

layout(scalar, binding = 1) readonly buffer Vertices
{
    uvec2 vertices[]; // for each disc: vertex index, and the bits of the area in square metres
};

layout(push_constant, scalar) uniform Constants
{
    DiscConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool bounces = (variant & discs_bounce) != 0u;

#define DISCS_BINDING 2
#define DISCS_BOUNCE bounces
#include "techniques/occlusion/alternatives/disc_sum.glsl"

layout(scalar, binding = 4) writeonly buffer Open
{
    float open[]; // per vertex: visibility, which is 1 minus the occlusion
};

layout(scalar, binding = 5) writeonly buffer Bounced
{
    vec4 bounced[]; // light that discs bounce onto each vertex
};

void main()
{
    uint item = item_index();
    bool is_there = item < constants.counts[0];
    uvec2 vertex = vertices[is_there ? item : 0u];
    uvec4 words = texelFetch(posed_vertices, int(vertex.x));
    DiscSum sum = sum_of_discs(uintBitsToFloat(words.xyz), unpack_normal(words.w), is_there);
    if (is_there) {
        open[vertex.x] = max(1.0 - sum.hidden, 0.0);
        if (bounces) {
            bounced[vertex.x] = vec4(sum.bounced, 0.0);
        }
    }
}
