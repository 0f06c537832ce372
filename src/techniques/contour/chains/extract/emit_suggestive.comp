// SPDX-License-Identifier: MIT
// One thread makes one segment of a suggestive contour or a crest, and finds the next segment in the adjacent
// triangle. A line ends within a triangle where the line's strength becomes zero. The surface that looks
// concave from the eye lies to the right of the line.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

#define MESH_TEXELS_BINDING 0
#include "shaders/mesh_texels.glsl"

layout(binding = 2) uniform usamplerBuffer neighbor_texels;

#define MARKS_BINDING 4
#include "techniques/contour/chains/extract/marked_items.glsl"

layout(scalar, binding = 6) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 7) buffer Segments
{
    Segment segments[];
};

layout(scalar, binding = 8) buffer Ranks
{
    Rank ranks[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

#define VIEW_BENDS_BINDING 3
#include "techniques/contour/chains/extract/suggestive.glsl"

struct End {
    vec3 position;
    vec3 normal;
};

End end_at(BendCrossing crossing)
{
    PosedVertex low = posed_vertex_at(crossing.low);
    PosedVertex high = posed_vertex_at(crossing.high);
    return End(mix(low.position, high.position, crossing.share),
               mix(unpack_normal(low.normal), unpack_normal(high.normal), crossing.share));
}

// The segment in the adjacent triangle, if the line has a positive strength at the triangles' common side and
// the surface is smooth at that side.
uint segment_beyond(uint triangle, uint corner, float strength, uint first_item, uint segment_count)
{
    uvec4 neighbors = texelFetch(neighbor_texels, int(triangle));
    bool is_smooth = (neighbors.w >> (neighbor_smooth_shift + corner) & 1u) != 0u;
    uint item = first_item + (is_smooth ? neighbors[corner] >> 2 : triangle);
    uint segment = is_smooth && strength > 0.0 && is_marked(item) ? segment_of(item) : no_segment;
    return segment < segment_count ? segment : no_segment;
}

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    uint segment_count = sizes[list_segments].count;
    if (slot >= segment_count) {
        return;
    }
    uint triangle_words = (constants.triangle_count + 31u) / 32u;
    uint first_word = triangle_words + (constants.loose_edge_count + 31u) / 32u;
    uint item = item_of(slot, first_word + triangle_words + constants.page_words);
    if (item < 32u * first_word || item >= 32u * (first_word + triangle_words)) {
        return;
    }
    uint triangle = item - 32u * first_word;
    uvec4 corners = triangle_at(triangle);
    BendSides sides = bend_sides(corners);
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & neighbor_is_turned) != 0u;
    bool is_reversed = is_turned != ((corners.w & triangle_mirrored) != 0u);
    uint start = is_reversed ? sides.up : sides.down;
    uint end = is_reversed ? sides.down : sides.up;
    BendCrossing first = bend_crossing(corners[start], corners[(start + 1u) % 3u]);
    BendCrossing last = bend_crossing(corners[end], corners[(end + 1u) % 3u]);
    End from = end_at(first);
    End to = end_at(last);
    float whole = first.strength - last.strength;
    float fades_at = clamp(first.strength / (whole != 0.0 ? whole : 1.0), 0.0, 1.0);
    float kept_from = first.strength > 0.0 ? 0.0 : fades_at;
    float kept_to = last.strength > 0.0 ? 1.0 : fades_at;
    vec3 normal_from = unit(mix(from.normal, to.normal, kept_from));
    vec3 normal_to = unit(mix(from.normal, to.normal, kept_to));
    uint next = segment_beyond(triangle, end, last.strength, 32u * first_word, segment_count);
    uint previous = segment_beyond(triangle, start, first.strength, 32u * first_word, segment_count);
    uint kind = is_of_ground(corners.x) ? line_crest : line_suggestive;
    segments[slot] = Segment(mix(from.position, to.position, kept_from), pack_normal(normal_from),
                             mix(from.position, to.position, kept_to), pack_normal(normal_to),
                             kind << 28 | triangle << 2 | 3u, next, previous != no_segment ? 1u : 0u, 0.0);
    ranks[slot] = next != no_segment ? Rank(next, 1u, slot, 0u) : Rank(slot, 0u, slot, 0u);
}
