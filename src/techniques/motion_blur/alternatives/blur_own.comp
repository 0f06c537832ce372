// SPDX-License-Identifier: MIT
// One thread blurs one pixel along the path of its motion. The path is followed in steps; each step has the
// direction of the motion at its position.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D wash_image;
layout(binding = 1) uniform sampler2D hatch_image;
layout(binding = 2) uniform sampler2D line_image;
layout(binding = 3) uniform sampler2D sky_ink_image;
layout(binding = 4) uniform usampler2D page_image;
layout(binding = 5, rgba16f) writeonly uniform image2D out_wash;
layout(binding = 6, r16f) writeonly uniform image2D out_hatch;
layout(binding = 7, rgba8) writeonly uniform image2D out_lines;

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_sky = (variant & blur_has_sky) != 0u;

#include "shaders/layers.glsl"
#include "shaders/layer_sample.glsl"

const int steps = 8; // number of steps in each direction along the path

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    Layers layers = layers_at(pixel);
    uvec4 own = texelFetch(page_image, pixel, 0);
    vec2 own_way = unpackHalf2x16(own.w);
    bool is_moving = own_way != vec2(0.0);
    LayerSample sum = unpack_sample(own);
    vec2 place = vec2(pixel);
    vec2 way = own_way;
    int count = is_moving ? 2 * steps : 0;
    int i = 0;
    do {
        bool turns = i == steps;
        place = turns ? vec2(pixel) : place;
        way = turns ? own_way : way;
        place += way * ((i < steps ? 1.0 : -1.0) / float(steps));
        ivec2 at = clamp(ivec2(floor(place + 0.5)), ivec2(0), ivec2(constants.size_px) - 1);
        uvec4 texel = texelFetch(page_image, at, 0);
        sum = sum_of(sum, unpack_sample(texel));
        way = unpackHalf2x16(texel.w);
        ++i;
    } while (i < count);
    vec4 wash = layers.wash;
    float hatch;
    vec4 lines;
    layers_of_sample(scaled(sum, 1.0 / float(count + 1)), layers.wash.rgb, wash.rgb, hatch, lines);
    imageStore(out_wash, pixel, is_moving ? wash : layers.wash);
    imageStore(out_hatch, pixel, vec4(is_moving ? hatch : layers.hatch));
    imageStore(out_lines, pixel, is_moving ? lines : layers.lines);
}
