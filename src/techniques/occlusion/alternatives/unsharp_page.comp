// SPDX-License-Identifier: MIT
// One thread per pixel darkens points behind the mean depth around them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/occlusion/alternatives/unsharp.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;
layout(binding = 2) uniform sampler2D mean_image;
layout(binding = 3, r16f) writeonly uniform image2D out_open;

layout(push_constant, scalar) uniform Constants
{
    UnsharpConstants constants;
};

#include "techniques/occlusion/half_page.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float depth = texelFetch(depth_image, pixel, 0).x;
    uvec2 on_page = uvec2(pixel) + frame.tile_from_px;
    vec2 between = 0.5 * vec2(on_page & 1u);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 looked = ivec2(on_page / 2u) + corner - ivec2(constants.from_half);
        bool is_there =
            all(greaterThanEqual(looked, ivec2(0))) && all(lessThan(uvec2(looked), constants.half_px));
        float mean = texelFetch(mean_image, clamp(looked, ivec2(0), ivec2(constants.half_px) - 1), 0).x;
        vec2 bilinear = mix(1.0 - between, between, vec2(corner));
        sum += (is_there ? bilinear.x * bilinear.y : 0.0) * vec2(mean, 1.0);
    }
    // In perspective, reversed depth is 1 / distance, so the result is the relative distance behind the mean.
    // In parallel projection, the distance is relative to the radius.
    float behind = sum.y > 0.0 ? max(sum.x / sum.y - depth, 0.0) : 0.0;
    behind /= frame.is_orthographic != 0u ? constants.radius_m / size_of(frame.anchor_from_clip[2].xyz)
                                          : max(sum.x / max(sum.y, 1e-6) + depth, 1e-12);
    float open = depth > 0.0 ? clamp(1.0 - constants.strength * behind, 0.0, 1.0) : 1.0;
    imageStore(out_open, pixel, vec4(open));
}
