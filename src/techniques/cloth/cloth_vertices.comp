// SPDX-License-Identifier: MIT
// One thread per drawn vertex: the position of the vertex's particle, and the normal there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/cloth/cloth_data.glsl"

layout(binding = 12) uniform samplerBuffer place_texels;

layout(scalar, binding = 13) readonly buffer Vertices
{
    ClothVertex vertices[];
};

layout(scalar, binding = 14) writeonly buffer PosedVertices
{
    PosedVertex posed_vertices[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

layout(binding = 15) uniform usamplerBuffer torn_texels;

uvec2 torn_of(uint local)
{
    return texelFetch(torn_texels, int(sheet.first + local)).xy;
}

#include "techniques/cloth/solver/cloth_torn.glsl"

vec3 place_at(uint local)
{
    return texelFetch(place_texels, int(sheet.first + local)).xyz;
}

vec3 grid_area(uint local, vec3 place)
{
    ivec2 size = ivec2(sheet.columns, sheet.rows);
    ivec2 at = ivec2(local % sheet.columns, local / sheet.columns);
    ivec2 low = max(at - 1, ivec2(0));
    ivec2 high = min(at + 1, size - 1);
    if (may_tear) {
        uvec2 torn = torn_of(local);
        low = ivec2(has_bit(torn, link_bit(ivec2(-1, 0))) ? at.x : low.x,
                    has_bit(torn, link_bit(ivec2(0, -1))) ? at.y : low.y);
        high = ivec2(has_bit(torn, link_bit(ivec2(1, 0))) ? at.x : high.x,
                     has_bit(torn, link_bit(ivec2(0, 1))) ? at.y : high.y);
    }
    vec3 along = place_at(uint(at.y * size.x + high.x)) - place_at(uint(at.y * size.x + low.x));
    vec3 across = place_at(uint(high.y * size.x + at.x)) - place_at(uint(low.y * size.x + at.x));
    return sheet.winding * cross(along, across);
}

vec3 faces_area(uint local, vec3 place)
{
    vec3 area = vec3(0.0);
    for (uint k = 0u; k < sheet.face_width; ++k) {
        uvec2 others = texelFetch(face_texels, int(sheet.first_face + k * sheet.stride + local)).xy;
        vec3 of_face = cross(place_at(others.x) - place, place_at(others.y) - place);
        area += is_torn_face(local, others) ? vec3(0.0) : of_face;
    }
    return area;
}

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    ClothVertex drawn = vertices[64u * group + gl_LocalInvocationID.x];
    if (drawn.vertex == cloth_no_vertex) {
        return;
    }
    sheet = sheets[sheet_of_group[group]];
    uint particle = drawn.particle & ~cloth_on_back;
    vec3 place = place_at(particle);
    vec3 area = (variant & cloth_bit_grid) != 0u ? grid_area(particle, place) : faces_area(particle, place);
    area = particle == drawn.particle ? area : -area;
    float length_m2 = length(area);
    posed_vertices[drawn.vertex].position = place;
    posed_vertices[drawn.vertex].normal =
        pack_normal(length_m2 > 0.0 ? area / length_m2 : vec3(0.0, 1.0, 0.0));
}
