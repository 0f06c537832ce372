// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_INK
#define ESTAMPE_LINE_INK

#include "shaders/lines.glsl"

// Ink of one family of lines at a pixel whose darkness is `dark`, box-filtered over the pixel.
float line_ink(LineField field, LineLook look, float dark, uint seed)
{
    float g = max(field.v_per_px, 1e-12f);
    DrawnLines drawn = drawn_lines(field, look, dark);
    // The lines that may touch the pixel: no more than four, since they keep apart.
    float reach =
        0.5f * drawn.lines.width * (1.0f + drawn.scale.pressure) + g * (1.15f * drawn.scale.wobble_px + 0.5f);
    int first = int(ceil(2.0f * (field.v - reach) / drawn.lines.spacing));
    int last = min(int(floor(2.0f * (field.v + reach) / drawn.lines.spacing)), first + 3);
    float ink = 0.0f;
    for (int i = first;; ++i) {
        uint identity = line_identity(field, drawn.lines, i, seed);
        float width = drawn_width(field, look, drawn, i, identity);
        float at = 0.5f * float(i) * drawn.lines.spacing + g * wobble(field, drawn.scale, identity);
        float low = max(at - 0.5f * width, field.v - 0.5f * g);
        float high = min(at + 0.5f * width, field.v + 0.5f * g);
        ink += i <= last ? max(high - low, 0.0f) : 0.0f;
        if (i >= last) {
            break;
        }
    }
    return dark > 0.0f ? min(ink / g, 1.0f) : 0.0f;
}

#endif
