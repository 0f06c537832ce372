// SPDX-License-Identifier: MIT
// One thread per node of a body: the body's middle along z, half its thickness, and the node's distance
// inside the outline. A node outside has no thickness, and gets the middle of the nearest node inside.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/cloth/cloth.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Ends
{
    uint ends[]; // per node: front surface, then back surface (negated); 0: empty
};

layout(scalar, binding = 1) writeonly buffer Texels
{
    vec4 texels[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothBody body;
};

float number_of(uint ordered)
{
    return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

vec2 middle_and_half(uint node)
{
    float front_m = number_of(ends[2u * node]);
    float back_m = -number_of(ends[2u * node + 1u]);
    return 0.5 * vec2(front_m + back_m, front_m - back_m);
}

void main()
{
    uint item = item_index();
    ivec2 nodes = ivec2(body.nodes);
    if (item == 0u) {
        texels[body.first] = vec4(vec2(nodes), 0.0, 0.0);
    }
    if (item >= body.nodes.x * body.nodes.y) {
        return;
    }
    const int skirt = int(cloth_seen_skirt);
    bool is_within = ends[2u * item] != 0u;
    ivec2 at = ivec2(item % body.nodes.x, item / body.nodes.x);
    vec2 texel_m = 2.0 * body.half_m.xy / vec2(nodes - 1);
    float least_m = min(texel_m.x, texel_m.y);
    float nearest_m = (float(skirt) + 0.5) * least_m;
    uint nearest = cloth_no_vertex; // nearest node on the other side of the body's outline
    for (int y = max(at.y - skirt, 0); y <= min(at.y + skirt, nodes.y - 1); ++y) {
        for (int x = max(at.x - skirt, 0); x <= min(at.x + skirt, nodes.x - 1); ++x) {
            uint node = uint(y * nodes.x + x);
            float away_m = length(vec2(ivec2(x, y) - at) * texel_m);
            if ((ends[2u * node] != 0u) != is_within && away_m < nearest_m) {
                nearest_m = away_m;
                nearest = node;
            }
        }
    }
    // The outline is assumed half way between the node inside and the node outside.
    float outline_m = nearest == cloth_no_vertex ? cloth_seen_nowhere_m : nearest_m - 0.5 * least_m;
    bool has_middle = is_within || nearest != cloth_no_vertex;
    vec2 middle = has_middle ? middle_and_half(is_within ? item : nearest) : vec2(0.0);
    texels[body.first + cloth_seen_head + item] =
        vec4(middle.x, is_within ? middle.y : 0.0, is_within ? outline_m : -outline_m, 0.0);
}
