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

// The vertices of a terrain. A terrain vertex is stored as a column and a row in the grid of one level of
// detail. The position of the level of detail converts column and row to a place on the ground.

// A vertex is one 32-bit word: column in bits 0-12, row in bits 13-25, part in bits 26-27, level in bits
// 28-31. The part "trim" fills the gap between a level and the finer level inside it; columns and rows of the
// trim count from the trim's own corner.
SHARED_CONSTANT uint terrain_part_grid = 0U;
SHARED_CONSTANT uint terrain_part_trim_column = 1U;
SHARED_CONSTANT uint terrain_part_trim_row = 2U;
SHARED_CONSTANT uint terrain_index_bits = 13U;

// Variant bits of terrain_vertices.comp. The bit terrain_has_places: vertices are in no grid and have stored
// positions. The bit terrain_keeps_before: the shader also writes the positions of the previous frame.
SHARED_CONSTANT uint terrain_has_places = 1U;
SHARED_CONSTANT uint terrain_keeps_before = 2U;

struct TerrainLevel {
    vec2 origin_m;  // position of column 0 and row 0, relative to the anchor (a nearby origin)
    vec2 eye_cells; // position of the eye relative to the origin, in cells
    float cell_m;   // distance between neighbouring vertices
    // Distance from the eye, in cells, at which heights begin to blend into the heights of the next coarser
    // level.
    float fade_from;
    // Distance from the eye, in cells, at which heights equal the heights of the next coarser level.
    float fade_to;
    uint hole_first;  // first column and row at which the hole for the finer level may begin
    uint hole_count;  // columns and rows of the hole for the finer level, in cells of the current level
    uvec2 hole_shift; // 0 or 1 in x and y: cells between `hole_first` and the actual start of the hole
};

// Constants for all vertices of a terrain.
struct TerrainGlobals {
    vec2 eye_m;            // position of the eye (x, z), relative to the anchor (a nearby origin)
    float anchor_y_m;      // height in the world of the anchor (the origin of positions on the GPU)
    float stroke_unit_m;   // length in metres of one unit of stroke coordinates
    float planet_radius_m; // radius of the planet; 0 for flat ground
    float before_s;        // time between the previous frame and this frame, in seconds
    uint vertex_count;
    uint first_vertex;    // index of the terrain's first vertex among all posed vertices
    uint first_parameter; // index of the first parameter in the words of the program
    uint first_instruction;
    uint instruction_count;
};

// A square field of heights. `origin_m` is the centre of the first texel, relative to the anchor (a nearby
// origin).
struct TerrainField {
    vec2 origin_m;
    float texel_m;
};

SHARED_CONSTANT uint terrain_fields_most = 5U;

// Several height fields of equal size, stacked vertically in one image. The z coordinate of a dispatch is the
// index of the field.
struct TerrainFieldConstants {
    TerrainField fields[5];
    uvec2 size; // size of one field in texels
    FieldSector wanted;
};

// Where the heights of the simulated sand are stored in the buffer of texels.
struct SandConstants {
    uint side;
    uint first_texel;
};

// Numbers of the operations of height graphs, for all interpreters and compilers of a program.

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

// Format in which a height program is stored as 32-bit words: places first, then parameters, then four words
// per instruction.
SHARED_CONSTANT uint height_words_most = 16000U; // limited so that all words fit in 64 KiB of uniforms
SHARED_CONSTANT uint height_words_a_place = 16U;
SHARED_CONSTANT uint height_place_words = 16U;

// An instruction of a height graph: its operation, target register, input registers and first parameter.
// `warp` holds the numbers of two registers, or height_no_register if the place is not warped.
struct HeightInstruction {
    uint op;
    uint target;
    uvec3 inputs;
    uvec2 warp;
    uint parameter;
    uint place;
    uint count; // number of points, if the operation is a curve
};

// Sand that the wind moves in slabs (small units of constant volume).

// State of a cell of the sand for the wind: open sand, open rock, or in the lee.
SHARED_CONSTANT uint slab_open_sand = 0U;
SHARED_CONSTANT uint slab_open_rock = 1U; // the cell has no sand left
SHARED_CONSTANT uint slab_in_lee = 2U;

// Largest number of hops of a slab (unit of sand) before it comes to rest.
SHARED_CONSTANT uint slab_most_hops = 32U;

// Number of pieces into which a line of cells along the wind is divided. One thread processes one piece of
// the line.
SHARED_CONSTANT uint slab_pieces = 16U;

// Constants of one simulation step of the sand. The movement of sand uses only whole numbers, so that the
// results are equal on every device.
struct SlabConstants {
    uint side; // number of cells per side, a power of two
    uint step; // number of steps since the start of the simulation
    uint seed;
    uint along_y; // 1: lines of cells along the wind advance by one cell in y per step; 0: in x
    int sign;     // direction of a step along a line: 1 or -1
    // Sideways shift of a line of cells per step along it, in cells times 65536. The shift over the whole
    // side is a whole number of cells.
    int slope;
    int phase; // offset for rounding lines to cells, in cells times 65536
    // Fall, per step along a line of cells, of the lee's roof (an imaginary surface that descends downwind
    // from each crest). In 1/256 slab (unit of sand).
    int drop;
    int hop_x; // length of a hop along x, in 1/256 cell
    int hop_y;
    int mean; // height of sand, in slabs, at which hops have the length `hop_x`, `hop_y`
    // Relative growth of a hop's length per slab (unit of sand) above the mean height `mean`, times 65536.
    int gain;
    // Number of cells, out of 65536, from which the wind tries to lift a slab (unit of sand) per step.
    uint lift;
    uint on_sand; // number of slabs (units of sand), out of 65536 that land on sand, that stay
    uint on_rock;
};

// Constants of one slide: steep sand slides within blocks of 2 x 2 cells. The next slide uses shifted blocks.
struct SlideConstants {
    uint side;
    uint first_x; // 0 or 1: column at which the first block starts
    uint first_y;
    int beside; // largest allowed difference of height between cells side by side, in slabs
    int aslant; // largest allowed difference of height between diagonal neighbours, in slabs
};

struct SlabHeightConstants {
    uint side;
    uint radius; // number of cells of sand in each direction over which heights are smoothed
    float slab_m;
    float fraction; // interpolates heights from before the last step (0) to after it (1)
};

// Ripples of sand, drawn by changing the shading normals.

// Size of a cell of the ripples' lattice in wavelengths, along and across the wind. The size along the wind
// is a whole number, so that waves continue from cell to cell.
SHARED_CONSTANT float ripple_cell_along = 4.0F;
SHARED_CONSTANT float ripple_cell_across = 7.0F;

struct RippleConstants {
    vec2 wind;  // unit vector of the wind's direction, as (x, z)
    vec2 rest;  // position of the anchor (a nearby origin) in its lattice cell, along and across the wind
    uvec2 cell; // lattice cell that contains the anchor (a nearby origin), as bits of an ivec2
    float wavelength_m;
    float height_m; // height of a ripple from trough to crest
    float meander;
    uint draw; // number of the draw (mesh primitive) that has ripples: the terrain
};

// Trails (footprints and drag marks) in sand.

// A square window of texels that moves over the ground. Texel number n of the ground is stored at index n
// modulo the side, so moving the window copies no texel.
struct TrailWindow {
    uint side;    // number of texels per side, a power of two
    uint first_x; // column in memory at which the window's first texel is stored
    uint first_y;
};

struct TrailPress {
    TrailWindow window;
    // Column of the base texel (a texel near the pressed shape), counted from the window's first texel. All
    // other positions of the shape are relative to the base texel.
    int base_x;
    int base_y;
    int low_x; // first column that the pressed shape touches, counted from the base texel
    int low_y;
    int high_x;
    int high_y;
    vec2 from; // start of the pressed bar, in metres from the centre of the base texel; `to` is its end
    vec2 to;
    float from_radius_m;
    float to_radius_m;
    float depth_m;
    float rim_m; // width of the rim of sand around the stamp (the pressed shape)
    float texel_m;
    float steepness; // slope of the edge of the pressed area
    // Columns by which the window moved. A stamp that was pressed earlier is repeated only in texels that are
    // new in the window.
    int moved_x;
    int moved_y;
    // 1: the stamp (a pressed shape) was pressed earlier and is repeated on new texels, which are level
    // ground.
    uint is_known;
};

struct TrailSlump {
    TrailWindow window;
    uint skip_x; // 0 or 1: column of the window at which the first block of 2 x 2 texels starts
    uint skip_y;
    float beside_m; // largest allowed difference of height between texels side by side, in metres
    float aslant_m; // largest allowed difference of height between diagonal neighbours, in metres
};

struct TrailFill {
    TrailWindow window;
    int moved_x; // columns by which the window has moved since the texels were written
    int moved_y;
    uint steps; // number of time steps that pass
    float kept; // factor by which a trail's height shrinks per time step
};

struct TrailImageConstants {
    TrailWindow window;
    uint edge; // width in texels of the border where heights fade to 0
};

struct TrailRelief {
    vec2 corner_m; // position of the image's corner, relative to the anchor (a nearby origin)
    float texel_m;
    uint draw;        // number of the terrain's draw (mesh primitive)
    vec3 towards_sun; // unit vector; zero if there is no sun
};

// Sand that drifts in the wind.

SHARED_CONSTANT uint drift_streaks_a_cell = 6U;
SHARED_CONSTANT float drift_life_s = 2.4F; // lifetime of a streak of sand

// Constants of the streaks of drifting sand. The cells are the texels of a field of heights. The cells are
// numbered on the ground, so that a streak does not depend on the position of the field.
struct DriftConstants {
    vec2 corner_m; // centre of the field's first texel, relative to the anchor (a nearby origin)
    float cell_m;
    uint side;    // number of cells per side of the field
    uint first_x; // column number on the ground of the field's first cell; wraps around
    uint first_y;
    vec2 wind;           // unit vector of the wind's direction, as (x, z)
    float speed_m_per_s; // speed of the sand in the air
    uint life;           // number of whole streak lifetimes since time 0
    float life_share;    // elapsed share of the current lifetime, for a streak born at its beginning
    float length_m;
    float lift_m;
    float reach_m;
    float half_width_px;
    float amount; // share of all possible streaks that are drawn
};

struct DriftInk {
    vec3 ink; // linear colour of the streaks
    uvec2 size_px;
};

#ifdef __cplusplus
static_assert(sizeof(SlabConstants) == 60);
} // namespace estampe::shared
#endif

#endif
