// SPDX-License-Identifier: MIT
// One thread per vertex: transforms a posed vertex into the sun's view.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "techniques/shadow/shadow.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer PosedVertices
{
    PosedVertex posed_vertices[];
};

layout(scalar, binding = 1) writeonly buffer SunVertices
{
    PosedVertex sun_vertices[];
};

layout(push_constant, scalar) uniform Constants
{
    SunVerticesConstants constants;
};

const float steps_per_texel = 32.0;

void main()
{
    uint i = item_index();
    if (i >= constants.vertex_count) {
        return;
    }
    PosedVertex vertex = posed_vertices[i];
    vec2 texel = vec2(dot(constants.right, vertex.position), dot(constants.down, vertex.position));
    float depth = dot(constants.depth_row, vec4(vertex.position, 1.0));
    vertex.position = vec3(round(texel * steps_per_texel) / steps_per_texel, depth);
    sun_vertices[i] = vertex;
}
