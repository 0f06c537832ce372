// SPDX-License-Identifier: MIT
// One thread displaces one vertex along its motion: forwards if the surface around it faces in the direction
// of motion, otherwise backwards.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/motion_blur/alternatives/stretch.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer posed_vertices;
layout(binding = 1) uniform usamplerBuffer posed_vertices_before;

layout(scalar, binding = 2) readonly buffer Together
{
    // For each vertex: start and length, in `members`, of the list of vertices at the same position.
    uvec2 together[];
};

layout(scalar, binding = 3) readonly buffer Members
{
    uint members[];
};

layout(scalar, binding = 4) writeonly buffer Stretched
{
    PosedVertex stretched[];
};

layout(scalar, binding = 5) writeonly buffer StretchedBefore
{
    PosedVertex stretched_before[];
};

layout(push_constant, scalar) uniform Constants
{
    StretchConstants constants;
};

vec3 place_of(uvec4 words)
{
    return uintBitsToFloat(words.xyz);
}

void main()
{
    uint item = item_index();
    if (item >= constants.vertex_count) {
        return;
    }
    uvec4 words = texelFetch(posed_vertices, int(item));
    vec3 now = place_of(words);
    vec3 before = place_of(texelFetch(posed_vertices_before, int(item)));
    // The vertex's previous position, transformed so that the current camera sees it where the previous
    // camera saw it.
    vec4 seen = constants.now_from_before * vec4(before, 1.0);
    vec3 way = seen.w > 1e-6 ? now - seen.xyz / seen.w : vec3(0.0);
    uvec2 list = together[item];
    vec3 normal = vec3(0.0);
    uint i = 0u;
    do {
        normal += unpack_normal(texelFetch(posed_vertices, int(members[list.x + i])).w);
        ++i;
    } while (i < list.y);
    vec3 shift = constants.share * (dot(normal, way) < 0.0 ? -way : way);
    stretched[item] = PosedVertex(now + shift, words.w);
    stretched_before[item] = PosedVertex(before + shift, words.w);
}
