// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PUFFS
#define ESTAMPE_PUFFS

// Follows a ray through a layer of puffs: balls of cloud with wavering outlines, cut flat by the layer's
// base. The puffs are found cell by cell (Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray
// Tracing", 1987). Define before inclusion: `clouds`, `start_texels`, `puff_texels`.

#include "shaders/lines.glsl"

const float no_hit_m = 1e9;

// What a ray sees of a layer of puffs.
struct SeenPuffs {
    float cover;    // coverage of the pixel by puffs
    float away_m;   // distance from the eye to the nearest puff; no_hit_m if there is none
    float shade;    // shade of the nearest puff: 0 lit, 1 shaded, 0.5 in the band between
    float line;     // ink of the outline at the pixel, 0 to 1
    float line_m;   // distance from the eye to the outlined puff
    float line_px;  // distance of the pixel outside of the outlined puff's edge, in pixels
    float width_px; // width of the outline in pixels
};

// A ray in the space of a layer, whose unit is a cell.
struct PuffRay {
    vec3 d;     // direction as a unit vector in metres: along the wind, up, across the wind
    vec3 step;  // direction in layer space, per metre along the ray
    vec3 aside; // horizontal unit vector at a right angle to the ray
    float per_step_squared;
    float enter_m; // distance in metres at which the ray enters the layer
    float leave_m;
    float pixel_rad;
};

CloudPuff puff_at(int i)
{
    vec4 ball = texelFetch(puff_texels, 2 * i);
    vec4 lean = texelFetch(puff_texels, 2 * i + 1);
    return CloudPuff(ball.xyz, ball.w, lean.xyz, lean.w);
}

// Width of the pen at a point of an outline: heavy on the side away from the light, thin and broken on the
// lit side.
float pen_px(float widest_px, float facing, float angle, float trait, float away_m)
{
    float lit = smoothstep(-0.5, 0.8, facing);
    float pressed = 0.5 + 0.5 * wave(2.0 * angle + trait);
    float left_out = clouds.broken * lit * smoothstep(0.35, 0.75, pressed);
    float thinned = clamp(pow(6000.0 / away_m, 0.35), 0.5, 1.25);
    return widest_px * thinned * mix(1.0, 0.45, lit) * mix(1.0, 0.7, pressed) * (1.0 - left_out);
}

// Light on the point of a puff's surface with the normal `outward`, from -1 to 1. The normal is bent towards
// `lean`, the direction that the whole cloud mass faces.
float light_on(vec3 outward, vec3 lean)
{
    return dot(normalize(mix(outward, lean, 0.45)), clouds.towards_sun);
}

// Converts light to shade: 0 lit, 1 shaded, and 0.5 in the band between if there are three tones. `soft` is
// the change of light over a pixel.
float shade_of(float light, float soft)
{
    float low = smoothstep(-soft, soft, clouds.shade_below - light);
    float lower = smoothstep(-soft, soft, clouds.shade_below - clouds.middle_band - light);
    return 0.5 * (low + lower);
}

// Coverage by ink of a pixel that lies `beyond_px` pixels outside of the outlined edge of a puff.
float line_ink_at(float beyond_px, float width_px)
{
    return clamp(beyond_px + 0.5, 0.0, min(width_px, 1.0)) * clamp(width_px - beyond_px + 0.5, 0.0, 1.0);
}

// Adds a puff to what a ray has seen. `from_centre` is the vector from the puff's centre to the eye.
void see_puff(inout SeenPuffs seen, PuffLayer layer, PuffRay ray, CloudPuff puff, vec3 from_centre)
{
    float nearest_m = -dot(from_centre, ray.step) * ray.per_step_squared;
    float at_m = max(nearest_m, ray.enter_m);
    vec3 offset = from_centre + ray.step * at_m;
    float away = max(length(offset), 1e-6);
    vec3 normal = offset / away;
    float angle = atan(dot(offset, ray.aside), offset.y) * 0.15915494;
    float radius = puff.radius * (1.0 + 0.05 * wave(3.0 * angle + puff.trait) +
                                  0.035 * wave(7.0 * angle + 5.0 * puff.trait));
    // Step from pixel to pixel at the outline. Where the flat base cuts the ball, the step lies in the plane
    // of the base; elsewhere it is perpendicular to the ray.
    vec3 slope = normal * layer.per_m;
    slope.y -= at_m > nearest_m ? dot(slope, ray.d) / ray.d.y : 0.0;
    float span = max(at_m * ray.pixel_rad * length(slope), 1e-9);
    float beyond_px = (away - radius) / span;
    vec3 facing_out = normalize(normal * layer.per_m);
    float width_px =
        pen_px(layer.pen * clouds.outline_px, dot(facing_out, clouds.towards_sun), angle, puff.trait, at_m);
    float line = line_ink_at(beyond_px, width_px);
    if (line > seen.line && at_m < seen.away_m && at_m < clouds.reach_m) {
        seen.line = line;
        seen.line_m = at_m;
        seen.line_px = beyond_px;
        seen.width_px = width_px;
    }
    float fade = 1.0 - smoothstep(0.35 * clouds.reach_m, clouds.reach_m, at_m);
    seen.cover = max(seen.cover, fade * clamp(0.5 - beyond_px, 0.0, 1.0));
    if (beyond_px < -0.5) {
        vec3 closest = from_centre + ray.step * nearest_m;
        float half_chord_m = sqrt(max(radius * radius - dot(closest, closest), 0.0) * ray.per_step_squared);
        float into_m = nearest_m - half_chord_m;
        float hit_m = max(into_m, ray.enter_m);
        if (hit_m <= seen.away_m) {
            // Where the edge between a puff's flat base and its round side crosses the pixel, the shades of
            // base and side are blended.
            float under =
                clamp((ray.enter_m - into_m) * ray.d.y / (ray.enter_m * ray.pixel_rad) + 0.5, 0.0, 1.0);
            vec3 side = normalize((from_centre + ray.step * hit_m) * layer.per_m);
            float soft = hit_m * ray.pixel_rad * length(layer.per_m) / radius;
            float shade = mix(shade_of(light_on(side, puff.lean), soft),
                              shade_of(light_on(vec3(0.0, -1.0, 0.0), puff.lean) - layer.under, 1e-3), under);
            // The bases of all puffs lie in one plane. So the rim of one base must not be visible within the
            // base of another puff.
            seen.shade = hit_m == seen.away_m ? max(shade, seen.shade) : shade;
            seen.away_m = hit_m;
        }
    }
}

// State of a ray's walk through the cells of a layer, and through the list of puffs of each cell.
struct PuffWalk {
    ivec2 cell;
    ivec2 forth;
    vec2 border_m; // distances at which the ray leaves the cell, along and across the wind
    vec2 cell_m;
    float at_m; // distance at which the ray entered the cell
    int next;   // index of the next puff to test
    int end;    // index after the last puff of the cell
};

void enter_cell(inout PuffWalk walk, PuffLayer layer)
{
    int mask = int(layer.cells) - 1;
    int index = int(layer.first_cell) + (walk.cell.y & mask) * int(layer.cells) + (walk.cell.x & mask);
    walk.next = int(texelFetch(start_texels, index).x);
    walk.end = int(texelFetch(start_texels, index + 1).x);
}

void leave_cell(inout PuffWalk walk)
{
    bool is_along = walk.border_m.x < walk.border_m.y;
    walk.at_m = min(walk.border_m.x, walk.border_m.y);
    walk.cell += is_along ? ivec2(walk.forth.x, 0) : ivec2(0, walk.forth.y);
    walk.border_m += is_along ? vec2(walk.cell_m.x, 0.0) : vec2(0.0, walk.cell_m.y);
}

PuffWalk start_walk(PuffLayer layer, PuffRay ray)
{
    PuffWalk walk;
    walk.cell = ivec2(floor(layer.eye.xz + ray.step.xz * ray.enter_m));
    walk.forth = ivec2(sign(ray.step.xz));
    walk.border_m = (vec2(walk.cell + max(walk.forth, ivec2(0))) - layer.eye.xz) / ray.step.xz;
    walk.cell_m = 1.0 / abs(ray.step.xz);
    walk.at_m = ray.enter_m;
    enter_cell(walk, layer);
    return walk;
}

// Vector to the eye from the centre of a puff in the list of `cell`.
vec3 from_centre_of(PuffLayer layer, vec3 centre, ivec2 cell)
{
    ivec2 in_tile = cell & (int(layer.cells) - 1);
    return layer.eye - centre - vec3(cell.x - in_tile.x, 0.0, cell.y - in_tile.y);
}

// Whether the ray passes near a puff that no nearer puff hides.
bool is_near(SeenPuffs seen, PuffRay ray, vec3 from_centre, float radius)
{
    float nearest_m = -dot(from_centre, ray.step) * ray.per_step_squared;
    vec3 offset = from_centre + ray.step * max(nearest_m, ray.enter_m);
    return dot(offset, offset) < puff_wavers * puff_wavers * radius * radius &&
           nearest_m - radius * sqrt(ray.per_step_squared) < seen.away_m;
}

// Advances to the next puff near the ray. Returns false at the end of the ray. CPUs run several rays in
// lockstep, and this small loop reduces the number of puffs that all rays must process together.
bool find_puff(inout PuffWalk walk, SeenPuffs seen, PuffLayer layer, PuffRay ray)
{
    bool is_found = false;
    while (!is_found && walk.at_m < ray.leave_m && walk.at_m <= seen.away_m) {
        if (walk.next < walk.end) {
            vec4 ball = texelFetch(puff_texels, 2 * walk.next);
            is_found = is_near(seen, ray, from_centre_of(layer, ball.xyz, walk.cell), ball.w);
            walk.next += is_found ? 0 : 1;
        } else {
            leave_cell(walk);
            enter_cell(walk, layer);
        }
    }
    return is_found;
}

// Converts a view direction to a ray in layer space. `d` is a unit vector well above the horizon, in the
// wind's axes: along, up, across.
PuffRay puff_ray(PuffLayer layer, vec3 d, float pixel_rad)
{
    PuffRay ray;
    ray.d = d;
    ray.step = d * layer.per_m;
    ray.step.xz += vec2(lessThan(abs(ray.step.xz), vec2(1e-9))) * 1e-9;
    ray.aside = normalize(vec3(-ray.step.z, 0.0, ray.step.x));
    ray.per_step_squared = 1.0 / dot(ray.step, ray.step);
    ray.enter_m = layer.base_m / d.y;
    ray.leave_m = min((layer.base_m + layer.thick_m) / d.y, clouds.reach_m);
    ray.pixel_rad = pixel_rad;
    return ray;
}

SeenPuffs no_puffs()
{
    return SeenPuffs(0.0, no_hit_m, 0.0, 0.0, no_hit_m, 0.0, 0.0);
}

// Completes the outline after all puffs of the layer were added.
void end_line(inout SeenPuffs seen, PuffRay ray)
{
    // Where two puffs touch, the outline of the nearer puff tapers off.
    float gap_cells = (seen.away_m - seen.line_m) * length(ray.step);
    float tapered = smoothstep(0.15, 0.9, gap_cells);
    seen.line = min(seen.line, line_ink_at(seen.line_px, tapered * seen.width_px));
    seen.line *= 1.0 - smoothstep(0.35 * clouds.reach_m, 0.8 * clouds.reach_m, seen.line_m);
}

SeenPuffs puffs_along(PuffLayer layer, vec3 d, float pixel_rad)
{
    PuffRay ray = puff_ray(layer, d, pixel_rad);
    SeenPuffs seen = no_puffs();
    PuffWalk walk = start_walk(layer, ray);
    while (find_puff(walk, seen, layer, ray)) {
        CloudPuff puff = puff_at(walk.next);
        see_puff(seen, layer, ray, puff, from_centre_of(layer, puff.centre, walk.cell));
        ++walk.next;
    }
    end_line(seen, ray);
    return seen;
}

#endif
