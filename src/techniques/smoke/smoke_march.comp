// SPDX-License-Identifier: MIT
// One thread per pixel marches through the smoke boxes from front to back, up to the visible surface. The
// thread computes the smoke's opacity, its brightness, and the distance at which the smoke is dense enough to
// draw.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/hash.glsl"
#include "techniques/smoke/smoke.glsl.h"
#include "techniques/smoke/smoke_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool by_axis = (variant & smoke_by_axis) != 0u;
const bool by_view = (variant & smoke_by_view) != 0u;
const bool by_slices = by_axis || by_view;
const bool has_several = (variant & smoke_has_several) != 0u;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 2) uniform sampler2DArray packed;
layout(binding = 3) uniform samplerBuffer brick_texels;
layout(binding = 4) uniform sampler2D depth_image;
layout(binding = 5, rgba32f) writeonly uniform image2D out_smoke;

#include "techniques/smoke/smoke_grid.glsl"
#include "techniques/smoke/smoke_volume.glsl"

const float least_left = 5e-5; // transmittance below which the march along a ray stops

// Positions of samples along a ray: from `first` on, `spacing` apart.
struct Samples {
    float first;
    float spacing;
};

// Positions of the samples of a ray in a box. For smoke_by_axis the sample planes are fixed in the box's
// grid, across the main axis of the view; for smoke_by_view they face the view.
Samples samples_of(Ray ray, uint box, float from)
{
    float step_m = smoke.boxes[box].step_m;
    if (!by_slices) {
        return Samples(from, step_m);
    }
    vec3 view = mat3(smoke.boxes[box].grid_from_anchor) * frame.view_forward;
    vec3 size = abs(view);
    int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    Ray within = ray_in_box(box, ray);
    float planes_per_cell = smoke.boxes[box].cell_m / step_m;
    float start = by_axis ? within.origin[axis] * planes_per_cell
                          : dot(ray.origin - frame.eye_anchor, frame.view_forward) / step_m;
    float rate =
        by_axis ? within.direction[axis] * planes_per_cell : dot(ray.direction, frame.view_forward) / step_m;
    rate = abs(rate) < 1e-6 ? 1e-6 : rate;
    float at_entry = start + from * rate;
    float plane = rate > 0.0 ? ceil(at_entry) : floor(at_entry);
    return Samples((plane - start) / rate, 1.0 / abs(rate));
}

vec3 facing(uint box, vec3 place)
{
    const float aside = 1.0;
    vec3 slope = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        vec3 off = vec3(0.0);
        off[axis] = aside;
        slope[axis] = smoke_at(box, place - off).x - smoke_at(box, place + off).x;
    }
    return slope * inversesqrt(max(dot(slope, slope), 1e-12));
}

// A part of a ray, in metres, that lies within a constant set of boxes, with one bit per box.
struct Stretch {
    float from;
    float until;
    uint boxes;
    uint finest; // number of the box with the shortest step
};

// The part of a ray from `from` on, to at most `most`, on which the set of smoke boxes around the ray is
// constant. `boxes` is 0 outside all boxes.
Stretch stretch_from(Ray ray, float from, float most)
{
    Stretch stretch = Stretch(from, most, 0u, 0u);
    for (uint i = 0u; i < box_count(); ++i) {
        Ray within = ray_in_box(i, ray);
        vec2 range = range_in_box(vec3(smoke.boxes[i].cells), within.origin, within.direction);
        float enters = max(range.x, 0.0);
        bool is_in = from >= enters && from < range.y;
        bool is_ahead = enters > from && enters < range.y;
        bool is_finer = stretch.boxes == 0u || smoke.boxes[i].step_m < smoke.boxes[stretch.finest].step_m;
        stretch.finest = is_in && is_finer ? i : stretch.finest;
        stretch.boxes |= is_in ? 1u << i : 0u;
        stretch.until = min(stretch.until, is_in ? range.y : is_ahead ? enters : most);
    }
    return stretch;
}

// State of a ray that is marched through the smoke.
struct Gone {
    float left; // transmittance of the smoke so far
    float bright;
    float surface_m; // distance at which the ray reached the edge opacity; 0 before
    uint box;        // number of the densest box at the distance surface_m
};

// Sum over all boxes of one step of a ray.
struct Passed {
    float thickness;
    float light;
    float empty; // distance from here that the ray stays in empty bricks
    uint densest;
};

Passed passed_at(Ray ray, Stretch stretch, float at, float way)
{
    Passed passed = Passed(0.0, 0.0, 1e9, stretch.finest);
    float most = 0.0;
    float glow = 0.0;
    for (uint i = 0u; i < box_count(); ++i) {
        if (!has_several || (stretch.boxes & (1u << i)) != 0u) {
            Ray within = ray_in_box(i, ray);
            vec3 place = within.origin + at * within.direction;
            vec2 here = smoke_at(i, place);
            float thickness = here.x * smoke.boxes[i].extinction_per_m * way;
            passed.thickness += thickness;
            passed.light = here.y;
            glow += thickness * here.y;
            passed.densest = thickness > most ? i : passed.densest;
            most = max(most, thickness);
            passed.empty = here.x > 0.0 ? 0.0 : min(passed.empty, empty_way(i, place, within.direction));
        }
    }
    passed.light = has_several ? glow / max(passed.thickness, 1e-20) : passed.light;
    return passed;
}

void go_through(inout Gone gone, Ray ray, Stretch stretch, float scattered)
{
    Samples samples = samples_of(ray, stretch.finest, stretch.from);
    float number = 0.0;
    float from = samples.first;
    while (from < stretch.until && gone.left > least_left) {
        float way = by_slices ? samples.spacing : min(samples.spacing, stretch.until - from);
        Passed passed = passed_at(ray, stretch, from + scattered * way, way);
        if (passed.thickness > 0.0) {
            float through = exp(-passed.thickness);
            float wanted = log(max(gone.left, 1e-6) / (1.0 - smoke.edge));
            bool is_edge = gone.surface_m == 0.0 && passed.thickness >= wanted;
            gone.surface_m =
                is_edge ? max(from + way * clamp(wanted / passed.thickness, 0.0, 1.0), 1e-6) : gone.surface_m;
            gone.box = is_edge ? passed.densest : gone.box;
            gone.bright += gone.left * (1.0 - through) * passed.light;
            gone.left *= through;
            number += 1.0;
        } else {
            number += max(floor(passed.empty / samples.spacing), 1.0);
        }
        from = samples.first + number * samples.spacing;
    }
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 position = vec2(pixel) + 0.5;
    Ray ray = ray_at(frame, position);
    float depth = texelFetch(depth_image, pixel, 0).x;
    float seen_m = depth > 0.0 ? dot(anchor_at(frame, position, depth) - ray.origin, ray.direction) : 1e9;
    uvec2 place_px = uvec2(page_place(frame, vec2(pixel)));
    float scattered =
        by_slices ? 0.0 : 0.5 + smoke.scatter * (unit_float(hash(place_px.x, place_px.y)) - 0.5);
    Gone gone = Gone(1.0, 0.0, 0.0, 0u);
    float from = 0.0;
    while (from < seen_m && gone.left > least_left) {
        Stretch stretch = stretch_from(ray, from, seen_m);
        if (stretch.boxes != 0u) {
            go_through(gone, ray, stretch, scattered);
        }
        from = stretch.until;
    }
    float opacity = 1.0 - gone.left;
    vec4 found = vec4(opacity, gone.bright / max(opacity, 1e-6), gone.surface_m, 0.5);
    if (gone.surface_m > 0.0) {
        Ray within = ray_in_box(gone.box, ray);
        vec3 way = facing(gone.box, within.origin + gone.surface_m * within.direction);
        found.w = 2.0 * float(gone.box) + 0.5 +
                  0.5 * clamp(dot(way, smoke.boxes[gone.box].towards_light), -0.99, 1.0);
    }
    imageStore(out_smoke, pixel, found);
}
