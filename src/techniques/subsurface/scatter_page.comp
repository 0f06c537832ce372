// SPDX-License-Identifier: MIT
// One thread per pixel of the listed squares adds transmitted and scattered light to the light that stays in
// place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/color.glsl"
#include "shaders/frame.glsl.h"
#include "techniques/subsurface/subsurface.glsl.h"

layout(local_size_x = scatter_square_px, local_size_y = scatter_square_px) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D sum_image;
layout(binding = 4) uniform sampler2D through_image;

#define PARAMETERS_BINDING 5
#define HAS_VARIANTS ((variant & subsurface_has_variants) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/parameters.glsl"
const bool shines = (variant & subsurface_shines) != 0u;
const bool spreads = (variant & subsurface_spreads) != 0u;
const bool looks_less = (variant & subsurface_looks_less) != 0u;
const bool in_perspective = (variant & subsurface_in_perspective) != 0u;

layout(binding = 7, rgba16f) uniform image2D light;

#define TILE_LIST_BINDING 8
#include "shaders/tile_list.glsl"

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

#include "techniques/subsurface/scatter.glsl"

const float most_light = 65504.0; // largest number that a half float can hold
// Least weight of a sample of the half page (every second pixel), so that a feature too thin for the half
// page takes transmitted light from its neighbours.
const float least_near = 1e-4;

void main()
{
    // If a square of the page were twice in the list, the square would get its light twice.
    ivec2 pixel =
        has_listed_tile() ? ivec2(listed_from_px() + gl_LocalInvocationID.xy) : ivec2(frame.size_px);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    uint style_variant = style_variant_of(word);
    bool takes = takes_light_in(word);
    vec3 scatter_m = spreads && takes ? scatter_of(style_variant).rgb : vec3(0.0);
    float ahead = ahead_at(vec2(pixel) + 0.5, texelFetch(depth_image, pixel, 0).x, in_perspective);
    float pixel_m = pixel_m_at(ahead);
    vec3 spread_px = spread_px_of(scatter_m, pixel_m);
    bool scatters = !holds_all(kept_below_px(), max(max(spread_px.r, spread_px.g), spread_px.b));
    bool is_shone_through = shines && takes && light_through(style_variant).a > 0.0;
    float tolerance_m = max(4.0 * pixel_m, max(max(scatter_m.x, scatter_m.y), scatter_m.z));
    float per_variance = -0.5 / max(tolerance_m * tolerance_m, 1e-12);
    // Pixels of the half page (every second pixel) lie at the middle of four page pixels. Transmitted light
    // was computed at the first of the four page pixels.
    uvec2 on_page = uvec2(pixel) + frame.tile_from_px;
    vec2 place = 0.5 * vec2(on_page) - 0.25 - vec2(constants.from_half);
    ivec2 first = ivec2(floor(place));
    vec2 between = place - vec2(first);
    vec2 off_first = 0.5 * vec2(on_page & 1u);
    vec4 sum = vec4(0.0);
    vec4 through = vec4(0.0);
    int i = 0;
    int corners = scatters || is_shone_through || !looks_less ? 4 : 1;
    do {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 looked = first + corner;
        ivec2 held = clamp(looked, ivec2(0), ivec2(constants.half_px) - 1);
        vec4 other = texelFetch(sum_image, held, 0);
        vec4 shone = shines ? texelFetch(through_image, held, 0) : vec4(vec3(0.0), takes_light_about);
        float off = min(abs(other.w - ahead), 1e15);
        float near = is_on_half_page(looked) ? exp(max(per_variance * off * off, -40.0)) : 0.0;
        if (spreads) {
            vec2 bilinear = mix(1.0 - between, between, vec2(corner));
            float share = shone.w >= takes_light_about ? bilinear.x * bilinear.y * near : 0.0;
            sum += share * vec4(other.rgb, 1.0);
        }
        if (shines) {
            vec2 bilinear = mix(off_first, 1.0 - off_first, vec2(corner));
            bool is_shone = shone.w == takes_light_through || shone.w > takes_light_about;
            float share = is_shone && is_on_half_page(looked) ? max(near, least_near) : 0.0;
            through += share * bilinear.x * bilinear.y * vec4(shone.rgb, 1.0);
        }
        ++i;
    } while (i < corners);
    scatters = scatters && sum.w > 1e-6;
    vec3 more = is_shone_through && through.w > 0.0 ? through.rgb / through.w : vec3(0.0);
    if (!scatters && more == vec3(0.0)) {
        return;
    }
    vec3 mixed = imageLoad(light, pixel).rgb + more;
    if (scatters) {
        mixed = share_up_to(kept_below_px(), spread_px) * mixed + sum.rgb / sum.w;
    }
    mixed = min(mixed, vec3(most_light));
    imageStore(light, pixel, vec4(mixed, luminance(mixed)));
}
