// SPDX-License-Identifier: MIT
// One thread per pixel: ink of the dots in the cells around the pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/hash.glsl"
#include "stipple.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D darkness_image;
layout(binding = 1, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    StippleConstants constants;
};

// Two random numbers, 0 to 1, of a cell.
vec2 random_of(ivec2 cell)
{
    uint bits = hash(uint(cell.x), uint(cell.y), constants.seed);
    return vec2(unit_float(bits), unit_float(hash(bits)));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    vec2 place = vec2(pixel) + 0.5;
    ivec2 home = ivec2(floor(place / constants.cell_px));
    float bare = 1.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 cell = home + ivec2(x, y);
            vec2 middle =
                (vec2(cell) + 0.5 + constants.jitter * (2.0 * random_of(cell) - 1.0)) * constants.cell_px;
            ivec2 at = clamp(ivec2(middle), ivec2(0), ivec2(constants.size_px) - 1);
            float darkness = clamp(texelFetch(darkness_image, at, 0).x, 0.0, 1.0);
            // The dot's ink equals its share of the cell: with an edge one pixel wide, a radius r shows pi
            // (r^2 + 1/12). A dot that is too small for this is drawn paler.
            float ink_px = constants.cell_px * constants.cell_px * darkness / 3.14159265;
            float radius_px = sqrt(max(ink_px - 1.0 / 12.0, 0.25));
            float pale = min(ink_px / (0.25 + 1.0 / 12.0), 1.0);
            bare *= 1.0 - pale * clamp(radius_px - distance(place, middle) + 0.5, 0.0, 1.0);
        }
    }
    imageStore(out_ink, pixel, vec4(1.0 - bare));
}
