// SPDX-License-Identifier: MIT
// One thread inks one pixel with the pieces of line near it, antialiased by distance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "shaders/scene.glsl.h"
#include "techniques/contour/contour.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D nearest_image;
layout(binding = 1) uniform sampler2D seed_image;
layout(binding = 2) uniform usampler2D draw_image;

#define DRAW_TEXELS_BINDING 3
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 4
#include "shaders/material_texels.glsl"

// The ink layer: square root of the ink's linear colour in rgb, coverage in alpha.
layout(binding = 5, rgba8) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    StrokeConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_own_outlines = (variant & stroke_has_own_outlines) != 0u;

const float half_piece_px = 0.75;

float piece_coverage(vec2 position, ivec2 seed_pixel)
{
    vec4 seed = texelFetch(seed_image, seed_pixel, 0);
    vec2 away = position - (vec2(seed_pixel) + 0.5 + seed.xy);
    float half_width = max(length(seed.zw), 1e-4);
    vec2 direction = seed.zw / half_width;
    float along = clamp(dot(away, direction), -half_piece_px, half_piece_px);
    float distance = length(away - along * direction);
    // A line thinner than a pixel is drawn one pixel wide and lighter.
    return clamp(max(half_width, 0.5) + 0.5 - distance, 0.0, 1.0) * min(half_width / 0.5, 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(constants.width, constants.height);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec2 position = vec2(pixel) + 0.5;
    float ink = 0.0;
    uint inked_by = no_seed;
    uint own = texelFetch(nearest_image, pixel, 0).x;
    float own_distance = distance(vec2(pixel), vec2(own & 0xffffu, own >> 16));
    if (own != no_seed && own_distance <= constants.reach_px + 2.5) {
        // The seed (short piece of line) in the nearest pixel may have an exact position that is not the
        // nearest. So the seeds of neighbouring pixels are tested too.
        for (int i = 0; i < 5; ++i) {
            ivec2 neighbour = ivec2(i == 1 ? 1 : i == 2 ? -1 : 0, i == 3 ? 1 : i == 4 ? -1 : 0);
            uint seed = texelFetch(nearest_image, clamp(pixel + neighbour, ivec2(0), size - 1), 0).x;
            if (seed != no_seed) {
                float piece = piece_coverage(position, ivec2(seed & 0xffffu, seed >> 16));
                inked_by = piece > ink ? seed : inked_by;
                ink = max(ink, piece);
            }
        }
    }
    vec3 color = constants.ink_color;
    // The outline belongs to a surface that is seen at the seed's pixel, or at the next pixel to the right or
    // below.
    for (int i = 0; has_own_outlines && inked_by != no_seed && i < 3; ++i) {
        ivec2 at = ivec2(inked_by & 0xffffu, inked_by >> 16) + ivec2(i & 1, i >> 1);
        uint word = texelFetch(draw_image, min(at, size - 1), 0).x;
        uint material = sees_draw(word) ? draw_at(draw_of(word)).material : 0u;
        if (sees_draw(word) && outline_width_m_of(material) > 0.0) {
            color = outline_color_of(material);
        }
    }
    imageStore(out_ink, pixel, vec4(sqrt(color), ink));
}
