// SPDX-License-Identifier: MIT
// One thread per texel: the horizon from the sweep's two lines next to the texel, and the share of the sun
// above the horizon.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/heightfield/height_shadow.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D height_image;

layout(scalar, binding = 1) readonly buffer Seen
{
    uint seen_step[];
};

layout(binding = 2, r16f) writeonly uniform image2D out_visibility;

layout(push_constant, scalar) uniform Constants
{
    SweepConstants sweep;
    SunConstants sun;
    float texel_m[5]; // texel size of each height field
};

// 1: the shader writes the horizon's height above the sun; 0: the sun's visibility.
layout(constant_id = 0) const uint variant = 0u;

#include "shaders/sun_disc.glsl"
#include "techniques/shadow/heightfield/height_lines.glsl"

// Slope from the line number `c` of a sweep's step up to the line's horizon; never negative.
float horizon_slope(uint step, int c)
{
    uint seen = seen_step[cell_of(step, c)];
    if (seen == height_no_step) {
        return 0.0;
    }
    int there = c - moved_across(step) + moved_across(seen);
    float rise = height_of_line(seen, there) - height_of_line(step, c);
    float way_m = float(step - seen) * sweep.step_texels * texel_m[gl_GlobalInvocationID.z];
    return max(rise / way_m, 0.0);
}

void main()
{
    uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, sweep.size))) {
        return;
    }
    uint along = sweep.steps_along_y != 0u ? texel.y : texel.x;
    int across = int(sweep.steps_along_y != 0u ? texel.x : texel.y);
    uint step = sweep.from_far_end != 0u ? step_total() - 1u - along : along;
    float slope = mix(horizon_slope(step, across + 1), horizon_slope(step, across), fraction_across(step));
    float above_rad = above_sun_rad(slope, sun.cos_elevation, sun.sin_elevation);
    float written = variant != 0u ? above_rad : share_of_disc(above_rad / sun.radius_rad);
    imageStore(out_visibility, place_of_texel(ivec2(texel)), vec4(written));
}
