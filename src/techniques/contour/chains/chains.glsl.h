// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CHAINS_GLSL_H
#define ESTAMPE_CHAINS_GLSL_H
// Declarations for contour chains (lines linked into chains along surfaces) that C++ and shaders share: kinds
// of lines, neighbours of triangles, shader variants and the formats of all lists. An item is a unit that can
// contain one segment of a line: a triangle or a loose edge for outlines, a triangle for suggestive contours,
// a cell of the page for lines found on the page. The items are numbered in the order triangles, loose edges,
// cells. A slot is an entry of the list of chains: first one slot per feature chain, then one slot per
// segment. One segment represents each chain; the slots of the chain's remaining segments stay empty.
#ifdef __cplusplus
#include "shaders/shared.hpp"
#include "shaders/tone.glsl.h"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#include "shaders/tone.glsl.h"
#endif

// The kinds of lines. The number of a kind fits in four bits.

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
SHARED_CONSTANT uint line_clump = 11U;      // around a clump of leaves
SHARED_CONSTANT uint line_leaf = 12U;       // a mark where the light ends on a clump
SHARED_CONSTANT uint line_kind_count = 13U; // more kinds do not fit into ShapeConstants and BrushConstants
// Number of the first kind of line that is found between the pixels of the page, not on the mesh.
SHARED_CONSTANT uint line_first_of_page = line_intersection;

// The record of a triangle in an edge mesh: the numbers of the three adjacent triangle sides (no_side where
// no triangle adjoins), then flags.

SHARED_CONSTANT uint no_side = 0xffffffffU;

// Flags of a triangle. is_turned: the triangle's winding is opposite to the winding of the triangle's shell
// (connected surface). smooth_shift: three bits, one for each side across which shading is smooth.
// is_inside_out: the vertex normals around the triangle point to the back of the shell. shell_shift: the
// number of the triangle's shell, from 1, or 0 if the triangle has no lines.
SHARED_CONSTANT uint neighbor_is_turned = 1U;
SHARED_CONSTANT uint neighbor_smooth_shift = 1U;
SHARED_CONSTANT uint neighbor_is_inside_out = 16U;
SHARED_CONSTANT uint neighbor_shell_shift = 5U;

// Variant bits: each bit compiles one feature into a chain shader. The first word of a bit's name is the
// shader's name.

// For the shaders mark_*.comp: outlines follow the edges of the mesh and do not cross triangles.
SHARED_CONSTANT uint mark_along_edges = 1U << 0U;

SHARED_CONSTANT uint emit_has_loose_edges = 1U << 0U;
// Outlines follow only edges of the mesh and do not cross triangles.
SHARED_CONSTANT uint emit_along_edges = 1U << 1U;

// Some lines have a brush, which is laid along the hidden part of a line too.
SHARED_CONSTANT uint ends_has_brushes = 1U << 0U;

// The second of two passes, which adds along columns what the first pass has added along rows.
SHARED_CONSTANT uint light_foliage_adds_rows = 1U << 0U;

// The lines run around clumps of foliage.
SHARED_CONSTANT uint emit_cells_of_clumps = 1U << 0U;

// Some points of feature lines (creases and other lines fixed to the surface) lie between vertices, and some
// segments of feature lines cross triangles.
SHARED_CONSTANT uint order_features_leave_edges = 1U << 0U;

// The shader makes strokes for hidden lines, not for visible lines.
SHARED_CONSTANT uint split_wants_hidden = 1U << 0U;

// At least one material sets the ink and width of its outline.
SHARED_CONSTANT uint shape_has_own_outlines = 1U << 0U;
SHARED_CONSTANT uint shape_recalls_frame = 1U << 1U; // the strokes of the previous frame are available
// The strokes of the current frame are stored for the next frame.
SHARED_CONSTANT uint shape_is_remembered = 1U << 2U;
SHARED_CONSTANT uint shape_has_brushes = 1U << 3U;
SHARED_CONSTANT uint shape_has_sway = 1U << 4U;
// The simulated hand wobbles, or it draws lines several times.
SHARED_CONSTANT uint shape_has_jitter = 1U << 5U;
SHARED_CONSTANT uint shape_has_widths_m = 1U << 6U; // some line widths are in metres of the scene
SHARED_CONSTANT uint shape_swells_in_turns = 1U << 7U;
SHARED_CONSTANT uint shape_is_even_in_shade = 1U << 8U; // strokes keep their width in dark areas
SHARED_CONSTANT uint shape_is_hidden = 1U << 9U;        // the pass shapes hidden lines
// The picture of a brush stretches over the whole stroke.
SHARED_CONSTANT uint shape_stretches = 1U << 10U;
// Surfaces have different style variants (styles of certain materials or objects).
SHARED_CONSTANT uint shape_has_variants = 1U << 11U;
SHARED_CONSTANT uint shape_has_inks_by_kind = 1U << 12U;

// Some lines have a brush; the corners of lines with a brush are not mitred.
SHARED_CONSTANT uint joints_has_brushes = 1U << 0U;

// At least one material sets the ink and width of its outline.
SHARED_CONSTANT uint ink_layer_has_own_outlines = 1U << 0U;
// A list of VariantLines is bound: lines depend on the style variant (the style of certain materials or
// objects).
SHARED_CONSTANT uint ink_layer_has_variants = 1U << 1U;

// Data formats of contour chains, and of the lists in the pipeline before and after chains.

// Spacing in pixels of the points of the page lattice (the grid in which lines are found on the page).
SHARED_CONSTANT uint cell_px = 2U;
// Size in pixels of a cell of the sample grid, which finds samples by their position on the page.
SHARED_CONSTANT uint grid_cell_px = 4U;
// Lengths are stored as whole numbers of 1/1024 pixel, so that sums are exact.
SHARED_CONSTANT float length_unit_px = 1024.0F;

// Indices of the lists in the buffer of ListSize, which stores the length of each list.
SHARED_CONSTANT uint list_segments = 0U;
SHARED_CONSTANT uint list_points = 1U;
SHARED_CONSTANT uint list_samples = 2U;
SHARED_CONSTANT uint list_strokes = 3U;
SHARED_CONSTANT uint list_slots = 4U;
SHARED_CONSTANT uint list_count = 5U;
SHARED_CONSTANT uint no_list = 0xffffffffU;

// Flags of a chain, stored in the chain's slot.
SHARED_CONSTANT uint chain_is_closed = 1U;

// Bits that say which part of a hard edge (an edge where the shading breaks) is outline. "Low" is the end of
// the edge where its first side starts.
SHARED_CONSTANT uint part_is_there = 1U;
// The edge's first side belongs to the triangle that faces the eye.
SHARED_CONSTANT uint part_first_is_front = 2U;
// Position of two bits that tell how the outline ends at the edge's low end. The bits hold bound_is_corner,
// bound_in_first or another constant bound_*.
SHARED_CONSTANT uint part_low_shift = 2U;
SHARED_CONSTANT uint part_high_shift = 4U;
SHARED_CONSTANT uint bound_is_corner = 0U; // the outline reaches the end of the edge
// The outline leaves the edge and continues into the triangle of the edge's first side.
SHARED_CONSTANT uint bound_in_first = 1U;
SHARED_CONSTANT uint bound_in_second = 2U;

// Bits that describe where a line crosses a side of the page lattice (a grid of points on the page), see
// page_cells.glsl.
SHARED_CONSTANT uint crossing_is_there = 0x80000000U;
SHARED_CONSTANT uint crossing_rises = 0x40000000U;
SHARED_CONSTANT uint crossing_seen_between = 0x20000000U;
// The line is a mark on a clump of foliage, not the clump's outline.
SHARED_CONSTANT uint crossing_is_mark = 0x10000000U;
// The line is the outline of a clump of foliage before foliage that is farther away.
SHARED_CONSTANT uint crossing_is_within = 0x08000000U;

// Value for a closed chain that cannot be cut open, because the chain has neither a hidden part nor a corner.
SHARED_CONSTANT uint no_rotation = 0xffffffffU;
// This bit is set if a closed chain is cut open at a corner. A chain with a hidden part is cut at the hidden
// part, not at a corner.
SHARED_CONSTANT uint rotation_to_corner = 0x40000000U;

// A point of a feature line (a line fixed to the surface). `kind` and `side` describe the edge to the next
// point. If the corner number in `side` is 3, the line does not follow an edge but crosses a triangle to the
// next point.
struct FeaturePoint {
    uint vertex;
    uint other_vertex; // the point lies at `share` of the way from `vertex` to `other_vertex`
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

// A segment of outline within one item (a triangle or an edge). The segment `next` starts where the segment
// ends.
struct Segment {
    vec3 from;
    uint from_normal;
    vec3 to;
    uint to_normal;
    uint source; // kind of line << 28 | side of a triangle; corner number 3 means the whole triangle
    uint next;   // index of the segment that follows in the chain, or no_segment
    uint has_previous;
    // How far the smooth surface may bulge out of the flat triangle, in metres; negative if the smooth
    // surface hides the line. Of a line around a clump: positive if foliage is seen behind the line, too.
    float bulge_m;
};

// State of pointer jumping for one segment: the segment that was reached, and the segment with the highest
// number on the way; for each of the two, the number of steps.
struct Rank {
    uint at;
    uint steps;
    uint highest;
    uint steps_to_highest;
};

// A point of a chain. `bulge_m` and `source` describe the line from the point to the next point of the chain.
struct ChainPoint {
    vec3 anchor;
    uint normal;
    float bulge_m;
    uint source; // kind of line << 28 | side of a triangle; corner number 3 means the whole triangle
    // 1 if the bend to the line after the next point is one of a round shape, which is drawn without a kink.
    uint ends_round;
    uint unused;
};

SHARED_CONSTANT uint no_sample = 0xffffffffU;

// State bits of a sample (a point on a line).
SHARED_CONSTANT uint sample_is_visible = 1U;
SHARED_CONSTANT uint sample_is_off_page = 2U;
SHARED_CONSTANT uint sample_is_corner = 4U;
SHARED_CONSTANT uint sample_in_ring = 8U;  // the sample belongs to a closed line without a gap
SHARED_CONSTANT uint piece_is_there = 16U; // the line continues from the sample to the next sample
// Ten bits of a sample's state say how far behind the line the next surface lies: the step in depth, in
// 1/16 mm on the page. The largest number stands for all greater steps, and for an empty background.
SHARED_CONSTANT uint sample_step_shift = 5U;
SHARED_CONSTANT uint sample_step_most = 1023U;
SHARED_CONSTANT float sample_steps_a_mm = 16.0F;
// Of lines around clumps of foliage: foliage is seen behind the line, too.
SHARED_CONSTANT uint sample_is_within = 1U << 15U;

// Surfaces that are closer on the page touch.
SHARED_CONSTANT float touching_mm = 0.25;

// A sample (a point on a chain). The samples of one chain are equally spaced.
struct LineSample {
    vec3 anchor;
    uint normal;
    vec2 page_px;
    uint source;
    // State bits of the sample, whose names begin with sample_ or piece_. The upper 16 bits are the distance
    // to the next sample in pixels, as a half float.
    uint state;
};

// Bits of Stroke::ends, which describe both ends of a stroke.
SHARED_CONSTANT uint stroke_starts_at_line = 1U;
SHARED_CONSTANT uint stroke_ends_at_line = 2U;
SHARED_CONSTANT uint stroke_is_dropped = 4U;
// A nearer line hides the rest of the line.
SHARED_CONSTANT uint stroke_starts_behind = 8U;
SHARED_CONSTANT uint stroke_ends_behind = 16U;

// Consecutive samples that are drawn as one stroke.
struct Stroke {
    uint first; // index of the first sample; `last` is the index of the last sample
    uint last;
    uint ends; // bits stroke_*
    // Index of the sample nearest to the stroke's middle that was drawn in the previous frame as well;
    // no_sample if there is none.
    uint recalled;
    int offset_sum; // sum over samples of (position along the brush - arc length), in 1/16 pixel
    uint offset_count;
    // Number of samples by which the line goes on where a nearer line cuts it, hidden or not, before the
    // start of the stroke (lower 16 bits) and after its end (upper 16 bits). A brush is laid along these
    // samples too.
    uint steps_behind;
};

// Data of a sample that is kept for the next frame.
struct DrawnSample {
    vec2 page_px;   // of the sample's anchor, not of the rounded line
    uint direction; // direction of the line on the page, as two signed half floats
    float half_width_px;
    float arc_px; // position along the brush, in pixels; the position follows the surface from frame to frame
    uint seed;
    float whole_px; // length of the brush, in pixels, with the part of it behind a nearer line
};

SHARED_CONSTANT uint no_stroke_seed = 0xffffffffU;

// Data that a sample has inherited from the sample's place in the previous frame.
struct Recall {
    // Half the line width in the previous frame; negative if the previous frame had no line at the sample.
    float half_width_px;
    float offset_px;
    uint seed; // seed of the stroke in the previous frame, or no_stroke_seed
};

struct RecallConstants {
    mat4 clip_from_anchor_before;
    uint width;
    uint height;
    uint stretches; // 1 if the picture of a brush stretches over the whole stroke
};

// A sample of a stroke with its final position, width and ink.
struct LinePoint {
    vec2 page_px;
    float half_width_px;
    uint ink; // number of the ink; see the comment of ink_of_variant
};

// Bits of LineTouch::uses. The four lower bits hold the kind of line, which selects the brush. Two flags mark
// the ends of the stroke.
SHARED_CONSTANT uint touch_use = 15U;
SHARED_CONSTANT uint touch_is_start = 16U;
SHARED_CONSTANT uint touch_is_end = 32U;

// Position of a sample along the brush. The samples are in the order of the LinePoint list.
struct LineTouch {
    // Position along the brush, in pixels; the position follows the surface from frame to frame.
    float phase_px;
    float along_px; // distance of the sample from the start of the brush, in pixels
    float whole_px; // length of the brush, in pixels, with the part of it behind a nearer line
    uint way;       // direction of the line on the page, as two signed half floats
    // The bits touch_use hold the kind of line, which selects the brush. The bits touch_is_start and
    // touch_is_end mark the ends of the stroke.
    uint uses;
};

// The length of a list, followed by the arguments of an indirect dispatch with one thread per entry of the
// list.
struct ListSize {
    uint count;
    uint groups_x;
    uint groups_y;
    uint groups_z;
};

// Number of parts into which a list is divided so that parallel workgroups can sum it. Equals the number of
// threads in a workgroup.
SHARED_CONSTANT uint scan_parts = 256U;

struct ScanConstants {
    uint fixed_count; // number of values that the CPU knows before the frame
    uint count_of;    // index of a list whose length is added to `fixed_count`, or no_list
    uint total_to;    // index of the list whose length becomes the total
    uint capacity;
    // Number of slots (entries of the list of chains) before the slots of the list `total_to`.
    uint slots_before;
    uint counts_bits; // 1: sums the number of set bits of each value; 0: sums the values
};

struct ChainConstants {
    uint triangle_count;
    uint loose_edge_count;
    // Number of triangles that may have suggestive contours or crests: either 0 or all triangles.
    uint suggestive_count;
    // Number of words of mark bits (1: a line runs through) for the page; one word has bits for 32 cells of
    // the page lattice (a grid of points on the page).
    uint page_words;
    uint feature_chain_count;
    uint feature_point_count;
    uint segment_capacity;
    uint point_capacity;
    uint sample_capacity;
    float step_px;           // approximate distance between samples, in pixels
    float most_rounding_px;  // how far a rounded line may be from the mesh's own line
    uint first_crest_vertex; // index of the first vertex of the terrain mesh that has crests
    float least_turn;        // smallest change of slope across a drawn crest
};

struct SettleConstants {
    float shortest_px;   // two corners are at least as far apart, in pixels
    float widest_gap_px; // a hidden part of a line that is shorter is drawn nevertheless
};

struct DropConstants {
    uvec2 size_px;
    float shortest_px; // length of the shortest stroke that is no scrap, in pixels
    float gap_px;      // how far before a nearer line a line stops
    float pixels_per_mm;
    float clump_px; // size of the gaps between leaves that are drawn as one clump
};

// The page lattice: a grid of points on the page, between which lines are found. See page_cells.glsl.
struct CellConstants {
    uint columns; // number of points per row of the page lattice (a grid of points on the page)
    uint rows;
    uint first_word; // index of the kind of line's first word of mark bits (1: a line runs through)
    uint word_count; // total number of words of mark bits (1: a line runs through)
    uint kind;
    float point_px;       // position of a lattice point within its pixel, equal for x and y
    float clump_px;       // size of the gaps between leaves that are drawn as one clump
    uint has_outlines;    // 1 if clumps have outlines
    uint has_marks;       // 1 if clumps have marks where the light ends
    float mark_lightness; // lightness of the tone at which the light ends
    uint first_leaf;      // number of the first triangle of surfaces that alpha cuts
};

// The bits of FoliagePoint::place that hold the depth; see foliage.glsl.
SHARED_CONSTANT uint foliage_depth_mask = 0xffffff00U;

// For the passes that find clumps of foliage on the page lattice.
struct FoliageConstants {
    uint columns;
    uint rows;
    uint reach;    // reach of a mean, in points of the lattice
    uint shrinks;  // 1 if clumps shrink, 0 if they grow
    ivec2 ring[8]; // the points of a ring, relative to the point at its middle
    ToneConstants tone;
};

// Curvature of a surface at a vertex, as in contour::Bending, in units of the object's size. The tangent of
// the curvature's coordinate frame points to the vertex `neighbor`.
struct VertexBending {
    uint neighbor;
    vec3 form;
    vec4 change;
};

struct ViewBendConstants {
    uint vertex_count;
    float least_growth;
    // Smallest sine of the angle between surface normal and view direction for which a line is drawn.
    float least_sine;
};

struct CrestConstants {
    uint first_vertex; // index of the first vertex of the mesh with crests
    uint vertex_count; // number of vertices of all meshes; the mesh with crests comes last
    uint keeps_others; // 1 if an earlier pass has already written the values of all meshes without crests
    vec2 along;        // unit vector of the direction towards which the wind blows, as (x, z)
};

struct ShapeConstants {
    // Full width of each kind of line, in metres if its bit in `metre_kinds` is set, else in pixels.
    float width_of_kind[line_kind_count];
    uint metre_kinds; // bit mask of the kinds of lines whose width is in metres
    float taper_px;
    float overshoot_px;
    float wobble_px;
    float pressure;
    float distance_thinning;
    uint seed;
    float wave_px;  // wavelength of the hand's wobble, in pixels
    float settling; // share of the brush's displacement that is corrected per frame
    float turn_px;  // radius of a bend at which the pen's pressure is greatest, in pixels
    uint hand;      // number of times that the lines have already been drawn
    float retrace_px;
    float jitter_ends_px;
    float jitter_offset_px;
    float jitter_width;
    float rank;      // how much the widths of outlines differ by what the outlines say, 0 to 1
    float lost;      // how far lines are left out in the light, 0 to 1
    float gap_px;    // how far before a nearer line a line stops
    uint brush_uses; // one bit per kind of line that has a brush other than the pen, and one for hidden lines
};

struct PartConstants {
    vec2 from_px; // corner of the drawn part of the page, in pixels of the part
    float scale;  // pixels of the part per pixel of the page on which the lines were linked
    uint has_touches;
};

// Line widths and inks of one style variant (the style with changes for certain materials or objects).
struct VariantLines {
    // Full width of each kind of line, in metres if its bit in `metre_kinds` is set, else in pixels.
    float width_of_kind[line_kind_count];
    uint metre_kinds;                  // bit mask of the kinds of lines whose width is in metres
    vec3 ink_of_kind[line_kind_count]; // linear colour of the ink of each kind of line
};

SHARED_CONSTANT uint variant_lines_words = 4U * line_kind_count + 1U;

// A LinePoint stores its ink as a 16-bit number. Number 0 is the ink of the style; number i + 1 is the
// outline ink of material i. If the bit ink_of_variant is set, the ink belongs to a kind of line in a style
// variant (the style of certain materials or objects). The bits from ink_kind_shift on then hold
// line_kind_count - 1 - kind, and the lower bits hold the number of the variant. Where lines of equal
// coverage overlap, the higher ink number is drawn, so outlines lie over creases.
SHARED_CONSTANT uint ink_of_variant = 0x8000U;
SHARED_CONSTANT uint ink_kind_shift = 11U;
SHARED_CONSTANT uint most_ink_variants = 1U << ink_kind_shift;

struct InkConstants {
    uint width;
    uint height;
    vec3 ink_color;
};

// Brushes are indexed by kind of line; brush_hidden, the last index, is the brush of hidden lines.
SHARED_CONSTANT uint brush_hidden = line_kind_count;
SHARED_CONSTANT uint brush_use_count = line_kind_count + 1U;
SHARED_CONSTANT uint brush_columns = 1024U;
SHARED_CONSTANT uint brush_rows = 32U;
SHARED_CONSTANT uint no_brush = 0xffffffffU;

struct BrushConstants {
    uint width;
    uint height;
    uvec2 grid_page_px; // size in pixels of the page that the sample grid covers
    // Length in pixels after which the brush repeats along the stroke; 0 stretches the brush over the whole
    // stroke.
    float period_px[brush_use_count];
    // Layer of each brush in the image array of brushes; no_brush draws with the pen.
    uint layer_of_use[brush_use_count];
};

#ifdef __cplusplus
static_assert(sizeof(Segment) == 48);
static_assert(sizeof(ChainPoint) == 32);
static_assert(sizeof(VertexBending) == 32);
static_assert(sizeof(LineSample) == 32);
static_assert(sizeof(Stroke) == 28);
static_assert(sizeof(DrawnSample) == 28);
static_assert(sizeof(VariantLines) == sizeof(uint) * variant_lines_words);
static_assert(sizeof(FoliageConstants) <= 128);
static_assert(sizeof(ShapeConstants) <= 128);
static_assert(sizeof(BrushConstants) <= 128);
} // namespace estampe::shared
#else

// Step in depth behind a line, in millimetres on the page. `state` is the member of a LineSample.
float depth_step_mm(uint state)
{
    return float(state >> sample_step_shift & sample_step_most) / sample_steps_a_mm;
}

// Whether a line was found between the pixels of the page and not on the mesh; such a line is certainly
// visible. `source` is the member of a Segment, ChainPoint or LineSample.
bool is_of_page(uint source)
{
    return source >> 28 >= line_first_of_page;
}

// Whether a line is the outline of a clump of foliage, or a mark on a clump.
bool is_of_foliage(uint source)
{
    return source >> 28 >= line_clump;
}
#endif

#endif
