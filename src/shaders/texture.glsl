// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TEXTURE
#define ESTAMPE_TEXTURE

#include "shaders/scene.glsl.h"

// Texture lookup. Textures are layers of array images, one per class of sizes. The including shader declares
// `sampler2DArray texture_class_0` to `_4`, and TEXTURE_CLASSES, the specialization bits of the classes that
// contain textures. CPUs execute every branch that remains, so branches of unused classes are removed.

// Texture coordinate after the wrap mode. The sampler repeats textures. In the wrap modes clamp and mirror,
// coordinates must keep half a texel away from the border; otherwise the filter would read across the border.
float wrap_coordinate(float x, uint mode, float half_texel)
{
    if (mode == 0u) {
        return x;
    }
    float inside = mode == 2u ? 1.0 - abs(1.0 - 2.0 * fract(0.5 * x)) : x;
    return clamp(inside, half_texel, 1.0 - half_texel);
}

uint uv_set_of(TextureSlot slot)
{
    return (slot.location >> 24) & 1u;
}

struct UvFootprint {
    vec2 uv;
    vec2 dx; // change of the texture coordinate per pixel to the right
    vec2 dy; // change of the texture coordinate per pixel down
};

UvFootprint transform_uv(TextureSlot slot, UvFootprint f)
{
    mat2 linear = mat2(slot.column_u, slot.column_v);
    return UvFootprint(linear * f.uv + slot.offset, linear * f.dx, linear * f.dy);
}

// Place of a texel in an array image. `texel_uv` is the size of a texel of the sampled mip level.
vec3 texture_place(TextureSlot slot, vec2 uv, float texel_uv)
{
    float half_texel = min(0.5 * texel_uv, 0.5);
    return vec3(wrap_coordinate(uv.x, (slot.location >> 25) & 3u, half_texel),
                wrap_coordinate(uv.y, (slot.location >> 27) & 3u, half_texel),
                float((slot.location >> 4) & 0xfffffu));
}

vec4 sample_texture(TextureSlot slot, UvFootprint footprint)
{
    UvFootprint f = transform_uv(slot, footprint);
    uint size_class = slot.location & 15u;
    // Texel size of the sampled mip level, which is about the size of the pixel's footprint.
    float texel_uv = max(1.0 / float(256u << size_class), max(length(f.dx), length(f.dy)));
    vec3 place = texture_place(slot, f.uv, texel_uv);
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
