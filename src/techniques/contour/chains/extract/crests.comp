// SPDX-License-Identifier: MIT
// One thread handles one vertex of the terrain. The thread computes two values: how steeply the ground falls
// along the wind, minus half the slope of a slip face (steep lee side); and the vertex's position along the
// wind. A dune's brink (sharp upper edge) lies where the first value rises through zero.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer posed_vertex_texels;

layout(scalar, binding = 1) writeonly buffer ViewBends
{
    vec2 view_bends[];
};

layout(push_constant, scalar) uniform Constants
{
    CrestConstants constants;
};

// Half the slope of a slip face (steep lee side); sand slides from a slope of 0.62 on, and windward sides are
// flatter than 0.3.
const float half_slip_face = 0.3;

void main()
{
    uint index = item_index() + (constants.keeps_others != 0u ? constants.first_vertex : 0u);
    if (index >= constants.vertex_count) {
        return;
    }
    uvec4 words = texelFetch(posed_vertex_texels, int(index));
    vec3 normal = unpack_normal(words.w);
    vec2 place = uintBitsToFloat(words.xz);
    float fall = dot(normal.xz, constants.along) / max(normal.y, 1e-3) - half_slip_face;
    bool is_of_ground = index >= constants.first_vertex;
    view_bends[index] = is_of_ground ? vec2(fall, dot(place, constants.along)) : vec2(1.0, -1.0);
}
