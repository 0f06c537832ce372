// SPDX-License-Identifier: MIT
// One thread packs the layers of one pixel, and the pixel's displacement in half the exposure, into one
// texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D depth_image;
layout(binding = 1) uniform sampler2D motion_image;
layout(binding = 2) uniform sampler2D wash_image;
layout(binding = 3) uniform sampler2D hatch_image;
layout(binding = 4) uniform sampler2D line_image;
layout(binding = 5) uniform sampler2D sky_ink_image;
// Motion of the surfaces before shapes are stretched; read only in the style's mode `stretched`.
layout(binding = 6) uniform sampler2D own_motion_image;
layout(binding = 7, rgba32ui) writeonly uniform uimage2D out_texel;
// Depth of the visible surface. At a pixel of a contour line, depth of the surface to which the line belongs.
layout(binding = 8, r32f) writeonly uniform image2D out_depth;
layout(binding = 9, r16f) writeonly uniform image2D out_hatch; // hatching, including the sky's strokes

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_sky = (variant & blur_has_sky) != 0u;
const bool is_stretched = (variant & blur_is_stretched) != 0u;
const bool lays_sky = (variant & blur_lays_sky) != 0u;

#include "shaders/layers.glsl"
#include "shaders/line_owner.glsl"
#include "shaders/layer_sample.glsl"

vec2 half_way(vec4 motion)
{
    vec2 way = motion.w > 0.0 ? constants.scale * motion.xy : vec2(0.0);
    float length_px = sqrt(dot(way, way));
    way *= min(constants.most_px / max(length_px, 1e-6), 1.0);
    return length_px < blur_still_px ? vec2(0.0) : way;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    Layers layers = layers_at(pixel);
    LineOwner owner = owner_of(pixel, layers.lines.a, constants.line_reach_px, ivec2(constants.size_px) - 1);
    vec2 way = half_way(texelFetch(motion_image, owner.pixel, 0));
    if (is_stretched && way == vec2(0.0)) {
        // The displaced, stretched shape may not cover a pixel of the moving surface. An uncovered pixel of
        // the moving surface is blurred by the surface's own motion, because the pixel would stay sharp
        // otherwise.
        way = half_way(texelFetch(own_motion_image, owner.pixel, 0));
    }
    imageStore(out_texel, pixel,
               pack_sample(sample_of_layers(layers.wash.rgb, layers.hatch, layers.lines), packHalf2x16(way)));
    imageStore(out_depth, pixel, vec4(owner.depth));
    if (lays_sky) {
        imageStore(out_hatch, pixel, vec4(layers.hatch));
    }
}
