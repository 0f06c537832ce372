// SPDX-License-Identifier: MIT
// One thread converts one listed pixel to a seed: a short piece of line with direction and width. The seed is
// placed with subpixel precision, where the nearer triangle ends. The order of the list does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/noise.glsl"
#include "shaders/visibility.glsl"
#include "techniques/contour/contour.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) readonly buffer Visibility
{
    uvec2 visibility[];
};

#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"

layout(binding = 4) uniform sampler2D depth_image;
layout(binding = 5) uniform sampler2D coordinate_image;
layout(binding = 6) uniform sampler2D light_image;

layout(scalar, binding = 7) readonly buffer Count
{
    uint edge_count;
};

layout(scalar, binding = 8) readonly buffer Edges
{
    EdgePixel edges[];
};

layout(binding = 9) uniform usampler2D draw_image;

#define DRAW_TEXELS_BINDING 10
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 11
#include "shaders/material_texels.glsl"

layout(binding = 12,
       // In xy the offset of the seed from the pixel's centre, in zw the line's direction times half the
       // line's width.
       rgba16f) writeonly uniform image2D out_seed;

layout(push_constant, scalar) uniform Constants
{
    SeedConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_own_outlines = (variant & seeds_has_own_outlines) != 0u;

vec2 page_position(vec4 clip)
{
    return (0.5 * clip.xy / clip.w + 0.5) * vec2(frame.page_px) - vec2(frame.tile_from_px);
}

// Finds where the straight path from pixel `from` to its neighbour `to` leaves the triangle seen at `from`.
// Returns where the path leaves the triangle, as a share of the path, and the direction of the crossed edge.
void exit_of_triangle(ivec2 from, ivec2 to, inout float share, inout vec2 direction)
{
    uvec2 seen = visibility[uint(from.y) * frame.size_px.x + uint(from.x)];
    if (!sees_triangle(seen)) {
        return;
    }
    uvec4 corners = triangle_at(seen_triangle(seen));
    vec4 clip[3];
    clip[0] = frame.clip_from_anchor * vec4(posed_vertex_at(corners.x).position, 1.0);
    clip[1] = frame.clip_from_anchor * vec4(posed_vertex_at(corners.y).position, 1.0);
    clip[2] = frame.clip_from_anchor * vec4(posed_vertex_at(corners.z).position, 1.0);
    if (min(clip[0].w, min(clip[1].w, clip[2].w)) <= frame.near_m * 0.5) {
        return;
    }
    vec2 start = vec2(from) + 0.5;
    vec2 way = vec2(to - from);
    float nearest = 2.0;
    float behind = 2.0;
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
        if (on_edge < -0.01 || on_edge > 1.01) {
            continue;
        }
        if (along >= 0.0 && along < nearest) {
            nearest = along;
            direction = normalize(edge);
        }
        behind = along < 0.0 ? min(behind, -along) : behind;
    }
    if (nearest <= 1.0) {
        // A triangle narrower than a pixel is rarely the last triangle of its surface. The surface then ends
        // somewhere between the narrow triangle's pixel and the neighbouring pixel.
        share = mix(0.5 + 0.5 * nearest, nearest, clamp(nearest + behind, 0.0, 1.0));
    }
}

float pressure_at(ivec2 pixel, float depth)
{
    vec3 p = texelFetch(coordinate_image, pixel, 0).xyz;
    float slow = value_noise(11.0 * p.xy + 7.0 * p.z, 3u) - 0.5;
    float shade = 1.0 - clamp(texelFetch(light_image, pixel, 0).a, 0.0, 1.0);
    float away = distance(anchor_at(frame, vec2(pixel) + 0.5, max(depth, 1e-9)), frame.eye_anchor);
    float thinning = mix(1.0, thinned_at(frame, away), constants.distance_thinning);
    return thinning * mix(1.0, 0.62 + 0.75 * shade + 0.7 * slow, constants.pressure);
}

// Size of a pixel in metres at a point. In perspective, the pixel's size depends on the point's distance from
// the eye, not on the point's depth. So an outline at a constant distance has a constant width all over the
// page.
float pixel_there_m(vec3 point)
{
    return frame.is_orthographic != 0u ? pixel_size_m(frame, point)
                                       : distance(point, frame.eye_anchor) * constants.pixel_m_at_one;
}

// Places the line between a pixel and its neighbour: finds the offset from the pixel's centre and the line's
// direction.
void place_line(ivec2 pixel, ivec2 way, inout float width, out vec2 offset, out vec2 direction)
{
    float depth_here = texelFetch(depth_image, pixel, 0).x;
    float depth_there = texelFetch(depth_image, pixel + way, 0).x;
    bool here_in_front = depth_here >= depth_there;
    ivec2 front = here_in_front ? pixel : pixel + way;
    float share = 0.5;
    direction = vec2(way.y, way.x);
    exit_of_triangle(front, here_in_front ? pixel + way : pixel, share, direction);
    offset = vec2(way) * (here_in_front ? share : 1.0 - share);
    width *= pressure_at(front, max(depth_here, depth_there));
    uint word = texelFetch(draw_image, front, 0).x;
    if (has_own_outlines && sees_draw(word)) {
        float own_m = outline_width_m_of(draw_at(draw_of(word)).material);
        vec3 point = anchor_at(frame, vec2(front) + 0.5, max(max(depth_here, depth_there), 1e-9));
        width = own_m > 0.0 ? own_m / pixel_there_m(point) : width;
    }
}

void main()
{
    uint count = min(edge_count, constants.capacity);
    for (uint i = gl_GlobalInvocationID.x; i < count; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x) {
        EdgePixel edge = edges[i];
        vec2 widths = unpackHalf2x16(edge.widths_px);
        ivec2 pixel = ivec2(edge.pixel & 0xffffu, edge.pixel >> 16);
        vec2 offset = vec2(0.0);
        vec2 direction = vec2(0.0);
        float width = 0.0;
        float found = 0.0;
        for (int side = 0; side < 2; ++side) {
            float side_width = side == 0 ? widths.x : widths.y;
            if (side_width <= 0.0) {
                continue;
            }
            vec2 side_offset, side_direction;
            place_line(pixel, side == 0 ? ivec2(1, 0) : ivec2(0, 1), side_width, side_offset, side_direction);
            offset += side_offset;
            direction += dot(direction, side_direction) < 0.0 ? -side_direction : side_direction;
            width = max(width, side_width);
            found += 1.0;
        }
        direction = length(direction) > 1e-6 ? normalize(direction) : vec2(1.0, 0.0);
        imageStore(out_seed, pixel, vec4(offset / max(found, 1.0), direction * 0.5 * width));
    }
}
