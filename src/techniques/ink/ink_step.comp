// SPDX-License-Identifier: MIT
// One thread per cell of ink: traces the ink back to the place one step before. Some of the ink fades, some
// dries into the paper, and the sources add ink.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/ink/flow/flow.glsl"
#include "techniques/ink/ink.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Ink
{
    InkGlobals globals;
};

layout(binding = 1) uniform usamplerBuffer state_texels;
// Cells of ink like state_texels, with four cells per texel.
layout(binding = 2) uniform usamplerBuffer fours_of_state;
layout(binding = 3) uniform usamplerBuffer corner_texels; // ink that the drawing gives, see ink_corners.comp
layout(binding = 4) uniform samplerBuffer stream_texels;  // stream function at nodes, for ink on the page
// Depths of surfaces, for ink_on_surface and ink_keeps_depth.
layout(binding = 5) uniform sampler2D depth_image;
// Depths of surfaces in the last picture, for ink_on_surface.
layout(binding = 6) uniform samplerBuffer depth_before_texels;
layout(binding = 7) uniform sampler2D motion_image; // motion of surfaces, for ink_has_motion

layout(scalar, binding = 8) buffer Sums
{
    InkSums sums;
};

layout(scalar, binding = 9) writeonly buffer State
{
    uint state[];
};

layout(scalar, binding = 10) writeonly buffer Depth
{
    float depth_now[]; // depths that the next picture will use, for ink_keeps_depth
};

layout(push_constant, scalar) uniform Constants
{
    InkStep step;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_around = (variant & ink_is_around) != 0u;
const bool is_moved = (variant & ink_is_moved) != 0u;
const bool is_on_surface = (variant & ink_on_surface) != 0u;
const bool has_motion = (variant & ink_has_motion) != 0u;
const bool keeps_depth = (variant & ink_keeps_depth) != 0u;
const bool has_blasts = (variant & ink_has_blasts) != 0u;

#include "techniques/ink/flow/carried.glsl"
#include "techniques/ink/front.glsl"
#include "techniques/ink/grid.glsl"
#include "techniques/ink/cover.glsl"

// Interpolation weights of nine cells in a row. Six of the nine weights, from index `past` (0 to 3) on, are
// not zero.
struct NineWeights {
    vec4 first;
    vec4 next;
    float last;
};

NineWeights moved(Weights weights, int past)
{
    vec4 first = vec4(weights.first, weights.last.x);
    vec4 next = vec4(weights.last.yz, 0.0, 0.0);
    bool is_odd = (past & 1) != 0;
    next = is_odd ? vec4(first.w, next.xyz) : next;
    first = is_odd ? vec4(0.0, first.xyz) : first;
    bool is_two = (past & 2) != 0;
    return NineWeights(is_two ? vec4(0.0, 0.0, first.xy) : first, is_two ? vec4(first.zw, next.xy) : next,
                       is_two ? next.z : 0.0);
}

// Ink at a place of the grid: wet ink in x, dry ink in y. Cells are read four at a time in a row; cells of
// weight 0 may belong to another row.
vec2 ink_at(vec2 grid)
{
    vec2 at = grid - 0.5;
    ivec2 third = ivec2(floor(at));
    ivec2 size = ivec2(globals.grid_size);
    int past = (third.x - 2) & 3;
    int four = (third.x - 2) >> 2;
    NineWeights across = moved(weights_of(at.x - float(third.x), third.x, size.x), past);
    Weights down = weights_of(at.y - float(third.y), third.y, size.y);
    int last_four = size.y * (size.x >> 2) - 1;
    vec2 sum = vec2(0.0);
    for (int row = 0; row < 6; ++row) {
        int place = clamp(third.y + row - 2, 0, size.y - 1) * (size.x >> 2) + four;
        uvec4 first = texelFetch(fours_of_state, clamp(place, 0, last_four));
        uvec4 next = texelFetch(fours_of_state, clamp(place + 1, 0, last_four));
        uint last = texelFetch(state_texels, 4 * clamp(place + 2, 0, last_four)).x;
        vec2 of_row = across.first.x * unpacked_ink(first.x);
        of_row += across.first.y * unpacked_ink(first.y);
        of_row += across.first.z * unpacked_ink(first.z);
        of_row += across.first.w * unpacked_ink(first.w);
        of_row += across.next.x * unpacked_ink(next.x);
        of_row += across.next.y * unpacked_ink(next.y);
        of_row += across.next.z * unpacked_ink(next.z);
        of_row += across.next.w * unpacked_ink(next.w);
        of_row += across.last * unpacked_ink(last);
        sum += (row < 3 ? down.first[row] : down.last[row - 3]) * of_row;
    }
    return clamp(sum, 0.0, 1.0);
}

// For ink in a cube around the eye: the direction from which ink flows to `direction` in a step. It is
// computed with the velocity half-way back.
vec3 direction_before(vec3 direction, int not_negative)
{
    vec3 drift = vec3(0.0);
    for (int i = 0; i < loop_rounds(2, not_negative); ++i) {
        vec3 middle = normalize(direction - 0.5 * drift);
        vec3 gradient = vec3(0.0);
        for (int wave = 0; wave < int(ink_wave_count); ++wave) {
            gradient += wave_gradient(globals.waves[wave].wave, globals.waves[wave].amplitude,
                                      step.phases[wave], middle);
        }
        drift = step.seconds * (cross(middle, gradient) + cross(globals.wind_axis, middle));
    }
    return normalize(direction - drift);
}

// Position of a visible point in the last picture.
struct Before {
    vec2 page_px;
    float depth; // reversed depth in the last picture; negative behind the eye
};

Before own_before(vec2 page_px)
{
    vec2 page = vec2(globals.page_px);
    float depth = is_on_surface ? texelFetch(depth_image, pixel_at(page_px), 0).x : globals.plane_depth;
    vec4 clip = globals.before_from_clip * vec4(2.0 * page_px / page - 1.0, depth, 1.0);
    vec2 before_px = (0.5 * clip.xy / clip.w + 0.5) * page;
    float depth_before = clip.w > 0.0 ? clip.z / clip.w : -1.0;
    if (has_motion) {
        vec4 motion = texelFetch(motion_image, pixel_at(page_px), 0);
        float share = motion.w > 0.0 ? globals.drag : 0.0;
        before_px = mix(before_px, page_px - motion.xy, share);
        depth_before = mix(depth_before, motion.z, share);
    }
    return Before(before_px, depth_before);
}

// Position of a place in the last picture. Ink next to an object moves with the object, less so with
// distance; otherwise the ink would tear where the background moves differently.
Before before_at(vec2 page_px)
{
    const float halo_mm = 5.0;
    const int rings = 4;
    Before before = own_before(page_px);
    float share = 0.0;
    for (int ring = 0; is_on_surface && ring < rings && share == 0.0; ++ring) {
        float away_px = max(line_reach_px(), halo_mm * globals.px_per_mm * float(ring) / float(rings - 1));
        vec2 front_px = front_place(page_px, away_px);
        if (front_px != page_px) {
            Before of_front = own_before(front_px);
            share = 1.0 - float(ring) / float(rings);
            before.page_px = mix(before.page_px, page_px + of_front.page_px - front_px, share);
            before.depth = max(before.depth, of_front.depth);
        }
    }
    return before;
}

float depth_before(vec2 grid)
{
    ivec2 cell = clamp(ivec2(floor(grid)), ivec2(0), ivec2(globals.grid_size) - 1);
    return texelFetch(depth_before_texels, cell.y * int(globals.grid_size.x) + cell.x).x;
}

float was_seen(Before before)
{
    bool is_hidden =
        is_on_surface && depth_before(grid_place_of_page(before.page_px)) > is_nearer * before.depth + 1e-9;
    return before.depth < 0.0 || is_hidden ? 0.0 : 1.0;
}

// A position in units of cells, counted from the middle of the first cell, and clamped to the middles of the
// outermost cells.
vec2 place_between(vec2 grid)
{
    return clamp(grid - 0.5, vec2(0.0), vec2(globals.grid_size) - 1.0);
}

// The word of ink_corners.comp for the four cells around a position.
uint corners_at(vec2 grid)
{
    ivec2 cell = ivec2(place_between(grid));
    return texelFetch(corner_texels, cell.y * int(globals.grid_size.x) + cell.x).x;
}

// Ink that the drawing gives at a position, interpolated between the four cells of `word`. When the covered
// area nears its budget, fewer spots give ink, each spot at full strength.
float given_at(vec2 grid, uint word, float room)
{
    vec2 share = fract(place_between(grid));
    uvec4 corners =
        uvec4(word, word >> ink_corner_bits, word >> 2u * ink_corner_bits, word >> 3u * ink_corner_bits);
    vec4 given = vec4(corners & ink_corner_most) / float(ink_corner_most);
    vec2 rows = mix(given.xz, given.yw, share.x);
    float rank = float(word >> ink_rank_shift) / 255.0;
    return mix(rows.x, rows.y, share.y) * smoothstep(0.0, 0.1, 1.1 * room - rank);
}

// Average ink given along the ink's path in the step, which ends at the place `grid`. Because of the average,
// a spot gives a thread and not a row of beads. Between cells, the given ink is interpolated: a thin source
// would otherwise give a staircase of cells, which the flow draws out into rungs.
float given_along(vec2 grid, vec2 path)
{
    // Stops at most half a cell apart. They are taken in fours, whose reads do not wait for each other.
    int fours = int(clamp(ceil(0.5 * length(path)), 1.0, 4.0));
    float room = clamp(2.0 - 2.0 * mean_cover(sums.covered[step.sum_before]) / globals.budget, 0.0, 1.0);
    vec2 to_next = path / float(4 * fours);
    float given = 0.0;
    for (int four = 0; four < fours; ++four) {
        vec2 from = grid - float(4 * four) * to_next;
        uvec4 words = uvec4(corners_at(from), corners_at(from - to_next), corners_at(from - 2.0 * to_next),
                            corners_at(from - 3.0 * to_next));
        // Most places of a page give nothing.
        if (((words.x | words.y | words.z | words.w) & ((1u << ink_rank_shift) - 1u)) != 0u) {
            given += given_at(from, words.x, room) + given_at(from - to_next, words.y, room) +
                     given_at(from - 2.0 * to_next, words.z, room) +
                     given_at(from - 3.0 * to_next, words.w, room);
        }
    }
    return step.given * given / float(4 * fours);
}

// Displacement, in cells, of the ink that arrives at a place of the page, by all blasts.
vec2 swept_cells(vec2 place_mm)
{
    vec2 moved_mm = vec2(0.0);
    for (uint i = 0u; i < globals.blast_count; ++i) {
        moved_mm += swept_mm(place_mm - globals.blasts_mm[i], step.blast_cubes_mm3[i]);
    }
    return moved_mm / globals.mm_per_cell;
}

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(cell), globals.grid_size))) {
        return;
    }
    int place = cell.y * int(globals.grid_size.x) + cell.x;
    vec2 grid = vec2(cell) + 0.5;
    vec2 before;
    float given;
    if (is_around) {
        vec3 direction = direction_of_cell(cell);
        vec2 from = grid_place_of_direction(direction_before(direction, cell.x));
        before = vec2(ink_at(from).x, dry_ink(cell_at(cell)));
        vec2 drift = grid_place_of_direction(direction) - from;
        bool is_on_one_face = all(lessThan(abs(drift), vec2(float(globals.face_side) * 0.5)));
        given = given_along(from + drift, is_on_one_face ? drift : vec2(0.0));
    } else {
        vec2 page_px = page_place_of_grid(grid);
        vec2 drift = carried_cells(grid, step.seconds);
        if (has_blasts) {
            drift += swept_cells(page_px / globals.px_per_mm);
        }
        if (is_moved) {
            Before was = before_at(page_px);
            vec2 from = grid_place_of_page(was.page_px);
            given = given_along(grid, drift);
            before = was_seen(was) * vec2(ink_at(from - drift).x, ink_at(from).y);
        } else {
            given = given_along(grid, drift);
            before = vec2(ink_at(grid - drift).x, dry_ink(cell_at(cell)));
        }
        if (keeps_depth) {
            depth_now[place] = texelFetch(depth_image, pixel_at(page_px), 0).x;
        }
    }
    before *= step.keeps;
    float wet = 1.0 - (1.0 - before.x * step.left) * (1.0 - given);
    float dry = 1.0 - (1.0 - before.y * step.stain_left) * (1.0 - before.x * step.soak);
    state[place] = packed_ink(vec2(wet, dry));
    if (place == 0 && step.sum_now < 2u) {
        sums.covered[step.sum_now] = 0u;
    }
}
