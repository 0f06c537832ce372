// SPDX-License-Identifier: MIT
// One thread lays the layers of one pixel on the paper: paint lets the paper through and settles in its
// hollows, ink lies on top and skips the heights a little.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/color.glsl"
#include "shaders/frame.glsl.h"
#include "shaders/noise.glsl"
#include "techniques/paper/paper.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D wash_image;
layout(binding = 2) uniform sampler2D hatch_image;
layout(binding = 3) uniform sampler2D line_image;
layout(binding = 4) uniform sampler2D sky_ink_image;
layout(binding = 5) uniform sampler2D light_image; // of the variant that tints
layout(binding = 6, rgba16f) writeonly uniform image2D out_picture;

layout(push_constant, scalar) uniform Constants
{
    PaperConstants constants;
};

// Bit 0: coloured light colours the strokes.
layout(constant_id = 0) const uint variant = 0u;
const bool has_tint = (variant & 1u) != 0u;

// How much of a pure colour of light the darkest ink shows under it.
const float sheen = 0.3;

// Ink in light of this colour: black by multiplication alone, if it did not shine a little.
vec3 lit_ink(vec3 ink, vec3 tint)
{
    float purity = 1.0 - min(tint.r, min(tint.g, tint.b));
    return mix(ink * tint, tint, sheen * purity);
}

// Height of the paper, about 0.5 on average, in features of a few tenths of a millimetre with long faint
// fibres.
float paper_height(vec2 page_mm)
{
    float tooth = fractal_noise(page_mm * 3.1, constants.seed);
    float fibre =
        value_noise(page_mm * vec2(0.9, 4.3) + 3.0 * value_noise(page_mm * 0.35, constants.seed + 9u),
                    constants.seed + 5u);
    return 0.72 * tooth + 0.28 * fibre;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 page_mm = (vec2(pixel) + 0.5) / frame.pixels_per_mm;
    float relief = paper_height(page_mm) - 0.5;
    vec4 wash = texelFetch(wash_image, pixel, 0);
    float pooled = value_noise(page_mm * 0.08, constants.seed + 21u) - 0.5;
    vec3 paint =
        pow(max(wash.rgb, vec3(1e-3)), vec3(1.0 + constants.granulation * (0.3 * pooled - 0.7 * relief)));
    vec3 color = constants.paper_color * (1.0 + 0.10 * constants.grain * relief) * paint;

    float dry = clamp(1.0 - constants.ink_break * max(relief - 0.1, 0.0) * 3.0, 0.0, 1.0);
    float sky_ink = wash.a > 0.5 ? 0.0 : 1.0;
    float hatch =
        max(texelFetch(hatch_image, pixel, 0).x,
            sky_ink * texelFetch(sky_ink_image, min(pixel, textureSize(sky_ink_image, 0) - 1), 0).x) *
        dry;
    vec4 line = texelFetch(line_image, pixel, 0);
    vec3 ink = constants.ink_color;
    if (has_tint) {
        vec3 tint = light_tint(texelFetch(light_image, pixel, 0).rgb);
        ink = mix(ink, lit_ink(ink, tint), constants.ink_tint);
    }
    color = mix(color, ink, hatch);
    color = mix(color, line.rgb * line.rgb, line.a * mix(1.0, dry, 0.5));
    imageStore(out_picture, pixel, vec4(color, 1.0));
}
