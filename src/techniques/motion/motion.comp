// SPDX-License-Identifier: MIT
// One thread computes, for one pixel, where on the page the visible point was in the previous frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"
#include "techniques/motion/motion.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define VISIBILITY_BINDING 1
#include "shaders/visibility_texels.glsl"

layout(binding = 4) uniform usamplerBuffer vertex_texels_before;
layout(binding = 5, rgba32f) writeonly uniform image2D out_motion;

layout(push_constant, scalar) uniform Constants
{
    MotionConstants constants;
};

vec4 vertex_before(uint vertex)
{
    return vec4(uintBitsToFloat(texelFetch(vertex_texels_before, int(vertex)).xyz), 1.0);
}

// A point in homogeneous coordinates of anchor space (relative to a nearby origin), in this frame and in the
// previous frame.
struct Point {
    vec4 now;
    vec4 before;
};

Point seen_point(uvec2 seen, vec2 position_px)
{
    uvec4 corners = triangle_at(seen_triangle(seen));
    vec4 a = vec4(posed_vertex_at(corners.x).position, 1.0);
    vec4 b = vec4(posed_vertex_at(corners.y).position, 1.0);
    vec4 c = vec4(posed_vertex_at(corners.z).position, 1.0);
    vec3 weight = barycentric_at(frame.clip_from_anchor * a, frame.clip_from_anchor * b,
                                 frame.clip_from_anchor * c, position_px, frame.size_px)
                      .weight;
    return Point(mat3x4(a, b, c) * weight,
                 mat3x4(vertex_before(corners.x), vertex_before(corners.y), vertex_before(corners.z)) *
                     weight);
}

// A point of the background at a pixel. The background is infinitely far away; in a parallel view it lies on
// the far plane.
Point far_point(vec2 position_px)
{
    vec4 far = frame.anchor_from_clip * vec4(ndc_at(position_px, frame.size_px), 0.0, 1.0);
    far.w = frame.is_orthographic != 0u ? far.w : 0.0;
    return Point(far, far);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 position_px = vec2(pixel) + 0.5;
    uvec2 seen = visibility_at(pixel);
    Point point = far_point(position_px);
    if (sees_triangle(seen)) {
        point = seen_point(seen, position_px);
    }
    vec4 now = constants.clip_from_anchor * point.now;
    vec4 before = constants.clip_from_anchor_before * point.before;
    bool is_known = before.w > 0.0;
    vec2 moved_px = 0.5 * vec2(frame.size_px) * (now.xy / now.w - before.xy / before.w);
    imageStore(out_motion, pixel,
               is_known ? vec4(moved_px, sees_triangle(seen) ? before.z / before.w : 0.0, 1.0) : vec4(0.0));
}
