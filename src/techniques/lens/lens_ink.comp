// SPDX-License-Identifier: MIT
// One thread draws the ink of one pixel as if with a softer pencil: out of focus, lines become wider and
// paler.
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
// For each pixel: the line that covers the pixel most, among the lines of the pixel's row, see
// lens_ink_across.comp.
layout(binding = 5) uniform usampler2D across_image;
layout(binding = 6, r16f) writeonly uniform image2D out_hatch;
layout(binding = 7, rgba8) writeonly uniform image2D out_lines;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_sky = (variant & lens_has_sky) != 0u;

#include "shaders/layers.glsl"

#include "techniques/lens/lens_ink.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    Layers layers = layers_at(pixel);
    vec4 widest = vec4(0.0);
    int reach = int(constants.most_wider_px);
    for (int aside = -reach; aside <= reach; ++aside) {
        ivec2 at = ivec2(pixel.x, clamp(pixel.y + aside, 0, int(constants.size_px.y) - 1));
        uvec2 packed = texelFetch(across_image, at, 0).xy;
        vec4 line = unpackUnorm4x8(packed.x);
        vec2 radius_and_away = unpackHalf2x16(packed.y);
        float away = sqrt(radius_and_away.y * radius_and_away.y + float(aside * aside));
        float cover = line.a * (away == 0.0 ? 1.0 : clamp(radius_and_away.x - away, 0.0, 1.0));
        widest = cover > widest.a ? vec4(line.rgb, cover) : widest;
    }
    imageStore(out_hatch, pixel, vec4(layers.hatch * paled(wider_by(texelFetch(page_image, pixel, 0).w))));
    imageStore(out_lines, pixel, widest);
}
