// SPDX-License-Identifier: MIT
// One thread per pixel adds the map's spread light to the light that stays in place. Back faces of sheets are
// not in the map.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

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

layout(binding = 5) uniform sampler2D spread_image;
layout(binding = 6) uniform sampler2D sum_image;

layout(binding = 7, rgba16f) uniform image2D light;

layout(push_constant, scalar) uniform Constants
{
    TextureConstants constants;
};

#include "techniques/subsurface/profile.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uvec2 seen = visibility_at(pixel);
    uint triangle = seen_triangle(seen);
    if (!sees_triangle(seen) || map_corner_at(3u * triangle).x < 0.0) {
        return;
    }
    uvec4 corners = triangle_at(triangle);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    Barycentric at = barycentric_at(
        frame.clip_from_anchor * vec4(a, 1.0), frame.clip_from_anchor * vec4(b, 1.0),
        frame.clip_from_anchor * vec4(c, 1.0), page_place(frame, vec2(pixel) + 0.5), frame.page_px);
    vec3 eye = towards_eye(frame, mat3(a, b, c) * at.weight);
    float facing = dot(cross(b - a, c - a), eye) * ((corners.w & triangle_mirrored) != 0u ? -1.0 : 1.0);
    vec2 place = place_in_map(triangle, at.weight) - 0.5;
    ivec2 first = ivec2(floor(place));
    vec2 between = place - vec2(first);
    vec4 sum = vec4(0.0);
    vec3 spread = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(first + corner, ivec2(0), ivec2(constants.size) - 1);
        vec4 other = texelFetch(sum_image, texel, 0);
        vec2 bilinear = mix(1.0 - between, between, vec2(corner));
        float weight = bilinear.x * bilinear.y * other.w;
        sum += weight * vec4(other.rgb, 1.0);
        spread += weight * texelFetch(spread_image, texel, 0).rgb;
    }
    if (facing < 0.0 || sum.w <= 1e-6) {
        return;
    }
    vec3 own = imageLoad(light, pixel).rgb;
    vec3 mixed = share_below(kept_below_tx(), spread / sum.w) * own + sum.rgb / sum.w;
    imageStore(light, pixel, vec4(mixed, luminance(mixed)));
}
