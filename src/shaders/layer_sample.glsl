// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAYER_SAMPLE
#define ESTAMPE_LAYER_SAMPLE

// What lies on the paper at a place, in parts that may be added: blurred so, layers on paper are the picture
// blurred, and the paper is not.

struct LayerSample {
    vec4 paint; // what the paint lets through beside the ink; ink of strokes beside lines
    vec4 lines; // colour of lines times their cover; their cover
};

const LayerSample no_sample = LayerSample(vec4(0.0), vec4(0.0));

LayerSample scaled(LayerSample sample_here, float by)
{
    return LayerSample(sample_here.paint * by, sample_here.lines * by);
}

LayerSample sum_of(LayerSample a, LayerSample b)
{
    return LayerSample(a.paint + b.paint, a.lines + b.lines);
}

// Of paint, ink of strokes over it, and lines over both: roots of their colour, and cover.
LayerSample sample_of_layers(vec3 paint, float hatch, vec4 lines)
{
    float shown = 1.0 - lines.a;
    return LayerSample(vec4(paint * ((1.0 - hatch) * shown), hatch * shown),
                       vec4(lines.rgb * lines.rgb * lines.a, lines.a));
}

// And back: paint where ink leaves any, else `paint_below`.
void layers_of_sample(LayerSample sample_here, vec3 paint_below, out vec3 paint, out float hatch,
                      out vec4 lines)
{
    float cover = clamp(sample_here.lines.a, 0.0, 1.0);
    hatch = clamp(sample_here.paint.a / max(1.0 - cover, 1e-4), 0.0, 1.0);
    float bare = (1.0 - cover) * (1.0 - hatch);
    paint = bare > 2e-3 ? sample_here.paint.rgb / max(bare, 1e-3) : paint_below;
    lines = vec4(sqrt(sample_here.lines.rgb / max(cover, 1e-4)), cover);
}

// In three words; the fourth is free.
uvec4 pack_sample(LayerSample sample_here, uint rest)
{
    return uvec4(packHalf2x16(sample_here.paint.xy), packHalf2x16(sample_here.paint.zw),
                 packUnorm4x8(vec4(sqrt(sample_here.lines.rgb), sample_here.lines.a)), rest);
}

LayerSample unpack_sample(uvec4 packed)
{
    vec4 lines = unpackUnorm4x8(packed.z);
    return LayerSample(vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y)),
                       vec4(lines.rgb * lines.rgb, lines.a));
}

#endif
