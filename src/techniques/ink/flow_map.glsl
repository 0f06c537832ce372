// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_FLOW_MAP
#define ESTAMPE_INK_FLOW_MAP

// The stream function of a picture of flow: quadratic B-splines about nodes that are spread over the page,
// whose derivatives have no divergence either. Wanted before: `globals`, and INK_MAP_TEXELS.

Stream add_flow_map(Stream stream, vec2 place_mm)
{
    vec2 step_mm = globals.page_mm / float(ink_map_side - 1u);
    vec2 at = clamp(place_mm / step_mm, vec2(0.0), vec2(float(ink_map_side - 1u)));
    vec2 node = floor(at + 0.5);
    vec2 f = at - node;
    vec3 across = vec3(0.5 * (0.5 - f.x) * (0.5 - f.x), 0.75 - f.x * f.x, 0.5 * (0.5 + f.x) * (0.5 + f.x));
    vec3 down = vec3(0.5 * (0.5 - f.y) * (0.5 - f.y), 0.75 - f.y * f.y, 0.5 * (0.5 + f.y) * (0.5 + f.y));
    vec3 across_slope = vec3(f.x - 0.5, -2.0 * f.x, f.x + 0.5);
    vec3 down_slope = vec3(f.y - 0.5, -2.0 * f.y, f.y + 0.5);
    float psi = 0.0;
    vec2 slope = vec2(0.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            ivec2 from = clamp(ivec2(node) + ivec2(column, row) - 1, ivec2(0), ivec2(int(ink_map_side) - 1));
            float value = texelFetch(INK_MAP_TEXELS, from.y * int(ink_map_side) + from.x).x;
            psi += across[column] * down[row] * value;
            slope += vec2(across_slope[column] * down[row], across[column] * down_slope[row]) * value;
        }
    }
    return Stream(stream.psi + globals.map_mm_s * psi, stream.gradient + globals.map_mm_s * slope / step_mm);
}

#endif
