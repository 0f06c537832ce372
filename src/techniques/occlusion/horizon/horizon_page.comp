// SPDX-License-Identifier: MIT
// One thread per pixel interpolates the visibility of the half page (every second pixel) between samples on
// the pixel's own surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/occlusion/horizon/horizon.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;
layout(binding = 2) uniform usampler2D normal_image;
layout(binding = 3) uniform usampler2D open_image;
layout(binding = 4, r16f) writeonly uniform image2D out_open;

layout(push_constant, scalar) uniform Constants
{
    HorizonConstants constants;
};

#include "techniques/occlusion/half_page.glsl"

// Small weight that every sample of the half page (every second pixel) gets in addition. The small weight
// only matters if no sample lies on the pixel's surface.
const float least_weight = 1e-3;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float depth = texelFetch(depth_image, pixel, 0).x;
    vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
    DepthPlane plane = depth_plane(pixel, max(depth, 1e-9), normal, 0.1 * constants.radius_m);
    uvec2 on_page = uvec2(pixel) + frame.tile_from_px;
    vec2 between = 0.5 * vec2(on_page & 1u);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 looked = ivec2(on_page / 2u) + corner - ivec2(constants.from_half);
        bool is_there =
            all(greaterThanEqual(looked, ivec2(0))) && all(lessThan(uvec2(looked), constants.half_px));
        looked = clamp(looked, ivec2(0), ivec2(constants.half_px) - 1);
        vec2 other = uintBitsToFloat(texelFetch(open_image, looked, 0).xy);
        vec2 bilinear = mix(1.0 - between, between, vec2(corner));
        vec2 offset = vec2(whole_pixel(looked) - pixel);
        float weight = on_plane(plane, offset, other.y) + least_weight;
        weight *= is_there && other.y > 0.0 ? max(bilinear.x * bilinear.y, least_weight) : 0.0;
        sum += weight * vec2(other.x, 1.0);
    }
    float open = depth > 0.0 && sum.y > 0.0 ? sum.x / sum.y : 1.0;
    imageStore(out_open, pixel, vec4(pow(open, constants.strength)));
}
