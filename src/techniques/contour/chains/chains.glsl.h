// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CHAINS_GLSL_H
#define ESTAMPE_CHAINS_GLSL_H
// Lines linked into chains along surfaces: kinds of lines, neighbours of triangles, shader variants, and all
// lists. An item is a unit that may contain a piece of a line found in each view: first all triangles and
// then all loose edges, for the outline; then all triangles again, for suggestive contours; then cells of the
// page, for lines found on the page. A slot holds a chain: first those of features, then one per segment
// found; only the slot of the segment that represents its chain is not empty.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Kinds of lines; a kind fits in four bits.

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
SHARED_CONSTANT uint line_first_of_page = line_intersection; // first of the kinds of lines found on the page

// Neighbours of a triangle in an edge mesh: the three adjacent sides, or no_side; then flags.

SHARED_CONSTANT uint no_side = 0xffffffffU;

// Flags: is_turned: the winding is opposite to its shell's, which follows most normals. smooth_shift: three
// bits, one for each side across which shading is smooth. is_inside_out: the normals of its smooth piece
// point to the back of the shell. shell_shift: number of its shell, from 1; 0 if the triangle has no lines.
SHARED_CONSTANT uint neighbor_is_turned = 1U;
SHARED_CONSTANT uint neighbor_smooth_shift = 1U;
SHARED_CONSTANT uint neighbor_is_inside_out = 16U;
SHARED_CONSTANT uint neighbor_shell_shift = 5U;

// Variant bits of the chain shaders, by shader.

// outlines follow the edges of the mesh and do not cross triangles
SHARED_CONSTANT uint mark_along_edges = 1U << 0U;

SHARED_CONSTANT uint emit_has_loose_edges = 1U << 0U;
SHARED_CONSTANT uint emit_along_edges = 1U << 1U; // outlines run only along edges

// some points are between vertices, and some pieces cross triangles
SHARED_CONSTANT uint order_features_leave_edges = 1U << 0U;

SHARED_CONSTANT uint split_wants_hidden = 1U << 0U; // hidden lines are drawn

SHARED_CONSTANT uint shape_has_own_outlines = 1U << 0U; // some material has its own outline
SHARED_CONSTANT uint shape_recalls_frame = 1U << 1U;    // the previous frame's strokes are stored
SHARED_CONSTANT uint shape_is_remembered = 1U << 2U;    // this frame's strokes are stored for the next frame
SHARED_CONSTANT uint shape_has_brushes = 1U << 3U;
SHARED_CONSTANT uint shape_has_sway = 1U << 4U;
SHARED_CONSTANT uint shape_has_jitter = 1U << 5U;   // the hand wobbles, or retraces lines
SHARED_CONSTANT uint shape_has_widths_m = 1U << 6U; // some widths are in metres
SHARED_CONSTANT uint shape_swells_in_turns = 1U << 7U;
SHARED_CONSTANT uint shape_is_even_in_shade = 1U << 8U; // strokes do not get wider in the dark
SHARED_CONSTANT uint shape_is_hidden = 1U << 9U;        // the pass shapes hidden lines
SHARED_CONSTANT uint shape_stretches = 1U << 10U;       // brushes stretch over the whole stroke
SHARED_CONSTANT uint shape_has_variants = 1U << 11U;    // surfaces have different style variants
SHARED_CONSTANT uint shape_has_inks_by_kind = 1U << 12U;

SHARED_CONSTANT uint joints_has_brushes = 1U << 0U; // corners of brushed lines are not mitred

SHARED_CONSTANT uint ink_layer_has_own_outlines = 1U << 0U; // some material has its own outline
SHARED_CONSTANT uint ink_layer_has_variants = 1U << 1U;     // VariantLines are bound

// Chains, and all lists from which they are made or that are made from them.

SHARED_CONSTANT uint cell_px = 2U;              // spacing of the points of the page's lattice
SHARED_CONSTANT uint grid_cell_px = 4U;         // cell size of the grid that finds samples by position
SHARED_CONSTANT float length_unit_px = 1024.0F; // lengths are whole numbers of 1/1024 pixel

// Indices of the lists into the buffer of ListSize.
SHARED_CONSTANT uint list_segments = 0U;
SHARED_CONSTANT uint list_points = 1U;
SHARED_CONSTANT uint list_samples = 2U;
SHARED_CONSTANT uint list_strokes = 3U;
SHARED_CONSTANT uint list_slots = 4U;
SHARED_CONSTANT uint list_count = 5U;
SHARED_CONSTANT uint no_list = 0xffffffffU;

// Flags of a slot for a chain.
SHARED_CONSTANT uint chain_is_closed = 1U;

// Bits of the part of a hard edge that is outline. "Low" is the end where the edge's first side starts.
SHARED_CONSTANT uint part_is_there = 1U;
SHARED_CONSTANT uint part_first_is_front = 2U; // the first of the two sides belongs to the front
SHARED_CONSTANT uint part_low_shift = 2U;      // two bits: how the part is bounded at the low end, see below
SHARED_CONSTANT uint part_high_shift = 4U;
SHARED_CONSTANT uint bound_is_corner = 0U; // the part reaches the end of the edge
SHARED_CONSTANT uint bound_in_first = 1U;  // the part ends where the outline enters the first side's triangle
SHARED_CONSTANT uint bound_in_second = 2U;

// Bits for the crossing of a line with a side of the page's cells, see page_cells.glsl.
SHARED_CONSTANT uint crossing_is_there = 0x80000000U;
SHARED_CONSTANT uint crossing_rises = 0x40000000U;
SHARED_CONSTANT uint crossing_seen_between = 0x20000000U;

// Position on a closed chain where its first stroke begins.
SHARED_CONSTANT uint no_rotation = 0xffffffffU;
SHARED_CONSTANT uint rotation_to_corner = 0x40000000U; // the start is at a corner; lower values are preferred

// A point of a feature line. `kind` and `side` are those of the edge to the next point; with corner 3, of the
// triangle through which the line goes there.
struct FeaturePoint {
    uint vertex;
    uint other_vertex; // the point lies at `share` of the way to this vertex
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

// A piece of outline within one item; the next piece starts at its end.
struct Segment {
    vec3 from;
    uint from_normal;
    vec3 to;
    uint to_normal;
    uint source; // kind << 28 | side; corner 3 for the whole triangle
    uint next;   // index of a segment, or no_segment
    uint has_previous;
    float bulge_m; // how far the true surface may bulge out; negative if this surface hides it
};

// State of pointer jumping for a segment: the segment it has reached, the number of steps to it, and the
// highest segment on the way with the number of steps to that.
struct Rank {
    uint at;
    uint steps;
    uint highest;
    uint steps_to_highest;
};

// A point of a chain; bulge and source belong to the piece to the next point.
struct ChainPoint {
    vec3 anchor;
    uint normal;
    float bulge_m;
    uint source; // kind << 28 | side; corner 3 for the whole triangle
    uvec2 unused;
};

SHARED_CONSTANT uint no_sample = 0xffffffffU;

// State bits of a sample on a line.
SHARED_CONSTANT uint sample_is_visible = 1U;
SHARED_CONSTANT uint sample_is_off_page = 2U;
SHARED_CONSTANT uint sample_is_corner = 4U;
SHARED_CONSTANT uint sample_in_ring = 8U;  // belongs to a closed line without a gap
SHARED_CONSTANT uint piece_is_there = 16U; // the line continues to the next sample

// A sample of a chain; all samples of a chain are equally spaced.
struct LineSample {
    vec3 anchor;
    uint normal;
    vec2 page_px;
    uint source;
    uint state; // the bits above; the upper bits are the distance to the next sample in pixels, as a half
};

// Bits for the ends of a stroke.
SHARED_CONSTANT uint stroke_starts_at_line = 1U;
SHARED_CONSTANT uint stroke_ends_at_line = 2U;
SHARED_CONSTANT uint stroke_is_dropped = 4U;

// Consecutive samples that are drawn as one stroke.
struct Stroke {
    uint first; // index of the first sample; `last` is the index of the last sample
    uint last;
    uint ends;      // whether the ends meet other lines and the stroke is drawn: see the bits above
    uint recalled;  // the sample nearest the middle that existed in the previous frame, or no_sample
    int offset_sum; // sum of positions along the brush minus arc lengths, in 1/16 pixel
    uint offset_count;
};

// State of a sample that is kept for the next frame.
struct DrawnSample {
    vec2 page_px;
    uint direction; // two signed halves
    float half_width_px;
    float arc_px; // position along the brush, which follows the surface from frame to frame
    uint seed;
    float whole_px; // length of the stroke; a stretched brush has the same length
};

SHARED_CONSTANT uint no_stroke_seed = 0xffffffffU;

// State of a sample in the previous frame.
struct Recall {
    float half_width_px; // negative if the previous frame had no such sample
    float offset_px;
    uint seed; // seed of the stroke, or no_stroke_seed
};

struct RecallConstants {
    mat4 clip_from_anchor_before;
    uint width;
    uint height;
    uint stretches; // brushes stretch over the whole stroke
};

// A sample of a stroke with its final position, width and ink.
struct LinePoint {
    vec2 page_px;
    float half_width_px;
    uint ink; // see ink_of_variant
};

// Bits of LineTouch::uses.
SHARED_CONSTANT uint touch_use = 15U;
SHARED_CONSTANT uint touch_is_start = 16U;
SHARED_CONSTANT uint touch_is_end = 32U;

// Position along the brush at a sample. Left and right sides are as in LinePoint.
struct LineTouch {
    float phase_px; // position along the brush, which follows the surface from frame to frame
    float along_px; // distance from the end where the stroke starts
    float whole_px;
    uint way;  // direction of the line, two signed halves
    uint uses; // the kind of brush, and whether the stroke starts or ends here: see the bits above
};

// Length of a list, and the arguments of an indirect dispatch with one thread per entry.
struct ListSize {
    uint count;
    uint groups_x;
    uint groups_y;
    uint groups_z;
};

// Number of parts into which a list is divided to sum it with parallel workgroups; as many as a workgroup has
// threads.
SHARED_CONSTANT uint scan_parts = 256U;

struct ScanConstants {
    uint fixed_count; // fixed number of values
    uint count_of;    // list whose size is added to that number, or no_list
    uint total_to;    // list whose size becomes the total
    uint capacity;
    uint slots_before; // slots that come before those of the total's list
    uint counts_bits;  // sums the set bits of the values, not the values
};

struct ChainConstants {
    uint triangle_count;
    uint loose_edge_count;
    uint suggestive_count; // triangles that may have suggestive contours or crests: all or none
    uint page_words;       // number of words of marks; one word has bits for 32 cells of the page
    uint feature_chain_count;
    uint feature_point_count;
    uint segment_capacity;
    uint point_capacity;
    uint sample_capacity;
    float step_px;           // approximate spacing of samples
    uint first_crest_vertex; // vertices from here on belong to the mesh with crests
    float least_turn;        // smallest change of slope across a crest
};

// Lattice of the page, see page_cells.glsl.
struct CellConstants {
    uint columns; // points per row of the lattice
    uint rows;
    uint first_word; // first word of this kind's marks
    uint word_count; // total number of words of marks
    uint kind;
    float point_px; // position of a lattice point in its pixel, in x and y
};

// Curvature of a surface at a vertex, as contour::Bending, in units of the object's size. The tangent points
// to the neighbour.
struct VertexBending {
    uint neighbor;
    vec3 form;
    vec4 change;
};

struct ViewBendConstants {
    uint vertex_count;
    float least_growth;
    float least_sine; // sine of the angle between normal and view
};

struct CrestConstants {
    uint first_vertex; // first vertex of the mesh with crests
    uint vertex_count; // number of vertices of all meshes; the mesh with crests is the last
    uint keeps_others; // another pass has written the vertices of the other meshes
    vec2 along;        // direction that the wind blows to, along x and z
};

struct ShapeConstants {
    float width_of_kind[line_kind_count]; // full widths in pixels or metres
    uint metre_kinds;                     // bit mask of the kinds whose width is in metres
    float taper_px;
    float overshoot_px;
    float wobble_px;
    float pressure;
    float distance_thinning;
    uint seed;
    float wave_px;  // wavelength of the hand's wobble
    float settling; // share of a brush's offset from its even position that is removed per frame
    float turn_px;  // radius of a bend at which pressure is greatest
    uint hand;      // number of times that the line has already been drawn
    float retrace_px;
    float jitter_ends_px;
    float jitter_offset_px;
    float jitter_width;
};

struct PartConstants {
    vec2 from_px; // position of the part, in pixels of the part
    float scale;  // pixels of the part per pixel of the page on which lines were linked
    uint has_touches;
};

// Line widths and inks of a style variant.
struct VariantLines {
    float width_of_kind[line_kind_count]; // full widths in pixels or metres
    uint metre_kinds;                     // bit mask of the kinds whose width is in metres
    vec3 ink_of_kind[line_kind_count];    // linear
};

SHARED_CONSTANT uint variant_lines_words = 4U * line_kind_count + 1U;

// Ink of a LinePoint, in 16 bits: 0 is the style's ink, index + 1 the ink of a material. With this bit set,
// the ink of a kind of line in a style variant: line_kind_count - 1 - kind from bit ink_kind_shift on, and
// the variant below. Where lines of equal coverage overlap, the higher number is drawn: outlines over folds.
SHARED_CONSTANT uint ink_of_variant = 0x8000U;
SHARED_CONSTANT uint ink_kind_shift = 11U;
SHARED_CONSTANT uint most_ink_variants = 1U << ink_kind_shift;

struct InkConstants {
    uint width;
    uint height;
    vec3 ink_color;
};

SHARED_CONSTANT uint brush_hidden = line_kind_count; // one use per kind of line; last, hidden lines
SHARED_CONSTANT uint brush_use_count = line_kind_count + 1U;
SHARED_CONSTANT uint brush_columns = 1024U;
SHARED_CONSTANT uint brush_rows = 32U;
SHARED_CONSTANT uint no_brush = 0xffffffffU;

struct BrushConstants {
    uint width;
    uint height;
    uvec2 grid_page_px;                 // size of the page of the grid that finds samples
    float period_px[brush_use_count];   // repeat length along the stroke; 0 stretches the brush over it
    uint layer_of_use[brush_use_count]; // layer in the image of brushes; no_brush draws with the pen
};

#ifdef __cplusplus
static_assert(sizeof(Segment) == 48);
static_assert(sizeof(ChainPoint) == 32);
static_assert(sizeof(VertexBending) == 32);
static_assert(sizeof(LineSample) == 32);
static_assert(sizeof(Stroke) == 24);
static_assert(sizeof(DrawnSample) == 28);
static_assert(sizeof(VariantLines) == sizeof(uint) * variant_lines_words);
static_assert(sizeof(ShapeConstants) <= 128);
static_assert(sizeof(BrushConstants) <= 128);
} // namespace estampe::shared
#else

// Whether a line was found on the page and is therefore visible. `source` comes from a segment, point or
// sample.
bool is_of_page(uint source)
{
    return source >> 28 >= line_first_of_page;
}
#endif

#endif
