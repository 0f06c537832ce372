// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TERRAIN_MESH_GLSL_H
#define ESTAMPE_TERRAIN_MESH_GLSL_H
// The vertices of a terrain: where each stands in the grid of its level, and where the levels stand.
#ifdef __cplusplus
#include "shaders/field_sector.glsl.h"
namespace estampe::shared {
#else
#include "shaders/field_sector.glsl.h"
#endif

// A vertex in one word: column in bits 0-12, row in 13-25, part in 26-27, level in 28-31. Columns and rows of
// the trim, which fills the gap between a level and the finer one within, count from the trim's own corner.
SHARED_CONSTANT uint terrain_part_grid = 0U;
SHARED_CONSTANT uint terrain_part_trim_column = 1U;
SHARED_CONSTANT uint terrain_part_trim_row = 2U;
SHARED_CONSTANT uint terrain_index_bits = 13U;

// Bits of terrain_vertices.comp's variant: vertices stand in no grid; where they were before is wanted.
SHARED_CONSTANT uint terrain_has_places = 1U;
SHARED_CONSTANT uint terrain_keeps_before = 2U;

struct TerrainLevel {
    vec2 origin_m;    // of column 0 and row 0, from the anchor
    vec2 eye_cells;   // from there
    float cell_m;     // between vertices
    float fade_from;  // cells from the eye where heights begin to go over to those of the next level
    float fade_to;    // where they are those
    uint hole_first;  // column and row where the finer level may begin
    uint hole_count;  // its columns and rows, in cells of this one
    uvec2 hole_shift; // 0 or 1: where it begins indeed
};

// What all vertices share.
struct TerrainGlobals {
    vec2 eye_m;            // from the anchor
    float anchor_y_m;      // of the anchor, in the world
    float stroke_unit_m;   // of stroke coordinates
    float planet_radius_m; // 0: flat
    float before_s;        // how long ago the frame before was
    uint vertex_count;
    uint first_vertex;    // of the posed ones
    uint first_parameter; // in the words of the program
    uint first_instruction;
    uint instruction_count;
};

// A field of heights: origin is the middle of the first texel, from the anchor.
struct TerrainField {
    vec2 origin_m;
    float texel_m;
};

SHARED_CONSTANT uint terrain_fields_most = 5U;

// Fields of one size, one under another in their image; the third coordinate of a dispatch counts them.
struct TerrainFieldConstants {
    TerrainField fields[5];
    uvec2 size; // of a field, texels
    FieldSector wanted;
};

// Where the heights of sand go among the texels.
struct SandConstants {
    uint side;
    uint first_texel;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
