// SPDX-License-Identifier: MIT
// One thread per pixel: blurs the ink of strokes and lines vertically, and rubs a share of the strokes' ink
// into the wash, where the ink comes from the whole neighbourhood.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/pigment/pigment.glsl"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D wash_image;
layout(binding = 1) uniform sampler2D hatch_image; // ink of strokes, blurred horizontally
layout(binding = 2) uniform sampler2D line_image;  // ink of lines, blurred horizontally, times coverage
layout(binding = 3) uniform sampler2D cell_image;  // ink that was spread
layout(binding = 4, rgba16f) writeonly uniform image2D out_wash;
layout(binding = 5, r16f) writeonly uniform image2D out_hatch;
layout(binding = 6, rgba8) writeonly uniform image2D out_lines;

layout(push_constant, scalar) uniform Constants
{
    PigmentDryConstants constants;
};

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float hatch = 0.0;
    vec4 lines = vec4(0.0);
    float weights = 0.0;
    int radius = int(constants.radius_px);
    for (int i = -radius; i <= radius; ++i) {
        ivec2 at = ivec2(pixel.x, clamp(pixel.y + i, 0, int(constants.size_px.y) - 1));
        float weight = exp(-constants.falloff * float(i * i));
        hatch += weight * texelFetch(hatch_image, at, 0).x;
        lines += weight * texelFetch(line_image, at, 0);
        weights += weight;
    }
    hatch /= weights;
    lines /= weights;
    vec4 wash = texelFetch(wash_image, pixel, 0);
    vec2 page_px = vec2(uvec2(pixel) + constants.from_px) + 0.5;
    float rubbed =
        constants.rub > 0.0
            ? constants.rub * spread_at(cell_image, page_px, constants.from_px, constants.cell_px).x
            : 0.0;
    // The rest of the ink lies over the rubbed ink. Both together cover as much as the mean of both.
    float rest = (1.0 - constants.rub) * hatch / max(1.0 - rubbed, 1e-4);
    imageStore(out_wash, pixel, vec4(wash.rgb * mix(vec3(1.0), constants.ink, rubbed), wash.a));
    imageStore(out_hatch, pixel, vec4(min(rest, 1.0)));
    imageStore(out_lines, pixel, vec4(lines.rgb / max(lines.a, 1e-6), lines.a));
}
