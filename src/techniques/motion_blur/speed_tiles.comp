// SPDX-License-Identifier: MIT
// One thread lists the speed lines that may touch one tile of the page, in the order of the lines' cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D seed_image;
// Speed lines that touch each tile of the page: one row of most_speed_lines entries per tile. An unused entry
// is 0.
layout(binding = 1, rgba32f) writeonly uniform image2D out_line;

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 count = ivec2((constants.size_px + blur_tile_px - 1u) / blur_tile_px);
    if (any(greaterThanEqual(tile, count))) {
        return;
    }
    float half_tile_px = 0.5 * float(blur_tile_px);
    vec2 middle = (vec2(tile) + 0.5) * float(blur_tile_px);
    float within_px = 1.5 * half_tile_px + constants.line_half_px + 1.0;
    float reach_px = within_px + 1.5 * constants.line_most_px;
    ivec2 cells = textureSize(seed_image, 0);
    ivec2 first = clamp(ivec2(floor((middle - reach_px) / constants.cell_px)), ivec2(0), cells - 1);
    ivec2 last = clamp(ivec2(floor((middle + reach_px) / constants.cell_px)), ivec2(0), cells - 1);
    ivec2 span = last - first + 1;
    int listed = 0;
    for (int i = 0; i < span.x * span.y; ++i) {
        vec4 seed = texelFetch(seed_image, first + ivec2(i % span.x, i / span.x), 0);
        float along = clamp(dot(middle - seed.xy, seed.zw) / max(dot(seed.zw, seed.zw), 1e-6), 0.0, 1.0);
        vec2 off = middle - seed.xy - along * seed.zw;
        bool passes = seed.zw != vec2(0.0) && dot(off, off) < within_px * within_px;
        if (passes && listed < int(most_speed_lines)) {
            imageStore(out_line, ivec2(tile.x * int(most_speed_lines) + listed, tile.y), seed);
            ++listed;
        }
    }
    for (int i = listed; i < int(most_speed_lines); ++i) {
        imageStore(out_line, ivec2(tile.x * int(most_speed_lines) + i, tile.y), vec4(0.0));
    }
}
