// SPDX-License-Identifier: MIT
// One thread draws the smear strokes that cover one pixel. The body from which a stroke starts hides the
// stroke.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/noise.glsl"
#define SMEAR_TEXELS_BINDING 0
#include "techniques/motion_blur/smear_texels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 1) uniform usamplerBuffer lists;
layout(binding = 2) uniform usampler2D page_image;
layout(binding = 3) uniform sampler2D owner_depth_image;
layout(binding = 4) uniform sampler2D depth_image;
layout(binding = 5, rgba8) uniform image2D line_image;

layout(push_constant, scalar) uniform Constants
{
    SmearConstants constants;
};

const float hair_px = 1.5; // approximate distance between the hairs of the brush
const float most_hairs = 7.0;

// Coverage of a place by a smear stroke. A stroke looks like a dry brush that is set down at the edge and
// pulled away. The stroke is full at first. Farther along, the brush's hairs separate, run dry in places and
// end one by one.
float stroke_cover(SmearStroke stroke, vec2 place)
{
    float length_px = max(sqrt(dot(stroke.way_px, stroke.way_px)), 1e-6);
    vec2 back = stroke.way_px / length_px;
    vec2 off = place - stroke.from_px;
    float along_px = dot(off, back);
    float along = along_px / length_px;
    float bent = smear_bow * (2.0 * unit_float(hash(stroke.random, 3u)) - 1.0) * along * along * length_px;
    float aside_px = back.x * off.y - back.y * off.x - bent;
    float hairs = clamp(floor(2.0 * stroke.half_px / hair_px), 1.0, most_hairs);
    float apart_px = 2.0 * stroke.half_px / hairs;
    // Towards the end of the stroke, the brush's hairs converge, as when a brush is lifted from the paper.
    float spread = 1.0 - 0.5 * clamp(along, 0.0, 1.0);
    float cover = 0.0;
    for (int i = 0; i < int(hairs); ++i) {
        float middle_px = (float(i) + 0.5 - 0.5 * hairs) * apart_px * spread;
        float outer = abs(2.0 * (float(i) + 0.5) / hairs - 1.0);
        uint random = hash(stroke.random, 16u + uint(i));
        float end =
            i * 2 + 1 == int(hairs) ? 1.0 : mix(1.0, 0.35 + 0.5 * unit_float(random), 0.4 + 0.6 * outer);
        float left = clamp(1.0 - along / end, 0.0, 1.0);
        float dry = hairs > 1.0 ? 0.75 * smoothstep(0.15, 0.9, along / end) : 0.0;
        float wet = value_noise(vec2(along_px / (8.0 * apart_px), 0.5), random);
        float half_px = 0.65 * apart_px * sqrt(left) * smoothstep(dry - 0.2, dry + 0.05, wet);
        float off_px = abs(aside_px - middle_px);
        cover = max(cover, clamp(max(half_px, 0.5) + 0.5 - off_px, 0.0, 1.0) * min(half_px / 0.5, 1.0));
    }
    // The stroke begins up to three half widths before the edge, inside the body, which hides the stroke's
    // start.
    return along_px > -3.0 * stroke.half_px - 1.0 && along < 1.0 ? cover : 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    uint blocks_x = (constants.size_px.x + smear_block_px - 1u) / smear_block_px;
    uvec2 block = uvec2(pixel) / smear_block_px;
    int first = int((block.y * blocks_x + block.x) * (most_smear_strokes + 1u));
    int count = int(texelFetch(lists, first).x);
    vec2 own_way = unpackHalf2x16(texelFetch(page_image, pixel, 0).w);
    float depth = texelFetch(depth_image, pixel, 0).x;
    // A contour line extends beyond the edge of its body. Smear strokes begin under the contour line.
    bool is_beyond = depth < texelFetch(owner_depth_image, pixel, 0).x;
    float cover = 0.0;
    for (int i = 1; i <= count; ++i) {
        SmearStroke stroke = stroke_at(int(texelFetch(lists, first + i).x));
        float forward_px = -dot(own_way, stroke.way_px) / max(sqrt(dot(stroke.way_px, stroke.way_px)), 1e-6);
        bool is_own = forward_px > stroke.least_px && !is_beyond;
        bool is_hidden = depth > 1.02 * stroke.depth;
        cover = max(cover, is_own || is_hidden ? 0.0 : stroke_cover(stroke, vec2(pixel) + 0.5));
    }
    vec4 before = imageLoad(line_image, pixel);
    if (cover > before.a) {
        imageStore(line_image, pixel, vec4(sqrt(constants.ink), cover));
    }
}
