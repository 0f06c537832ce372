// SPDX-License-Identifier: MIT
// One thread per pixel interpolates the occlusion between the vertices of its triangle.
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

layout(scalar, binding = 4) readonly buffer Open
{
    float open_of_vertex[];
};

layout(binding = 5) uniform samplerBuffer bounced_of_vertex;
layout(binding = 6, r16f) writeonly uniform image2D out_open;
layout(binding = 7, rgba16f) writeonly uniform image2D out_bounced;

layout(push_constant) uniform Constants
{
    float strength;
    float bleeding;
    uint vertex_count; // number of vertices that have discs; the ground's vertices follow
}

constants;

layout(constant_id = 0) const uint variant = 0u;
const bool bounces = (variant & discs_bounce) != 0u;

float open_at(uint vertex)
{
    return vertex < constants.vertex_count ? open_of_vertex[vertex] : 1.0;
}

vec3 bounced_at(uint vertex)
{
    return vertex < constants.vertex_count ? texelFetch(bounced_of_vertex, int(vertex)).rgb : vec3(0.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uvec2 seen = visibility_at(pixel);
    float open = 1.0;
    vec3 bounced = vec3(0.0);
    if (sees_triangle(seen)) {
        uvec4 corners = triangle_at(seen_triangle(seen));
        Barycentric at =
            barycentric_at(frame.clip_from_anchor * vec4(posed_vertex_at(corners.x).position, 1.0),
                           frame.clip_from_anchor * vec4(posed_vertex_at(corners.y).position, 1.0),
                           frame.clip_from_anchor * vec4(posed_vertex_at(corners.z).position, 1.0),
                           page_place(frame, vec2(pixel) + 0.5), frame.page_px);
        vec3 of_corners = vec3(open_at(corners.x), open_at(corners.y), open_at(corners.z));
        open = clamp(dot(of_corners, at.weight), 0.0, 1.0);
        if (bounces) {
            bounced = mat3(bounced_at(corners.x), bounced_at(corners.y), bounced_at(corners.z)) * at.weight;
        }
    }
    imageStore(out_open, pixel, vec4(pow(open, constants.strength)));
    if (bounces) {
        imageStore(out_bounced, pixel, vec4(max(constants.bleeding * bounced, vec3(0.0)), 0.0));
    }
}
