// SPDX-License-Identifier: MIT
// One thread per pixel of the half page (every second pixel) averages four neighbours in a row or column that
// lie on its own surface. The two passes together average each of the pattern's 16 directions once.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/occlusion/horizon/horizon.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D normal_image;
layout(binding = 2) uniform usampler2D open_image;
layout(binding = 3, rg32ui) writeonly uniform uimage2D out_open;

layout(push_constant, scalar) uniform Constants
{
    HorizonConstants constants;
};

layout(constant_id = 0) const uint is_upright = 0u;

#include "techniques/occlusion/half_page.glsl"

void main()
{
    ivec2 half_pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(half_pixel), constants.half_px))) {
        return;
    }
    ivec2 pixel = whole_pixel(half_pixel);
    vec2 own = uintBitsToFloat(texelFetch(open_image, half_pixel, 0).xy);
    vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
    DepthPlane plane = depth_plane(pixel, max(own.y, 1e-9), normal, 0.1 * constants.radius_m);
    // The direction is computed at run time, because Mesa replaces a vector that a specialization constant
    // selects with the constant's default.
    ivec2 along = ivec2(1 - int(is_upright), int(is_upright));
    vec2 sum = vec2(own.x, 1.0);
    for (int i = 1; i <= 4; ++i) {
        int step = i <= 2 ? -i : i - 2;
        ivec2 looked = half_pixel + step * along;
        bool is_there =
            all(greaterThanEqual(looked, ivec2(0))) && all(lessThan(uvec2(looked), constants.half_px));
        vec2 other = uintBitsToFloat(texelFetch(open_image, is_there ? looked : half_pixel, 0).xy);
        float share = abs(step) == 2 ? 0.5 : 1.0;
        float weight = is_there ? share * on_plane(plane, vec2(2 * step * along), other.y) : 0.0;
        sum += weight * vec2(other.x, 1.0);
    }
    imageStore(out_open, half_pixel, uvec4(floatBitsToUint(vec2(sum.x / sum.y, own.y)), 0u, 0u));
}
