// SPDX-License-Identifier: MIT
// One thread handles one texel, a square of pixels of the page. The texel is 0 where one of the pixels shows
// a thing, and far away otherwise; see halo.glsl.h. All surfaces are things except ground, floors and other
// level planes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/halo.glsl.h"
#include "shaders/level.glsl"
#include "shaders/unit.glsl"
#include "techniques/halo/halo.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform usampler2D normal_image;
layout(binding = 3, r16f) writeonly uniform image2D out_distance;

layout(push_constant, scalar) uniform Constants
{
    HaloThingConstants constants;
};

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(out_distance)))) {
        return;
    }
    int side = int(halo_texel_px);
    ivec2 from = side * texel - ivec2(halo_offset_px(frame.tile_from_px));
    bool has_thing = false;
    bool has_floor = false;
    vec3 first = vec3(0.0);
    for (int i = 0; i < side * side && !has_thing; ++i) {
        ivec2 pixel = from + ivec2(i % side, i / side);
        bool on_page = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(uvec2(pixel), frame.size_px));
        uint word = on_page ? texelFetch(draw_image, pixel, 0).x : 0u;
        has_floor = has_floor || sees_draw(word);
        if (sees_draw(word) && !is_ground(word, constants.ground_draws)) {
            vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
            first = first == vec3(0.0) ? normal : first;
            has_thing = !is_flat_and_level(normal, first);
        }
    }
    imageStore(out_distance, texel, vec4(has_thing ? 0.0 : has_floor ? floor_px : blank_px));
}
