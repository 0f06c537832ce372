// SPDX-License-Identifier: MIT
// One thread looks from its pixel to the right and down. Where the surface breaks it leaves a seed: a short piece of
// line, placed to a fraction of a pixel where the front triangle really ends, with its direction and width.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/material.glsl.h"
#include "shaders/mesh.glsl.h"
#include "shaders/noise.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/visibility.glsl"
#include "techniques/contour/contour.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame { FrameGlobals frame; };
layout(scalar, binding = 1) readonly buffer Visibility { uvec2 visibility[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) readonly buffer PosedVertices { PosedVertex posed_vertices[]; };
layout(scalar, binding = 4) readonly buffer Draws { DrawRecord draws[]; };
layout(scalar, binding = 5) readonly buffer Materials { MaterialRecord materials[]; };
layout(binding = 6) uniform usampler2D draw_image;
layout(binding = 7) uniform sampler2D depth_image;
layout(binding = 8) uniform sampler2D normal_image;
layout(binding = 9) uniform sampler2D coordinate_image;
layout(binding = 10) uniform sampler2D light_image;
layout(binding = 11, rgba16f) writeonly uniform image2D out_seed;    // offset from the pixel's centre, direction, half width
layout(binding = 12, r32ui) writeonly uniform uimage2D out_nearest;

layout(push_constant, scalar) uniform Constants { EdgeConstants constants; };

ivec2 on_page(ivec2 pixel) { return clamp(pixel, ivec2(0), ivec2(frame.size_px) - 1); }

struct Sample {
    uint draw;
    float depth;
    vec3 normal;
};

Sample sample_at(ivec2 pixel)
{
    ivec2 p = on_page(pixel);
    return Sample(texelFetch(draw_image, p, 0).x, texelFetch(depth_image, p, 0).x,
                  octahedral_decode(texelFetch(normal_image, p, 0).zw));
}

bool is_paper(uint draw)
{
    return draw == 0u || (materials[draws[draw - 1u].material].flags & MATERIAL_PAPER) != 0u;
}

// Whole width in pixels of the line between two neighbours; 0 for none. Reversed depth is linear over the page on a
// plane, so a break is a step that neither side's own slope foretells.
float line_width(Sample a, Sample b, ivec2 before, ivec2 after)
{
    if (a.draw != b.draw) {
        if (is_paper(a.draw) && is_paper(b.draw)) {
            return 0.0;
        }
        bool same_object = a.draw != 0u && b.draw != 0u && draws[a.draw - 1u].object == draws[b.draw - 1u].object;
        if (!same_object) {
            return constants.outline_px;
        }
    }
    if (a.draw == 0u) {
        return 0.0;
    }
    float step = b.depth - a.depth;
    float slope_a = a.depth - texelFetch(depth_image, on_page(before), 0).x;
    float slope_b = texelFetch(depth_image, on_page(after), 0).x - b.depth;
    float surprise = min(abs(step - slope_a), abs(step - slope_b));
    if (surprise > constants.depth_step * max(a.depth, b.depth)) {
        return constants.outline_px * 0.9;
    }
    if (a.draw != b.draw && draws[a.draw - 1u].material != draws[b.draw - 1u].material) {
        return constants.boundary_px;
    }
    float bend = dot(a.normal, b.normal);
    if (bend < constants.crease_cosine) {
        vec3 normal_before = octahedral_decode(texelFetch(normal_image, on_page(before), 0).zw);
        vec3 normal_after = octahedral_decode(texelFetch(normal_image, on_page(after), 0).zw);
        float around = (1.0 - dot(normal_before, a.normal)) + (1.0 - dot(b.normal, normal_after));
        return around < 0.5 * (1.0 - bend) ? constants.crease_px : 0.0;
    }
    return 0.0;
}

vec2 page_position(vec4 clip) { return (0.5 * clip.xy / clip.w + 0.5) * vec2(frame.size_px); }

// Where the way from pixel `from` to its neighbour `to` leaves the triangle seen at `from`: the share of the way, and the
// direction of the edge that is crossed.
void exit_of_triangle(ivec2 from, ivec2 to, inout float share, inout vec2 direction)
{
    uvec2 seen = visibility[uint(from.y) * frame.size_px.x + uint(from.x)];
    if (!sees_triangle(seen)) {
        return;
    }
    uvec4 corners = triangles[seen_triangle(seen)];
    vec4 clip[3];
    clip[0] = frame.clip_from_anchor * vec4(posed_vertices[corners.x].position, 1.0);
    clip[1] = frame.clip_from_anchor * vec4(posed_vertices[corners.y].position, 1.0);
    clip[2] = frame.clip_from_anchor * vec4(posed_vertices[corners.z].position, 1.0);
    if (min(clip[0].w, min(clip[1].w, clip[2].w)) <= frame.near_m * 0.5) {
        return;
    }
    vec2 start = vec2(from) + 0.5;
    vec2 way = vec2(to - from);
    float nearest = 2.0;
    for (int i = 0; i < 3; ++i) {
        vec2 a = page_position(clip[i]);
        vec2 edge = page_position(clip[(i + 1) % 3]) - a;
        float crossing = way.x * edge.y - way.y * edge.x;
        if (abs(crossing) < 1e-6) {
            continue;
        }
        vec2 between = a - start;
        float along = (between.x * edge.y - between.y * edge.x) / crossing;
        float on_edge = (between.x * way.y - between.y * way.x) / crossing;
        if (along >= 0.0 && along < nearest && on_edge >= -0.01 && on_edge <= 1.01) {
            nearest = along;
            direction = normalize(edge);
        }
    }
    if (nearest <= 1.0) {
        share = nearest;
    }
}

float pressure_at(ivec2 pixel, float depth)
{
    vec3 p = texelFetch(coordinate_image, pixel, 0).xyz;
    float slow = value_noise(11.0 * p.xy + 7.0 * p.z, 3u) - 0.5;
    float shade = 1.0 - clamp(texelFetch(light_image, pixel, 0).a, 0.0, 1.0);
    float away = distance(anchor_at(frame, vec2(pixel) + 0.5, max(depth, 1e-9)), frame.eye_anchor);
    float thinning = mix(1.0, clamp(pow(2.2 * frame.scene_radius_m / max(away, 1e-6), 0.4), 0.45, 1.25), constants.distance_thinning);
    return thinning * mix(1.0, 0.62 + 0.75 * shade + 0.7 * slow, constants.pressure);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    Sample here = sample_at(pixel);
    vec2 offset = vec2(0.0);
    vec2 direction = vec2(0.0);
    float width = 0.0;
    float found = 0.0;
    for (int i = 0; i < 2; ++i) {
        ivec2 way = i == 0 ? ivec2(1, 0) : ivec2(0, 1);
        ivec2 other = pixel + way;
        if (any(greaterThanEqual(other, ivec2(frame.size_px)))) {
            continue;
        }
        Sample there = sample_at(other);
        float line = line_width(here, there, pixel - way, other + way);
        if (line <= 0.0) {
            continue;
        }
        bool here_in_front = here.depth >= there.depth;
        ivec2 front = here_in_front ? pixel : other;
        float share = 0.5;
        vec2 edge_direction = vec2(way.y, way.x);
        exit_of_triangle(front, here_in_front ? other : pixel, share, edge_direction);
        offset += vec2(way) * (here_in_front ? share : 1.0 - share);
        direction += dot(direction, edge_direction) < 0.0 ? -edge_direction : edge_direction;
        width = max(width, line * pressure_at(front, here_in_front ? here.depth : there.depth));
        found += 1.0;
    }
    if (found == 0.0) {
        imageStore(out_seed, pixel, vec4(0.0));
        imageStore(out_nearest, pixel, uvec4(NO_SEED));
        return;
    }
    offset /= found;
    imageStore(out_seed, pixel, vec4(offset, atan(direction.y, direction.x), 0.5 * width));
    imageStore(out_nearest, pixel, uvec4(uint(pixel.y) << 16 | uint(pixel.x)));
}
