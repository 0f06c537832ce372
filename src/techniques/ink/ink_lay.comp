// SPDX-License-Identifier: MIT
// One thread per pixel: the colour and the coverage of the ink.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "techniques/ink/ink.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Ink
{
    InkGlobals globals;
};

layout(binding = 2) uniform usamplerBuffer state_texels;

layout(scalar, binding = 3) readonly buffer Sums
{
    InkSums sums;
};

layout(binding = 4, rgba8) writeonly uniform image2D out_layer;

layout(push_constant, scalar) uniform Constants
{
    InkMeasure measure;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_around = (variant & ink_is_around) != 0u;

#include "techniques/ink/grid.glsl"
#include "techniques/ink/cover.glsl"
#include "techniques/ink/page_ink.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 page_px = page_place(frame, vec2(pixel) + 0.5);
    vec2 cover = ink_cover(ink_on_page(page_px));
    float within = min(1.0, globals.budget / max(mean_cover(sums.covered[measure.sum_now]), 1e-6));
    vec2 inside_px = min(page_px - globals.clip_min_px, globals.clip_max_px - page_px) + 0.5;
    float clip = clamp(min(inside_px.x, inside_px.y), 0.0, 1.0);
    vec3 color = mix(globals.thin_color, globals.color, cover.y);
    imageStore(out_layer, pixel, vec4(sqrt(color), cover.x * within * clip));
}
