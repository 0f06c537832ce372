// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TERRAIN_GLSL_H
#define ESTAMPE_TERRAIN_GLSL_H
// What the shaders of terrains share with C++: the mesh, height graphs, slabs of sand, ripples, trails and
// drift.
#include "shaders/field_sector.glsl.h"
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// The vertices of a terrain: where each stands in the grid of its level, and where the levels stand.

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

// A height graph's instructions, as every reader of a program has them.

SHARED_CONSTANT uint height_constant = 0U;
SHARED_CONSTANT uint height_add = 1U;
SHARED_CONSTANT uint height_subtract = 2U;
SHARED_CONSTANT uint height_multiply = 3U;
SHARED_CONSTANT uint height_divide = 4U;
SHARED_CONSTANT uint height_minimum = 5U;
SHARED_CONSTANT uint height_maximum = 6U;
SHARED_CONSTANT uint height_lerp = 7U;
SHARED_CONSTANT uint height_smoothstep = 8U;
SHARED_CONSTANT uint height_power = 9U;
SHARED_CONSTANT uint height_curve = 10U;
SHARED_CONSTANT uint height_sine = 11U;
SHARED_CONSTANT uint height_cosine = 12U;
SHARED_CONSTANT uint height_absolute = 13U;
SHARED_CONSTANT uint height_root = 14U;
SHARED_CONSTANT uint height_radius = 15U;
SHARED_CONSTANT uint height_angle = 16U;
SHARED_CONSTANT uint height_coordinate_u = 17U;
SHARED_CONSTANT uint height_coordinate_v = 18U;
SHARED_CONSTANT uint height_wave = 19U;
SHARED_CONSTANT uint height_noise = 20U;
SHARED_CONSTANT uint height_fbm = 21U;
SHARED_CONSTANT uint height_ridged = 22U;
SHARED_CONSTANT uint height_cellular = 23U;
SHARED_CONSTANT uint height_texture = 24U;
SHARED_CONSTANT uint height_dunes = 25U;

SHARED_CONSTANT uint height_no_register = 0xffffffffU;
SHARED_CONSTANT uint height_register_count = 32U;

// A program in words: places, parameters, four words an instruction.
SHARED_CONSTANT uint height_words_most = 16000U; // within 64 KiB of uniforms
SHARED_CONSTANT uint height_words_a_place = 16U;
SHARED_CONSTANT uint height_place_words = 16U;

// What an instruction does, and where its result goes. Registers `inputs` and `warp`, the last two of which
// are height_no_register where the place is not warped; `parameter` begins the parameters.
struct HeightInstruction {
    uint op;
    uint target;
    uvec3 inputs;
    uvec2 warp;
    uint parameter;
    uint place;
    uint count; // points of a curve
};

// Slabs of sand.

// What the wind finds in a cell.
SHARED_CONSTANT uint slab_open_sand = 0U;
SHARED_CONSTANT uint slab_open_rock = 1U; // no sand left
SHARED_CONSTANT uint slab_in_lee = 2U;

SHARED_CONSTANT uint slab_most_hops = 32U; // where the last one ends, the slab stays

// A line of cells along the wind is walked in so many pieces, each by a thread.
SHARED_CONSTANT uint slab_pieces = 16U;

// All that moves sand is whole numbers, alike on every device.
struct SlabConstants {
    uint side; // cells, a power of two
    uint step; // counted from the field's beginning
    uint seed;
    uint along_y; // 1: lines of the wind step along y, else along x
    int sign;     // of that step
    int slope;    // cells across for a step along, times 65536; over the whole side it is whole cells
    int phase;    // where lines round, times 65536
    int drop;     // of the lee's roof over a step, 1/256 slab
    int hop_x;    // of a slab, 1/256 cell
    int hop_y;
    int mean;     // height at which hops are that long, slabs
    int gain;     // of a hop's length by a slab of height, times 65536
    uint lift;    // of 65536 cells, those that the wind tries in a step
    uint on_sand; // of 65536 slabs that touch sand, those that stay
    uint on_rock;
};

// A phase of the sliding looks at blocks of two by two cells; the next phase's blocks lie elsewhere.
struct SlideConstants {
    uint side;
    uint first_x; // 0 or 1: where blocks begin
    uint first_y;
    int beside; // slabs that a cell may be higher than the one beside it
    int aslant; // slabs that a cell may be higher than the one across its corner
};

struct SlabHeightConstants {
    uint side;
    uint radius; // cells that are smoothed over, on either side
    float slab_m;
    float fraction; // from the state before the last step, 0, to the last, 1
};

// Ripples.

// A cell of the lattice that ripples hang on, in wavelengths along the wind and across; whole along the wind,
// so that waves go on from cell to cell.
SHARED_CONSTANT float ripple_cell_along = 4.0F;
SHARED_CONSTANT float ripple_cell_across = 7.0F;

struct RippleConstants {
    vec2 wind;  // unit, x and z
    vec2 rest;  // of the anchor in the lattice: along the wind, across
    uvec2 cell; // and the whole cells, as bits of ivec2
    float wavelength_m;
    float height_m; // from trough to crest
    float meander;
    uint draw; // whose surface ripples
};

// Trails.

// The texels of a window on the ground. A texel of the ground is kept at its number modulo the side, so that
// nothing is moved when the window is.
struct TrailWindow {
    uint side;    // texels, a power of two
    uint first_x; // where the window's first texel is kept
    uint first_y;
};

struct TrailPress {
    TrailWindow window;
    int base_x; // the texel that places are counted from, seen from the window's first
    int base_y;
    int low_x; // what is touched, in texels from the base
    int low_y;
    int high_x;
    int high_y;
    vec2 from; // ends of what is pressed in, metres from the base's centre
    vec2 to;
    float from_radius_m;
    float to_radius_m;
    float depth_m;
    float rim_m; // width of the rim
    float texel_m;
    float steepness; // of the sole's edge
    int moved_x;     // of the window: texels that it has kept are left, if what is pressed is known
    int moved_y;
    uint is_known; // pressed in before, on ground that was level
};

struct TrailSlump {
    TrailWindow window;
    uint skip_x; // 0 or 1: where blocks of two by two begin in the window
    uint skip_y;
    float beside_m; // that a texel may be higher than the one beside it
    float aslant_m; // that a texel may be higher than the one across its corner
};

struct TrailFill {
    TrailWindow window;
    int moved_x; // of the window since the texels were made
    int moved_y;
    uint steps; // that pass
    float kept; // of a height in a step
};

struct TrailImageConstants {
    TrailWindow window;
    uint edge; // texels over which trails fade towards the window's edge
};

struct TrailRelief {
    vec2 corner_m; // of the image, from the anchor
    float texel_m;
    uint draw;        // whose surface is trodden
    vec3 towards_sun; // unit; 0: there is none
};

// Drifting sand.

SHARED_CONSTANT uint drift_streaks_a_cell = 6U;
SHARED_CONSTANT float drift_life_s = 2.4F; // of a streak

// Cells are the texels of a field of heights, numbered on the ground, so that a streak is the same wherever
// the field is.
struct DriftConstants {
    vec2 corner_m; // of the field's first texel's middle, from the anchor
    float cell_m;
    uint side;    // cells
    uint first_x; // number of the first cell on the ground, which wraps
    uint first_y;
    vec2 wind;           // unit, x and z
    float speed_m_per_s; // of sand in the air
    uint life;           // number of the life that streaks are in
    float life_share;    // of it that has passed for a streak born at its beginning
    float length_m;
    float lift_m;
    float reach_m;
    float half_width_px;
    float amount; // streaks that are there, as a share
};

struct DriftInk {
    vec3 ink; // linear
    uvec2 size_px;
};

#ifdef __cplusplus
static_assert(sizeof(SlabConstants) == 60);
} // namespace estampe::shared
#endif

#endif
