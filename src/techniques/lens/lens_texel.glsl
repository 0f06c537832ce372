// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LENS_TEXEL
#define ESTAMPE_LENS_TEXEL

// The packed texel that the lens passes exchange: the layers of a pixel and the pixel's blur. The including
// shader must declare `constants` and `variant`.

#include "shaders/layer_sample.glsl"

struct LensTexel {
    LayerSample layers;
    float radius_px; // radius of the circle of confusion; negative in front of the plane in focus
    float part;      // part of the texel's area that the surface covers
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

// Size of the drawn image, extended to whole blocks of the page.
ivec2 padded_px()
{
    ivec2 size = ivec2(constants.size_px + constants.pad_px + lens_block_px - 1u);
    return size - size % int(lens_block_px);
}

// Position of a mip level in the image that holds all levels: the first mip level is at the top, all further
// levels are side by side below the first level.
ivec2 level_origin(int level)
{
    ivec2 padded = padded_px();
    return level == 1 ? ivec2(0) : ivec2((padded.x >> 1) - (padded.x >> (level - 1)), padded.y >> 1);
}

ivec2 level_size(int level)
{
    return padded_px() >> level;
}

// Share of a surface that belongs to the near field (surfaces in front of the focus, which blur over
// everything behind the near surfaces).
float near_share(float radius_px)
{
    return smoothstep(lens_nearly_px, lens_blurred_px, -radius_px);
}

float far_share(float radius_px)
{
    return smoothstep(lens_nearly_px, lens_blurred_px, radius_px);
}

// Radius of a disc blur over texels that are means of squares of pixels. The means already blur a little, so
// the radius is reduced.
float disc_texels(float radius_texels)
{
    return sqrt(max(radius_texels * radius_texels - 0.67, 0.25));
}

// Distance of a sampled texel from the centre of the blur. The distance is scaled so that a polygonal
// aperture can be treated as a disc.
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

// Share of a texel's light that falls on a place at distance `away`, if the light is spread over a disc of
// radius `radius`. Both lengths are in texels.
float disc_share(float radius, float away)
{
    return clamp(radius + 0.5 - away, 0.0, 1.0) / (3.14159265 * (radius * radius + 1.0 / 12.0));
}

#endif
