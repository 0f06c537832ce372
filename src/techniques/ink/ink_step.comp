// SPDX-License-Identifier: MIT
// One thread a cell of ink: looks back to where its ink was a step before, lets some of that go and some dry
// into the paper, and adds what the drawing gives.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/hash.glsl"
#include "shaders/rounds.glsl"
#include "techniques/ink/flow.glsl"
#include "techniques/ink/ink.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Ink
{
    InkGlobals globals;
};

layout(binding = 1) uniform usamplerBuffer state_texels;
layout(binding = 2) uniform sampler2D source_image;
layout(binding = 3) uniform samplerBuffer stream_texels;       // on the page
layout(binding = 4) uniform sampler2D depth_image;             // of the variant on surfaces
layout(binding = 5) uniform samplerBuffer depth_before_texels; // of the same
layout(binding = 6) uniform sampler2D motion_image;            // of the variant that has motion

layout(scalar, binding = 7) buffer Sums
{
    InkSums sums;
};

layout(scalar, binding = 8) writeonly buffer State
{
    uint state[];
};

layout(scalar, binding = 9) writeonly buffer Depth
{
    float depth_now[]; // of the variant that keeps depth
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

#include "techniques/ink/carried.glsl"
#include "techniques/ink/grid.glsl"
#include "techniques/ink/look.glsl"

// x: wet, y: dry; with weights of Catmull and Rom.
vec2 ink_at(vec2 grid)
{
    vec2 at = grid - 0.5;
    ivec2 second = ivec2(floor(at));
    vec4 across = weights_within(at.x - float(second.x), second.x, int(globals.grid_size.x));
    vec4 down = weights_within(at.y - float(second.y), second.y, int(globals.grid_size.y));
    vec2 sum = vec2(0.0);
    for (int row = 0; row < 4; ++row) {
        vec2 of_row = vec2(0.0);
        for (int column = 0; column < 4; ++column) {
            of_row += across[column] * unpacked_ink(cell_at(second + ivec2(column, row) - 1));
        }
        sum += down[row] * of_row;
    }
    return clamp(sum, 0.0, 1.0);
}

// Around the eye: where ink came from, by the velocity half-way back.
vec3 direction_before(vec3 direction, int not_negative)
{
    vec3 drift = vec3(0.0);
    for (int i = 0; i < rounds(2, not_negative); ++i) {
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

// Where something was on the page of the picture before, and whether it was seen there.
struct Before {
    vec2 page_px;
    float was_seen;
};

// Reversed depth of the farthest of the four cells about a place of the picture before: an edge hides
// nothing.
float farthest_before(vec2 grid)
{
    ivec2 first = ivec2(floor(grid - 0.5));
    float farthest = 1.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 cell = clamp(first + ivec2(i & 1, i >> 1), ivec2(0), ivec2(globals.grid_size) - 1);
        farthest =
            min(farthest, texelFetch(depth_before_texels, cell.y * int(globals.grid_size.x) + cell.x).x);
    }
    return farthest;
}

Before before_at(vec2 page_px, ivec2 pixel)
{
    const float nearer = 1.02; // by this factor, and it is another thing
    vec2 page = vec2(globals.page_px);
    float depth = is_on_surface ? texelFetch(depth_image, pixel, 0).x : globals.plane_depth;
    vec4 clip = globals.before_from_clip * vec4(2.0 * page_px / page - 1.0, depth, 1.0);
    vec2 before_px = (0.5 * clip.xy / clip.w + 0.5) * page;
    float depth_before = clip.z / clip.w;
    bool was_seen = clip.w > 0.0;
    if (has_motion) {
        vec4 motion = texelFetch(motion_image, pixel, 0);
        float share = motion.w > 0.0 ? globals.drag : 0.0;
        before_px = mix(before_px, page_px - motion.xy, share);
        depth_before = mix(depth_before, motion.z, share);
    }
    if (is_on_surface) {
        was_seen = was_seen && farthest_before(grid_place_of_page(before_px)) <= nearer * depth_before + 1e-9;
    }
    return Before(before_px, was_seen ? 1.0 : 0.0);
}

// How much of what it can give a spot gives at a place. There is one in each square of the spacing; it swells
// and dies down, and then there is another.
float spot_at(vec2 place_mm, float share_that_gives)
{
    vec2 square = floor(place_mm / globals.spacing_mm);
    uint id = hash(uint(int(square.x)), uint(int(square.y)), globals.seed);
    float lives = step.spot_share + unit_float(id);
    uint life = step.spot_round + uint(lives);
    uint own = hash(id ^ hash(life));
    float radius = globals.spot_mm * (0.5 + 0.5 * unit_float(hash(own ^ 3u)));
    vec2 middle =
        vec2(unit_float(hash(own ^ 1u)), unit_float(hash(own ^ 2u))) * (globals.spacing_mm - 2.0 * radius);
    vec2 away = place_mm - square * globals.spacing_mm - radius - middle;
    float swell = fract(lives);
    float gives = smoothstep(0.0, 0.1, 1.1 * share_that_gives - unit_float(hash(own ^ 4u)));
    return clamp(1.0 - dot(away, away) / (radius * radius), 0.0, 1.0) *
           min(1.0, 5.0 * min(swell, 1.0 - swell)) * gives;
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
    vec2 spot_mm;
    if (is_around) {
        vec3 direction = direction_of_cell(cell);
        before = vec2(ink_at(grid_place_of_direction(direction_before(direction, cell.x))).x,
                      dry_ink(cell_at(cell)));
        spot_mm = grid_place_of_direction(direction) * globals.mm_per_cell;
    } else {
        vec2 page_px = page_place_of_grid(grid);
        spot_mm = page_px * (globals.mm_per_cell * globals.cells_per_px);
        vec2 drift_cells = carried_cells(grid, step.seconds);
        if (is_moved) {
            ivec2 pixel = clamp(ivec2(floor(page_px)), ivec2(0), ivec2(globals.page_px) - 1);
            Before was = before_at(page_px, pixel);
            vec2 from = grid_place_of_page(was.page_px);
            before = was.was_seen * vec2(ink_at(from - drift_cells).x, ink_at(from).y);
        } else {
            before = vec2(ink_at(grid - drift_cells).x, dry_ink(cell_at(cell)));
        }
        if (keeps_depth) {
            ivec2 pixel = clamp(ivec2(floor(page_px)), ivec2(0), ivec2(globals.page_px) - 1);
            depth_now[place] = texelFetch(depth_image, pixel, 0).x;
        }
    }
    before *= step.keeps;
    float source = texelFetch(source_image, cell, 0).x;
    float spot = 0.0;
    for (int i = 0; i < rounds(source > 0.0 ? 1 : 0, cell.x); ++i) { // spares most of the page the hashes
        float room = 2.0 - 2.0 * mean_cover(sums.covered[step.sum_before]) / globals.budget;
        spot = spot_at(spot_mm, clamp(room, 0.0, 1.0));
    }
    float given = step.given * source * spot;
    float wet = 1.0 - (1.0 - before.x * step.left) * (1.0 - given);
    float dry = 1.0 - (1.0 - before.y * step.stain_left) * (1.0 - before.x * step.soak);
    state[place] = packed_ink(vec2(wet, dry));
    if (place == 0 && step.sum_now < 2u) {
        sums.covered[step.sum_now] = 0u;
    }
}
