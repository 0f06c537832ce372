// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_CARRIED
#define ESTAMPE_INK_CARRIED

// Displacement of ink by a stream function that is stored at nodes. Requires before inclusion: `globals`,
// `stream_texels`.

#include "techniques/ink/flow/spline.glsl"

uint nodes_across(uint cells)
{
    return cells / ink_node_cells + 4u;
}

// Displacement, in cells, of the ink that arrives at `grid` after `seconds`, to second order. The texels hold
// the stream function in square node distances per second.
vec2 carried_cells(vec2 grid, float seconds)
{
    vec2 at = grid / float(ink_node_cells) + 1.0f; // plus 1, because one node lies beyond the edge
    vec2 node = floor(at + 0.5f);
    vec2 f = at - node;
    int across = int(nodes_across(globals.grid_size.x));
    int first = (int(node.y) - 1) * across + int(node.x) - 1;
    vec3 slope = vec3(0.0f); // derivatives of the stream function along x, along y, and mixed
    vec2 bend = vec2(0.0f);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            float psi = texelFetch(stream_texels, first + row * across + column).x;
            float value_x = spline_values(f.x)[column];
            float value_y = spline_values(f.y)[row];
            float slope_x = spline_slopes(f.x)[column];
            float slope_y = spline_slopes(f.y)[row];
            slope += psi * vec3(slope_x * value_y, value_x * slope_y, slope_x * slope_y);
            bend += psi * vec2(spline_bends()[column] * value_y, value_x * spline_bends()[row]);
        }
    }
    vec2 velocity = vec2(slope.y, -slope.x);
    vec2 acceleration = vec2(slope.y * slope.z - slope.x * bend.y, slope.x * slope.z - slope.y * bend.x);
    return float(ink_node_cells) * seconds * (velocity - 0.5f * seconds * acceleration);
}

// Displacement by a ball that expands, of ink that arrives at a place `away_mm` from the ball's middle.
// `cubes_mm3` holds the ball's cubed radius before and after. Outside of the ball, the cubed distance grows
// as the cubed radius does; inside, the ink spreads evenly.
vec2 swept_mm(vec2 away_mm, vec2 cubes_mm3)
{
    float distance_mm = length(away_mm);
    float cube = distance_mm * distance_mm * distance_mm;
    if (cubes_mm3.y <= cubes_mm3.x || cube <= 0.0f) {
        return vec2(0.0f);
    }
    float share = cube > cubes_mm3.y ? 1.0f - (cubes_mm3.y - cubes_mm3.x) / cube : cubes_mm3.x / cubes_mm3.y;
    return away_mm * (1.0f - pow(share, 1.0f / 3.0f));
}

#endif
