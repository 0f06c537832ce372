// SPDX-License-Identifier: MIT
// One thread per pixel fades every layer with distance: colour fades into the sky's colour, strokes and lines
// fade to nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/haze/haze.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(push_constant, scalar) uniform Constants
{
    HazeConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_tiles = (variant & haze_has_tiles) != 0u;

#define HAZE_DEPTH_BINDING 1
#include "techniques/haze/haze.glsl"

layout(binding = 2) uniform sampler2D sky_image;
layout(binding = 3, rgba16f) uniform image2D wash_image;
layout(binding = 4, r16f) uniform image2D hatch_image;
layout(binding = 5, rgba8) uniform image2D line_image;

#define TILE_LIST_BINDING 6
#include "shaders/tile_list.glsl" // used only in the variant with a tile list

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (has_tiles) {
        pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    }
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px)) || (has_tiles && !has_listed_tile())) {
        return;
    }
    float depth = haze_depth(pixel);
    float halved = depth > 0.0 ? halvings(pixel, depth) : 0.0;
    if (halved > 0.0) {
        vec4 wash = imageLoad(wash_image, pixel);
        vec3 sky = texelFetch(sky_image, min(pixel, textureSize(sky_image, 0) - 1), 0).rgb;
        imageStore(wash_image, pixel, vec4(mix(sky, wash.rgb, exp2(-halved)), wash.a));
        float hatch = imageLoad(hatch_image, pixel).x;
        imageStore(hatch_image, pixel, vec4(hatch * exp2(-constants.ink * halved)));
    }
    vec4 line = imageLoad(line_image, pixel);
    float of_line = line.a > 0.0 ? line_depth(pixel, depth) : -1.0;
    if (of_line >= 0.0) {
        imageStore(line_image, pixel, vec4(line.rgb, line.a * ink_left(pixel, of_line)));
    }
}
