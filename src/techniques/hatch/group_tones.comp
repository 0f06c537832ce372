// SPDX-License-Identifier: MIT
// One thread gives one pixel the tone of its area. Areas that are too small take the tone of the area with
// which they share the longest border. Each workgroup lists its tile of pixels if the tile has any darkness.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require

#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Constants
{
    GroupConstants constants;
};

#include "techniques/hatch/groups.glsl"

layout(binding = 4) uniform sampler2D exact_image; // darkness before smoothing
layout(binding = 5, r16f) writeonly uniform image2D out_darkness;

#define DARK_TILES_BINDING 6
#include "techniques/hatch/dark_tiles.glsl"

// Tone of the areas that are not small with which a small area shares the longest border; no_group if the
// area touches none.
uint tone_around(uint name)
{
    uint longest = 0u;
    uint group = no_group;
    for (uint i = 0u; i < constants.count; ++i) {
        uint border = imageLoad(borders, border_texel(name, i)).x;
        group = border > longest ? i : group;
        longest = max(border, longest);
    }
    return group;
}

float grouped(ivec2 pixel)
{
    float dark = texelFetch(exact_image, pixel, 0).x;
    if (dark < 0.0) {
        return 0.0;
    }
    uint group = group_at(pixel);
    uint name = parents[number_of(pixel)];
    uint around = tone_around(name);
    float tone = tone_of_group(group, constants.count);
    if (around != no_group) {
        float own = smoothstep(constants.least_px, full_area * constants.least_px, float(pixels_of[name]));
        tone = mix(tone_of_group(around, constants.count), tone, own);
    }
    return mix(dark, tone, constants.strength);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool on_page = all(lessThan(uvec2(pixel), constants.size_px));
    float dark = on_page ? grouped(pixel) : 0.0;
    list_dark_tile(dark);
    if (on_page) {
        imageStore(out_darkness, pixel, vec4(dark));
    }
}
