// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VARIANT_LINES
#define ESTAMPE_VARIANT_LINES

// Lines of each style variant, see VariantLines. Requires before inclusion: VARIANT_LINES_BINDING.
layout(binding = VARIANT_LINES_BINDING) uniform usamplerBuffer variant_line_texels;

uint variant_line_word(uint style_variant, uint word)
{
    return texelFetch(variant_line_texels, int(16u * style_variant + word)).x;
}

/// In pixels, or in metres if the kind's bit in metre_kinds is set.
float variant_width_of(uint style_variant, uint kind)
{
    return uintBitsToFloat(variant_line_word(style_variant, kind));
}

bool is_in_metres(uint style_variant, uint kind)
{
    return (variant_line_word(style_variant, line_kind_count) >> kind & 1u) != 0u;
}

vec3 ink_of(uint style_variant)
{
    return vec3(uintBitsToFloat(variant_line_word(style_variant, line_kind_count + 1u)),
                uintBitsToFloat(variant_line_word(style_variant, line_kind_count + 2u)),
                uintBitsToFloat(variant_line_word(style_variant, line_kind_count + 3u)));
}

#endif
