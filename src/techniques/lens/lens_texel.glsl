// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LENS_TEXEL
#define ESTAMPE_LENS_TEXEL

// What the lens' passes hand on of a place. Whoever includes this has `constants`, and `variant`.

#include "shaders/layer_sample.glsl"

struct LensTexel {
    LayerSample layers;
    float radius_px; // of the circle of confusion; below 0 before the plane in focus
    float part;      // of the texel's area that is taken
};

uvec4 pack_texel(LensTexel t)
{
    return pack_sample(t.layers, packHalf2x16(vec2(t.radius_px, t.part)));
}

LensTexel unpack_texel(uvec4 packed)
{
    vec2 rest = unpackHalf2x16(packed.w);
    return LensTexel(unpack_sample(packed), rest.x, rest.y);
}

// Of the drawn pixels and of what lies before them up to the corner of a block, in whole blocks.
ivec2 padded_px()
{
    ivec2 size = ivec2(constants.size_px + constants.pad_px + lens_block_px - 1u);
    return size - size % int(lens_block_px);
}

// Levels lie in one image: the first above, the others side by side below it.
ivec2 level_origin(int level)
{
    ivec2 padded = padded_px();
    return level == 1 ? ivec2(0) : ivec2((padded.x >> 1) - (padded.x >> (level - 1)), padded.y >> 1);
}

ivec2 level_size(int level)
{
    return padded_px() >> level;
}

// How much something is of the near field, which is spread over what lies behind it, or of the far one.
float near_share(float radius_px)
{
    return smoothstep(lens_nearly_px, lens_blurred_px, -radius_px);
}

float far_share(float radius_px)
{
    return smoothstep(lens_nearly_px, lens_blurred_px, radius_px);
}

// Of a blur of a disc that is gathered from squares which are themselves means: what is left to it.
float disc_texels(float radius_texels)
{
    return sqrt(max(radius_texels * radius_texels - 0.67, 0.25));
}

// How far a tap lies from the middle of an aperture, where a disc counts by its radius.
float aperture_distance(vec2 offset)
{
    float away = sqrt(dot(offset, offset));
    if ((variant & lens_has_blades) != 0u) {
        float turn = atan(offset.y, offset.x) + constants.blade_turn_rad;
        turn -= constants.blade_rad * floor(turn / constants.blade_rad);
        away *= cos(turn - 0.5 * constants.blade_rad) * constants.blade_scale;
    }
    return away;
}

// How much of the light of a tap falls on a place `away` from it, both in texels.
float disc_share(float radius, float away)
{
    return clamp(radius + 0.5 - away, 0.0, 1.0) / (3.14159265 * (radius * radius + 1.0 / 12.0));
}

#endif
