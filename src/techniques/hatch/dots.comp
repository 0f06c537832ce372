// SPDX-License-Identifier: MIT
// One thread draws one pixel of a screentone: dots on a lattice that lies on the page. The lattice is
// attached to the shaded object, so that the dots move with the object.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/surface_images.glsl"
#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D darkness_image;
layout(binding = 2) uniform usampler2D draw_image;

#define DRAW_TEXELS_BINDING 3
#include "shaders/draw_texels.glsl"

layout(binding = 4, r16f) uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    DotConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_ink = (variant & dots_has_ink) != 0u;
const bool marks_solid = (variant & dots_marks_solid) != 0u;

// Radius of the dots, in spacings of the lattice, for dots that cover a given share of the page. If the share
// is more than pi / 4, the dots overlap. Newton's method then takes into account the four circle segments by
// which neighbouring dots overlap.
float radius_for(float share)
{
    float radius = sqrt(share / 3.14159265);
    for (int i = 0; i < 3; ++i) {
        float away = max(radius * radius - 0.25, 0.0);
        float segment = acos(clamp(0.5 / max(radius, 1e-3), 0.0, 1.0));
        float area = radius * radius * (3.14159265 - 4.0 * segment) + 2.0 * sqrt(away);
        float rate = radius * (6.2831853 - 8.0 * segment);
        radius += (share - area) / max(rate, 0.5);
    }
    return radius;
}

// Position of an object on the page, in pixels; (0, 0) if the object is behind the eye.
vec2 place_of(uint draw)
{
    vec4 clip = frame.clip_from_anchor * vec4(draw_pose_at(draw).anchor_from_object[3].xyz, 1.0);
    vec2 place = (0.5 + 0.5 * clip.xy / clip.w) * vec2(frame.page_px);
    return clip.w > 0.0 ? place : vec2(0.0);
}

float dot_ink(vec2 from_object_px, float dark)
{
    vec2 across =
        constants.axis * from_object_px.x + vec2(-constants.axis.y, constants.axis.x) * from_object_px.y;
    vec2 place = across / constants.pitch_px;
    float radius_px = radius_for(dark) * constants.pitch_px;
    // The area that an antialiased edge one pixel wide adds to a disc, divided by pi, in square pixels.
    const float soft = 1.0 / 12.0;
    // A dot smaller than a pixel is drawn about one pixel wide and lighter.
    float drawn_px = max(sqrt(max(radius_px * radius_px - soft, 0.0)), 0.6);
    float ink = 0.0;
    // Several dots may each cover a part of the pixel, so the four nearest dots are summed.
    for (int i = 0; i < 4; ++i) {
        vec2 corner = floor(place) + vec2(i & 1, i >> 1);
        ink += clamp(drawn_px - length(place - corner) * constants.pitch_px + 0.5, 0.0, 1.0);
    }
    return min(ink, 1.0) * min(radius_px * radius_px / (drawn_px * drawn_px + soft), 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float dark = texelFetch(darkness_image, pixel, 0).x;
    uint word = texelFetch(draw_image, pixel, 0).x;
    if (dark <= 0.0 || !sees_draw(word)) {
        return;
    }
    float tone = dark;
    if (constants.steps > 0u) {
        // Darkness is rounded to a few tones. Darkness below half a tone stays blank, as with cut sheets of
        // screentone.
        tone = round(dark * float(constants.steps)) / float(constants.steps);
    }
    float ink = tone > 0.0
                    ? dot_ink(page_place(frame, vec2(pixel) + 0.5) - place_of(draw_of(word)), min(tone, 1.0))
                    : 0.0;
    ink = dark >= constants.black_above || tone >= 1.0 ? (marks_solid ? solid_ink : 1.0) : ink;
    if (has_ink) {
        ink = max(ink, imageLoad(out_ink, pixel).x);
    }
    imageStore(out_ink, pixel, vec4(ink));
}
