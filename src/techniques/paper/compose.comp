// SPDX-License-Identifier: MIT
// One thread composes the layers of one pixel on the paper. Paint lets the paper through and settles in its
// hollows; ink lies on top and skips the paper's high spots a little.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/noise.glsl"
#include "shaders/loops.glsl"
#include "techniques/paper/paper.glsl.h"

// With the chosen workgroup size, one warp (32 threads) writes one whole line of memory, which is fast over
// the bus to the host.
layout(local_size_x = 32, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D wash_image;
layout(binding = 2) uniform sampler2D hatch_image;
layout(binding = 3) uniform sampler2D line_image;
layout(binding = 4) uniform sampler2D sky_ink_image;
layout(binding = 5) uniform sampler2D light_image;       // light on surfaces, for compose_has_tint
layout(binding = 6) uniform sampler2D ink_image;         // flowing ink, for compose_has_ink
layout(binding = 7) uniform sampler2D smoke_paint_image; // paint of smoke, for compose_has_smoke
layout(binding = 8) uniform sampler2D smoke_ink_image;
layout(binding = 9) uniform sampler2D cover_image; // coverage by objects, for compose_has_cover
layout(binding = 10, rgba16f) writeonly uniform image2D out_picture;
layout(binding = 11, rgba32f) writeonly uniform image2D out_stage; // layers up to a stage

layout(std430, binding = 12) writeonly buffer Pixels // output for compose_develops, which writes sRGB bytes
{
    uint pixels[];
};

layout(push_constant, scalar) uniform Constants
{
    PaperConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_tint = (variant & compose_has_tint) != 0u;
const bool has_sky = (variant & compose_has_sky) != 0u;
const bool has_ink = (variant & compose_has_ink) != 0u;
const bool has_smoke = (variant & compose_has_smoke) != 0u;
const bool is_staged = (variant & compose_is_staged) != 0u;
const bool has_margin = (variant & compose_has_margin) != 0u;
const bool develops = (variant & compose_develops) != 0u;
const bool has_grain = (variant & compose_has_grain) != 0u;
const bool is_transparent = (variant & compose_is_transparent) != 0u;
const bool keeps_things = (variant & compose_keeps_things) != 0u;
const bool is_shifted = (variant & compose_is_shifted) != 0u;
const bool has_cover = (variant & compose_has_cover) != 0u;

// Largest deviation of the window's edge from a straight line.
const float edge_stray_mm = 0.17;

// Share of a pure light colour that remains visible in the darkest ink.
const float sheen = 0.3;

// Colour of ink under light of colour `tint`. Multiplication alone leaves ink black, so the ink also shines a
// little.
vec3 lit_ink(vec3 ink, vec3 tint)
{
    float purity = 1.0 - min(tint.r, min(tint.g, tint.b));
    return mix(ink * tint, tint, sheen * purity);
}

// Relief and stains of the paper at a place.
struct Paper {
    // Height of the relief, with the mean 0; has features of a few tenths of a millimetre, and long faint
    // fibres.
    float relief;
    float tooth;  // the isotropic part of the relief, 0 to 1
    float pooled; // amount of paint that gathers, with the mean 0, in features of a centimetre
    float stray;  // deviation of a ruled line, with the mean 0
};

// Paper at a place of the page. One loop computes all noises but the finest, because CPU drivers compile the
// loop's body only once.
Paper paper_at(vec2 page_mm, int loop_count)
{
    vec2 tooth_at = page_mm * 3.1;
    float bend = 0.0;
    float fibre = 0.0;
    float pooled = 0.0;
    float tooth = 0.0;
    float stray = 0.0;
    int i = 0;
    do {
        vec2 place = i == 0   ? page_mm * 0.35
                     : i == 1 ? page_mm * vec2(0.9, 4.3) + 3.0 * bend
                     : i == 2 ? page_mm * 0.08
                     : i == 3 ? tooth_at
                     : i == 4 ? 2.0 * tooth_at + 17.0
                     : i == 5 ? page_mm * 0.07
                              : page_mm * 0.6;
        uint seed = i == 0 ? 9u : i == 1 ? 5u : i == 2 ? 21u : i < 5 ? uint(i - 3) : uint(36 + i);
        float noise = value_noise(place, constants.seed + seed);
        bend = i == 0 ? noise : bend;
        fibre = i == 1 ? noise : fibre;
        pooled = i == 2 ? noise : pooled;
        tooth += i == 3 ? 4.0 * noise : i == 4 ? 2.0 * noise : 0.0;
        stray += i == 5 ? 0.7 * (noise - 0.5) : i == 6 ? 0.3 * (noise - 0.5) : 0.0;
    } while (++i < loop_count);
    tooth += value_noise(4.0 * tooth_at + 31.0, constants.seed + 2u);
    tooth /= 7.0;
    return Paper(0.72 * tooth + 0.28 * fibre - 0.5, tooth, pooled - 0.5, stray);
}

// Range of the tooth from its deepest hollow to its highest spot. Smoothstep over this range gives about the
// share of the paper that is lower.
const float hollow = 0.205;
const float summit = 0.795;
// How soft the edges of the caught pigment are: rise of the share of the paper over which pigment fades.
const float catch_width = 0.5;

// Pigment of a dry stroke that stays at a place of the paper. High spots catch pigment first, and hollows
// only where the stroke is dark. The mean over the paper is the stroke's coverage, because `level` solves
//     coverage = mean of clamp((level - higher) / catch_width, 0, 1) for `higher` between 0 and 1.
float caught(float coverage, float tooth)
{
    float higher = 1.0 - smoothstep(hollow, summit, tooth); // share of the paper that is higher
    float light = sqrt(2.0 * catch_width * coverage);
    float dark = 1.0 + catch_width - sqrt(2.0 * catch_width * (1.0 - coverage));
    float level = coverage < 0.5 * catch_width         ? light
                  : coverage > 1.0 - 0.5 * catch_width ? dark
                                                       : coverage + 0.5 * catch_width;
    return mix(coverage, clamp((level - higher) / catch_width, 0.0, 1.0), constants.ink_grain);
}

// Distance to the edge of the drawing's window (the page inside the margin), negative inside.
float from_window_mm(vec2 page_mm)
{
    vec2 beyond = max(constants.window_min_mm - page_mm, page_mm - constants.window_max_mm);
    return max(beyond.x, beyond.y);
}

// Share of a pixel that objects cover, for the alpha of a transparent background.
float things_at(ivec2 pixel, float wash_alpha)
{
    if (!keeps_things) {
        return 0.0;
    }
    return clamp(has_cover ? texelFetch(cover_image, pixel, 0).r : wash_alpha, 0.0, 1.0);
}

// Paint on paper: linear colour and alpha. Transparent paper has no relief, because a relief would tint the
// backdrop. Covered pixels get the smallest alpha that can show their colour. Source: "colour to alpha" of
// painting programs.
vec4 painted(vec3 bare, vec3 paint, float cover)
{
    if (!is_transparent) {
        return vec4(bare * paint, 1.0);
    }
    vec3 below = cover >= 1.0 ? bare : mix(constants.paper_color, bare, cover);
    vec3 color = below * paint;
    return vec4(color, max(cover, least_alpha(constants.paper_color, color)));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 page_mm = page_place(frame, vec2(pixel) + 0.5) / frame.pixels_per_mm;
    Paper paper = paper_at(page_mm, loop_rounds(has_margin ? 7 : 5, pixel.x));
    float relief = paper.relief;
    float beyond_mm = has_margin ? from_window_mm(page_mm) + edge_stray_mm * paper.stray : -1.0;
    float within = clamp(0.5 - beyond_mm * frame.pixels_per_mm, 0.0, 1.0);
    vec4 wash = texelFetch(wash_image, pixel, 0);
    vec3 plate = wash.rgb;
    if (is_shifted) {
        ivec2 from = clamp(pixel - constants.paint_shift_px, ivec2(0), ivec2(frame.size_px) - 1);
        plate = texelFetch(wash_image, from, 0).rgb;
    }
    vec3 paint =
        pow(max(plate, vec3(1e-3)), vec3(1.0 + constants.granulation * (0.3 * paper.pooled - 0.7 * relief)));
    vec3 bare = constants.paper_color * (1.0 + 0.10 * constants.grain * relief);
    float things = things_at(pixel, wash.a) * within;
    vec4 page = painted(bare, mix(vec3(1.0), paint, within), things);

    float dry = clamp(1.0 - constants.ink_break * max(relief - 0.1, 0.0) * 3.0, 0.0, 1.0);
    float strokes = texelFetch(hatch_image, pixel, 0).x;
    if (has_sky) {
        float sky_ink = wash.a > 0.5 ? 0.0 : 1.0;
        strokes = max(
            strokes, sky_ink * texelFetch(sky_ink_image, min(pixel, textureSize(sky_ink_image, 0) - 1), 0).x);
    }
    float hatch = strokes * dry * within;
    vec4 line = texelFetch(line_image, pixel, 0);
    vec3 line_color = line.rgb * line.rgb;
    float line_cover = line.a * mix(1.0, dry, 0.5) * within;
    if (has_grain) {
        hatch = caught(hatch, paper.tooth);
        line_cover = caught(line_cover, paper.tooth);
    }
    vec3 ink = constants.ink_color;
    if (has_tint) {
        vec3 tint = light_tint(texelFetch(light_image, pixel, 0).rgb);
        ink = mix(ink, lit_ink(ink, tint), constants.ink_tint);
    }
    vec3 below = mix(vec3(1.0), paint, constants.overprint);
    ink *= below;
    line_color *= below;
    float border = 0.0;
    if (has_margin) {
        // The border line is drawn over the contour lines, in the ink of the strokes.
        border = (0.5 * constants.border_mm - abs(beyond_mm)) * frame.pixels_per_mm + 0.5;
        border = clamp(border, 0.0, min(constants.border_mm * frame.pixels_per_mm, 1.0));
        float cover = 1.0 - (1.0 - line_cover) * (1.0 - border);
        line_color = mix(line_color, constants.ink_color, border / max(cover, 1e-6));
        line_cover = cover;
    }
    if (is_staged) {
        page = constants.stage >= stage_wash ? page : vec4(bare, 1.0);
        hatch = constants.stage >= stage_hatch ? hatch : 0.0;
        line_cover = constants.stage >= stage_lines ? line_cover : 0.0;
    }
    float flow_cover = 0.0;
    if (has_ink) {
        vec4 flow = texelFetch(ink_image, pixel, 0);
        // Thin ink shows the grain; solid ink has filled the hollows.
        flow_cover = clamp(flow.a * (1.0 - constants.settles * relief * (1.0 - flow.a * flow.a)), 0.0, 1.0);
        flow_cover = is_staged && constants.stage < stage_ink ? 0.0 : flow_cover;
        page = mix(page, vec4(flow.rgb * flow.rgb, 1.0), flow_cover);
    }
    page = mix(page, vec4(ink, 1.0), hatch);
    page = mix(page, vec4(line_color, 1.0), line_cover);
    float smoke_cover = 0.0;
    if (has_smoke && (!is_staged || constants.stage >= stage_smoke)) {
        vec4 smoke = texelFetch(smoke_paint_image, pixel, 0);
        float drawn = texelFetch(smoke_ink_image, pixel, 0).x * dry;
        float there = within * (1.0 - border);
        vec4 paint_of_smoke = is_transparent ? painted(bare, smoke.rgb * smoke.rgb, keeps_things ? 1.0 : 0.0)
                                             : vec4(bare * smoke.rgb * smoke.rgb, 1.0);
        page = mix(page, paint_of_smoke, smoke.a * there);
        page = mix(page, vec4(ink, 1.0), drawn * there);
        smoke_cover = (1.0 - (1.0 - smoke.a) * (1.0 - drawn)) * there;
    }
    if (is_staged) {
        float cover = constants.stage == stage_smoke   ? smoke_cover
                      : constants.stage == stage_lines ? line_cover
                      : constants.stage == stage_hatch ? hatch
                      : constants.stage == stage_ink   ? flow_cover
                                                       : page.a;
        imageStore(out_stage, pixel, vec4(page.rgb, cover));
    } else if (develops) {
        // Colours are rounded to half floats, so that the bytes equal those of a picture that is developed
        // later.
        vec3 kept = vec3(unpackHalf2x16(packHalf2x16(page.rg)), unpackHalf2x16(packHalf2x16(page.bb)).x);
        pixels[uint(pixel.y) * frame.size_px.x + uint(pixel.x)] =
            is_transparent ? straight_srgb_bytes(constants.paper_color, page.rgb, page.a, kept)
                           : srgb_bytes(kept);
    } else {
        imageStore(out_picture, pixel, vec4(page.rgb, 1.0));
    }
}
