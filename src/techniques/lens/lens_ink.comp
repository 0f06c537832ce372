// SPDX-License-Identifier: MIT
// One thread draws the ink of a pixel as a softer pencil does: lines as wide as the circle about them lets them
// be, and paler by that.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D wash_image;
layout(binding = 1) uniform sampler2D hatch_image;
layout(binding = 2) uniform sampler2D line_image;
layout(binding = 3) uniform sampler2D sky_ink_image;
layout(binding = 4) uniform usampler2D page_image;
layout(binding = 5, r16f) writeonly uniform image2D out_hatch;
layout(binding = 6, rgba8) writeonly uniform image2D out_lines;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_sky = (variant & lens_has_sky) != 0u;

#include "shaders/layers.glsl"

float radius_at(ivec2 pixel)
{
    return abs(unpackHalf2x16(texelFetch(page_image, pixel, 0).w).x);
}

// How dark ink is of what was drawn as a line of about two pixels and is now wider by this much.
float paled(float wider_px)
{
    return 1.0 / (1.0 + constants.paling_per_px * wider_px);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    Layers layers = layers_at(pixel);
    float own_px = max(radius_at(pixel) - lens_sharp_px, 0.0);
    vec4 widest = vec4(layers.lines.rgb, layers.lines.a * paled(own_px));
    int reach = own_px >= 0.0 ? int(constants.most_wider_px) : 0;
    int side = 2 * reach + 1;
    for (int i = 0; i < side * side; ++i) {
        ivec2 aside = ivec2(i % side, i / side) - reach;
        ivec2 at = clamp(pixel + aside, ivec2(0), ivec2(constants.size_px) - 1);
        vec4 line = texelFetch(line_image, at, 0);
        float wider_px = max(radius_at(at) - lens_sharp_px, 0.0);
        float half_px = min(0.5 * constants.widening * wider_px, constants.most_wider_px - 0.5);
        float share = clamp(half_px + 0.5 - sqrt(float(aside.x * aside.x + aside.y * aside.y)), 0.0, 1.0);
        float cover = aside == ivec2(0) ? 0.0 : line.a * share * paled(wider_px);
        widest = cover > widest.a ? vec4(line.rgb, cover) : widest;
    }
    imageStore(out_hatch, pixel, vec4(layers.hatch * paled(own_px)));
    imageStore(out_lines, pixel, widest);
}
