// SPDX-License-Identifier: MIT
// One thread paints the clouds at one pixel over the sky, the highest layer first.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require

#include "shaders/frame.glsl.h"
#include "shaders/loops.glsl"
#include "techniques/sky/sky.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Clouds
{
    CloudGlobals clouds;
};

layout(binding = 2) uniform usamplerBuffer start_texels;
layout(binding = 3) uniform samplerBuffer puff_texels;
layout(binding = 4) uniform samplerBuffer streak_texels;
layout(binding = 5, rgba16f) uniform image2D wash_image;
layout(binding = 6, r16f) uniform image2D ink_image;
// Coverage by clouds; only with clouds_keep_cover.
layout(binding = 7, r16f) writeonly uniform image2D out_cover;

layout(binding = 9) uniform sampler2D depth_image; // reversed depth; only with clouds_have_depth

layout(push_constant, scalar) uniform Constants
{
    CloudCover over;
};

#define TILE_LIST_BINDING 8
#include "shaders/tile_list.glsl" // only with clouds_have_tiles

layout(constant_id = 0) const uint variant = 0u;
const bool have_hatching = (variant & clouds_have_hatching) != 0u;
const bool have_streaks = (variant & clouds_have_streaks) != 0u;
const bool keep_cover = (variant & clouds_keep_cover) != 0u;
const bool have_tiles = (variant & clouds_have_tiles) != 0u;
const bool have_depth = (variant & clouds_have_depth) != 0u;
const bool by_groups = (variant & clouds_by_groups) != 0u;

// Smallest upward component of a view direction in which clouds are drawn. Clouds in lower directions are too
// far away.
const float lowest_way = 0.012;

#include "techniques/sky/clouds/puffs.glsl"
#include "techniques/sky/clouds/puffs_of_group.glsl"

// Streaks (cirrus clouds): white strokes along the wind, on a horizontal plane high above the ground.

#include "shaders/lines.glsl"

// Returns where a ray hits the plane of the streaks, in cells: first along the slightly bent streaks, then
// across them.
vec2 streak_place(StreakLayer layer, vec3 d)
{
    vec2 at = layer.eye + d.xz * (layer.base_m / (max(d.y, 1e-3) * layer.cell_m));
    float turns = 2.0 / float(layer.cells); // a whole number of periods per tile, so that the tile repeats
    at.y += 0.35 * wave(at.x * turns) + 0.05 * wave(4.0 * turns * at.x + turns * at.y);
    return at;
}

float density_at(StreakLayer layer, vec2 at)
{
    int mask = int(layer.cells) - 1;
    vec2 corner = floor(at);
    ivec2 low = ivec2(corner) & mask;
    ivec2 high = (low + 1) & mask;
    int cells = int(layer.cells);
    vec2 f = at - corner;
    float near = mix(texelFetch(streak_texels, low.y * cells + low.x).x,
                     texelFetch(streak_texels, low.y * cells + high.x).x, f.x);
    float far = mix(texelFetch(streak_texels, high.y * cells + low.x).x,
                    texelFetch(streak_texels, high.y * cells + high.x).x, f.x);
    return mix(near, far, f.y);
}

// Coverage of a pixel by streaks. `right` and `down` are the view directions of the neighbouring pixels.
float streaks_along(StreakLayer layer, vec3 d, vec3 right, vec3 down)
{
    vec2 here = streak_place(layer, d);
    vec2 to_right = streak_place(layer, right) - here;
    vec2 to_down = streak_place(layer, down) - here;
    vec2 gradient = vec2(to_right.y, to_down.y);
    LineField field;
    field.v = here.y;
    field.v_per_px = length(gradient);
    vec2 along = vec2(-gradient.y, gradient.x) / max(field.v_per_px, 1e-12);
    field.u = here.x;
    field.u_per_px = abs(to_right.x * along.x + to_down.x * along.y);
    field.wander = here;
    field.wraps = false;
    float pen = layer.width_px;
    float away_m = layer.base_m / max(d.y, 1e-3);
    float dark = density_at(layer, here) * (1.0 - smoothstep(0.8, 2.5, away_m / clouds.reach_m));
    return line_ink(field, HatchLineStyle(pen, 0.6 * pen, 10.0 * pen, 90.0 * pen, 120.0 * pen, 0.6, 0.0),
                    dark, 91u);
}

#include "techniques/sky/vault.glsl"

// Rotates a world vector to the wind's axes: along the wind, up, across the wind.
vec3 in_wind(vec3 d)
{
    vec2 along = clouds.along_wind;
    return vec3(dot(d.xz, along), d.y, d.z * along.x - d.x * along.y);
}

vec3 tone_of(float shade)
{
    return shade < 0.5 ? mix(clouds.lit_color, clouds.middle_color, 2.0 * shade)
                       : mix(clouds.middle_color, clouds.shade_color, 2.0 * shade - 1.0);
}

// Whether clouds may be visible at a pixel. `d` is the view direction of the pixel.
bool may_show(ivec2 pixel, vec3 d)
{
    return frame.is_orthographic == 0u && d.y >= lowest_way &&
           !(have_depth && is_covered(depth_image, pixel, d, over.far_m));
}

// Computes the view directions at the corners of the workgroup's pixels, widened by one pixel, for
// puffs_of_group().
void share_corners(ivec2 pixel)
{
    if (gl_LocalInvocationIndex < 4u) {
        ivec2 from_px = pixel - ivec2(gl_LocalInvocationID.xy);
        uvec2 corner = uvec2(gl_LocalInvocationIndex & 1u, gl_LocalInvocationIndex >> 1);
        corner_ways[gl_LocalInvocationIndex] =
            in_wind(direction_at(vec2(from_px) - 0.5 + 9.0 * vec2(corner)));
    }
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (have_tiles) {
        pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    }
    bool is_on_page = all(lessThan(uvec2(pixel), frame.size_px)) && (!have_tiles || has_listed_tile());
    if (keep_cover && is_on_page) {
        imageStore(out_cover, pixel, vec4(0.0));
    }
    vec2 position = vec2(pixel) + 0.5;
    vec3 d = direction_at(position);
    bool is_open = is_on_page && may_show(pixel, d);
    if (by_groups) {
        share_corners(pixel);
    }
    if (by_groups ? !any_of_group(is_open) : !is_open) {
        return;
    }
    vec3 right = direction_at(position + vec2(1.0, 0.0));
    vec3 down = direction_at(position + vec2(0.0, 1.0));
    // Threads outside of the page take the nearest pixel, as they still help to find puffs.
    ivec2 under = min(pixel, ivec2(frame.size_px) - 1);
    vec3 wash = imageLoad(wash_image, under).rgb;
    float ink = imageLoad(ink_image, under).x;
    float open = 1.0;
    if (have_streaks) {
        float cover = streaks_along(clouds.streaks, in_wind(d), in_wind(right), in_wind(down));
        wash = mix(wash, clouds.lit_color, cover);
        ink *= 1.0 - cover;
        open -= cover;
    }
    vec3 in_layer = in_wind(d);
    float pixel_rad = 0.5 * (distance(d, right) + distance(d, down));
    float hatched = 0.0;
    for (int i = loop_rounds(int(clouds.puff_layer_count), pixel.x) - 1; i >= 0; --i) {
        SeenPuffs seen = by_groups ? puffs_of_group(clouds.puffs[i], in_layer, pixel_rad, is_open)
                                   : puffs_along(clouds.puffs[i], in_layer, pixel_rad);
        wash = mix(wash, tone_of(seen.shade), seen.cover);
        ink = max(ink * (1.0 - seen.cover), seen.line);
        hatched = mix(hatched, seen.shade, seen.cover);
        open *= 1.0 - seen.cover;
    }
    if (have_hatching) {
        ink = max(ink, line_ink(level_strokes(d, position), level_pen(clouds.hatch_width_px),
                                clouds.hatch_darkness * hatched, 83u));
    }
    if (!is_open) {
        return;
    }
    imageStore(wash_image, pixel, vec4(wash, 1.0));
    imageStore(ink_image, pixel, vec4(ink));
    if (keep_cover) {
        imageStore(out_cover, pixel, vec4(1.0 - open));
    }
}
