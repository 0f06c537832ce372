// SPDX-License-Identifier: MIT
// One thread per triangle of a body: the front and back extent of the triangle along z, at each node that the
// triangle covers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "techniques/cloth/cloth.glsl.h"
#include "techniques/cloth/solids/cloth_turns.glsl"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer triangle_texels; // three posed vertices per triangle of the body

layout(scalar, binding = 1) readonly buffer PosedVertices
{
    PosedVertex posed_vertices[];
};

layout(scalar, binding = 2) buffer Ends
{
    uint ends[]; // per node: front surface, then back surface (negated); 0: empty
};

layout(push_constant, scalar) uniform Constants
{
    ClothBody body;
};

// Maps floats to integers above 0 that compare in the order of the floats.
uint ordered(float number)
{
    uint bits = floatBitsToUint(number);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

// Position of a vertex in the grid of its body: x and y in nodes, counted from the lowest node; z in metres.
vec3 corner_at(uint vertex)
{
    vec3 own = turned_back(body.rotation, posed_vertices[vertex].position - body.centre_m);
    return vec3((0.5 + 0.5 * own.xy / body.half_m.xy) * vec2(body.nodes - 1u), own.z);
}

float twice_area(vec2 a, vec2 b, vec2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

void main()
{
    uint item = item_index();
    if (item >= body.triangle_count) {
        return;
    }
    uvec3 vertices = texelFetch(triangle_texels, int(body.first_triangle + item)).xyz;
    vec3 a = corner_at(vertices.x);
    vec3 b = corner_at(vertices.y);
    vec3 c = corner_at(vertices.z);
    float area = twice_area(a.xy, b.xy, c.xy);
    ivec2 low = max(ivec2(ceil(min(a.xy, min(b.xy, c.xy)))), ivec2(0));
    ivec2 high = min(ivec2(floor(max(a.xy, max(b.xy, c.xy)))), ivec2(body.nodes) - 1);
    if (abs(area) < 1e-9) {
        return;
    }
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            vec2 at = vec2(x, y);
            vec3 shares =
                vec3(twice_area(b.xy, c.xy, at), twice_area(c.xy, a.xy, at), twice_area(a.xy, b.xy, at)) /
                area;
            // Widens triangles by a rounding error, so that no node between two neighbouring triangles is
            // missed.
            const float rounding = 1e-5;
            if (min(shares.x, min(shares.y, shares.z)) >= -rounding) {
                float z_m = dot(shares, vec3(a.z, b.z, c.z));
                uint node = 2u * (uint(y) * body.nodes.x + uint(x));
                atomicMax(ends[node], ordered(z_m));
                atomicMax(ends[node + 1u], ordered(-z_m));
            }
        }
    }
}
