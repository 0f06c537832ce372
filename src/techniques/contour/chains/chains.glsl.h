// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CHAINS_GLSL_H
#define ESTAMPE_CHAINS_GLSL_H
// Lines strung along the surface: kinds of line, neighbours of triangles, variants of the shaders, and all
// lists. An item is what may hold a piece of a line that is found from view to view: of the outline a
// triangle, or after all triangles a loose edge; after those, of a suggestive contour, a triangle again;
// then, of lines that are found on the page, a cell of that. A slot is a chain: first those of features, then
// one for each segment found, of which only the one that stands for its whole chain is not empty.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// What lines stand for. Four bits hold a kind.

SHARED_CONSTANT uint line_silhouette = 0U;
SHARED_CONSTANT uint line_border = 1U;
SHARED_CONSTANT uint line_boundary = 2U;
SHARED_CONSTANT uint line_crease = 3U;
SHARED_CONSTANT uint line_marked = 4U;
SHARED_CONSTANT uint line_ridge = 5U;
SHARED_CONSTANT uint line_valley = 6U;
SHARED_CONSTANT uint line_suggestive = 7U;
SHARED_CONSTANT uint line_crest = 8U;
SHARED_CONSTANT uint line_intersection = 9U;
SHARED_CONSTANT uint line_shadow = 10U;
SHARED_CONSTANT uint line_kind_count = 11U;
SHARED_CONSTANT uint line_first_of_page = line_intersection; // this and those after it are found on the page

// What an edge mesh says of a triangle: the three sides that face its own, or no_side; then flags.

SHARED_CONSTANT uint no_side = 0xffffffffU;

// The triangle runs against the sense of its shell, which is that of most normals; which of its sides are
// smooth, where shading goes on; the normals of the smooth piece it is of point to the back, in the sense of
// the shell; and from this bit on the number of its shell, from 1, or 0 where it has no lines.
SHARED_CONSTANT uint neighbor_is_turned = 1U;
SHARED_CONSTANT uint neighbor_smooth_shift = 1U;
SHARED_CONSTANT uint neighbor_is_inside_out = 16U;
SHARED_CONSTANT uint neighbor_shell_shift = 5U;

// What is asked of the shaders of chains, shader by shader.

// Outlines run along the edges of the mesh, not through its triangles.
SHARED_CONSTANT uint mark_along_edges = 1U << 0U;

SHARED_CONSTANT uint emit_has_loose_edges = 1U << 0U;
SHARED_CONSTANT uint emit_along_edges = 1U << 1U; // outlines run along those alone

// Some points lie between vertices, and some pieces within triangles.
SHARED_CONSTANT uint order_features_leave_edges = 1U << 0U;

SHARED_CONSTANT uint split_wants_hidden = 1U << 0U; // lines that are not seen

SHARED_CONSTANT uint shape_has_own_outlines = 1U << 0U; // that some material brings
SHARED_CONSTANT uint shape_recalls_frame = 1U << 1U;    // there was one before this
SHARED_CONSTANT uint shape_is_remembered = 1U << 2U;    // there will be one after it
SHARED_CONSTANT uint shape_has_brushes = 1U << 3U;
SHARED_CONSTANT uint shape_has_sway = 1U << 4U;
SHARED_CONSTANT uint shape_has_jitter = 1U << 5U;   // the hand strays, or draws a line again
SHARED_CONSTANT uint shape_has_widths_m = 1U << 6U; // some widths are those of the scene
SHARED_CONSTANT uint shape_swells_in_turns = 1U << 7U;
SHARED_CONSTANT uint shape_is_even_in_shade = 1U << 8U; // strokes do not swell where it is dark
SHARED_CONSTANT uint shape_is_hidden = 1U << 9U;        // these are hidden lines
SHARED_CONSTANT uint shape_stretches = 1U << 10U;       // brushes go from end to end of a stroke
SHARED_CONSTANT uint shape_has_looks = 1U << 11U;       // surfaces differ

SHARED_CONSTANT uint joints_has_brushes = 1U << 0U; // whose corners stay as they are

SHARED_CONSTANT uint ink_layer_has_own_outlines = 1U << 0U; // that some material brings
SHARED_CONSTANT uint ink_layer_has_looks = 1U << 1U;        // surfaces differ

// Chains, and all lists on the way to them and from them.

SHARED_CONSTANT uint cell_px = 2U;              // from point to point of the page's lattice
SHARED_CONSTANT uint grid_cell_px = 4U;         // of the grid in which samples find each other
SHARED_CONSTANT float length_unit_px = 1024.0F; // lengths are whole numbers of these a pixel

// Lists, as ListSize counts them.
SHARED_CONSTANT uint list_segments = 0U;
SHARED_CONSTANT uint list_points = 1U;
SHARED_CONSTANT uint list_samples = 2U;
SHARED_CONSTANT uint list_strokes = 3U;
SHARED_CONSTANT uint list_slots = 4U;
SHARED_CONSTANT uint list_count = 5U;
SHARED_CONSTANT uint no_list = 0xffffffffU;

// Flags of a slot.
SHARED_CONSTANT uint chain_is_closed = 1U;

// Which part of an edge at which shading breaks is outline. Low is towards the start of its first side.
SHARED_CONSTANT uint part_is_there = 1U;
SHARED_CONSTANT uint part_first_is_front = 2U; // of both sides the first is the front
SHARED_CONSTANT uint part_low_shift = 2U;      // what bounds the part there, two bits: see below
SHARED_CONSTANT uint part_high_shift = 4U;
SHARED_CONSTANT uint bound_is_corner = 0U; // the edge's end
SHARED_CONSTANT uint bound_in_first = 1U;  // where the outline crosses into the first side's triangle
SHARED_CONSTANT uint bound_in_second = 2U;

// Where a line crosses a side of the page's cells, see page_cells.glsl.
SHARED_CONSTANT uint crossing_is_there = 0x80000000U;
SHARED_CONSTANT uint crossing_rises = 0x40000000U;
SHARED_CONSTANT uint crossing_seen_between = 0x20000000U;

// Where along a closed chain its first stroke begins.
SHARED_CONSTANT uint no_rotation = 0xffffffffU;
SHARED_CONSTANT uint rotation_to_corner = 0x40000000U; // better none than at a corner: lower is better

// A point of a feature's line; its kind and side are those of the edge to the next point, or of the triangle
// that leads there, with corner 3.
struct FeaturePoint {
    uint vertex;
    uint other_vertex; // the point lies a share of the way to this one
    float share;
    uint chain;
    uint kind;
    uint side;
};

struct FeatureChain {
    uint first_point;
    uint point_count;
    uint is_closed;
};

SHARED_CONSTANT uint no_segment = 0xffffffffU;

// A piece of outline within one item; the next goes on where it ends.
struct Segment {
    vec3 from;
    uint from_normal;
    vec3 to;
    uint to_normal;
    uint source; // kind << 28 | side; corner 3 for the whole triangle
    uint next;   // segment, or no_segment
    uint has_previous;
    float bulge_m; // how far the true surface may stand out; negative where it is hidden by itself
};

// What pointer jumping knows of a segment: where it has got to, in how many steps, and the highest segment
// on the way, with the steps to it.
struct Rank {
    uint at;
    uint steps;
    uint highest;
    uint steps_to_highest;
};

// A point of a chain; bulge and source are those of the piece to the next.
struct ChainPoint {
    vec3 anchor;
    uint normal;
    float bulge_m;
    uint source; // kind << 28 | side; corner 3 for the whole triangle
    uvec2 unused;
};

SHARED_CONSTANT uint no_sample = 0xffffffffU;

// States of a sample.
SHARED_CONSTANT uint sample_is_visible = 1U;
SHARED_CONSTANT uint sample_is_off_page = 2U;
SHARED_CONSTANT uint sample_is_corner = 4U;
SHARED_CONSTANT uint sample_in_ring = 8U;  // of a closed line without a break
SHARED_CONSTANT uint piece_is_there = 16U; // a line goes on to the next sample

// One step along a chain, all steps of a chain alike.
struct LineSample {
    vec3 anchor;
    uint normal;
    vec2 page_px;
    uint source;
    uint state; // see the bits above; the distance to the next sample in pixels, as a half, above them
};

// Ends of a stroke.
SHARED_CONSTANT uint stroke_starts_at_line = 1U;
SHARED_CONSTANT uint stroke_ends_at_line = 2U;
SHARED_CONSTANT uint stroke_is_dropped = 4U;

// Consecutive samples that are drawn in one go.
struct Stroke {
    uint first; // samples
    uint last;
    uint ends;      // whether they meet other lines, and whether it is drawn at all: see the bits above
    uint recalled;  // the sample nearest its middle with a past, see stroke_places.glsl, or no_sample
    int offset_sum; // of the place on its brush there less the arc length here, in sixteenths of a pixel
    uint offset_count;
};

// What is remembered of a sample for the frame after.
struct DrawnSample {
    vec2 page_px;
    uint direction; // two signed halves
    float half_width_px;
    float arc_px; // along the brush, held to the surface from frame to frame
    uint seed;
    float whole_px; // length of the stroke, which a stretched brush has too
};

SHARED_CONSTANT uint no_stroke_seed = 0xffffffffU;

// What a sample was in the frame before.
struct Recall {
    float half_width_px; // negative: it was not there
    float offset_px;
    uint seed; // or no_stroke_seed
};

struct RecallConstants {
    mat4 clip_from_anchor_before;
    uint width;
    uint height;
    uint stretches; // brushes, from end to end of a stroke
};

// A sample as it is inked.
struct LinePoint {
    vec2 page_px;
    float half_width_px;
    uint ink; // see ink_of_look
};

// Uses of a touch.
SHARED_CONSTANT uint touch_use = 15U;
SHARED_CONSTANT uint touch_is_start = 16U;
SHARED_CONSTANT uint touch_is_end = 32U;

// Where on its brush a stroke is at a sample. Sides are those of LinePoint.
struct LineTouch {
    float phase_px; // along the brush, held to the surface from frame to frame
    float along_px; // from the end where the stroke starts
    float whole_px;
    uint way;  // along the line, two signed halves
    uint uses; // of which brush, and whether the stroke starts or ends here: see the bits above
};

// How many there are of something, and the arguments of a dispatch with a thread for each.
struct ListSize {
    uint count;
    uint groups_x;
    uint groups_y;
    uint groups_z;
};

// Stretches that a list is summed up in where workgroups run side by side; as many as one has threads.
SHARED_CONSTANT uint scan_parts = 256U;

struct ScanConstants {
    uint fixed_count; // how many values there are
    uint count_of;    // and the list that brings more, or no_list
    uint total_to;    // the list whose size is the total
    uint capacity;
    uint slots_before; // of the slots that the total's come after
    uint counts_bits;  // of the values, not the values themselves
};

struct ChainConstants {
    uint triangle_count;
    uint loose_edge_count;
    uint suggestive_count; // triangles that may have suggestive contours or crests: all or none
    uint page_words;       // of marks, 32 cells of the page each
    uint feature_chain_count;
    uint feature_point_count;
    uint segment_capacity;
    uint point_capacity;
    uint sample_capacity;
    float step_px;           // between samples, about
    uint first_crest_vertex; // from it on vertices are of the mesh that has crests
    float least_turn;        // of its slope, across a crest
};

// Of the page as a lattice, see page_cells.glsl.
struct CellConstants {
    uint columns; // points of the lattice
    uint rows;
    uint first_word; // of the marks of its cells
    uint word_count; // of all marks
    uint kind;
    float point_px; // where in its pixel a point lies, both ways
};

// How a surface bends at a vertex, as contour::Bending, in sizes of its object. The tangent leads to the
// neighbour.
struct VertexBending {
    uint neighbor;
    vec3 form;
    vec4 change;
};

struct ViewBendConstants {
    uint vertex_count;
    float least_growth;
    float least_sine; // of the angle between normal and view
};

struct CrestConstants {
    uint first_vertex; // of the mesh that has crests
    uint vertex_count; // of all meshes; it is the last
    uint keeps_others; // the other vertices have been written
    vec2 along;        // where the wind blows to, over x and z
};

struct ShapeConstants {
    float width_of_kind[line_kind_count]; // whole ones, in pixels or metres
    uint metre_kinds;                     // a bit a kind
    float taper_px;
    float overshoot_px;
    float wobble_px;
    float pressure;
    float distance_thinning;
    uint seed;
    float wave_px;  // of the hand's sway
    float settling; // share of what a brush is off its even place that it loses in a frame
    float turn_px;  // radius of a bend that is pressed fully
    uint hand;      // how often the line was drawn before
    float retrace_px;
    float jitter_ends_px;
    float jitter_offset_px;
    float jitter_width;
};

struct PartConstants {
    vec2 from_px; // where the part begins, in its own pixels
    float scale;  // of those to pixels of the page that lines were strung on
    uint has_touches;
};

// How wide the lines of a look are, and of what ink: four texels of 16 bytes.
struct LineLook {
    float width_of_kind[line_kind_count]; // whole ones, in pixels or metres
    uint metre_kinds;                     // a bit a kind
    vec3 ink;
    uint unused;
};

// Inks of LinePoint: 0 that of the style, a material + 1, or a look with this bit.
SHARED_CONSTANT uint ink_of_look = 0x8000U;

struct InkConstants {
    uint width;
    uint height;
    vec3 ink_color;
};

SHARED_CONSTANT uint brush_hidden = line_kind_count; // uses of brushes: each kind of line, and this
SHARED_CONSTANT uint brush_use_count = line_kind_count + 1U;
SHARED_CONSTANT uint brush_columns = 1024U;
SHARED_CONSTANT uint brush_rows = 32U;
SHARED_CONSTANT uint no_brush = 0xffffffffU;

struct BrushConstants {
    uint width;
    uint height;
    uvec2 grid_page_px;                 // of the page whose grid knows the samples
    float period_px[brush_use_count];   // of each use, along the stroke; 0 from end to end
    uint layer_of_use[brush_use_count]; // in the image of brushes; no_brush for the pen
};

#ifdef __cplusplus
static_assert(sizeof(Segment) == 48);
static_assert(sizeof(ChainPoint) == 32);
static_assert(sizeof(VertexBending) == 32);
static_assert(sizeof(LineSample) == 32);
static_assert(sizeof(Stroke) == 24);
static_assert(sizeof(DrawnSample) == 28);
static_assert(sizeof(LineLook) == 64);
static_assert(sizeof(ShapeConstants) <= 128);
static_assert(sizeof(BrushConstants) <= 128);
} // namespace estampe::shared
#else

// By the source of a segment, a point or a sample: its line was found on the page, so it is seen.
bool is_of_page(uint source)
{
    return source >> 28 >= line_first_of_page;
}
#endif

#endif
