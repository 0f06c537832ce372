// SPDX-License-Identifier: MIT
// One thread per pixel follows the view ray through clear bodies to the background: the transmittance per
// colour, and the width of the blur.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/surface_images.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;

#define PARAMETERS_BINDING 2
#define HAS_VARIANTS ((variant & subsurface_has_variants) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/parameters.glsl"

#define MESH_TEXELS_BINDING 4
#include "shaders/mesh_texels.glsl"

#include "shaders/visibility.glsl"

layout(binding = 6) uniform usamplerBuffer background;
layout(binding = 7) uniform usamplerBuffer inside_0;
layout(binding = 8) uniform usamplerBuffer inside_1;
layout(binding = 9) uniform usamplerBuffer inside_2;
layout(binding = 10) uniform usamplerBuffer inside_3;

// Colours of visible surfaces, as square roots of linear colour.
layout(binding = 11) uniform sampler2D color_image;

// Transmittance of the clear bodies; in alpha, the standard deviation of the background's blur on the page.
layout(binding = 12, rgba32f) writeonly uniform image2D out_clear;
// Visible share of the background behind clear bodies.
layout(binding = 13, r16f) writeonly uniform image2D out_share;

uvec2 inside_at(int layer, int index)
{
    return layer == 0   ? texelFetch(inside_0, index).xy
           : layer == 1 ? texelFetch(inside_1, index).xy
           : layer == 2 ? texelFetch(inside_2, index).xy
                        : texelFetch(inside_3, index).xy;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    vec3 seen_behind = takes_light_in(word) ? behind_of(style_variant_of(word)) : vec3(0.0);
    float share = seen_behind.x;
    int index = pixel.y * int(frame.size_px.x) + pixel.x;
    vec2 middle_px = vec2(pixel) + 0.5;
    float end_depth = seen_depth(texelFetch(background, index).xy);
    vec3 absorbed = vec3(0.0);
    float blur_m = 0.0;
    uint entered = 0u; // parameter set of the body that the ray is in, plus 1; 0 outside all bodies
    float entered_depth = 0.0;
    float before_depth = 2.0;
    float pixel_m = 1.0;
    int i = 0;
    int layers = share > 0.0 ? 4 : 1;
    do {
        uvec2 seen = inside_at(i, index);
        // The layer may be missing; then its buffer is a copy of the last layer's buffer.
        bool is_there = share > 0.0 && sees_triangle(seen) && seen_depth(seen) < before_depth;
        float depth = is_there ? seen_depth(seen) : end_depth;
        bool is_behind = depth <= end_depth;
        uvec4 corners = triangle_at(is_there ? seen_triangle(seen) : 0u);
        vec3 a = posed_vertex_at(corners.x).position;
        vec3 b = posed_vertex_at(corners.y).position;
        vec3 c = posed_vertex_at(corners.z).position;
        vec3 flat_normal = cross(b - a, c - a) * ((corners.w & triangle_mirrored) != 0u ? -1.0 : 1.0);
        bool goes_in = is_there && !is_behind && dot(flat_normal, towards_eye(frame, a)) >= 0.0;
        bool goes_out = entered != 0u && is_there;
        uint style_variant = style_variant_of((corners.w & triangle_draw_mask) + 1u);
        float at_depth = max(depth, end_depth);
        vec3 there = anchor_at(frame, middle_px, max(at_depth, 1e-9));
        if (i == 0) {
            pixel_m = pixel_size_m(frame, there);
        }
        // If the ray enters a body again without an exit, the surface is a thin sheet.
        uint left = goes_out ? entered - 1u : style_variant;
        float inside_m = goes_in ? scatter_of(left).a
                                 : distance(there, anchor_at(frame, middle_px, max(entered_depth, 1e-9)));
        if (goes_out) {
            absorbed += light_through(left).rgb * inside_m;
            blur_m += behind_of(left).y * inside_m;
            entered = 0u;
        }
        if (goes_in) {
            entered = style_variant + 1u;
            entered_depth = depth;
        }
        before_depth = is_there ? seen_depth(seen) : -1.0;
        ++i;
    } while (i < layers);
    if (entered != 0u) {
        absorbed += light_through(entered - 1u).rgb * scatter_of(entered - 1u).a;
        blur_m += behind_of(entered - 1u).y * scatter_of(entered - 1u).a;
    }
    vec3 color = texelFetch(color_image, pixel, 0).rgb;
    vec3 tint = mix(vec3(1.0), color * color, seen_behind.z);
    imageStore(out_clear, pixel, vec4(tint * exp(-absorbed), blur_m / pixel_m));
    imageStore(out_share, pixel, vec4(share));
}
