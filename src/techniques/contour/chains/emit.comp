// SPDX-License-Identifier: MIT
// One thread makes one segment of the outline, and finds the one that goes on where it ends: across a smooth
// edge that is the segment of the neighbouring triangle; along hard edges, the next one around the fronts
// that meet at the end. Fronts lie on the left.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/octahedral.glsl"
#include "shaders/rounds.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"
#include "techniques/contour/chains/silhouette.glsl"

layout(binding = 3) uniform usamplerBuffer neighbor_texels;

layout(scalar, binding = 4) readonly buffer LooseEdges
{
    uvec2 loose_edges[];
};

layout(scalar, binding = 5) readonly buffer LooseEdgeOfSide
{
    uint loose_edge_of_side[]; // three a triangle
};

#define FACING_BINDING 6
#include "techniques/contour/chains/facing.glsl"

#define MARKS_BINDING 7
#include "techniques/contour/chains/marked_items.glsl"

layout(scalar, binding = 9) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 10) writeonly buffer Segments
{
    Segment segments[];
};

layout(scalar, binding = 11) writeonly buffer Ranks
{
    Rank ranks[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

// Bit 0: there are loose edges.
layout(constant_id = 0) const uint variant = 0u;
const bool has_loose_edges = (variant & 1u) != 0u;

const uint most_triangles_at_a_point = 64u;

uint next_corner(uint corner)
{
    return corner == 2u ? 0u : corner + 1u;
}

// Whether a triangle's corners run clockwise as seen from its front.
bool is_reversed(uint triangle)
{
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & NEIGHBOR_IS_TURNED) != 0u;
    return is_turned != ((triangle_at(triangle).w & TRIANGLE_MIRRORED) != 0u);
}

// The segment beyond a side, if the surface goes on smoothly and the outline with it.
uint segment_beyond(uint triangle, uint corner, uint segment_count)
{
    uvec4 neighbors = texelFetch(neighbor_texels, int(triangle));
    bool is_smooth = (neighbors.w >> (NEIGHBOR_SMOOTH_SHIFT + corner) & 1u) != 0u;
    uint beyond = neighbors[corner] >> 2;
    uint segment = is_smooth && is_marked(beyond) ? segment_of(beyond) : NO_SEGMENT;
    return segment < segment_count ? segment : NO_SEGMENT;
}

// A vertex as an outline passes it by.
struct Corner {
    uint vertex;
    vec3 position;
    vec3 normal; // unit
    float facing;
};

Corner corner_at(uint vertex)
{
    PosedVertex posed = posed_vertex_at(vertex);
    vec3 normal = unit(normal_direction(posed.normal));
    return Corner(vertex, posed.position, normal, facing_at(posed));
}

struct Crossing {
    vec3 position;
    uint normal;
};

// Where the outline crosses the side between two corners; the same from both triangles.
Crossing crossing_of(Corner i, Corner j)
{
    bool in_order = i.vertex < j.vertex;
    Corner low = in_order ? i : j;
    Corner high = in_order ? j : i;
    float s_low = dot(low.normal, way_to_eye(low.position));
    float s_high = dot(high.normal, way_to_eye(high.position));
    float along = clamp(s_low / (s_low - s_high), 0.0, 1.0);
    return Crossing(mix(low.position, high.position, along),
                    pack_normal(unit(mix(low.normal, high.normal, along))));
}

// How far the surface whose normals these are may stand out beyond the flat triangle.
float bulge_of(Corner a, Corner b, Corner c)
{
    float ab = size_of(a.position - b.position) * size_of(a.normal - b.normal);
    float bc = size_of(b.position - c.position) * size_of(b.normal - c.normal);
    float ca = size_of(c.position - a.position) * size_of(c.normal - a.normal);
    return 0.125 * max(ab, max(bc, ca));
}

Segment through_triangle(uint triangle, uint segment_count)
{
    uvec4 corners = triangle_at(triangle);
    Corner a = corner_at(corners.x);
    Corner b = corner_at(corners.y);
    Corner c = corner_at(corners.z);
    bvec3 fronts = bvec3(a.facing >= 0.0, b.facing >= 0.0, c.facing >= 0.0);
    // One corner is on the one side, two are on the other: the outline crosses the sides that meet at the
    // one.
    uint lone = fronts.y == fronts.z ? 0u : fronts.x == fronts.z ? 1u : 2u;
    Corner apart = lone == 0u ? a : lone == 1u ? b : c;
    Corner after = lone == 0u ? b : lone == 1u ? c : a;
    Corner before = lone == 0u ? c : lone == 1u ? a : b;
    // It starts on the side where the corners, in the sense of the front, pass from front to back.
    bool starts_after = (apart.facing >= 0.0) != is_reversed(triangle);
    Crossing from = Crossing(vec3(0.0), 0u);
    Crossing to = from;
    uint next = NO_SEGMENT;
    uint previous = NO_SEGMENT;
    for (int i = 0; i < rounds(2, int(triangle)); ++i) {
        bool is_start = i == 0;
        bool takes_after = is_start == starts_after;
        Crossing crossing = crossing_of(takes_after ? after : before, apart);
        uint side = takes_after ? lone : next_corner(next_corner(lone));
        uint beyond = segment_beyond(triangle, side, segment_count);
        from = is_start ? crossing : from;
        previous = is_start ? beyond : previous;
        to = crossing;
        next = beyond;
    }
    return Segment(from.position, from.normal, to.position, to.normal, triangle << 2 | 3u, next,
                   previous != NO_SEGMENT ? 1u : 0u, bulge_of(a, b, c));
}

// The outline's edge that leaves the point where a front's side ends (or starts, going back), around all
// fronts that follow there.
uint outline_around(uint triangle, uint corner, bool forwards, uint segment_count)
{
    for (uint i = 0u; i < most_triangles_at_a_point; ++i) {
        // With corners in the front's own sense, one step on; against it, one step back.
        bool step_on = is_reversed(triangle) != forwards;
        corner = step_on ? next_corner(corner) : next_corner(next_corner(corner));
        uint facing_side = texelFetch(neighbor_texels, int(triangle))[corner];
        if (facing_side == NO_SIDE) {
            return NO_SEGMENT;
        }
        if (!is_front(facing_side >> 2)) {
            uint edge = loose_edge_of_side[3u * triangle + corner];
            uint item = 32u * ((constants.triangle_count + 31u) / 32u) + edge;
            uint segment = edge != NO_SIDE && is_marked(item) ? segment_of(item) : NO_SEGMENT;
            return segment < segment_count ? segment : NO_SEGMENT;
        }
        triangle = facing_side >> 2;
        corner = facing_side & 3u;
    }
    return NO_SEGMENT;
}

Segment along_edge(uint edge, uint segment_count)
{
    uvec2 sides = loose_edges[edge];
    uint side = is_front(sides.x >> 2) ? sides.x : sides.y;
    uint triangle = side >> 2;
    uvec4 corners = triangle_at(triangle);
    bool reversed = is_reversed(triangle);
    uint first = side & 3u;
    PosedVertex a = posed_vertex_at(corners[reversed ? next_corner(first) : first]);
    PosedVertex b = posed_vertex_at(corners[reversed ? first : next_corner(first)]);
    vec3 normal = unpack_normal(a.normal) + unpack_normal(b.normal);
    uint packed = pack_normal(unit(normal + 1e-6 * way_to_eye(a.position)));
    // In a hollow the front hides its own outline.
    uint behind = is_front(sides.x >> 2) ? sides.y : sides.x;
    vec3 beyond =
        posed_vertex_at(triangle_at(behind >> 2)[(behind & 3u) == 0u ? 2u : (behind & 3u) - 1u]).position;
    vec3 third = posed_vertex_at(corners[first == 0u ? 2u : first - 1u]).position;
    vec3 plane = cross(b.position - a.position, third - a.position);
    bool is_hollow = dot(plane, beyond - a.position) * dot(plane, way_to_eye(a.position)) > 0.0;
    uvec2 around;
    for (uint back = 0u; back < 2u; ++back) {
        around[back] = outline_around(triangle, first, back == 0u, segment_count);
    }
    return Segment(a.position, packed, b.position, packed, side, around.x, around.y != NO_SEGMENT ? 1u : 0u,
                   is_hollow ? -1e-30 : 0.0);
}

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    uint segment_count = sizes[LIST_SEGMENTS].count;
    if (slot >= segment_count) {
        return;
    }
    uint triangle_words = (constants.triangle_count + 31u) / 32u;
    uint own_words = triangle_words + (constants.loose_edge_count + 31u) / 32u;
    uint item = item_of(slot, own_words + (constants.suggestive_count + 31u) / 32u + constants.page_words);
    if (item >= 32u * own_words) {
        return;
    }
    Segment segment;
    if (!has_loose_edges || item < 32u * triangle_words) {
        segment = through_triangle(item, segment_count);
    } else {
        segment = along_edge(item - 32u * triangle_words, segment_count);
    }
    segments[slot] = segment;
    ranks[slot] = segment.next != NO_SEGMENT ? Rank(segment.next, 1u, slot, 0u) : Rank(slot, 0u, slot, 0u);
}
