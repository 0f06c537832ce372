// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAYER_SAMPLE
#define ESTAMPE_LAYER_SAMPLE

// The layers of a drawing at one place, in a form in which samples may be added. Samples are blurred in this
// form: the blurred layers, composited on paper, give the blurred picture with sharp paper.

struct LayerSample {
    // Paint that is not hidden by ink; in w, ink of strokes that is not hidden by contour lines.
    vec4 paint;
    vec4 lines; // premultiplied colour of contour lines, and their coverage
};

const LayerSample no_sample = LayerSample(vec4(0.0), vec4(0.0));

LayerSample scaled(LayerSample layers, float by)
{
    return LayerSample(layers.paint * by, layers.lines * by);
}

LayerSample sum_of(LayerSample a, LayerSample b)
{
    return LayerSample(a.paint + b.paint, a.lines + b.lines);
}

// Combines paint, the ink of strokes over it, and contour lines over both into one sample. Colours of lines
// are given as square roots.
LayerSample sample_of_layers(vec3 paint, float hatch, vec4 lines)
{
    float shown = 1.0 - lines.a;
    return LayerSample(vec4(paint * ((1.0 - hatch) * shown), hatch * shown),
                       vec4(lines.rgb * lines.rgb * lines.a, lines.a));
}

// Splits a sample into the layers paint, strokes and lines. Where ink hides the paint completely, the paint
// is `paint_below`.
void layers_of_sample(LayerSample layers, vec3 paint_below, out vec3 paint, out float hatch, out vec4 lines)
{
    float cover = clamp(layers.lines.a, 0.0, 1.0);
    hatch = clamp(layers.paint.a / max(1.0 - cover, 1e-4), 0.0, 1.0);
    float bare = (1.0 - cover) * (1.0 - hatch);
    paint = bare > 2e-3 ? layers.paint.rgb / max(bare, 1e-3) : paint_below;
    lines = vec4(sqrt(layers.lines.rgb / max(cover, 1e-4)), cover);
}

// Packs a sample of layers into three words; the fourth word is `rest`.
uvec4 pack_sample(LayerSample layers, uint rest)
{
    return uvec4(packHalf2x16(layers.paint.xy), packHalf2x16(layers.paint.zw),
                 packUnorm4x8(vec4(sqrt(layers.lines.rgb), layers.lines.a)), rest);
}

LayerSample unpack_sample(uvec4 packed)
{
    vec4 lines = unpackUnorm4x8(packed.z);
    return LayerSample(vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y)),
                       vec4(lines.rgb * lines.rgb, lines.a));
}

#endif
