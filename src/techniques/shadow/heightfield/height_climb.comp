// SPDX-License-Identifier: MIT
// One thread handles one texel: it walks towards the sun from cell to cell of the pyramid (grids of maximum
// heights). Skips cells that cannot raise the horizon, and stops where the horizon no longer affects the sun.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/heightfield/height_shadow.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D height_image;
layout(binding = 1) uniform sampler2D greatest_image;
layout(binding = 2, r16f) writeonly uniform image2D out_visibility;

layout(push_constant, scalar) uniform Constants
{
    PyramidConstants pyramid;
};

// 1: the shader writes the horizon's height above the sun; 0: the sun's visibility.
layout(constant_id = 0) const uint variant = 0u;

#include "shaders/sun_disc.glsl"
#include "techniques/shadow/heightfield/height_pyramid.glsl"

// Height of the ground, interpolated between four texels; `place` is in texels.
float height_at(vec2 place)
{
    ivec2 cell = clamp(ivec2(floor(place)), ivec2(0), ivec2(pyramid.cells) - 1);
    vec2 share = clamp(place - vec2(cell), 0.0, 1.0);
    ivec2 corner = place_of_texel(cell);
    return mix(mix(texelFetch(height_image, corner, 0).x, texelFetch(height_image, corner + ivec2(1, 0), 0).x,
                   share.x),
               mix(texelFetch(height_image, corner + ivec2(0, 1), 0).x,
                   texelFetch(height_image, corner + ivec2(1, 1), 0).x, share.x),
               share.y);
}

float horizon_slope(ivec2 texel)
{
    const float past_the_edge = 1e-3; // small distance in texels that leads into the next cell
    float texel_m = pyramid.texel_m[gl_GlobalInvocationID.z];
    float from_m = texelFetch(height_image, place_of_texel(texel), 0).x;
    float best = pyramid.slopes.x;
    float along = 0.0;
    uint level = 0u;
    // The loop's bound is larger than the number of steps of the longest walk over the largest field.
    for (uint i = 0u; i < 60000u && best < pyramid.slopes.y; ++i) {
        vec2 place = vec2(texel) + (along + past_the_edge) * pyramid.sunwards;
        ivec2 cell = ivec2(floor(place / float(1u << level)));
        if (any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(cell, cells_of_level(level)))) {
            break;
        }
        vec2 wall = vec2(cell + ivec2(greaterThan(pyramid.sunwards, vec2(0.0)))) * float(1u << level);
        vec2 ways = mix(vec2(1e9), (wall - vec2(texel)) / pyramid.sunwards,
                        greaterThan(abs(pyramid.sunwards), vec2(1e-6)));
        float leaves = max(min(ways.x, ways.y), along + past_the_edge);
        float rise = texelFetch(greatest_image, place_of_cell(cell, level), 0).x - from_m;
        bool can_raise = rise > best * texel_m * along;
        if (can_raise && level > 0u) {
            --level;
            continue;
        }
        if (can_raise) {
            float there = height_at(vec2(texel) + leaves * pyramid.sunwards);
            best = max(best, (there - from_m) / (leaves * texel_m));
        } else {
            level = min(level + 1u, pyramid.level);
        }
        along = leaves;
    }
    return best;
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(texel, ivec2(pyramid.cells))) ||
        !is_within(pyramid.wanted, gl_GlobalInvocationID.z, uvec2(texel))) {
        return;
    }
    float above_rad =
        above_sun_rad(horizon_slope(texel), pyramid.sun.cos_elevation, pyramid.sun.sin_elevation);
    float written = variant != 0u ? above_rad : share_of_disc(above_rad / pyramid.sun.radius_rad);
    imageStore(out_visibility, place_of_texel(texel), vec4(written));
}
