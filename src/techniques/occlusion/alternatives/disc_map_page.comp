// SPDX-License-Identifier: MIT
// One thread per pixel interpolates the occlusion map that disc_map_gather.comp wrote.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#include "techniques/occlusion/alternatives/discs.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define VISIBILITY_BINDING 1
#include "shaders/visibility_texels.glsl"

#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"

#define MAP_CORNERS_BINDING 4
#include "shaders/map_corners.glsl"

// Occlusion per texel of the map, from disc_map_gather.comp.
layout(binding = 5) uniform samplerBuffer found_texels;
layout(binding = 6, r16f) writeonly uniform image2D out_open;
layout(binding = 7, rgba16f) writeonly uniform image2D out_bounced;

layout(push_constant) uniform Constants
{
    float strength;
    float bleeding;
    int size; // texels per side of the map
}

constants;

layout(constant_id = 0) const uint variant = 0u;
const bool bounces = (variant & discs_bounce) != 0u;

// Bounced light at a place of the map, and visibility in alpha. Places without texels are unoccluded.
vec4 found_at(vec2 place)
{
    vec2 from = place - 0.5;
    ivec2 first = ivec2(floor(from));
    vec2 between = from - vec2(first);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(first + corner, ivec2(0), ivec2(constants.size - 1));
        vec4 found = texelFetch(found_texels, texel.y * constants.size + texel.x);
        vec2 bilinear = mix(1.0 - between, between, vec2(corner));
        float weight = found.a < 0.0 ? 0.0 : bilinear.x * bilinear.y;
        sum += weight * found;
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : vec4(0.0, 0.0, 0.0, 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uvec2 seen = visibility_at(pixel);
    vec4 found = vec4(0.0, 0.0, 0.0, 1.0);
    if (sees_triangle(seen)) {
        uvec4 corners = triangle_at(seen_triangle(seen));
        Barycentric at =
            barycentric_at(frame.clip_from_anchor * vec4(posed_vertex_at(corners.x).position, 1.0),
                           frame.clip_from_anchor * vec4(posed_vertex_at(corners.y).position, 1.0),
                           frame.clip_from_anchor * vec4(posed_vertex_at(corners.z).position, 1.0),
                           page_place(frame, vec2(pixel) + 0.5), frame.page_px);
        if (map_corner_at(3u * seen_triangle(seen)).x >= 0.0) {
            found = found_at(place_in_map(seen_triangle(seen), at.weight));
        }
    }
    imageStore(out_open, pixel, vec4(pow(clamp(found.a, 0.0, 1.0), constants.strength)));
    if (bounces) {
        imageStore(out_bounced, pixel, vec4(max(constants.bleeding * found.rgb, vec3(0.0)), 0.0));
    }
}
