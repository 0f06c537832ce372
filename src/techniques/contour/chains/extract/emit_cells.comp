// SPDX-License-Identifier: MIT
// One thread makes one segment of a line that was found on the page. The segment runs from one side of its
// cell to another side; the next segment lies in the adjacent cell. Each end of the segment is placed on the
// surface that is seen at the start of the side.
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

#include "techniques/contour/chains/extract/page_cells.glsl"

#define CROSSINGS_BINDING 4
#include "techniques/contour/chains/extract/page_lines.glsl"

struct End {
    vec3 position;
    uint normal;
    uint triangle;
};

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
        to = end_at(cell_side(cell, side));
        next = segment_beyond(cell, side, segment_count);
    }
    segments[slot] =
        Segment(from.position, from.normal, to.position, to.normal,
                constants.kind << 28 | from.triangle << 2 | 3u, next, previous != no_segment ? 1u : 0u, 0.0);
    ranks[slot] = next != no_segment ? Rank(next, 1u, slot, 0u) : Rank(slot, 0u, slot, 0u);
}
