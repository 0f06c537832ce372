// SPDX-License-Identifier: MIT
// One thread lights one pixel; the 64 threads of a tile first agree on the lights that can reach it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/draw_word.glsl"
#include "shaders/material.glsl.h"
#include "shaders/mesh.glsl.h"
#include "shaders/octahedral.glsl"
#include "techniques/light/light.glsl.h"
#include "techniques/shadow/edge.glsl.h"
#include "techniques/shadow/sun.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Lighting
{
    LightGlobals lighting;
};

layout(scalar, binding = 2) readonly buffer Lights
{
    LightRecord lights[];
};

layout(binding = 3) uniform usampler2D draw_image;
layout(binding = 4) uniform sampler2D depth_image;
layout(binding = 5) uniform usampler2D normal_image;

#define DRAW_TEXELS_BINDING 6
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 7
#include "shaders/material_texels.glsl"

layout(binding = 8) uniform samplerBuffer sun_map;

layout(scalar, binding = 9) uniform Sun
{
    SunShadow sun_shadow;
};

// Read where edges of shadows have teeth.
layout(binding = 10) uniform sampler2D coordinate_image;
layout(binding = 11) uniform usampler2D footprint_image;

layout(scalar, binding = 12) uniform EdgeLooks
{
    EdgeLook edge_look;
};

layout(binding = 13, rgba16f) writeonly uniform image2D out_light; // irradiance / pi; its luminance in alpha

// What the scene needs of this shader.
layout(constant_id = 0) const uint variant = 0u;
const bool has_shadow = (variant & 1u) != 0u;
const bool has_local_lights = (variant & 2u) != 0u;
const bool has_emissive = (variant & 4u) != 0u;
const bool has_stroke_edges = (variant & 0x100u) != 0u;
const bool has_wave_edges = (variant & 0x200u) != 0u;
const bool has_edges = has_stroke_edges || has_wave_edges;
const bool has_soft_sun = (variant & 0x400u) != 0u;

const uint lights_per_round = 256u;
shared uint tile_nearest; // bits of reversed depth, which order as numbers do
shared uint tile_farthest;
shared uint reaching[lights_per_round / 32u];

#include "techniques/shadow/edge.glsl"
#include "techniques/shadow/sun_shadow.glsl"

Edge edge_at(ivec2 pixel, uint word, float depth, vec3 point, vec3 normal)
{
    vec2 at_px = vec2(pixel) + 0.5;
    PageRates rates = page_rates(frame, at_px, depth, point, normal);
    Edge edge;
    edge.first = wave_teeth(edge_look.axis_0, point, rates, 1u);
    edge.second = wave_teeth(edge_look.axis_1, point, rates, 2u);
    edge.m_per_px = distance(point, anchor_at(frame, at_px + vec2(1.0, 0.0), depth));
    if (has_stroke_edges) {
        edge.first = stroke_teeth(edge_look, strokes_of(word), texelFetch(coordinate_image, pixel, 0).xyz,
                                  unpack_footprint(texelFetch(footprint_image, pixel, 0)), normal, rates);
    }
    return edge;
}

// Share of the sun that arrives, edges and breadth of the sun counted.
float sun_share(vec3 point, vec3 normal, vec3 towards_sun, Edge edge)
{
    float penumbra_m = has_soft_sun ? sun_penumbra_m(point, normal, towards_sun) : 0.0;
    EdgePoints points = edge_points(edge, edge_look, has_wave_edges, point, penumbra_m);
    float radius_m = 0.5 * penumbra_m;
    float first = has_soft_sun ? sun_soft_visibility(points.first, normal, towards_sun, radius_m)
                               : sun_visibility(points.first, normal, towards_sun);
    float second = has_soft_sun ? sun_soft_visibility(points.second, normal, towards_sun, radius_m)
                                : sun_visibility(points.second, normal, towards_sun);
    return edge_blend(points, first, second);
}

// What arrives of the sun at a pixel.
float sun_at(ivec2 pixel, uint word, float depth, vec3 point, vec3 normal, vec3 towards_sun)
{
    if (has_edges) {
        return sun_share(point, normal, towards_sun, edge_at(pixel, word, depth, point, normal));
    }
    if (has_soft_sun) {
        return sun_soft_visibility(point, normal, towards_sun, sun_penumbra_m(point, normal, towards_sun));
    }
    return sun_visibility(point, normal, towards_sun);
}

vec3 local_light(LightRecord light, vec3 point, vec3 normal)
{
    vec3 to_light = light.position - point;
    float distance_2 = max(dot(to_light, to_light), 1e-6);
    vec3 direction = to_light * inversesqrt(distance_2);
    // KHR_lights_punctual: inverse square, windowed to reach zero at the range.
    float ratio = distance_2 / (light.range_m * light.range_m);
    float window = clamp(1.0 - ratio * ratio, 0.0, 1.0);
    float attenuation = window / distance_2;
    if (light.type == LIGHT_SPOT) {
        float cone = clamp(dot(-direction, light.direction) * light.cone_scale + light.cone_offset, 0.0, 1.0);
        attenuation *= cone * cone;
    }
    return light.color * (attenuation * pow(max(dot(normal, direction), 1e-6), lighting.falloff));
}

// Bounds of the tile's visible points in anchor space.
void tile_box(out vec3 low, out vec3 high)
{
    vec2 corner = vec2(gl_WorkGroupID.xy * 8u);
    float near = uintBitsToFloat(tile_nearest);
    float far = uintBitsToFloat(tile_farthest);
    low = vec3(1e30);
    high = vec3(-1e30);
    for (int i = 0; i < 8; ++i) {
        vec2 at = corner + 8.0 * vec2(i & 1, (i >> 1) & 1);
        vec3 point = anchor_at(frame, at, (i & 4) != 0 ? near : far);
        low = min(low, point);
        high = max(high, point);
    }
}

void find_reaching(uint first, uint count)
{
    uint thread = gl_LocalInvocationIndex;
    if (thread < lights_per_round / 32u) {
        reaching[thread] = 0u;
    }
    barrier();
    vec3 low, high;
    tile_box(low, high);
    for (uint i = thread; i < count; i += 64u) {
        LightRecord light = lights[first + i];
        vec3 gap = max(max(low - light.position, light.position - high), vec3(0.0));
        if (tile_nearest != 0u && dot(gap, gap) < light.range_m * light.range_m) {
            atomicOr(reaching[i >> 5], 1u << (i & 31u));
        }
    }
    barrier();
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool on_page = all(lessThan(uvec2(pixel), frame.size_px));
    uint word = on_page ? texelFetch(draw_image, pixel, 0).x : 0u;
    float depth = sees_draw(word) ? texelFetch(depth_image, pixel, 0).x : 0.0;
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, max(depth, 1e-9));
    uvec4 normals = texelFetch(normal_image, min(pixel, ivec2(frame.size_px) - 1), 0);
    vec3 normal = unpack_normal(normals.x);
    vec3 smooth_normal = unpack_normal(normals.y);

    vec3 light = mix(lighting.ground_ambient, lighting.sky_ambient, 0.5 + 0.5 * normal.y);
    float sun_visible =
        has_shadow ? sun_at(pixel, word, max(depth, 1e-9), point, smooth_normal, lights[0].direction) : 1.0;
    for (uint i = 0u; i < lighting.directional_count; ++i) {
        LightRecord sun = lights[i];
        float lambert = dot(smooth_normal, sun.direction) > 0.0 ? max(dot(normal, sun.direction), 0.0) : 0.0;
        float visible = i == 0u ? sun_visible : 1.0;
        light += lambert > 0.0 ? sun.color * (pow(lambert, lighting.falloff) * visible) : vec3(0.0);
    }
    if (has_local_lights) {
        if (gl_LocalInvocationIndex == 0u) {
            tile_nearest = 0u;
            tile_farthest = 0xffffffffu;
        }
        barrier();
        if (sees_draw(word)) {
            atomicMax(tile_nearest, floatBitsToUint(depth));
            atomicMin(tile_farthest, floatBitsToUint(depth));
        }
        barrier();
        for (uint done = 0u; done < lighting.local_count; done += lights_per_round) {
            uint first = lighting.directional_count + done;
            find_reaching(first, min(lights_per_round, lighting.local_count - done));
            for (uint word = 0u; word < lights_per_round / 32u; ++word) {
                uint bits = reaching[word];
                while (bits != 0u) {
                    uint bit = uint(findLSB(bits));
                    bits &= bits - 1u;
                    light += local_light(lights[first + word * 32u + bit], point, normal);
                }
            }
            barrier();
        }
    }
    if (!on_page) {
        return;
    }
    if (has_emissive && (word & DRAW_EMISSIVE) != 0u) {
        light += emissive_of(draw_at(draw_of(word)).material);
    }
    if (!sees_draw(word) || (word & DRAW_UNLIT) != 0u) {
        light = vec3(1.0);
    }
    imageStore(out_light, pixel, vec4(light, luminance(light)));
}
