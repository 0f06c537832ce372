// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TEXTURE
#define ESTAMPE_TEXTURE

#include "shaders/material.glsl.h"

// Texture look-up through size classes. The including shader declares `sampler2DArray texture_class_0` to `_4`, and
// TEXTURE_CLASSES, the specialization bits of those that hold anything: a processor runs every branch that is left in.

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
    uint size_class = slot.location & 15u;
    vec4 texel = vec4(1.0);
    if ((TEXTURE_CLASSES & 1u) != 0u && size_class == 0u) {
        texel = textureGrad(texture_class_0, place, f.dx, f.dy);
    }
    if ((TEXTURE_CLASSES & 2u) != 0u && size_class == 1u) {
        texel = textureGrad(texture_class_1, place, f.dx, f.dy);
    }
    if ((TEXTURE_CLASSES & 4u) != 0u && size_class == 2u) {
        texel = textureGrad(texture_class_2, place, f.dx, f.dy);
    }
    if ((TEXTURE_CLASSES & 8u) != 0u && size_class == 3u) {
        texel = textureGrad(texture_class_3, place, f.dx, f.dy);
    }
    if ((TEXTURE_CLASSES & 16u) != 0u && size_class == 4u) {
        texel = textureGrad(texture_class_4, place, f.dx, f.dy);
    }
    return texel;
}

#endif
