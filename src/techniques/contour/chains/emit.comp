// SPDX-License-Identifier: MIT
// One thread makes one segment of the outline, and finds the one that goes on where it ends: across a smooth
// edge that is the segment of the neighbouring triangle; at a hard one, that along the edge, and where this
// ends at a corner the next around the fronts that meet there. Fronts lie on the left.
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

// Bit 0: there are loose edges. Bit 1: outlines run along those alone.
layout(constant_id = 0) const uint variant = 0u;
const bool has_loose_edges = (variant & 1u) != 0u;
const bool along_edges = (variant & 2u) != 0u;

const uint most_triangles_at_a_point = 64u;

#include "techniques/contour/chains/outline_edge.glsl"

uint segment_or_none(uint item, uint segment_count)
{
    uint segment = is_marked(item) ? segment_of(item) : NO_SEGMENT;
    return segment < segment_count ? segment : NO_SEGMENT;
}

// The segment along the edge that a side is of.
uint segment_along(uint triangle, uint corner, uint segment_count)
{
    uint edge = loose_edge_of_side[3u * triangle + corner];
    uint item = 32u * ((constants.triangle_count + 31u) / 32u) + edge;
    return edge != NO_SIDE ? segment_or_none(item, segment_count) : NO_SEGMENT;
}

// The segment beyond a side, which the outline reaches within a triangle: where the surface goes on smoothly
// in the next, else along the edge.
uint segment_beyond(uint triangle, uint corner, uint segment_count)
{
    uvec4 neighbors = texelFetch(neighbor_texels, int(triangle));
    bool is_smooth = (neighbors.w >> (NEIGHBOR_SMOOTH_SHIFT + corner) & 1u) != 0u;
    if (has_loose_edges && !is_smooth) {
        return is_inside_out(triangle) ? NO_SEGMENT : segment_along(triangle, corner, segment_count);
    }
    return is_smooth ? segment_or_none(neighbors[corner] >> 2, segment_count) : NO_SEGMENT;
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

// Share of the side between two corners at which the outline crosses it.
float share_of_crossing(Corner i, Corner j)
{
    float s_i = dot(i.normal, way_to_eye(i.position));
    float s_j = dot(j.normal, way_to_eye(j.position));
    return clamp(s_i / (s_i - s_j), 0.0, 1.0);
}

// Where the outline crosses the side between two corners; the same from both triangles.
Crossing crossing_of(Corner i, Corner j)
{
    bool in_order = i.vertex < j.vertex;
    Corner low = in_order ? i : j;
    Corner high = in_order ? j : i;
    float along = share_of_crossing(low, high);
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
        uvec4 neighbors = texelFetch(neighbor_texels, int(triangle));
        uint facing_side = neighbors[corner];
        if (facing_side == NO_SIDE) {
            return NO_SEGMENT;
        }
        bool is_smooth = !along_edges && (neighbors.w >> (NEIGHBOR_SMOOTH_SHIFT + corner) & 1u) != 0u;
        uvec2 ends = ends_of(facing_side);
        if (!is_smooth && !fronts_of(facing_side >> 2)[forwards ? ends.y : ends.x]) {
            return segment_along(triangle, corner, segment_count);
        }
        triangle = facing_side >> 2;
        corner = facing_side & 3u;
    }
    return NO_SEGMENT;
}

// What bounds the part of an edge that is outline.
const uint at_corner = 0u;
const uint at_first_crossing = 1u; // where the outline comes from, or goes on, in the first side's triangle
const uint at_second_crossing = 2u;

struct OutlinePart {
    bool is_first_front; // of both sides the first is the front
    uint low;            // towards the first side's start
    uint high;
};

OutlinePart part_of(uvec2 sides, Corner first_start, Corner first_end, Corner second_start, Corner second_end)
{
    EdgeFronts fronts = fronts_along(sides);
    bool first_turns = fronts.first.x != fronts.first.y;
    bool second_turns = fronts.second.x != fronts.second.y;
    bool differs_at_start = fronts.first.x != fronts.second.x;
    bool differs_at_end = fronts.first.y != fronts.second.y;
    if (first_turns && second_turns) {
        // Between both crossings that side is the front which turns last from front to back, or first to it.
        bool is_first =
            share_of_crossing(first_start, first_end) < share_of_crossing(second_end, second_start);
        return OutlinePart(fronts.first.x != is_first, is_first ? at_first_crossing : at_second_crossing,
                           is_first ? at_second_crossing : at_first_crossing);
    }
    uint crossing = first_turns ? at_first_crossing : at_second_crossing;
    return OutlinePart(differs_at_start ? fronts.first.x : fronts.first.y,
                       differs_at_start ? at_corner : crossing, differs_at_end ? at_corner : crossing);
}

// In a hollow the front hides its own outline.
bool is_hollow(uint front_side, uint back_side)
{
    uvec4 corners = triangle_at(front_side >> 2);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 plane = cross(posed_vertex_at(corners.y).position - a, posed_vertex_at(corners.z).position - a);
    uint opposite = next_corner(next_corner(back_side & 3u));
    float above = dot(plane, posed_vertex_at(triangle_at(back_side >> 2)[opposite]).position - a);
    return is_reversed(front_side >> 2) ? above < 0.0 : above > 0.0;
}

float bulge_of_triangle(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    return bulge_of(corner_at(corners.x), corner_at(corners.y), corner_at(corners.z));
}

Segment along_edge(uint edge, uint segment_count)
{
    uvec2 sides = loose_edges[edge];
    uvec2 first_ends = ends_of(sides.x);
    uvec2 second_ends = ends_of(sides.y);
    uvec4 first_corners = triangle_at(sides.x >> 2);
    uvec4 second_corners = triangle_at(sides.y >> 2);
    Corner first_start = corner_at(first_corners[first_ends.x]);
    Corner first_end = corner_at(first_corners[first_ends.y]);
    Corner second_start = corner_at(second_corners[second_ends.x]);
    Corner second_end = corner_at(second_corners[second_ends.y]);
    OutlinePart part = part_of(sides, first_start, first_end, second_start, second_end);
    uint front = part.is_first_front ? sides.x : sides.y;
    vec3 normal =
        part.is_first_front ? first_start.normal + first_end.normal : second_start.normal + second_end.normal;
    uint packed = pack_normal(unit(normal + 1e-6 * way_to_eye(first_start.position)));
    Crossing first_crossing = crossing_of(first_start, first_end);
    Crossing second_crossing = crossing_of(second_start, second_end);
    vec3 place[2];
    uint beyond[2];
    for (uint end = 0u; end < 2u; ++end) {
        bool is_low = (end == 0u) == part.is_first_front;
        uint bound = is_low ? part.low : part.high;
        vec3 corner = is_low ? first_start.position : first_end.position;
        uint crossed = (bound == at_first_crossing ? sides.x : sides.y) >> 2;
        place[end] = bound == at_corner           ? corner
                     : bound == at_first_crossing ? first_crossing.position
                                                  : second_crossing.position;
        if (bound == at_corner) {
            beyond[end] = outline_around(front >> 2, front & 3u, end == 1u, segment_count);
        } else {
            beyond[end] = is_inside_out(crossed) ? NO_SEGMENT : segment_or_none(crossed, segment_count);
        }
    }
    float bulge_m = along_edges ? 0.0 : max(bulge_of_triangle(sides.x >> 2), bulge_of_triangle(sides.y >> 2));
    bool hides = is_hollow(front, part.is_first_front ? sides.y : sides.x);
    return Segment(place[0], packed, place[1], packed, front, beyond[1], beyond[0] != NO_SEGMENT ? 1u : 0u,
                   hides ? -1e-30 : bulge_m);
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
