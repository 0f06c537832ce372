// SPDX-License-Identifier: MIT
// One thread paints one pixel of the sky: a wash from the horizon to the zenith, long horizontal strokes that
// thin out towards the light, and the disc of sun or moon.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/halo.glsl.h"
#include "techniques/sky/sky.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1, rgba16f) writeonly uniform image2D out_wash;
layout(binding = 2, r16f) writeonly uniform image2D out_ink;

#define TILE_LIST_BINDING 3
#include "shaders/tile_list.glsl" // only with sky_has_tiles

layout(constant_id = 0) const uint variant = 0u;
const bool has_tiles = (variant & sky_has_tiles) != 0u;
const bool has_depth = (variant & sky_has_depth) != 0u;
const bool has_halo = (variant & sky_has_halo) != 0u;

layout(binding = 4) uniform sampler2D depth_image; // reversed depth; only with sky_has_depth
layout(binding = 5) uniform sampler2D halo_image;  // only with sky_has_halo

layout(push_constant, scalar) uniform Constants
{
    SkyConstants constants;
};

#include "techniques/sky/vault.glsl"

// Rounds a position between horizon (0) and zenith (1) to a number of flat tones with soft transitions.
float stepped(float share, float steps)
{
    const float wiped = 0.3; // width of the transition between two tones, as a share of a tone's width
    float at = share * (steps - 1.0);
    float edge = floor(at) + 0.5;
    return (edge - 0.5 + smoothstep(edge - 0.5 * wiped, edge + 0.5 * wiped, at)) / max(steps - 1.0, 1.0);
}

// Colour of the sky's wash in a direction, without the disc of sun or moon: a gradient from horizon to
// zenith, blended with colour bands high and low in the sky.
vec3 graded(vec3 d, float height)
{
    float share = smoothstep(0.0, 1.0, sqrt(height));
    share = constants.steps > 0.5 ? stepped(share, constants.steps) : share;
    vec3 wash = mix(constants.horizon_color, constants.zenith_color, share);
    float up = asin(clamp(d.y, -1.0, 1.0));
    float low = constants.low_rad > 0.0 ? 1.0 - smoothstep(0.4, 1.6, up / constants.low_rad) : 0.0;
    float breadth = 0.3 * constants.high_rad;
    float high = constants.high_rad < 1.57
                     ? smoothstep(constants.high_rad - breadth, constants.high_rad + breadth, up)
                     : 0.0;
    return mix(mix(wash, constants.low_color, low), constants.high_color, high);
}

// Coverage of a pixel by the disc of sun or moon. `pixel_rad` is the angular width of the pixel.
float disc_cover(vec3 d, float pixel_rad)
{
    vec3 to_sun = vec3(constants.towards_sun.x, 0.0, constants.towards_sun.z) + 1e-6;
    vec3 right = normalize(cross(constants.towards_disc, vec3(0.0, 1.0, 0.0)) + 1e-6);
    right *= dot(right, to_sun) < 0.0 ? -1.0 : 1.0;
    vec2 at = vec2(dot(d, right), dot(d, cross(right, constants.towards_disc)));
    float away = dot(d, constants.towards_disc) > 0.0 ? asin(min(length(at), 1.0)) : 3.0;
    float cover = clamp((constants.disc_rad - away) / pixel_rad + 0.5, 0.0, 1.0);
    // The border between the moon's lit and dark part is half an ellipse on the page.
    float half_width = sqrt(max(constants.disc_rad * constants.disc_rad - at.y * at.y, 0.0));
    float from = at.x - (1.0 - 2.0 * constants.disc_lit) * half_width;
    cover *= constants.disc_lit < 1.0 ? clamp(from / pixel_rad + 0.5, 0.0, 1.0) : 1.0;
    return constants.disc_rad > 0.0 ? cover * clamp(d.y / pixel_rad + 0.5, 0.0, 1.0) : 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (has_tiles) {
        pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    }
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 position = vec2(pixel) + 0.5;
    vec3 d = direction_at(position);
    if (has_depth && is_covered(depth_image, pixel, d, constants.far_m)) {
        imageStore(out_wash, pixel, vec4(1.0));
        imageStore(out_ink, pixel, vec4(0.0));
        return;
    }
    float height = clamp(d.y * 1.9, 0.0, 1.0);
    vec3 wash = graded(d, height);
    LineField field = level_strokes(d, position);
    float towards_light =
        0.5 + 0.5 * dot(normalize(vec3(d.x, 0.0, d.z) + 1e-6),
                        normalize(vec3(constants.towards_sun.x, 0.0, constants.towards_sun.z) + 1e-6));
    float dark = constants.darkness * smoothstep(0.04, 0.55, height) * mix(1.0, 0.25, towards_light);
    dark *= has_halo ? left_in_halo(halo_image, position, frame.tile_from_px, constants.halo_px) : 1.0;
    float pen = constants.stroke_width_px;
    float ink = line_ink(field, level_pen(pen), dark, 77u);
    float disc = disc_cover(d, distance(d, direction_at(position + vec2(1.0, 0.0))));
    wash = mix(wash, constants.disc_color, disc);
    ink *= 1.0 - disc;
    imageStore(out_wash, pixel, vec4(wash, 1.0));
    imageStore(out_ink, pixel, vec4(ink));
}
