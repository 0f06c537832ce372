// SPDX-License-Identifier: MIT
// One thread per disc places the disc at its posed vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/occlusion/alternatives/discs.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer posed_vertices;

layout(scalar, binding = 1) readonly buffer Vertices
{
    uvec2 vertices[]; // for each disc: vertex index, and the bits of the area in square metres
};

layout(scalar, binding = 2) writeonly buffer Discs
{
    Disc discs[];
};

layout(push_constant, scalar) uniform Constants
{
    DiscConstants constants;
};

void main()
{
    uint item = item_index();
    if (item >= constants.counts[0]) {
        return;
    }
    uvec2 vertex = vertices[item];
    uvec4 words = texelFetch(posed_vertices, int(vertex.x));
    float area_m2 = uintBitsToFloat(vertex.y);
    discs[item] = Disc(uintBitsToFloat(words.xyz), 0.0, area_m2 * unpack_normal(words.w), area_m2);
}
