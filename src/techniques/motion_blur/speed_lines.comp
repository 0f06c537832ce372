// SPDX-License-Identifier: MIT
// One thread draws the speed lines that cover one pixel. The body from which a line starts hides the line.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D listed_image;
layout(binding = 1) uniform usampler2D page_image;
layout(binding = 2, rgba8) uniform image2D line_image;

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

float line_cover(vec2 from, vec2 way, vec2 place)
{
    float length_px = max(sqrt(dot(way, way)), 1e-6);
    vec2 forward = way / length_px;
    float along = dot(place - from, forward) / length_px;
    float aside_px = abs(forward.x * (place.y - from.y) - forward.y * (place.x - from.x));
    // A speed line swells soon after its start and then tapers, like a quick pen stroke.
    float half_px = constants.line_half_px * smoothstep(0.0, 0.12, along) * (1.0 - along);
    float cover = clamp(max(half_px, 0.5) + 0.5 - aside_px, 0.0, 1.0) * min(half_px / 0.5, 1.0);
    return along > 0.0 && along < 1.0 ? cover : 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    ivec2 tile = pixel / int(blur_tile_px);
    vec2 own_way = unpackHalf2x16(texelFetch(page_image, pixel, 0).w);
    float cover = 0.0;
    for (int i = 0; i < int(most_speed_lines); ++i) {
        vec4 line = texelFetch(listed_image, ivec2(tile.x * int(most_speed_lines) + i, tile.y), 0);
        bool is_own = dot(own_way, -line.zw) > 0.5 * constants.line_from_px * sqrt(dot(line.zw, line.zw));
        float inked = line.zw == vec2(0.0) || is_own ? 0.0 : line_cover(line.xy, line.zw, vec2(pixel) + 0.5);
        cover = max(cover, inked);
    }
    vec4 before = imageLoad(line_image, pixel);
    if (cover > before.a) {
        imageStore(line_image, pixel, vec4(sqrt(constants.line_ink), cover));
    }
}
