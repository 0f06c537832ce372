// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STREAKS
#define ESTAMPE_STREAKS

// White strokes on a plane high above, along the wind. The includer has `clouds` and `streak_texels`.

#include "shaders/line_ink.glsl"

// Where a ray meets the plane, in cells: along the strokes, which bend to and fro, and across them.
vec2 streak_place(StreakLayer layer, vec3 d)
{
    vec2 at = layer.eye + d.xz * (layer.base_m / (max(d.y, 1e-3) * layer.cell_m));
    float turns = 2.0 / float(layer.cells); // whole ones on the tile
    at.y += 0.35 * wave(at.x * turns) + 0.05 * wave(4.0 * turns * at.x + turns * at.y);
    return at;
}

float density_at(StreakLayer layer, vec2 at)
{
    int mask = int(layer.cells) - 1;
    vec2 corner = floor(at);
    ivec2 low = ivec2(corner) & mask;
    ivec2 high = (low + 1) & mask;
    int cells = int(layer.cells);
    vec2 f = at - corner;
    float near = mix(texelFetch(streak_texels, low.y * cells + low.x).x,
                     texelFetch(streak_texels, low.y * cells + high.x).x, f.x);
    float far = mix(texelFetch(streak_texels, high.y * cells + low.x).x,
                    texelFetch(streak_texels, high.y * cells + high.x).x, f.x);
    return mix(near, far, f.y);
}

// How much of a pixel streaks cover; `right` and `down` are the directions of its neighbours.
float streaks_along(StreakLayer layer, vec3 d, vec3 right, vec3 down)
{
    vec2 here = streak_place(layer, d);
    vec2 to_right = streak_place(layer, right) - here;
    vec2 to_down = streak_place(layer, down) - here;
    vec2 gradient = vec2(to_right.y, to_down.y);
    LineField field;
    field.v = here.y;
    field.v_per_px = length(gradient);
    vec2 along = vec2(-gradient.y, gradient.x) / max(field.v_per_px, 1e-12);
    field.u = here.x;
    field.u_per_px = abs(to_right.x * along.x + to_down.x * along.y);
    field.wander = here;
    field.wraps = false;
    float pen = layer.width_px;
    float away_m = layer.base_m / max(d.y, 1e-3);
    float dark = density_at(layer, here) * (1.0 - smoothstep(0.8, 2.5, away_m / clouds.reach_m));
    return line_ink(field, LineLook(pen, 0.6 * pen, 10.0 * pen, 90.0 * pen, 120.0 * pen, 0.6, 0.0), dark,
                    91u);
}

#endif
