// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VEIL
#define ESTAMPE_VEIL

// What lies on the paper at a place, in parts that may be added: blurred so, layers on paper are the picture
// blurred, and the paper is not.

struct Veil {
    vec4 paint; // what the paint lets through beside the ink; ink of strokes beside lines
    vec4 lines; // colour of lines times their cover; their cover
};

const Veil no_veil = Veil(vec4(0.0), vec4(0.0));

Veil scaled(Veil veil, float by)
{
    return Veil(veil.paint * by, veil.lines * by);
}

Veil sum_of(Veil a, Veil b)
{
    return Veil(a.paint + b.paint, a.lines + b.lines);
}

// Of paint, ink of strokes over it, and lines over both: roots of their colour, and cover.
Veil veil_of(vec3 paint, float hatch, vec4 lines)
{
    float shown = 1.0 - lines.a;
    return Veil(vec4(paint * ((1.0 - hatch) * shown), hatch * shown),
                vec4(lines.rgb * lines.rgb * lines.a, lines.a));
}

// And back: paint where ink leaves any, else `paint_below`.
void unveil(Veil veil, vec3 paint_below, out vec3 paint, out float hatch, out vec4 lines)
{
    float cover = clamp(veil.lines.a, 0.0, 1.0);
    hatch = clamp(veil.paint.a / max(1.0 - cover, 1e-4), 0.0, 1.0);
    float bare = (1.0 - cover) * (1.0 - hatch);
    paint = bare > 2e-3 ? veil.paint.rgb / max(bare, 1e-3) : paint_below;
    lines = vec4(sqrt(veil.lines.rgb / max(cover, 1e-4)), cover);
}

// In three words; the fourth is free.
uvec4 pack_veil(Veil veil, uint rest)
{
    return uvec4(packHalf2x16(veil.paint.xy), packHalf2x16(veil.paint.zw),
                 packUnorm4x8(vec4(sqrt(veil.lines.rgb), veil.lines.a)), rest);
}

Veil unpack_veil(uvec4 packed)
{
    vec4 lines = unpackUnorm4x8(packed.z);
    return Veil(vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y)),
                vec4(lines.rgb * lines.rgb, lines.a));
}

#endif
