// SPDX-License-Identifier: MIT
// One thread makes one segment of the outline and finds the segment that follows it. Across a smooth edge,
// the neighbouring triangle has the next segment. At a hard edge, the next segment runs along the edge. Where
// the edge's segment ends at a corner, the next segment is found around the front-facing triangles that meet
// at the corner. Front-facing triangles lie on the left of the line.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"
#include "shaders/loops.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"
#include "techniques/contour/chains/extract/silhouette.glsl"

layout(binding = 3) uniform usamplerBuffer neighbor_texels;

// The two sides of each loose edge (an edge where the shading breaks, without a crease or other fixed line).
layout(binding = 4) uniform usamplerBuffer loose_edge_texels;
// Number of the loose edge (an edge without a crease or other fixed line) at each side of a triangle.
layout(binding = 5) uniform usamplerBuffer loose_edge_of_side_texels;
// The part of each loose edge (an edge without a crease or other fixed line) that is outline, as part_ bits.
layout(binding = 6) uniform usamplerBuffer part_texels;

#define FACING_BINDING 7
#include "techniques/contour/chains/extract/facing.glsl"

#define MARKS_BINDING 8
#include "techniques/contour/chains/extract/marked_items.glsl"

layout(scalar, binding = 10) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 11) writeonly buffer Segments
{
    Segment segments[];
};

layout(scalar, binding = 12) writeonly buffer Ranks
{
    Rank ranks[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_loose_edges = (variant & emit_has_loose_edges) != 0u;
const bool along_edges = (variant & emit_along_edges) != 0u;

const uint most_triangles_at_a_point = 64u;
// Cosine of 53 degrees, the largest angle between the view and the normal of a triangle that plainly faces
// the eye. The triangles along the outline of a round shape of seven sides turn less.
const float plain_cosine = 0.6;

#include "techniques/contour/chains/extract/triangle_sides.glsl"

uint segment_or_none(uint item, uint segment_count)
{
    uint segment = is_marked(item) ? segment_of(item) : no_segment;
    return segment < segment_count ? segment : no_segment;
}

// The number of the loose edge (an edge without a crease or other fixed line) to which a triangle's side
// belongs, or no_side if the side is no loose edge.
uint loose_edge_at(uint triangle, uint corner)
{
    return texelFetch(loose_edge_of_side_texels, int(3u * triangle + corner)).x;
}

uint part_at(uint edge)
{
    return texelFetch(part_texels, int(edge)).x;
}

uint segment_along(uint edge, uint segment_count)
{
    return segment_or_none(32u * ((constants.triangle_count + 31u) / 32u) + edge, segment_count);
}

// The outline segment that follows when the outline leaves a triangle through a side. If the surface is
// smooth at the side, the next segment lies in the neighbouring triangle; else the next segment runs along
// the edge.
uint segment_beyond(uint triangle, uint corner, uint segment_count)
{
    uvec4 neighbors = texelFetch(neighbor_texels, int(triangle));
    bool is_smooth = (neighbors.w >> (neighbor_smooth_shift + corner) & 1u) != 0u;
    uint beyond = is_smooth ? segment_or_none(neighbors[corner] >> 2, segment_count) : no_segment;
    if (has_loose_edges) {
        uint edge = loose_edge_at(triangle, corner);
        bool is_linked = edge != no_side && !is_inside_out(triangle);
        beyond = is_linked ? segment_along(edge != no_side ? edge : 0u, segment_count) : beyond;
    }
    return beyond;
}

// A triangle's vertex with the values that outlines need.
struct Corner {
    uint vertex;
    vec3 position;
    vec3 normal; // unit vector
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

// The point where the outline crosses the side between two corners. Both triangles at the side compute
// exactly equal points.
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

uint turned_over(uint packed_normal)
{
    return pack_normal(-unpack_normal(packed_normal));
}

// How far the smooth surface with a triangle's vertex normals may bulge out of the flat triangle, in metres.
float bulge_of(Corner a, Corner b, Corner c)
{
    float ab = size_of(a.position - b.position) * size_of(a.normal - b.normal);
    float bc = size_of(b.position - c.position) * size_of(b.normal - c.normal);
    float ca = size_of(c.position - a.position) * size_of(c.normal - a.normal);
    return 0.125 * max(ab, max(bc, ca));
}

// Whether the surface turns its front away from the eye on the way to the eye. Where the eye sees the front,
// such a place is hidden; so if it is seen, the eye sees the back of the surface, and the outside of the
// outline lies where the back's normals point.
bool bends_to_eye(Corner a, Corner b, Corner c)
{
    vec3 ab = b.position - a.position;
    vec3 ac = c.position - a.position;
    vec3 plane = cross(ab, ac);
    vec3 way = way_to_eye(a.position);
    vec3 turns = vec3(dot(a.normal, way), dot(b.normal, way), dot(c.normal, way));
    vec3 growth = (turns.y - turns.x) * cross(ac, plane) + (turns.z - turns.x) * cross(plane, ab);
    return dot(growth, way) < 0.0;
}

// Whether the flat triangle plainly faces the eye or turns away from it, so that an outline through it comes
// from vertex normals that do not fit the shape, for example averaged ones on a box.
bool is_turned_plainly(Corner a, Corner b, Corner c)
{
    vec3 plane = cross(b.position - a.position, c.position - a.position);
    vec3 way = way_to_eye(a.position);
    float facing = dot(plane, way);
    return facing * facing > plain_cosine * plain_cosine * dot(plane, plane) * dot(way, way);
}

Segment through_triangle(uint triangle, uint segment_count)
{
    uvec4 corners = triangle_at(triangle);
    Corner a = corner_at(corners.x);
    Corner b = corner_at(corners.y);
    Corner c = corner_at(corners.z);
    bvec3 fronts = bvec3(a.facing >= 0.0, b.facing >= 0.0, c.facing >= 0.0);
    // Of the triangle's three corners, one differs from the other two in whether it faces the eye. The
    // outline crosses the two sides that meet at the corner that differs.
    uint lone = fronts.y == fronts.z ? 0u : fronts.x == fronts.z ? 1u : 2u;
    Corner apart = lone == 0u ? a : lone == 1u ? b : c;
    Corner after = lone == 0u ? b : lone == 1u ? c : a;
    Corner before = lone == 0u ? c : lone == 1u ? a : b;
    // The segment starts on the side where the corners change from front-facing to back-facing, in the order
    // seen from the front.
    bool starts_after = (apart.facing >= 0.0) != is_reversed(triangle);
    Crossing from = Crossing(vec3(0.0), 0u);
    Crossing to = from;
    uint next = no_segment;
    uint previous = no_segment;
    int i = 0;
    do {
        bool is_start = i == 0;
        bool takes_after = is_start == starts_after;
        Crossing crossing = crossing_of(takes_after ? after : before, apart);
        uint side = takes_after ? lone : next_corner(next_corner(lone));
        uint beyond = segment_beyond(triangle, side, segment_count);
        from = is_start ? crossing : from;
        previous = is_start ? beyond : previous;
        to = crossing;
        next = beyond;
        ++i;
    } while (i < loop_rounds(2, int(triangle)));
    bool sees_back = (corners.w & triangle_two_sided) != 0u && bends_to_eye(a, b, c);
    return Segment(from.position, sees_back ? turned_over(from.normal) : from.normal, to.position,
                   sees_back ? turned_over(to.normal) : to.normal, triangle << 2 | 3u, next,
                   previous != no_segment ? 1u : 0u, is_turned_plainly(a, b, c) ? -1e-30 : bulge_of(a, b, c));
}

// Finds the outline segment on an edge that continues at the end of a side of a front-facing triangle (or at
// the start of the side, when `forwards` is false). Searches around all front-facing triangles at the end of
// the side.
uint outline_around(uint triangle, uint corner, bool forwards, uint segment_count)
{
    for (uint i = 0u; i < most_triangles_at_a_point; ++i) {
        // The corner numbers run forwards around the triangle if their order is counter-clockwise seen from
        // the front, else backwards.
        bool step_on = is_reversed(triangle) != forwards;
        corner = step_on ? next_corner(corner) : next_corner(next_corner(corner));
        uvec4 neighbors = texelFetch(neighbor_texels, int(triangle));
        uint facing_side = neighbors[corner];
        if (facing_side == no_side) {
            return no_segment;
        }
        bool is_smooth = !along_edges && (neighbors.w >> (neighbor_smooth_shift + corner) & 1u) != 0u;
        uvec2 ends = ends_of(facing_side);
        if (!is_smooth && !is_front_at(facing_side >> 2, forwards ? ends.y : ends.x)) {
            uint edge = loose_edge_at(triangle, corner);
            return edge != no_side ? segment_along(edge, segment_count) : no_segment;
        }
        triangle = facing_side >> 2;
        corner = facing_side & 3u;
    }
    return no_segment;
}

// Whether an edge is concave, so that the front-facing surface hides the outline along the edge, unless the
// eye sees the back of the surface.
bool is_hollow(uint front_side, uint back_side)
{
    uvec4 corners = triangle_at(front_side >> 2);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 plane = cross(posed_vertex_at(corners.y).position - a, posed_vertex_at(corners.z).position - a);
    uint opposite = next_corner(next_corner(back_side & 3u));
    float above = dot(plane, posed_vertex_at(triangle_at(back_side >> 2)[opposite]).position - a);
    bool is_turned = is_reversed(front_side >> 2) != is_inside_out(front_side >> 2);
    return is_turned ? above < 0.0 : above > 0.0;
}

Segment along_edge(uint edge, uint segment_count)
{
    uvec2 sides = texelFetch(loose_edge_texels, int(edge)).xy;
    uint part = part_at(edge);
    bool first_is_front = (part & part_first_is_front) != 0u;
    uint front = first_is_front ? sides.x : sides.y;
    Crossing place[2];
    uint beyond[2];
    float bulge_m = 0.0;
    int end = 0;
    do {
        bool is_low = (end == 0) == first_is_front;
        uint bound = part >> (is_low ? part_low_shift : part_high_shift) & 3u;
        bool is_corner = bound == bound_is_corner;
        bool is_first = is_corner ? first_is_front : bound == bound_in_first;
        uint side = is_first ? sides.x : sides.y;
        uvec4 corners = triangle_at(side >> 2);
        uvec2 ends = ends_of(side);
        Corner start = corner_at(corners[ends.x]);
        Corner finish = corner_at(corners[ends.y]);
        Crossing crossing = crossing_of(start, finish);
        // Position of the edge's end number `end`.
        vec3 corner = end == 0 ? start.position : finish.position;
        uint packed = pack_normal(unit(start.normal + finish.normal + 1e-6 * way_to_eye(corner)));
        place[end] = Crossing(is_corner ? corner : crossing.position, is_corner ? packed : crossing.normal);
        uint within = is_inside_out(side >> 2) ? no_segment : segment_or_none(side >> 2, segment_count);
        beyond[end] = is_corner ? outline_around(front >> 2, front & 3u, end == 1, segment_count) : within;
        Corner third = corner_at(corners[3u - ends.x - ends.y]);
        bool is_round = !along_edges && !is_flat(side >> 2);
        bulge_m = is_round ? max(bulge_m, bulge_of(start, finish, third)) : bulge_m;
        ++end;
    } while (end < loop_rounds(2, int(edge)));
    bool hides = is_hollow(front, first_is_front ? sides.y : sides.x);
    bool sees_back = hides && (triangle_at(front >> 2).w & triangle_two_sided) != 0u;
    return Segment(place[0].position, sees_back ? turned_over(place[0].normal) : place[0].normal,
                   place[1].position, sees_back ? turned_over(place[1].normal) : place[1].normal, front,
                   beyond[1], beyond[0] != no_segment ? 1u : 0u, hides && !sees_back ? -1e-30 : bulge_m);
}

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    uint segment_count = sizes[list_segments].count;
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
    ranks[slot] = segment.next != no_segment ? Rank(segment.next, 1u, slot, 0u) : Rank(slot, 0u, slot, 0u);
}
