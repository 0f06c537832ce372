// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_HEIGHTS
#define ESTAMPE_CLOTH_HEIGHTS

// A solid of cloth_solids.glsl: all space below heights on a grid in x and z. Unit tests compile
// cloth_heights.glsl as C++.
//
// Requires: float grid_number(int at), and constants of cloth.glsl.h.

ivec3 grid_nodes(int first)
{
    return ivec3(grid_number(first), grid_number(first + 1), grid_number(first + 2));
}

// Converts a place to grid cells, counted from the first node. `half_m` is half the grid's size.
vec3 in_cells(vec3 place, vec3 half_m, ivec3 nodes)
{
    return clamp(0.5f + 0.5f * place / half_m, vec3(0.0f), vec3(1.0f)) * vec3(nodes - 1);
}

// The grid cell that contains a place in x and z. A place on the border of two cells belongs to the cell that
// starts at the border.
ivec2 cell_below(vec3 place, vec3 half_m, ivec3 nodes)
{
    vec3 at = in_cells(place, half_m, nodes);
    return min(ivec2(at.x, at.z), ivec2(nodes.x, nodes.z) - 2);
}

// Heights at the four corners of a grid cell; x varies fastest.
vec4 heights_about(int first, ivec3 nodes, ivec2 cell)
{
    int corner = first + int(cloth_grid_head) + cell.y * nodes.x + cell.x;
    return vec4(grid_number(corner), grid_number(corner + 1), grid_number(corner + nodes.x),
                grid_number(corner + nodes.x + 1));
}

// Slope of the ground from the height differences between neighbouring nodes.
vec2 slope_of(vec2 rises, vec3 half_m, ivec3 nodes)
{
    return rises * vec2(nodes.x - 1, nodes.z - 1) / (2.0f * vec2(half_m.x, half_m.z));
}

vec4 heights_at(int first, vec3 half_m, vec3 place)
{
    ivec3 nodes = grid_nodes(first);
    vec3 at = in_cells(place, half_m, nodes);
    ivec2 cell = cell_below(place, half_m, nodes);
    vec2 f = vec2(at.x, at.z) - vec2(cell);
    vec4 corners = heights_about(first, nodes, cell);
    vec2 low = vec2(corners.x, corners.y);
    vec2 high = vec2(corners.z, corners.w);
    vec2 along = mix(low, high, f.y);
    vec2 rises = vec2(along.y - along.x, mix(high.x - low.x, high.y - low.y, f.x));
    vec2 slope = slope_of(rises, half_m, nodes);
    vec3 normal = normalize(vec3(-slope.x, 1.0f, -slope.y));
    return vec4(normal, (place.y - mix(along.x, along.y, f.x)) * normal.y);
}

// Whether the ground is so far below a ball that no movement inside the ball reaches it. True if heights_at()
// is more than the longest movement plus `near_m` everywhere in the ball. heights_at() depends on the cell
// below the place. No part of a cell is higher than the cell's corners or steeper than the cell's sides. So
// all cells below the ball are tested, if the cells are few.
bool are_far_below(int first, vec3 half_m, vec4 ball, float near_m)
{
    const int most_cells = 8; // largest number of tested cells along each axis
    ivec3 nodes = grid_nodes(first);
    ivec2 low = cell_below(vec3(ball) - ball.w, half_m, nodes);
    ivec2 high = cell_below(vec3(ball) + ball.w, half_m, nodes);
    bool are_few = all(lessThan(high - low, ivec2(most_cells)));
    float highest_m = -1e30f;
    vec2 rises = vec2(0.0f);
    ivec2 cell = low;
    do {
        vec4 corners = heights_about(first, nodes, cell);
        vec2 higher = max(vec2(corners.x, corners.y), vec2(corners.z, corners.w));
        highest_m = max(highest_m, max(higher.x, higher.y));
        rises = max(rises, abs(vec2(corners.y - corners.x, corners.z - corners.x)));
        rises = max(rises, abs(vec2(corners.w - corners.z, corners.w - corners.y)));
        cell = cell.x < high.x ? ivec2(cell.x + 1, cell.y) : ivec2(low.x, cell.y + 1);
    } while (are_few && cell.y <= high.y);
    vec2 slope = slope_of(rises, half_m, nodes);
    float steepness = sqrt(1.0f + dot(slope, slope));
    return are_few && ball.y - ball.w - highest_m > steepness * (2.0f * ball.w + near_m);
}

#endif
