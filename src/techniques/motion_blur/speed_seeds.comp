// SPDX-License-Identifier: MIT
// One thread searches one cell of the page for a place on the trailing edge of a fast body. A speed line
// begins at that place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/hash.glsl"
#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D page_image;
layout(binding = 1) uniform sampler2D owner_depth_image;
layout(binding = 2,
       rgba32f) writeonly uniform image2D out_seed; // start and vector of the cell's speed line; 0: no line

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

const int tries = 24;

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = ivec2(constants.size_px) - 1;
    if (any(greaterThan(vec2(cell) * constants.cell_px, vec2(last)))) {
        return;
    }
    vec4 seed = vec4(0.0);
    uint random = hash(uint(cell.x) + 0x9e37u * hash(uint(cell.y) + 0x85ebu * constants.seed));
    for (int i = 0; i < tries; ++i) {
        uint own = hash(random + uint(i));
        vec2 part = vec2(own & 0xffffu, own >> 16) / 65536.0;
        ivec2 at = clamp(ivec2((vec2(cell) + part) * constants.cell_px), ivec2(0), last);
        vec2 way = unpackHalf2x16(texelFetch(page_image, at, 0).w);
        float length_px = sqrt(dot(way, way));
        // Just behind the body's trailing edge, the page must show a farther surface that does not move with
        // the body.
        vec2 back = -way / max(length_px, 1e-6);
        ivec2 left = clamp(ivec2(floor(vec2(at) + 3.0 * back + 0.5)), ivec2(0), last);
        vec2 left_way = unpackHalf2x16(texelFetch(page_image, left, 0).w);
        bool is_edge =
            texelFetch(owner_depth_image, left, 0).x < 0.98 * texelFetch(owner_depth_image, at, 0).x &&
            dot(left_way, way) < 0.5 * dot(way, way);
        float line_px = min(length_px * constants.line_length, constants.line_most_px);
        float uneven = 0.5 + float(hash(own) & 0xffffu) / 65536.0;
        bool is_kept = seed.zw == vec2(0.0) && is_edge && length_px > constants.line_from_px;
        seed = is_kept ? vec4(vec2(at) + 0.5 + 3.0 * back, back * line_px * uneven) : seed;
    }
    imageStore(out_seed, cell, seed);
}
