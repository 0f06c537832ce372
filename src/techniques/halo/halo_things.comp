// SPDX-License-Identifier: MIT
// One thread handles one texel, a square of pixels of the page. The texel is 0 where one of the pixels shows
// a thing, and far away otherwise. All surfaces are things except ground, floors and other level planes, and
// the narrow edges of floors, such as steps between slabs.
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

const float far_px = 60000.0;

bool is_on_page(ivec2 pixel)
{
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(uvec2(pixel), frame.size_px));
}

// Normal of a level surface at a pixel; zero for other surfaces and where no surface is seen.
vec3 level_normal(ivec2 pixel)
{
    uint word = is_on_page(pixel) ? texelFetch(draw_image, pixel, 0).x : 0u;
    if (!sees_draw(word)) {
        return vec3(0.0);
    }
    vec3 normal = is_ground(word, constants.ground_draws)
                      ? vec3(0.0, 1.0, 0.0)
                      : unpack_normal(texelFetch(normal_image, pixel, 0).y);
    return normal.y > least_level ? normal : vec3(0.0);
}

bool is_between_floors(ivec2 pixel, ivec2 offset)
{
    const float most_turn = 0.01; // largest difference of the normals of two slabs of a floor
    vec3 before = level_normal(pixel - offset);
    vec3 behind = level_normal(pixel + offset);
    return before != vec3(0.0) && behind != vec3(0.0) && distance(before, behind) < most_turn;
}

// Whether a floor lies close by on two opposite sides.
bool is_edge_of_floor(ivec2 pixel)
{
    return is_between_floors(pixel, ivec2(0, constants.edge_px)) ||
           is_between_floors(pixel, ivec2(constants.edge_px, 0));
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(out_distance)))) {
        return;
    }
    int side = int(halo_texel_px);
    ivec2 from = side * texel - ivec2(halo_offset_px(frame.tile_from_px));
    bool has_thing = false;
    vec3 first = vec3(0.0);
    for (int i = 0; i < side * side && !has_thing; ++i) {
        ivec2 pixel = from + ivec2(i % side, i / side);
        uint word = is_on_page(pixel) ? texelFetch(draw_image, pixel, 0).x : 0u;
        if (sees_draw(word) && !is_ground(word, constants.ground_draws)) {
            vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
            first = first == vec3(0.0) && normal.y > least_level ? normal : first;
            has_thing = !is_flat_and_level(normal, first) && !is_edge_of_floor(pixel);
        }
    }
    imageStore(out_distance, texel, vec4(has_thing ? 0.0 : far_px));
}
