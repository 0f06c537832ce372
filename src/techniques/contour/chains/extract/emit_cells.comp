// SPDX-License-Identifier: MIT
// One thread makes one segment of a line that was found on the page. The segment runs from one side of its
// cell to another side; the next segment lies in the adjacent cell. Each end of the segment is placed on the
// surface that is seen at the start of the side, or on the clump of foliage of which it is the outline.
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
#include "techniques/contour/chains/extract/seen_plane.glsl"

#define VISIBILITY_BINDING 3
#include "shaders/visibility_texels.glsl"

#define MARKS_BINDING 5
#include "techniques/contour/chains/extract/marked_items.glsl"

layout(scalar, binding = 7) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 8) buffer Segments
{
    Segment segments[];
};

layout(scalar, binding = 9) buffer Ranks
{
    Rank ranks[];
};

layout(push_constant, scalar) uniform Constants
{
    CellConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_of_clumps = (variant & emit_cells_of_clumps) != 0u;

#define FOLIAGE_BINDING 10
#include "techniques/contour/chains/extract/foliage.glsl"

#include "techniques/contour/chains/extract/page_cells.glsl"

#define CROSSINGS_BINDING 4
#include "techniques/contour/chains/extract/page_lines.glsl"

struct End {
    vec3 position;
    uint normal;
    uint triangle;
};

// The place where the outline of a clump crosses a side: as far from the eye as the clump.
End end_at_clump(CellSide side)
{
    Crossing crossing = crossing_at(side);
    ivec2 way = side.is_down ? ivec2(0, 1) : ivec2(1, 0);
    FoliagePoint clump = foliage_at(ivec2(side.point) + (crossing.rises ? way : ivec2(0)));
    vec2 place =
        vec2(pixel_of_point(side.point)) + constants.point_px + float(cell_px) * crossing.share * vec2(way);
    uvec2 word = visibility_at(ivec2(clump.pixel & 0xffffu, clump.pixel >> 16));
    return End(anchor_at(frame, place, max(depth_of(clump), 1e-9)), 0u,
               sees_triangle(word) ? seen_triangle(word) : 0u);
}

// The direction to the right of a line, as seen from the eye. A clump lies on the left of its outline.
vec3 right_of_line(vec3 from, vec3 to)
{
    return cross(unit(to - from + 1e-9 * frame.view_forward), towards_eye(frame, from));
}

End end_at(CellSide side)
{
    Crossing crossing = crossing_at(side);
    ivec2 pixel = pixel_of_point(side.point);
    ivec2 way = side.is_down ? ivec2(0, 1) : ivec2(1, 0);
    ivec2 seen = pixel + (crossing.is_seen_between ? way : ivec2(0));
    uint triangle = seen_triangle(visibility_at(seen));
    Ray ray = ray_at(vec2(pixel) + constants.point_px + float(cell_px) * crossing.share * vec2(way));
    SeenPlane plane = seen_plane(triangle);
    vec3 normal = unit(plane.normal);
    return End(seen_point(plane, ray), pack_normal(dot(normal, ray.way) > 0.0 ? -normal : normal), triangle);
}

// The segment in the adjacent cell, beyond side `side` of `cell`.
uint segment_beyond(uvec2 cell, uint side, uint segment_count)
{
    ivec2 beyond = ivec2(cell) + ivec2(side == 1u   ? 1
                                       : side == 3u ? -1
                                                    : 0,
                                       side == 2u   ? 1
                                       : side == 0u ? -1
                                                    : 0);
    bool is_cell = all(greaterThanEqual(beyond, ivec2(0)));
    uint item =
        32u * constants.first_word + (is_cell ? uint(beyond.y) * constants.columns + uint(beyond.x) : 0u);
    uint segment = is_cell && is_marked(item) ? segment_of(item) : no_segment;
    return segment < segment_count ? segment : no_segment;
}

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    uint segment_count = sizes[list_segments].count;
    if (slot >= segment_count) {
        return;
    }
    uint item = item_of(slot, constants.word_count);
    uint index = item - 32u * constants.first_word;
    if (item < 32u * constants.first_word || index >= constants.columns * constants.rows) {
        return;
    }
    uvec2 cell = point_of_cell(index);
    CellLine line = line_through(cell);
    End from;
    End to = End(vec3(0.0), 0u, 0u);
    uint previous;
    uint next = no_segment;
    for (int end = 0; end < loop_rounds(2, int(segment_count)); ++end) {
        uint side = end == 0 ? line.from : line.to;
        from = to;
        previous = next;
        to = is_of_clumps ? end_at_clump(cell_side(cell, side)) : end_at(cell_side(cell, side));
        next = segment_beyond(cell, side, segment_count);
    }
    uint kind = constants.kind;
    bool is_within = false;
    if (is_of_clumps) {
        CellSide start = cell_side(cell, line.from);
        uint word = start.is_down ? crossing_words(start.point).y : crossing_words(start.point).x;
        bool is_mark = (word & crossing_is_mark) != 0u;
        is_within = (word & crossing_is_within) != 0u;
        kind = is_mark ? line_leaf : line_clump;
        // The normal points away from a clump, and to the lighter side of a mark.
        vec3 normal = right_of_line(from.position, to.position) * (is_mark ? -1.0 : 1.0);
        from.normal = to.normal = pack_normal(normal);
    }
    segments[slot] =
        Segment(from.position, from.normal, to.position, to.normal, kind << 28 | from.triangle << 2 | 3u,
                next, previous != no_segment ? 1u : 0u, is_within ? 1.0 : 0.0);
    ranks[slot] = next != no_segment ? Rank(next, 1u, slot, 0u) : Rank(slot, 0u, slot, 0u);
}
