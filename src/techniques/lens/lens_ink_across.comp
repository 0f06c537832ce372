// SPDX-License-Identifier: MIT
// One thread searches the row of one pixel for the line that covers the pixel most, after lines are widened
// by the blur circles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D line_image;
layout(binding = 1) uniform usampler2D page_image;
// The line that was found: the line's colour and coverage in the first word, the line's radius and distance
// in the second.
layout(binding = 2, rg32ui) writeonly uniform uimage2D out_line;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

#include "techniques/lens/lens_ink.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    int reach = int(constants.most_wider_px);
    float best = 0.0;
    uvec2 kept = uvec2(0u);
    for (int aside = -reach; aside <= reach; ++aside) {
        ivec2 at = ivec2(clamp(pixel.x + aside, 0, int(constants.size_px.x) - 1), pixel.y);
        vec4 line = texelFetch(line_image, at, 0);
        float wider_px = wider_by(texelFetch(page_image, at, 0).w);
        float radius = min(0.5 * constants.widening * wider_px, constants.most_wider_px - 0.5) + 0.5;
        float away = abs(float(aside));
        float cover = line.a * paled(wider_px);
        // If two lines are equally dark, the nearer one is chosen.
        float score = cover * (aside == 0 ? 1.0 : clamp(radius - away, 0.0, 1.0)) - 1e-4 * away;
        kept = score > best ? uvec2(packUnorm4x8(vec4(line.rgb, cover)), packHalf2x16(vec2(radius, away)))
                            : kept;
        best = max(best, score);
    }
    imageStore(out_line, pixel, uvec4(kept, 0u, 0u));
}
