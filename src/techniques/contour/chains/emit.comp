// SPDX-License-Identifier: MIT
// One thread makes one segment of the outline, and finds the one that goes on where it ends: across a smooth
// edge that is the segment of the neighbouring triangle; along hard edges, the next one around the fronts
// that meet at the end. Fronts lie on the left.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/octahedral.glsl"
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
uint segment_beyond(uint triangle, uint corner)
{
    uvec4 neighbors = texelFetch(neighbor_texels, int(triangle));
    bool is_smooth = (neighbors.w >> (NEIGHBOR_SMOOTH_SHIFT + corner) & 1u) != 0u;
    uint beyond = neighbors[corner] >> 2;
    uint segment = is_smooth && is_marked(beyond) ? segment_of(beyond) : NO_SEGMENT;
    return segment < sizes[LIST_SEGMENTS].count ? segment : NO_SEGMENT;
}

struct Crossing {
    vec3 position;
    vec3 normal;
};

// Where the outline crosses the side at `corner`; the same from both triangles.
Crossing crossing_at(uvec4 corners, uint corner)
{
    uint i = corners[corner];
    uint j = corners[next_corner(corner)];
    PosedVertex low = posed_vertex_at(min(i, j));
    PosedVertex high = posed_vertex_at(max(i, j));
    vec3 n_low = normal_direction(low.normal);
    vec3 n_high = normal_direction(high.normal);
    float s_low = dot(normalize(n_low), way_to_eye(low.position));
    float s_high = dot(normalize(n_high), way_to_eye(high.position));
    float along = clamp(s_low / (s_low - s_high), 0.0, 1.0);
    return Crossing(mix(low.position, high.position, along),
                    normalize(mix(normalize(n_low), normalize(n_high), along)));
}

// How far the surface whose normals these are may stand out beyond the flat triangle.
float bulge_of(PosedVertex a, PosedVertex b, PosedVertex c)
{
    vec3 n_a = unpack_normal(a.normal);
    vec3 n_b = unpack_normal(b.normal);
    vec3 n_c = unpack_normal(c.normal);
    float ab = length(a.position - b.position) * length(n_a - n_b);
    float bc = length(b.position - c.position) * length(n_b - n_c);
    float ca = length(c.position - a.position) * length(n_c - n_a);
    return 0.125 * max(ab, max(bc, ca));
}

// How fast the surface turns to the eye on the way to the eye. Where it turns away the outline lies behind
// the surface that it belongs to; at a cusp one becomes the other.
float turn_to_eye(PosedVertex a, PosedVertex b, PosedVertex c)
{
    vec3 u = b.position - a.position;
    vec3 v = c.position - a.position;
    vec3 way = way_to_eye(a.position);
    vec3 s = vec3(dot(unpack_normal(a.normal), way), dot(unpack_normal(b.normal), way_to_eye(b.position)),
                  dot(unpack_normal(c.normal), way_to_eye(c.position)));
    float uu = dot(u, u);
    float uv = dot(u, v);
    float vv = dot(v, v);
    float along_u = vv * dot(way, u) - uv * dot(way, v);
    float along_v = uu * dot(way, v) - uv * dot(way, u);
    return along_u * (s.y - s.x) + along_v * (s.z - s.x);
}

Segment through_triangle(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    PosedVertex a = posed_vertex_at(corners.x);
    PosedVertex b = posed_vertex_at(corners.y);
    PosedVertex c = posed_vertex_at(corners.z);
    bvec3 sides = bvec3(facing_at(a) >= 0.0, facing_at(b) >= 0.0, facing_at(c) >= 0.0);
    uint down = sides.x && !sides.y ? 0u : sides.y && !sides.z ? 1u : 2u; // from front to back
    uint up = !sides.x && sides.y ? 0u : !sides.y && sides.z ? 1u : 2u;
    bool reversed = is_reversed(triangle);
    uint start = reversed ? up : down;
    uint end = reversed ? down : up;
    Crossing from = crossing_at(corners, start);
    Crossing to = crossing_at(corners, end);
    return Segment(from.position, pack_normal(from.normal), to.position, pack_normal(to.normal),
                   triangle << 2 | 3u, segment_beyond(triangle, end),
                   segment_beyond(triangle, start) != NO_SEGMENT ? 1u : 0u, bulge_of(a, b, c));
}

// The outline's edge that leaves the point where a front's side ends (or starts, going back), around all
// fronts that follow there.
uint outline_around(uint triangle, uint corner, bool forwards)
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
            return segment < sizes[LIST_SEGMENTS].count ? segment : NO_SEGMENT;
        }
        triangle = facing_side >> 2;
        corner = facing_side & 3u;
    }
    return NO_SEGMENT;
}

Segment along_edge(uint edge)
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
    uint packed = pack_normal(normalize(normal + 1e-6 * way_to_eye(a.position)));
    // In a hollow the front hides its own outline.
    uint behind = is_front(sides.x >> 2) ? sides.y : sides.x;
    vec3 beyond =
        posed_vertex_at(triangle_at(behind >> 2)[(behind & 3u) == 0u ? 2u : (behind & 3u) - 1u]).position;
    vec3 third = posed_vertex_at(corners[first == 0u ? 2u : first - 1u]).position;
    vec3 plane = cross(b.position - a.position, third - a.position);
    bool is_hollow = dot(plane, beyond - a.position) * dot(plane, way_to_eye(a.position)) > 0.0;
    return Segment(a.position, packed, b.position, packed, side, outline_around(triangle, first, true),
                   outline_around(triangle, first, false) != NO_SEGMENT ? 1u : 0u, is_hollow ? -1e-30 : 0.0);
}

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= sizes[LIST_SEGMENTS].count) {
        return;
    }
    uint triangle_words = (constants.triangle_count + 31u) / 32u;
    uint item = item_of(slot, triangle_words + (constants.loose_edge_count + 31u) / 32u);
    Segment segment;
    if (!has_loose_edges || item < 32u * triangle_words) {
        segment = through_triangle(item);
    } else {
        segment = along_edge(item - 32u * triangle_words);
    }
    segments[slot] = segment;
    ranks[slot] = segment.next != NO_SEGMENT ? Rank(segment.next, 1u, slot, 0u) : Rank(slot, 0u, slot, 0u);
}
