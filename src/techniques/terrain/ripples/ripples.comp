// SPDX-License-Identifier: MIT
// One thread bends the shading normal at one pixel of sand by the ripples at that place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/unit.glsl"
#include "techniques/terrain/plane_step.glsl"
#include "techniques/terrain/ripples/ripples.glsl"
#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3, rg32ui) uniform uimage2D normal_image;

layout(push_constant, scalar) uniform Constants
{
    RippleConstants constants;
};

// Two numbers of ripples per pixel: ripples begin to fade at the first number and are gone at the second
// number.
const vec2 resolved = vec2(0.15, 0.36);
// Two slopes of the ground: ripples begin to fade at the first slope and are gone at the second slope,
// because steep sand slides.
const vec2 sliding = vec2(0.35, 0.55);

// Upper limit of the number of ripples in a step on the ground. Ripples are not exactly perpendicular to the
// wind, so the limit is larger than the number of ripples along the wind.
float waves_over(vec3 step_m)
{
    vec2 across = vec2(-constants.wind.y, constants.wind.x);
    return (1.15 * abs(dot(step_m.xz, constants.wind)) + 0.3 * abs(dot(step_m.xz, across))) /
           constants.wavelength_m;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    if (!sees_draw(word) || draw_of(word) != constants.draw) {
        return;
    }
    vec2 position_px = vec2(pixel) + 0.5;
    float depth = max(texelFetch(depth_image, pixel, 0).x, 1e-9);
    vec3 place = anchor_at(frame, position_px, depth);
    if (pixel_size_m(frame, place) > resolved.y * constants.wavelength_m) {
        return;
    }
    uvec2 packed = imageLoad(normal_image, pixel).xy;
    vec3 smooth_normal = unpack_normal(packed.y);
    float waves =
        max(waves_over(step_on_plane(frame, position_px, depth, place, smooth_normal, vec2(1.0, 0.0))),
            waves_over(step_on_plane(frame, position_px, depth, place, smooth_normal, vec2(0.0, 1.0))));
    float steepness = length(smooth_normal.xz) / max(smooth_normal.y, 1e-3);
    float height = constants.height_m / constants.wavelength_m;
    height *= 1.0 - smoothstep(resolved.x, resolved.y, waves);
    height *= 1.0 - smoothstep(sliding.x, sliding.y, steepness);
    // No ripples are drawn where the smooth normal points downwards: the ground is then seen from below.
    if (height <= 0.0 || smooth_normal.y <= 0.0) {
        return;
    }
    vec2 across = vec2(-constants.wind.y, constants.wind.x);
    vec2 cells = vec2(ripple_cell_along, ripple_cell_across);
    vec2 at = constants.rest +
              vec2(dot(place.xz, constants.wind), dot(place.xz, across)) / (constants.wavelength_m * cells);
    vec2 lean = height * ripple_lean(ivec2(constants.cell), at, constants.meander, cells);
    vec2 rise = lean.x * constants.wind + lean.y * across; // slope of the ripples along x and z
    vec3 normal = unpack_normal(packed.x);
    normal = unit(normal - normal.y * vec3(rise.x, 0.0, rise.y));
    imageStore(normal_image, pixel, uvec4(pack_normal(normal), packed.y, 0u, 0u));
}
