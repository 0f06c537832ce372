// SPDX-License-Identifier: MIT
// Finds where the strokes at a pixel come from, if strokes run over silhouettes. Requires before inclusion:
// darkness_image, draw_image, has_overrun, source_image as written by overrun.comp, and OVERRUN_PX.

// The pixel whose strokes are drawn at `pixel`: the pixel itself, or a nearby pixel with strokes that run
// over onto blank paper. `share` becomes the part of that pixel's darkness that is drawn at `pixel`.
ivec2 source_of(ivec2 pixel, out float share)
{
    share = 1.0;
    if (!has_overrun || !is_paper(texelFetch(draw_image, pixel, 0).x) ||
        texelFetch(darkness_image, pixel, 0).x > 0.0) {
        return pixel;
    }
    uint source = texelFetch(source_image, pixel, 0).x;
    ivec2 at = ivec2(source & 0xffffu, source >> 16);
    float away = distance(vec2(pixel), vec2(at));
    share = source == no_source ? 0.0 : 1.0 - smoothstep(0.3, 1.0, away / OVERRUN_PX);
    return source == no_source ? pixel : at;
}
