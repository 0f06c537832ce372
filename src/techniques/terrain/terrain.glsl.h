// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TERRAIN_GLSL_H
#define ESTAMPE_TERRAIN_GLSL_H
// Constants and structs of the terrain shaders, shared with C++: mesh, height graphs, slabs of sand, ripples,
// trails and drifting sand.
#include "shaders/field_sector.glsl.h"
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// The vertices of a terrain: their column and row in the grid of a level, and the levels' positions.

// A vertex is one word: column in bits 0-12, row in 13-25, part in 26-27, level in 28-31. The trim fills the
// gap between a level and the finer level inside it; its columns and rows count from its own corner.
SHARED_CONSTANT uint terrain_part_grid = 0U;
SHARED_CONSTANT uint terrain_part_trim_column = 1U;
SHARED_CONSTANT uint terrain_part_trim_row = 2U;
SHARED_CONSTANT uint terrain_index_bits = 13U;

// Variant bits of terrain_vertices.comp: vertices are in no grid; previous positions are wanted.
SHARED_CONSTANT uint terrain_has_places = 1U;
SHARED_CONSTANT uint terrain_keeps_before = 2U;

struct TerrainLevel {
    vec2 origin_m;    // position of column 0 and row 0, from the anchor
    vec2 eye_cells;   // position of the eye, in cells from the origin
    float cell_m;     // distance between vertices
    float fade_from;  // distance in cells from the eye, where heights begin to blend into the next level
    float fade_to;    // distance where they reach the next level's heights
    uint hole_first;  // first column and row where the finer level may begin
    uint hole_count;  // columns and rows of the hole, in cells of this level
    uvec2 hole_shift; // 0 or 1: offset of the hole's actual start
};

// Constants of all vertices.
struct TerrainGlobals {
    vec2 eye_m;            // from the anchor
    float anchor_y_m;      // height of the anchor in the world
    float stroke_unit_m;   // length of a unit of stroke coordinates
    float planet_radius_m; // 0 for flat ground
    float before_s;        // time since the previous frame
    uint vertex_count;
    uint first_vertex;    // index of the terrain's first posed vertex
    uint first_parameter; // index in the words of the program
    uint first_instruction;
    uint instruction_count;
};

// A field of heights. Its origin is the centre of the first texel, from the anchor.
struct TerrainField {
    vec2 origin_m;
    float texel_m;
};

SHARED_CONSTANT uint terrain_fields_most = 5U;

// Fields of one size, stacked vertically in one image. The z coordinate of a dispatch is the field's index.
struct TerrainFieldConstants {
    TerrainField fields[5];
    uvec2 size; // of a field, texels
    FieldSector wanted;
};

// The place of the sand's heights in the buffer of texels.
struct SandConstants {
    uint side;
    uint first_texel;
};

// Operations of height graphs, for all interpreters and compilers of a program.

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

// A program in words: places, parameters, and four words per instruction.
SHARED_CONSTANT uint height_words_most = 16000U; // so that words fit in 64 KiB of uniforms
SHARED_CONSTANT uint height_words_a_place = 16U;
SHARED_CONSTANT uint height_place_words = 16U;

// An instruction: its operation, target register, input registers and first parameter. `warp` holds two
// registers, or height_no_register if the place is not warped.
struct HeightInstruction {
    uint op;
    uint target;
    uvec3 inputs;
    uvec2 warp;
    uint parameter;
    uint place;
    uint count; // number of points of a curve
};

// Slabs of sand.

// Kinds of ground for the wind, per cell.
SHARED_CONSTANT uint slab_open_sand = 0U;
SHARED_CONSTANT uint slab_open_rock = 1U; // no sand left
SHARED_CONSTANT uint slab_in_lee = 2U;

SHARED_CONSTANT uint slab_most_hops = 32U; // a slab stays where its last hop ends

// A line of cells along the wind is divided into this many pieces, one per thread.
SHARED_CONSTANT uint slab_pieces = 16U;

// The movement of sand uses whole numbers only, so that results are equal on every device.
struct SlabConstants {
    uint side; // cells per side, a power of two
    uint step; // steps since the field's beginning
    uint seed;
    uint along_y; // 1: a line along the wind steps along y; 0: along x
    int sign;     // sign of that step
    int slope;    // cells across per step along, times 65536; whole cells over the whole side
    int phase;    // offset for rounding lines to cells, times 65536
    int drop;     // fall of the lee's roof per step, 1/256 slab
    int hop_x;    // length of a hop, 1/256 cell
    int hop_y;
    int mean;     // height in slabs at which hops have that length
    int gain;     // growth of a hop's length per slab of height, times 65536
    uint lift;    // number of cells, of 65536, at which the wind tries to lift a slab per step
    uint on_sand; // of 65536 slabs that land on sand, how many stay
    uint on_rock;
};

// One phase of sliding works on blocks of 2 x 2 cells; the next phase uses other blocks.
struct SlideConstants {
    uint side;
    uint first_x; // 0 or 1: offset of the blocks
    uint first_y;
    int beside; // height difference in slabs that is allowed between side neighbours
    int aslant; // height difference in slabs that is allowed between diagonal neighbours
};

struct SlabHeightConstants {
    uint side;
    uint radius; // cells of smoothing in each direction
    float slab_m;
    float fraction; // interpolation from the state before the last step, 0, to the state after it, 1
};

// Ripples.

// Size of a cell of the ripples' lattice in wavelengths, along and across the wind. It is whole along the
// wind, so that waves continue from cell to cell.
SHARED_CONSTANT float ripple_cell_along = 4.0F;
SHARED_CONSTANT float ripple_cell_across = 7.0F;

struct RippleConstants {
    vec2 wind;  // unit vector in x and z
    vec2 rest;  // fractional position of the anchor in the lattice: along the wind, across
    uvec2 cell; // whole cells of that position, as bits of ivec2
    float wavelength_m;
    float height_m; // from trough to crest
    float meander;
    uint draw; // number of the draw that has ripples
};

// Trails.

// A square window of texels on the ground. Texel number n of the ground is stored at index n modulo the side,
// so moving the window copies no texel.
struct TrailWindow {
    uint side;    // texels, a power of two
    uint first_x; // where the window's first texel is stored
    uint first_y;
};

struct TrailPress {
    TrailWindow window;
    int base_x; // texel that places are relative to, counted from the window's first texel
    int base_y;
    int low_x; // bounds of the touched texels, relative to the base
    int low_y;
    int high_x;
    int high_y;
    vec2 from; // ends of the stamp, metres from the base's centre
    vec2 to;
    float from_radius_m;
    float to_radius_m;
    float depth_m;
    float rim_m; // width of the rim
    float texel_m;
    float steepness; // slope of the sole's edge
    int moved_x;     // movement of the window; a known stamp leaves the texels unchanged that the window kept
    int moved_y;
    uint is_known; // 1: pressed earlier, repeated now on new texels, on level ground
};

struct TrailSlump {
    TrailWindow window;
    uint skip_x; // 0 or 1: offset of the 2 x 2 blocks in the window
    uint skip_y;
    float beside_m; // height difference in metres that is allowed between side neighbours
    float aslant_m; // height difference in metres that is allowed between diagonal neighbours
};

struct TrailFill {
    TrailWindow window;
    int moved_x; // movement of the window since the texels were written
    int moved_y;
    uint steps; // steps that pass
    float kept; // factor of a height per step
};

struct TrailImageConstants {
    TrailWindow window;
    uint edge; // width in texels of the fade at the window's edge
};

struct TrailRelief {
    vec2 corner_m; // corner of the image, from the anchor
    float texel_m;
    uint draw;        // number of the terrain's draw
    vec3 towards_sun; // unit vector; 0 without a sun
};

// Drifting sand.

SHARED_CONSTANT uint drift_streaks_a_cell = 6U;
SHARED_CONSTANT float drift_life_s = 2.4F; // lifetime of a streak

// Cells are the texels of a field of heights. Cells are numbered on the ground, so that a streak does not
// depend on the field's position.
struct DriftConstants {
    vec2 corner_m; // centre of the field's first texel, from the anchor
    float cell_m;
    uint side;    // cells per side
    uint first_x; // number of the first cell on the ground; wraps around
    uint first_y;
    vec2 wind;           // unit vector in x and z
    float speed_m_per_s; // of sand in the air
    uint life;           // number of the current lifetime of streaks
    float life_share;    // elapsed share of the lifetime, for a streak born at its beginning
    float length_m;
    float lift_m;
    float reach_m;
    float half_width_px;
    float amount; // share of the streaks that are drawn
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
