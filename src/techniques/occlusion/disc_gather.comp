// SPDX-License-Identifier: MIT
// One thread a vertex sums what discs hide from it, those far off many at once: down the tree where a node is
// too near, past it where that has been looked at.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/items.glsl"
#include "shaders/octahedral.glsl"
#include "techniques/occlusion/discs.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer posed_vertices;

layout(scalar, binding = 1) readonly buffer Vertices
{
    uvec2 vertices[]; // number, and area as bits
};

#define DISCS_BINDING 2

layout(scalar, binding = 3) writeonly buffer Open
{
    float open[]; // a vertex
};

layout(push_constant, scalar) uniform Constants
{
    DiscConstants constants;
};

#include "techniques/occlusion/disc_texels.glsl"
#include "techniques/occlusion/discs.glsl"

void main()
{
    uint item = item_index();
    bool is_there = item < constants.counts[0];
    uvec2 vertex = vertices[is_there ? item : 0u];
    uvec4 words = texelFetch(posed_vertices, int(vertex.x));
    vec3 place = uintBitsToFloat(words.xyz);
    vec3 normal = unpack_normal(words.w);
    uint top = constants.level_count - 1u;
    uint level = top;
    uint node = 0u;
    uint first = first_of(top);
    float hidden = 0.0;
    bool goes_on = is_there;
    // All lanes leave together: one that has left would go on computing.
    do {
        Disc disc = disc_at(first + node);
        vec3 way = disc.place - place;
        float away = sqrt(dot(way, way));
        bool is_out_of_reach = away - disc.radius_m > constants.radius_m;
        bool is_whole = level == 0u || is_out_of_reach || disc.radius_m < constants.apart * away;
        hidden += goes_on && is_whole ? hidden_by_disc(disc, way, normal, constants.radius_m) : 0.0;
        // Down to the first below, or on to the next and up where a node's last has been looked at.
        bool goes_down = goes_on && !is_whole;
        bool goes_past = goes_on && is_whole;
        level -= goes_down ? 1u : 0u;
        first -= goes_down ? constants.counts[level] : 0u;
        node = goes_down ? node * disc_children : goes_past ? node + 1u : node;
        for (uint i = 0u; i < most_disc_levels - 1u; ++i) {
            bool goes_up =
                goes_past && level < top && (node % disc_children == 0u || node == constants.counts[level]);
            first += goes_up ? constants.counts[level] : 0u;
            node = goes_up ? (node + disc_children - 1u) / disc_children : node;
            level += goes_up ? 1u : 0u;
        }
        goes_on = goes_on && !(level == top && node >= constants.counts[top]);
    } while (subgroupAny(goes_on));
    if (is_there) {
        open[vertex.x] = max(1.0 - hidden, 0.0);
    }
}
