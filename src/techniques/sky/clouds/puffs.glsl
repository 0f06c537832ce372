// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PUFFS
#define ESTAMPE_PUFFS

// One ray through one layer of puffs: balls whose outlines waver, cut flat by the base, found cell by cell
// (Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987). The includer has `clouds`,
// `start_texels` and `puff_texels`.

#include "shaders/lines.glsl"

const float no_hit_m = 1e9;

// What is seen of a layer along a ray.
struct SeenPuffs {
    float cover;  // of the pixel
    float away_m; // of the nearest puff; no_hit_m where there is none
    float facing; // -1 to 1: the light
    float soft;   // change of that over a pixel
    float line;   // ink of outlines
    float line_m; // how far they lie
};

// A ray, as a layer has it.
struct PuffRay {
    vec3 d;          // along the wind, up, across: unit, in metres
    vec3 step;       // the same in the layer's space: a metre's way
    vec3 aside;      // level, unit, across it
    float enter_m;   // into the slab
    float pixel_rad;
};

CloudPuff puff_at(int i)
{
    vec4 ball = texelFetch(puff_texels, 2 * i);
    vec4 lean = texelFetch(puff_texels, 2 * i + 1);
    return CloudPuff(ball.xyz, ball.w, lean.xyz, lean.w);
}

// How wide the pen is drawn at a place of an outline: heavy away from the light, thin and broken towards it.
float pen_px(float facing, float angle, float trait, float away_m)
{
    float lit = smoothstep(-0.5, 0.8, facing);
    float pressed = 0.5 + 0.5 * wave(2.0 * angle + trait);
    float left_out = clouds.broken * lit * smoothstep(0.35, 0.75, pressed);
    float thinned = clamp(pow(6000.0 / away_m, 0.35), 0.5, 1.25);
    return clouds.outline_px * thinned * mix(1.0, 0.45, lit) * mix(1.0, 0.7, pressed) * (1.0 - left_out);
}

// Adds a puff to what is seen.
void see_puff(inout SeenPuffs seen, PuffLayer layer, PuffRay ray, CloudPuff puff, vec3 tile_from)
{
    vec3 from_centre = layer.eye - puff.centre - tile_from;
    float step_squared = dot(ray.step, ray.step);
    float nearest_m = -dot(from_centre, ray.step) / step_squared;
    float at_m = max(nearest_m, ray.enter_m);
    vec3 offset = from_centre + ray.step * at_m;
    float away = max(length(offset), 1e-6);
    vec3 normal = offset / away;
    float angle = atan(dot(offset, ray.aside), offset.y) * 0.15915494;
    float radius =
        puff.radius * (1.0 + 0.05 * wave(3.0 * angle + puff.trait) + 0.035 * wave(7.0 * angle + 5.0 * puff.trait));
    // What a pixel spans across the outline: on the base, where that cuts the ball, else across the ray.
    vec3 slope = normal * layer.per_m;
    slope.y -= at_m > nearest_m ? dot(slope, ray.d) / ray.d.y : 0.0;
    float span = max(at_m * ray.pixel_rad * length(slope), 1e-9);
    float beyond_px = (away - radius) / span;
    vec3 facing_out = normalize(normal * layer.per_m);
    float width_px = pen_px(dot(facing_out, clouds.towards_sun), angle, puff.trait, at_m);
    float line = clamp(beyond_px + 0.5, 0.0, min(width_px, 1.0)) * clamp(width_px - beyond_px + 0.5, 0.0, 1.0);
    if (line > seen.line && at_m < seen.away_m && at_m < clouds.reach_m) {
        seen.line = line;
        seen.line_m = at_m;
    }
    float fade = 1.0 - smoothstep(0.35 * clouds.reach_m, clouds.reach_m, at_m);
    seen.cover = max(seen.cover, fade * clamp(0.5 - beyond_px, 0.0, 1.0));
    if (beyond_px < -0.5) {
        vec3 closest = from_centre + ray.step * nearest_m;
        float half_chord_m =
            sqrt(max(radius * radius - dot(closest, closest), 0.0) / step_squared);
        float into_m = nearest_m - half_chord_m;
        bool is_under = into_m < ray.enter_m;
        float hit_m = max(into_m, ray.enter_m);
        if (hit_m < seen.away_m) {
            vec3 outward = is_under ? vec3(0.0, -1.0, 0.0)
                                    : normalize((from_centre + ray.step * hit_m) * layer.per_m);
            // Moved towards where the whole mass faces.
            vec3 moved = normalize(mix(outward, puff.lean, 0.45));
            seen.away_m = hit_m;
            seen.facing = dot(moved, clouds.towards_sun) - (is_under ? 0.3 : 0.0);
            seen.soft = is_under ? 1e-3 : hit_m * ray.pixel_rad * length(layer.per_m) / radius;
        }
    }
}

// `d` is a unit vector well above the horizon, along the wind, up and across.
SeenPuffs puffs_along(PuffLayer layer, vec3 d, float pixel_rad)
{
    PuffRay ray;
    ray.d = d;
    ray.step = d * layer.per_m;
    ray.step.xz += vec2(lessThan(abs(ray.step.xz), vec2(1e-9))) * 1e-9;
    ray.aside = normalize(vec3(-ray.step.z, 0.0, ray.step.x));
    ray.enter_m = layer.base_m / d.y;
    ray.pixel_rad = pixel_rad;
    float leave_m = min((layer.base_m + layer.thick_m) / d.y, clouds.reach_m);
    SeenPuffs seen = SeenPuffs(0.0, no_hit_m, 0.0, 1e-3, 0.0, no_hit_m);
    ivec2 cell = ivec2(floor(layer.eye.xz + ray.step.xz * ray.enter_m));
    ivec2 forth = ivec2(sign(ray.step.xz));
    vec2 border_m = (vec2(cell + max(forth, ivec2(0))) - layer.eye.xz) / ray.step.xz;
    vec2 cell_m = 1.0 / abs(ray.step.xz);
    int mask = int(layer.cells) - 1;
    for (float at_m = ray.enter_m; at_m < leave_m && seen.away_m > at_m;) {
        int index = int(layer.first_cell) + (cell.y & mask) * int(layer.cells) + (cell.x & mask);
        vec3 tile_from = vec3(cell.x - (cell.x & mask), 0.0, cell.y - (cell.y & mask));
        int last = int(texelFetch(start_texels, index + 1).x);
        for (int i = int(texelFetch(start_texels, index).x); i < last; ++i) {
            see_puff(seen, layer, ray, puff_at(i), tile_from);
        }
        bool is_along = border_m.x < border_m.y;
        at_m = min(border_m.x, border_m.y);
        cell += is_along ? ivec2(forth.x, 0) : ivec2(0, forth.y);
        border_m += is_along ? vec2(cell_m.x, 0.0) : vec2(0.0, cell_m.y);
    }
    // Of two puffs that touch, the outline of the nearer tapers away where they meet.
    float gap_cells = (seen.away_m - seen.line_m) * length(ray.step);
    seen.line *= smoothstep(0.25, 1.1, gap_cells);
    seen.line *= 1.0 - smoothstep(0.35 * clouds.reach_m, 0.8 * clouds.reach_m, seen.line_m);
    return seen;
}

#endif
