// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_GRID
#define ESTAMPE_INK_GRID

// The grid of flowing ink: where its cells lie on the page, and how ink is interpolated. A cell stores wet
// ink in its lower 16 bits and dry ink in its upper 16 bits. Requires before inclusion: `globals`,
// `state_texels`, `is_around`.

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

// Rows of the grid per face of the cube around the eye; the faces are stored one below the other.
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

// The cell of the ink grid in a direction from the eye, counted from the grid's upper left corner.
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

// Weights of six ink cells in a row for a place that lies `f` cells beyond the third cell of the row, by
// Lagrange interpolation. With only four cells for interpolation, a thin thread of ink is blurred away within
// a hundred steps.
struct Weights {
    vec3 first;
    vec3 last;
};

// Interpolation weights; cells outside the grid get weight 0, because such cells hold no ink.
Weights weights_of(float f, int third, int count)
{
    vec3 first = vec3(-(f + 1.0) * f / 120.0, (f + 2.0) * f / 24.0, -(f + 2.0) * (f + 1.0) / 12.0) *
                 ((f - 1.0) * (f - 2.0) * (f - 3.0));
    vec3 last =
        vec3((f - 2.0) * (f - 3.0) / 12.0, -(f - 1.0) * (f - 3.0) / 24.0, (f - 1.0) * (f - 2.0) / 120.0) *
        ((f + 2.0) * (f + 1.0) * f);
    // Indices of cells before the first cell wrap around to large unsigned numbers, so the comparison below
    // excludes cells before the first.
    uvec3 cells = uvec3(third + ivec3(-2, -1, 0));
    uvec3 more = uvec3(third + ivec3(1, 2, 3));
    return Weights(first * vec3(lessThan(cells, uvec3(uint(count)))),
                   last * vec3(lessThan(more, uvec3(uint(count)))));
}

uint cell_at(ivec2 cell)
{
    ivec2 nearest = clamp(cell, ivec2(0), ivec2(globals.grid_size) - 1);
    return texelFetch(state_texels, nearest.y * int(globals.grid_size.x) + nearest.x).x;
}

// Wet and dry ink at a place of the grid, interpolated bilinearly.
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
