// SPDX-License-Identifier: MIT
// One thread per particle: the target at the end of the next run of steps is the posed position of the
// particle's vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "techniques/cloth/cloth.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Holds
{
    ClothHold holds[];
};

layout(scalar, binding = 1) readonly buffer PosedVertices
{
    PosedVertex posed_vertices[];
};

layout(scalar, binding = 2) writeonly buffer Targets
{
    vec4 targets[];
};

layout(push_constant, scalar) uniform Constants
{
    uint particle_count;
};

void main()
{
    uint particle = item_index();
    if (particle >= particle_count) {
        return;
    }
    ClothHold hold = holds[particle];
    vec3 place = hold.vertex == cloth_no_vertex ? vec3(0.0) : posed_vertices[hold.vertex].position;
    targets[particle] = vec4(place, hold.share);
}
