// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VARIANT_LINES
#define ESTAMPE_VARIANT_LINES

// Widths and inks of lines for each style variant (the style of certain materials or objects), see
// VariantLines. Requires before inclusion: VARIANT_LINES_BINDING.
layout(binding = VARIANT_LINES_BINDING) uniform usamplerBuffer variant_line_texels;

uint variant_line_word(uint style_variant, uint word)
{
    return texelFetch(variant_line_texels, int(variant_lines_words * style_variant + word)).x;
}

/// Full width of a kind of line in a style variant (the style of certain materials or objects): in metres if
/// the kind's bit in `metre_kinds` is set, else in pixels.
float variant_width_of(uint style_variant, uint kind)
{
    return uintBitsToFloat(variant_line_word(style_variant, kind));
}

bool is_in_metres(uint style_variant, uint kind)
{
    return (variant_line_word(style_variant, line_kind_count) >> kind & 1u) != 0u;
}

/// Colour of an ink number that has the bit ink_of_variant, see LinePoint::ink.
vec3 ink_color_of(uint ink)
{
    uint kind = line_kind_count - 1u - ((ink & ~ink_of_variant) >> ink_kind_shift);
    uint style_variant = ink & (most_ink_variants - 1u);
    uint first = line_kind_count + 1u + 3u * kind;
    return vec3(uintBitsToFloat(variant_line_word(style_variant, first)),
                uintBitsToFloat(variant_line_word(style_variant, first + 1u)),
                uintBitsToFloat(variant_line_word(style_variant, first + 2u)));
}

#endif
