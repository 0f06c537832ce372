// SPDX-License-Identifier: MIT
// One thread paints the clouds of one pixel over its sky, the highest first.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/rounds.glsl"
#include "techniques/sky/clouds/clouds.glsl.h"

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
layout(binding = 7, r16f) writeonly uniform image2D out_cover; // of the variant that keeps it

layout(binding = 9) uniform sampler2D depth_image; // of the variant that has one

layout(push_constant, scalar) uniform Constants
{
    CloudCover over;
};

#define TILE_LIST_BINDING 8
#include "shaders/tile_list.glsl" // of the variant that has one

layout(constant_id = 0) const uint variant = 0u;
const bool have_hatching = (variant & clouds_have_hatching) != 0u;
const bool have_streaks = (variant & clouds_have_streaks) != 0u;
const bool keep_cover = (variant & clouds_keep_cover) != 0u;
const bool have_tiles = (variant & clouds_have_tiles) != 0u;
const bool have_depth = (variant & clouds_have_depth) != 0u;

#include "techniques/sky/clouds/puffs.glsl"
#include "techniques/sky/clouds/streaks.glsl"
#include "techniques/sky/vault.glsl"

// Along the wind, up and across.
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

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (have_tiles) {
        pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    }
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px)) || (have_tiles && !has_listed_tile())) {
        return;
    }
    if (keep_cover) {
        imageStore(out_cover, pixel, vec4(0.0));
    }
    if (frame.is_orthographic != 0u) {
        return;
    }
    const float lowest = 0.012; // of a direction: below, clouds are too far
    vec2 position = vec2(pixel) + 0.5;
    vec3 d = direction_at(position);
    if (d.y < lowest || (have_depth && is_covered(depth_image, pixel, d, over.far_m))) {
        return;
    }
    vec3 right = direction_at(position + vec2(1.0, 0.0));
    vec3 down = direction_at(position + vec2(0.0, 1.0));
    vec3 wash = imageLoad(wash_image, pixel).rgb;
    float ink = imageLoad(ink_image, pixel).x;
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
    for (int i = rounds(int(clouds.puff_layer_count), pixel.x) - 1; i >= 0; --i) {
        SeenPuffs seen = puffs_along(clouds.puffs[i], in_layer, pixel_rad);
        wash = mix(wash, tone_of(seen.shade), seen.cover);
        ink = max(ink * (1.0 - seen.cover), seen.line);
        hatched = mix(hatched, seen.shade, seen.cover);
        open *= 1.0 - seen.cover;
    }
    if (have_hatching) {
        ink = max(ink, line_ink(level_strokes(d, position), level_pen(clouds.hatch_width_px),
                                clouds.hatch_darkness * hatched, 83u));
    }
    imageStore(wash_image, pixel, vec4(wash, 1.0));
    imageStore(ink_image, pixel, vec4(ink));
    if (keep_cover) {
        imageStore(out_cover, pixel, vec4(1.0 - open));
    }
}
