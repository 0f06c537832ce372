// SPDX-License-Identifier: MIT
// One thread handles one point of the page lattice (a grid of points on the page) and its sides to the right
// and downwards. The outline of a clump of foliage crosses a side if a clump is seen at only one end of the
// side, and a surface behind the clump at the second end. The surface behind a clump may be foliage if it is
// much farther away. Where the light ends on a clump, some leaves get a mark.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/hash.glsl"
#include "shaders/loops.glsl"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define VISIBILITY_BINDING 1
#include "shaders/visibility_texels.glsl"

#define FOLIAGE_BINDING 2

layout(binding = 3) uniform usamplerBuffer light_texels;

#define FOLIAGE_PIXELS_BINDING 4

layout(scalar, binding = 7) writeonly buffer Crossings
{
    uvec2 crossings[];
};

layout(push_constant, scalar) uniform Constants
{
    CellConstants constants;
};

#include "techniques/contour/chains/extract/foliage.glsl"
#include "techniques/contour/chains/extract/page_cells.glsl"

// The least step in depth between two clumps, as a multiple of the clumps' size on the page.
const float least_steps = 4.0;
const float mark_share = 0.5; // share of the leaves that get a mark where the light ends

bool is_on_lattice(ivec2 point)
{
    return all(lessThan(point, ivec2(constants.columns, constants.rows)));
}

vec3 anchor_of(ivec2 point, FoliagePoint seen)
{
    return anchor_at(frame, vec2(pixel_of_point(uvec2(point))) + 0.5, max(depth_of(seen), 1e-9));
}

// Whether clumps of foliage surround a point, whatever their depth.
bool is_within(ivec2 point)
{
    int reach = max(int(0.5 * constants.clump_px / float(cell_px)), 1);
    bool is_inside = true;
    for (int i = 0; i < loop_rounds(8, int(constants.columns)); ++i) {
        float angle = 0.7853981634 * float(i);
        is_inside = is_inside &&
                    is_foliage(foliage_at(point + ivec2(round(float(reach) * vec2(cos(angle), sin(angle))))));
    }
    return is_inside;
}

// Whether foliage is a clump in front of what is seen at a neighbouring point. Foliage in front of foliage
// counts only within a clump: near an outline, the depth of a surface that turns away changes as much.
bool is_before(ivec2 point, FoliagePoint leaf, ivec2 beside, FoliagePoint behind)
{
    if (!is_foliage(leaf) || leaf.place <= behind.place) {
        return false;
    }
    if (!is_foliage(behind)) {
        return true;
    }
    vec3 here = anchor_of(point, leaf);
    float step_m = distance(anchor_of(beside, behind), here);
    return step_m > least_steps * constants.clump_px * pixel_size_m(frame, here) && is_within(point);
}

// Share of the nine points around a point that show foliage in front of `limit`.
float share_before(ivec2 point, uint limit)
{
    Cells around = Cells(point - 1, point + 1);
    float sum = 0.0;
    for (ivec2 at = around.low; at.y <= around.high.y; at = next_cell(at, around)) {
        FoliagePoint seen = foliage_at(at);
        sum += is_foliage(seen) && seen.place > limit ? 1.0 : 0.0;
    }
    return sum / 9.0;
}

// Share of the 25 pixels around a point that show foliage in front of `limit`.
float share_seen_before(ivec2 point, uint limit)
{
    ivec2 last = ivec2(frame.size_px) - 1;
    ivec2 middle = pixel_of_point(uvec2(point));
    Cells around = Cells(middle - 2, middle + 2);
    float sum = 0.0;
    for (ivec2 at = around.low; at.y <= around.high.y; at = next_cell(at, around)) {
        uint place = foliage_place(clamp(at, ivec2(0), last));
        sum += (place & 1u) != 0u && place > limit ? 1.0 : 0.0;
    }
    return sum / 25.0;
}

// Where the outline of a clump crosses the side between two points. Where a leaf ends between the points, the
// outline follows the leaf. Elsewhere, it follows the clump.
float share_of_outline(ivec2 from, ivec2 to, uint limit, bool rises)
{
    float before = share_seen_before(from, limit) - 0.5;
    float after = share_seen_before(to, limit) - 0.5;
    if (before * after >= 0.0 || (after > before) != rises) {
        before = share_before(from, limit) - 0.5;
        after = share_before(to, limit) - 0.5;
    }
    return before * after < 0.0 ? before / (before - after) : 0.5;
}

// The mean lightness of the tone of the foliage around a point.
float lightness_around(ivec2 point)
{
    vec2 sum = unpackHalf2x16(texelFetch(light_texels, point.y * int(constants.columns) + point.x).x);
    return sum.x / max(sum.y, 1e-3);
}

bool has_mark(FoliagePoint leaf)
{
    uvec2 word = visibility_at(ivec2(leaf.pixel & 0xffffu, leaf.pixel >> 16));
    // The two triangles of a card usually follow each other, and have one mark.
    uint card = (max(seen_triangle(word), constants.first_leaf) - constants.first_leaf) >> 1;
    return sees_triangle(word) && unit_float(hash(card)) < mark_share;
}

uint crossing_between(ivec2 from, ivec2 to)
{
    FoliagePoint a = foliage_at(from);
    FoliagePoint b = foliage_at(to);
    if (!is_on_lattice(to) || !(is_foliage(a) || is_foliage(b))) {
        return 0u;
    }
    bool falls = is_before(from, a, to, b);
    bool rises = is_before(to, b, from, a);
    bool is_one_clump = is_foliage(a) && is_foliage(b);
    if (falls || rises) {
        uint limit = (a.place >> 1) + (b.place >> 1);
        float share = share_of_outline(from, to, limit, rises);
        uint outline =
            pack_crossing(Crossing(true, rises, false, share)) | (is_one_clump ? crossing_is_within : 0u);
        return constants.has_outlines != 0u ? outline : 0u;
    }
    bool may_end = is_one_clump && constants.has_marks != 0u;
    float before = may_end ? lightness_around(from) - constants.mark_lightness : 0.0;
    float after = may_end ? lightness_around(to) - constants.mark_lightness : 0.0;
    bool is_mark = before * after < 0.0 && has_mark(a) && is_within(from) && is_within(to);
    float share = is_mark ? before / (before - after) : 0.0;
    return is_mark ? crossing_is_mark | pack_crossing(Crossing(true, after > before, false, share)) : 0u;
}

void main()
{
    ivec2 point = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_lattice(point)) {
        return;
    }
    crossings[point.y * int(constants.columns) + point.x] =
        uvec2(crossing_between(point, point + ivec2(1, 0)), crossing_between(point, point + ivec2(0, 1)));
}
