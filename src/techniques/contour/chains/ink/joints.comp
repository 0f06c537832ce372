// SPDX-License-Identifier: MIT
// One thread fills the outer side of the corner at one sample, up to the point where the edges of the lines
// before and after the sample cross. The two lines belong to one stroke, or to two strokes that end at one
// place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define SAMPLES_BINDING 1
#define STROKES_BEFORE_BINDING 2
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 3) readonly buffer Strokes
{
    Stroke strokes[];
};

layout(scalar, binding = 4) readonly buffer LinePoints
{
    LinePoint line_points[];
};

layout(scalar, binding = 5) readonly buffer LineTouches
{
    LineTouch touches[];
};

#define GRID_BINDING 6
#define GRID_ACCESS readonly
#include "techniques/contour/chains/stroke/sample_grid.glsl"

layout(scalar, binding = 7) buffer Inked
{
    uint inked[]; // one word per pixel: coverage in the upper 16 bits, number of the ink in the lower 16 bits
};

#define INK_TILES_BINDING 8
#define INK_TILES_ACCESS
#include "techniques/contour/chains/ink/ink_tiles.glsl"

layout(push_constant, scalar) uniform Constants
{
    BrushConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_brushes = (variant & joints_has_brushes) != 0u;

#include "techniques/contour/chains/ink/inked_pieces.glsl"

const float one_place_px = 1.5;
// Sine of half the angle below which a corner stays round and is not mitred.
const float least_half_angle_sine = 0.25;
// Corners that bend by less than ten degrees count as straight and are not filled.
const float straight_cosine = -0.985;

// The end of a line: the end's position, and the direction that points out of the line.
struct End {
    LinePoint point;
    vec2 out_way;
    bool is_pen;
};

bool is_drawn_by_pen(uint i)
{
    return !has_brushes || constants.layer_of_use[touches[i].uses & touch_use] == no_brush;
}

End end_of_piece(uint at, uint before)
{
    vec2 way = line_points[at].page_px - line_points[before].page_px;
    return End(line_points[at], length(way) > 0.0 ? normalize(way) : vec2(0.0), is_drawn_by_pen(at));
}

End start_of_stroke(Stroke stroke)
{
    return end_of_piece(2u * stroke.first, 2u * stroke.first + 3u);
}

End end_of_stroke(Stroke stroke)
{
    return end_of_piece(2u * stroke.last + 1u, 2u * stroke.last - 2u);
}

// The two lines nearest to a line's end, to the left and to the right, as angles counter-clockwise from the
// line.
struct Around {
    End left;
    End right;
    float left_rad;
    float right_rad;
};

void look_at(End other, End own, inout Around around)
{
    if (distance(other.point.page_px, own.point.page_px) < one_place_px && other.point.half_width_px > 0.0) {
        float angle = atan(own.out_way.x * other.out_way.y - own.out_way.y * other.out_way.x,
                           dot(own.out_way, other.out_way));
        if (angle > around.left_rad) {
            around.left = other;
            around.left_rad = angle;
        }
        if (angle < around.right_rad) {
            around.right = other;
            around.right_rad = angle;
        }
    }
}

// Several strokes may end at the place of `end`. Finds the stroke end that, together with `end`, encloses all
// ends at that place. Finds none if lines leave in all directions.
End partner_of(End end, vec2 sample_px, uint own)
{
    uvec2 size_px = constants.grid_page_px;
    End none = End(LinePoint(vec2(0.0), 0.0, 0u), vec2(0.0), false);
    Around around = Around(none, none, 0.0, 0.0);
    Cells cells = cells_around(sample_px, size_px);
    for (ivec2 cell = cells.low; cell.y <= cells.high.y; cell = next_cell(cell, cells)) {
        uvec2 found = grid[cell_index(cell, size_px)];
        for (int k = 0; k < 2 && found.y != 0u; ++k) {
            uint other = strokes_before(k == 0 ? found.x + 1u : found.y);
            if (other - 1u != own) {
                look_at(start_of_stroke(strokes[other - 1u]), end, around);
                look_at(end_of_stroke(strokes[other - 1u]), end, around);
            }
        }
    }
    if (around.left_rad > 0.0 && around.right_rad < 0.0) {
        return none;
    }
    return around.left_rad > 0.0 ? around.left : around.right;
}

float band(vec2 pixel, End end)
{
    vec2 off = pixel - end.point.page_px;
    float across = abs(off.x * end.out_way.y - off.y * end.out_way.x);
    return dot(off, end.out_way) > 0.0 ? coverage(end.point.half_width_px, across) : 0.0;
}

void fill_corner(End a, End b)
{
    float half_angle_sine = sqrt(max(0.5 - 0.5 * dot(a.out_way, b.out_way), 0.0));
    float widest = min(max(a.point.half_width_px, b.point.half_width_px), widest_px);
    if (half_angle_sine < least_half_angle_sine || dot(a.out_way, b.out_way) < straight_cosine ||
        min(a.point.half_width_px, b.point.half_width_px) < 0.5 || !a.is_pen || !b.is_pen) {
        return;
    }
    float reach = widest / half_angle_sine + 1.0;
    vec2 size = vec2(constants.width, constants.height);
    ivec2 low = ivec2(clamp(floor(a.point.page_px - reach), vec2(0.0), size));
    ivec2 high = ivec2(clamp(ceil(a.point.page_px + reach), vec2(0.0), size));
    list_tiles(low, high);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            vec2 pixel = vec2(x, y) + 0.5;
            float ink = min(band(pixel, a), band(pixel, b));
            if (ink > 0.0) {
                uint word = uint(65535.0 * ink + 0.5) << 16 | min(a.point.ink, 0xffffu);
                atomicMax(inked[uint(y) * constants.width + uint(x)], word);
            }
        }
    }
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count) {
        return;
    }
    bool goes_on = (sample_at(index).state & piece_is_there) != 0u;
    bool was_on = index > 0u && (sample_at(index - 1u).state & piece_is_there) != 0u;
    if (goes_on && was_on) {
        fill_corner(end_of_piece(2u * index + 1u, 2u * index - 2u),
                    end_of_piece(2u * index, 2u * index + 3u));
    } else if (goes_on || was_on) {
        uint own = strokes_before(goes_on ? index + 1u : index) - 1u;
        End end = goes_on ? start_of_stroke(strokes[own]) : end_of_stroke(strokes[own]);
        if (end.point.half_width_px > 0.5) {
            fill_corner(end, partner_of(end, sample_at(index).page_px, own));
        }
    }
}
