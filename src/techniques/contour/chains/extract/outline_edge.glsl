// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_OUTLINE_EDGE
#define ESTAMPE_OUTLINE_EDGE

// Edges at which shading breaks. Such an edge is outline where the surface on the one side faces the eye and
// that on the other does not, each by its own normals. With the outline through triangles these parts close
// around all that faces the eye. Wanted before: triangle_sides.glsl, what that wants, and unit.glsl.

// Share of the side between two vertices at which what faces the eye ends.
float share_of_turn(PosedVertex from, PosedVertex to)
{
    float s_from = dot(unit(normal_direction(from.normal)), way_to_eye(from.position));
    float s_to = dot(unit(normal_direction(to.normal)), way_to_eye(to.position));
    return s_from / (s_from - s_to);
}

// The part of an edge that is outline, as part_ bits. Where two parts are, at both ends and not between, none
// counts.
uint outline_part(uvec2 sides)
{
    uvec2 ends = ends_of(sides.x);
    uvec2 back_ends = ends_of(sides.y).yx; // at the same two places
    uvec4 corners = triangle_at(sides.x >> 2);
    uvec4 back_corners = triangle_at(sides.y >> 2);
    bvec2 first = bvec2(is_front_at(sides.x >> 2, ends.x), is_front_at(sides.x >> 2, ends.y));
    bvec2 second = bvec2(is_front_at(sides.y >> 2, back_ends.x), is_front_at(sides.y >> 2, back_ends.y));
    bvec2 differs = bvec2(first.x != second.x, first.y != second.y);
    bool first_turns = first.x != first.y;
    bool second_turns = second.x != second.y;
    bool both_turn = first_turns && second_turns;
    bool is_there = (any(differs) || both_turn) && !(both_turn && differs.x);
    uint crossing = first_turns ? bound_in_first : bound_in_second;
    bool is_front = differs.x ? first.x : first.y;
    uint low = differs.x ? bound_is_corner : crossing;
    uint high = differs.y ? bound_is_corner : crossing;
    // Between both crossings that side is the front which turns last from front to back, or first to it.
    bool comes_first =
        share_of_turn(posed_vertex_at(corners[ends.x]), posed_vertex_at(corners[ends.y])) <
        share_of_turn(posed_vertex_at(back_corners[back_ends.x]), posed_vertex_at(back_corners[back_ends.y]));
    is_front = both_turn ? first.x != comes_first : is_front;
    low = both_turn ? (comes_first ? bound_in_first : bound_in_second) : low;
    high = both_turn ? (comes_first ? bound_in_second : bound_in_first) : high;
    return is_there ? part_is_there | (is_front ? part_first_is_front : 0u) | low << part_low_shift |
                          high << part_high_shift
                    : 0u;
}

#endif
