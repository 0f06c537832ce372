// SPDX-License-Identifier: MIT
// One thread lays the layers of one pixel on the paper: paint lets the paper through and settles in its
// hollows, ink lies on top and skips the heights a little.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/color.glsl"
#include "shaders/frame.glsl.h"
#include "shaders/noise.glsl"
#include "shaders/rounds.glsl"
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
layout(binding = 7, rgba32f) writeonly uniform image2D out_stage; // of the variant that is staged

layout(push_constant, scalar) uniform Constants
{
    PaperConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_tint = (variant & compose_has_tint) != 0u;
const bool has_sky = (variant & compose_has_sky) != 0u;
const bool is_staged = (variant & compose_is_staged) != 0u;

// How much of a pure colour of light the darkest ink shows under it.
const float sheen = 0.3;

// Ink in light of this colour: black by multiplication alone, if it did not shine a little.
vec3 lit_ink(vec3 ink, vec3 tint)
{
    float purity = 1.0 - min(tint.r, min(tint.g, tint.b));
    return mix(ink * tint, tint, sheen * purity);
}

// What the paper is like at a place.
struct Paper {
    float relief; // about 0 on average, in features of a few tenths of a millimetre with long faint fibres
    float pooled; // where paint gathers, the same in features of a centimetre
};

// All noises but the finest come from one loop, which is compiled once on processors.
Paper paper_at(vec2 page_mm, int loop_count)
{
    vec2 tooth_at = page_mm * 3.1;
    float bend = 0.0;
    float fibre = 0.0;
    float pooled = 0.0;
    float tooth = 0.0;
    for (int i = 0; i < loop_count; ++i) {
        vec2 place = i == 0   ? page_mm * 0.35
                     : i == 1 ? page_mm * vec2(0.9, 4.3) + 3.0 * bend
                     : i == 2 ? page_mm * 0.08
                     : i == 3 ? tooth_at
                              : 2.0 * tooth_at + 17.0;
        uint seed = i == 0 ? 9u : i == 1 ? 5u : i == 2 ? 21u : uint(i - 3);
        float noise = value_noise(place, constants.seed + seed);
        bend = i == 0 ? noise : bend;
        fibre = i == 1 ? noise : fibre;
        pooled = i == 2 ? noise : pooled;
        tooth += i == 3 ? 4.0 * noise : i == 4 ? 2.0 * noise : 0.0;
    }
    tooth += value_noise(4.0 * tooth_at + 31.0, constants.seed + 2u);
    return Paper(0.72 * (tooth / 7.0) + 0.28 * fibre - 0.5, pooled - 0.5);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 page_mm = (vec2(pixel) + 0.5) / frame.pixels_per_mm;
    Paper paper = paper_at(page_mm, rounds(5, pixel.x));
    float relief = paper.relief;
    vec4 wash = texelFetch(wash_image, pixel, 0);
    vec3 paint = pow(max(wash.rgb, vec3(1e-3)),
                     vec3(1.0 + constants.granulation * (0.3 * paper.pooled - 0.7 * relief)));
    vec3 bare = constants.paper_color * (1.0 + 0.10 * constants.grain * relief);
    vec3 color = bare * paint;

    float dry = clamp(1.0 - constants.ink_break * max(relief - 0.1, 0.0) * 3.0, 0.0, 1.0);
    float strokes = texelFetch(hatch_image, pixel, 0).x;
    if (has_sky) {
        float sky_ink = wash.a > 0.5 ? 0.0 : 1.0;
        strokes = max(
            strokes, sky_ink * texelFetch(sky_ink_image, min(pixel, textureSize(sky_ink_image, 0) - 1), 0).x);
    }
    float hatch = strokes * dry;
    vec4 line = texelFetch(line_image, pixel, 0);
    vec3 ink = constants.ink_color;
    if (has_tint) {
        vec3 tint = light_tint(texelFetch(light_image, pixel, 0).rgb);
        ink = mix(ink, lit_ink(ink, tint), constants.ink_tint);
    }
    float line_cover = line.a * mix(1.0, dry, 0.5);
    if (is_staged) {
        color = constants.stage >= stage_wash ? color : bare;
        hatch = constants.stage >= stage_hatch ? hatch : 0.0;
        line_cover = constants.stage >= stage_lines ? line_cover : 0.0;
    }
    color = mix(color, ink, hatch);
    color = mix(color, line.rgb * line.rgb, line_cover);
    if (is_staged) {
        float cover = constants.stage == stage_lines   ? line_cover
                      : constants.stage == stage_hatch ? hatch
                                                       : 1.0;
        imageStore(out_stage, pixel, vec4(color, cover));
    } else {
        imageStore(out_picture, pixel, vec4(color, 1.0));
    }
}
