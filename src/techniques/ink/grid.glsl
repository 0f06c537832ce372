// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_GRID
#define ESTAMPE_INK_GRID

// Cells of ink: where on the page they lie, and how ink is looked up between them. A cell holds wet ink in
// its lower half and dry ink in its upper, 0 to 65535. Wanted before: `globals`, `state_texels`, and
// `is_around`.

#include "techniques/ink/cube.glsl"

const float cell_unit = 1.0 / 65535.0;

uint packed_ink(vec2 wet_and_dry)
{
    return packUnorm2x16(wet_and_dry);
}

float wet_ink(uint cell)
{
    return float(cell & 0xffffu) * cell_unit;
}

float dry_ink(uint cell)
{
    return float(cell >> 16u) * cell_unit;
}

vec2 unpacked_ink(uint cell)
{
    return vec2(wet_ink(cell), dry_ink(cell));
}

// Of the cube a face lies below the other.
uint rows_of_face()
{
    return globals.face_side + 2u * ink_gutter;
}

vec3 direction_of_cell(ivec2 cell)
{
    uint rows = rows_of_face();
    uint face = uint(cell.y) / rows;
    vec2 within = vec2(cell.x, uint(cell.y) - face * rows) + 0.5 - float(ink_gutter);
    return normalize(face_direction(face, 2.0 * within / float(globals.face_side) - 1.0));
}

// In cells from the upper left corner of the grid.
vec2 grid_place_of_direction(vec3 direction)
{
    FacePlace place = face_place(direction);
    vec2 within = (0.5 * place.at + 0.5) * float(globals.face_side) + float(ink_gutter);
    return within + vec2(0.0, float(place.face * rows_of_face()));
}

vec2 grid_place_of_page(vec2 page_px)
{
    return page_px * globals.cells_per_px + globals.margin_cells;
}

vec2 page_place_of_grid(vec2 grid)
{
    return (grid - globals.margin_cells) / globals.cells_per_px;
}

// Weights of four cells about a place that lies `f` beyond the second: Catmull and Rom.
vec4 cubic_weights(float f)
{
    return vec4(f * (-0.5 + f * (1.0 - 0.5 * f)), 1.0 + f * f * (-2.5 + 1.5 * f),
                f * (0.5 + f * (2.0 - 1.5 * f)), f * f * (-0.5 + 0.5 * f));
}

// No weight for what lies outside, where there is no ink.
vec4 weights_within(float f, int second, int count)
{
    uvec4 cells = uvec4(second + ivec4(-1, 0, 1, 2)); // below the first wraps round
    return cubic_weights(f) * vec4(lessThan(cells, uvec4(uint(count))));
}

uint cell_at(ivec2 cell)
{
    ivec2 nearest = clamp(cell, ivec2(0), ivec2(globals.grid_size) - 1);
    return texelFetch(state_texels, nearest.y * int(globals.grid_size.x) + nearest.x).x;
}

// Wet and dry ink between four cells.
vec2 ink_between(vec2 grid)
{
    vec2 at = grid - 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 f = at - vec2(first);
    return mix(
        mix(unpacked_ink(cell_at(first)), unpacked_ink(cell_at(first + ivec2(1, 0))), f.x),
        mix(unpacked_ink(cell_at(first + ivec2(0, 1))), unpacked_ink(cell_at(first + ivec2(1, 1))), f.x),
        f.y);
}

#endif
