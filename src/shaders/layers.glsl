// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAYERS
#define ESTAMPE_LAYERS

// The layers of a drawing before they are composited on paper. The including shader declares their images and
// `has_sky`.

struct Layers {
    vec4 wash;
    float hatch; // ink of strokes, including strokes of the sky, where no surface is visible
    vec4 lines;  // contour lines: square roots of the colour, and coverage
};

Layers layers_at(ivec2 pixel)
{
    Layers layers = Layers(texelFetch(wash_image, pixel, 0), texelFetch(hatch_image, pixel, 0).x,
                           texelFetch(line_image, pixel, 0));
    if (has_sky && layers.wash.a <= 0.5) {
        ivec2 at = min(pixel, textureSize(sky_ink_image, 0) - 1);
        layers.hatch = max(layers.hatch, texelFetch(sky_ink_image, at, 0).x);
    }
    return layers;
}

#endif
