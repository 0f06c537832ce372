// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_LOOKS
#define ESTAMPE_LINE_LOOKS

// Lines of each style variant, see LineLook. Requires before inclusion: LINE_LOOKS_BINDING.
layout(binding = LINE_LOOKS_BINDING) uniform usamplerBuffer line_look_texels;

uint line_look_word(uint look, uint word)
{
    return texelFetch(line_look_texels, int(16u * look + word)).x;
}

/// In pixels, or in metres if the kind's bit in metre_kinds is set.
float look_width_of(uint look, uint kind)
{
    return uintBitsToFloat(line_look_word(look, kind));
}

bool is_in_metres(uint look, uint kind)
{
    return (line_look_word(look, line_kind_count) >> kind & 1u) != 0u;
}

vec3 ink_of(uint look)
{
    return vec3(uintBitsToFloat(line_look_word(look, line_kind_count + 1u)),
                uintBitsToFloat(line_look_word(look, line_kind_count + 2u)),
                uintBitsToFloat(line_look_word(look, line_kind_count + 3u)));
}

#endif
