// SPDX-License-Identifier: MIT
// One thread writes the blurred colour and ink of one pixel back to the layers. Sharp pixels are unchanged.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D wash_image;
layout(binding = 1) uniform sampler2D hatch_image;
layout(binding = 2) uniform sampler2D line_image;
layout(binding = 3) uniform sampler2D sky_ink_image;
layout(binding = 4) uniform usampler2D page_image;
// Near field (surfaces in front of the focus); the whole blurred page if lens_is_gathered is not set.
layout(binding = 5) uniform usampler2D near_image;
layout(binding = 6) uniform usampler2D far_image;
layout(binding = 7) uniform sampler2D reach_image;
layout(binding = 8, rgba16f) writeonly uniform image2D out_wash;
layout(binding = 9, r16f) writeonly uniform image2D out_hatch;
layout(binding = 10, rgba8) writeonly uniform image2D out_lines;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_sky = (variant & lens_has_sky) != 0u;
const bool is_wash_only = (variant & lens_wash_only) != 0u;
const bool is_gathered = (variant & lens_is_gathered) != 0u;
const bool shows_circles = (variant & lens_shows_circles) != 0u;

#include "techniques/lens/lens_texel.glsl"
#include "shaders/layers.glsl"

// The layers that a pixel shows, and whether neighbouring pixels contribute to the layers.
struct Seen {
    LayerSample layers;
    bool is_blurred;
};

const int small_side = 3;

// Blurs a nearly sharp pixel by reading the page's pixels.
Seen nearly_sharp(ivec2 pixel, LensTexel own, float reach_px)
{
    float own_radius = abs(own.radius_px);
    bool is_wanted = own_radius < lens_blurred_px && reach_px > lens_sharp_px;
    int rows = is_wanted ? small_side : 0;
    LayerSample sum = no_sample;
    float weights = 0.0;
    float others = 0.0;
    for (int row = 0; row < rows; ++row) {
        [[unroll]] for (int column = 0; column < small_side; ++column)
        {
            ivec2 aside = ivec2(column, row) - small_side / 2;
            ivec2 at = pixel + aside;
            bool is_there =
                all(greaterThanEqual(at, ivec2(0))) && all(lessThan(uvec2(at), constants.size_px));
            LensTexel tap =
                unpack_texel(texelFetch(page_image, clamp(at, ivec2(0), ivec2(constants.size_px) - 1), 0));
            // The blur of a surface behind the pixel's surface is limited to the pixel's own blur circle.
            bool is_behind = tap.radius_px > own.radius_px;
            float radius = is_behind ? min(abs(tap.radius_px), own_radius) : abs(tap.radius_px);
            float share = disc_share(max(radius, lens_sharp_px), aperture_distance(vec2(aside)));
            float weight =
                is_there ? share * (aside == ivec2(0) ? 1.0 : 1.0 - near_share(tap.radius_px)) : 0.0;
            sum = sum_of(sum, scaled(tap.layers, weight));
            weights += weight;
            others += aside == ivec2(0) ? 0.0 : weight;
        }
    }
    bool is_blurred = others > 0.0;
    return Seen(is_blurred ? scaled(sum, 1.0 / max(weights, 1e-6)) : own.layers, is_blurred);
}

// Bilinear lookup in the image of the near field (surfaces in front of the focus) or of the far field. In the
// near field, radius_px of the result is the field's coverage.
LensTexel between(usampler2D field_image, ivec2 pixel, bool is_wanted)
{
    vec2 place = 0.5 * (vec2(pixel + ivec2(constants.pad_px)) + 0.5) - 0.5;
    ivec2 corner = ivec2(floor(place));
    vec2 part = place - vec2(corner);
    ivec2 most = level_size(1) - 1;
    LensTexel sum = LensTexel(no_sample, 0.0, 1.0);
    // A loop replaces an `if` here, because CPU drivers execute both branches of an `if`.
    int rounds = is_wanted ? 1 : 0;
    for (int round = 0; round < rounds; ++round) {
        [[unroll]] for (int i = 0; i < 4; ++i)
        {
            ivec2 aside = ivec2(i & 1, i >> 1);
            vec2 side = mix(1.0 - part, part, vec2(aside));
            float weight = side.x * side.y;
            LensTexel texel = unpack_texel(texelFetch(field_image, clamp(corner + aside, ivec2(0), most), 0));
            sum.layers = sum_of(sum.layers, scaled(texel.layers, weight));
            sum.radius_px += weight * texel.radius_px;
        }
    }
    return sum;
}

Seen gathered(ivec2 pixel, LensTexel own)
{
    vec2 reach = texelFetch(reach_image, (pixel + ivec2(constants.pad_px)) / int(lens_tile_px), 0).xy;
    float own_radius = abs(own.radius_px);
    Seen seen = nearly_sharp(pixel, own, max(reach.y, own_radius));
    float far = smoothstep(lens_nearly_px, lens_blurred_px, own_radius);
    LensTexel near_field = between(near_image, pixel, reach.x > lens_nearly_px);
    LensTexel far_field = between(far_image, pixel, far > 0.0);
    float cover = near_field.radius_px;
    LayerSample behind = sum_of(scaled(seen.layers, 1.0 - far), scaled(far_field.layers, far));
    LayerSample sample_here = sum_of(scaled(behind, 1.0 - cover), near_field.layers);
    return Seen(sample_here, seen.is_blurred || far > 0.0 || cover > 0.0);
}

// Colour that shows the radius of the blur circle: blue behind the plane in focus, red in front of the plane,
// white in focus.
vec3 circle_color(float radius_px)
{
    float share = clamp(abs(radius_px) / max(constants.most_px, 1e-6), 0.0, 1.0);
    return mix(vec3(1.0), radius_px < 0.0 ? vec3(0.7, 0.1, 0.05) : vec3(0.05, 0.15, 0.6), sqrt(share));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    Layers layers = layers_at(pixel);
    LensTexel own = unpack_texel(texelFetch(page_image, pixel, 0));
    if (shows_circles) {
        imageStore(out_wash, pixel, vec4(circle_color(own.radius_px), layers.wash.a));
        imageStore(out_hatch, pixel, vec4(0.0));
        imageStore(out_lines, pixel, vec4(0.0));
        return;
    }
    Seen seen;
    if (is_gathered) {
        seen = gathered(pixel, own);
    } else {
        seen = Seen(unpack_sample(texelFetch(near_image, pixel, 0)), abs(own.radius_px) > lens_sharp_px);
    }
    vec4 wash = layers.wash;
    float hatch;
    vec4 line;
    layers_of_sample(seen.layers, layers.wash.rgb, wash.rgb, hatch, line);
    imageStore(out_wash, pixel, seen.is_blurred ? wash : layers.wash);
    if (!is_wash_only) {
        imageStore(out_hatch, pixel, vec4(seen.is_blurred ? hatch : layers.hatch));
        imageStore(out_lines, pixel, seen.is_blurred ? line : layers.lines);
    }
}
