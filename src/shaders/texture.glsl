// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TEXTURE
#define ESTAMPE_TEXTURE

#include "shaders/material.glsl.h"

// Texture look-up through size classes. The including shader declares `sampler2DArray texture_class_0` to `_4`.

float wrap_coordinate(float x, uint mode)
{
    if (mode == 1u) {
        return clamp(x, 0.0, 1.0);
    }
    if (mode == 2u) {
        return 1.0 - abs(1.0 - 2.0 * fract(0.5 * x));
    }
    return x; // the sampler repeats
}

struct UvFootprint {
    vec2 uv;
    vec2 dx; // change over one pixel to the right
    vec2 dy; // and down
};

UvFootprint transform_uv(TextureSlot slot, UvFootprint f)
{
    mat2 linear = mat2(slot.column_u, slot.column_v);
    return UvFootprint(linear * f.uv + slot.offset, linear * f.dx, linear * f.dy);
}

vec4 sample_texture(TextureSlot slot, UvFootprint footprint)
{
    UvFootprint f = transform_uv(slot, footprint);
    vec3 place = vec3(wrap_coordinate(f.uv.x, (slot.location >> 25) & 3u),
                      wrap_coordinate(f.uv.y, (slot.location >> 27) & 3u), float((slot.location >> 4) & 0xfffffu));
    switch (slot.location & 15u) {
    case 0u:
        return textureGrad(texture_class_0, place, f.dx, f.dy);
    case 1u:
        return textureGrad(texture_class_1, place, f.dx, f.dy);
    case 2u:
        return textureGrad(texture_class_2, place, f.dx, f.dy);
    case 3u:
        return textureGrad(texture_class_3, place, f.dx, f.dy);
    default:
        return textureGrad(texture_class_4, place, f.dx, f.dy);
    }
}

#endif
