// SPDX-License-Identifier: MIT
// One thread handles one texel. A thing with a floor close by on two opposite sides is an edge of the floor,
// such as the step between two slabs, and no thing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/halo/halo.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D things_image;
layout(binding = 1, r16f) writeonly uniform image2D out_things;

layout(push_constant, scalar) uniform Constants
{
    HaloEdgeConstants constants;
};

float thing_at(ivec2 texel)
{
    return texelFetch(things_image, clamp(texel, ivec2(0), constants.size_texels - 1), 0).x;
}

bool is_between_floors(ivec2 texel, ivec2 offset)
{
    return thing_at(texel - offset) == floor_px && thing_at(texel + offset) == floor_px;
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, constants.size_texels))) {
        return;
    }
    float thing = thing_at(texel);
    bool is_edge = thing == 0.0 && (is_between_floors(texel, ivec2(0, constants.reach_texels)) ||
                                    is_between_floors(texel, ivec2(constants.reach_texels, 0)));
    imageStore(out_things, texel, vec4(is_edge ? floor_px : thing));
}
