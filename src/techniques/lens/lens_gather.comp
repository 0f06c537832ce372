// SPDX-License-Identifier: MIT
// One thread handles a block of 2 x 2 pixels. It gathers the near field (surfaces in front of the focus,
// which blur over the block) and the far field. Behind near surfaces, the far field is filled in from the
// surroundings of the near surfaces.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D level_image;
layout(binding = 1) uniform sampler2D reach_image;
// Near field (surfaces in front of the focus): sums of the layers. The member radius_px holds the field's
// coverage.
layout(binding = 2, rgba32ui) writeonly uniform uimage2D out_near;
layout(binding = 3, rgba32ui) writeonly uniform uimage2D out_far;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;

#include "techniques/lens/lens_texel.glsl"

const int tap_side = 7;
const float hidden_sharp = 0.15;

// The finest mip level on which the radius of the blur circle is at most three texels.
int level_for(float radius_px)
{
    return clamp(int(ceil(log2(max(radius_px, 1.0) / 3.0))), 1, int(lens_levels));
}

// A position on a mip level: the texel that contains it, and the offset from the texel's centre.
struct Place {
    int level;
    ivec2 texel;
    vec2 beside;
    float texels_per_px;
};

Place place_on(int level, ivec2 at)
{
    vec2 place = (vec2(at) + 0.5) / float(1 << (level - 1));
    ivec2 texel = ivec2(floor(place));
    return Place(level, texel, place - vec2(texel) - 0.5, 1.0 / float(1 << level));
}

struct Tap {
    LensTexel texel;
    vec2 offset; // vector from the sampled texel to the position, in texels of the mip level
    bool is_there;
};

Tap tap_at(Place place, ivec2 aside)
{
    ivec2 at = place.texel + aside;
    bool is_there = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, level_size(place.level)));
    ivec2 from = level_origin(place.level) + clamp(at, ivec2(0), level_size(place.level) - 1);
    Tap tap = Tap(unpack_texel(texelFetch(level_image, from, 0)), place.beside - vec2(aside), is_there);
    tap.texel.part = is_there ? tap.texel.part : 0.0;
    return tap;
}

LensTexel gather_near(ivec2 at, float own_px, float reach_px)
{
    Place place = place_on(level_for(reach_px), at);
    float own_texels = max(-own_px * place.texels_per_px, 0.5);
    float own_near = near_share(own_px);
    LayerSample sum = no_sample;
    float cover = 0.0;
    float seen = 0.0;
    float seen_near = 0.0;
    int rows = reach_px > lens_nearly_px ? tap_side : 0;
    for (int row = 0; row < rows; ++row) {
        [[unroll]] for (int column = 0; column < tap_side; ++column)
        {
            Tap tap = tap_at(place, ivec2(column, row) - tap_side / 2);
            float radius = disc_texels(-tap.texel.radius_px * place.texels_per_px);
            float away = aperture_distance(tap.offset);
            float near = near_share(tap.texel.radius_px) * tap.texel.part;
            float weight = near * disc_share(radius, away);
            sum = sum_of(sum, scaled(tap.texel.layers, weight));
            cover += weight;
            float within = clamp(own_texels + 0.5 - away, 0.0, 1.0) * tap.texel.part;
            seen += within;
            seen_near += within * near_share(tap.texel.radius_px);
        }
    }
    // A near surface that fills the whole blur circle hides everything behind the surface. The lower limit
    // prevents gaps from rounding.
    float hidden = min(max(cover, own_near * seen_near / max(seen, 1e-6)), 1.0);
    return LensTexel(scaled(sum, hidden / max(cover, 1e-6)), hidden, 1.0);
}

LensTexel gather_far(ivec2 at, LensTexel own, float own_reach_px)
{
    float own_near = near_share(own.radius_px);
    float own_far = far_share(own.radius_px);
    float search_px = max(abs(own.radius_px), 4.0);
    Place place = place_on(level_for(search_px), at);
    LayerSample sum = no_sample;
    float weights = 0.0;
    int rows = own_reach_px > lens_nearly_px ? tap_side : 0;
    for (int row = 0; row < rows; ++row) {
        [[unroll]] for (int column = 0; column < tap_side; ++column)
        {
            Tap tap = tap_at(place, ivec2(column, row) - tap_side / 2);
            float away = aperture_distance(tap.offset);
            float radius = disc_texels(min(tap.texel.radius_px, own.radius_px) * place.texels_per_px);
            float blurred = far_share(tap.texel.radius_px) * disc_share(radius, away);
            // The far field behind near surfaces is unknown. The hidden far field is filled in from far
            // texels if possible, otherwise from sharp texels.
            float far = far_share(tap.texel.radius_px);
            float sharp = hidden_sharp * (1.0 - far - near_share(tap.texel.radius_px));
            float beside = (far + own_near * sharp) / (1.0 + away * away * away * away);
            float weight = mix(beside, blurred, own_far) * tap.texel.part;
            sum = sum_of(sum, scaled(tap.texel.layers, weight));
            weights += weight;
        }
    }
    bool has_any = weights > 1e-5;
    return LensTexel(has_any ? scaled(sum, 1.0 / max(weights, 1e-6)) : own.layers, own.radius_px, 1.0);
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, level_size(1)))) {
        return;
    }
    LensTexel own = unpack_texel(texelFetch(level_image, at, 0));
    vec2 reach = texelFetch(reach_image, 2 * at / int(lens_tile_px), 0).xy;
    imageStore(out_near, at, pack_texel(gather_near(at, own.radius_px, reach.x)));
    imageStore(out_far, at, pack_texel(gather_far(at, own, reach.y)));
}
