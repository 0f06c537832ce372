// SPDX-License-Identifier: MIT
// One thread handles one vertex. The thread computes the radial curvature: the curvature of the curve in
// which the plane through eye and normal cuts the surface. The thread also tests whether the radial curvature
// grows enough towards the eye for a suggestive contour.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usamplerBuffer posed_vertex_texels;
layout(binding = 2) uniform usamplerBuffer bending_texels; // the VertexBending of each vertex, as two texels

layout(scalar, binding = 3) writeonly buffer ViewBends
{
    vec2 view_bends[];
};

layout(push_constant, scalar) uniform Constants
{
    ViewBendConstants constants;
};

PosedVertex posed_vertex_at(uint vertex)
{
    uvec4 words = texelFetch(posed_vertex_texels, int(vertex));
    return PosedVertex(uintBitsToFloat(words.xyz), words.w);
}

void main()
{
    uint index = item_index();
    if (index >= constants.vertex_count) {
        return;
    }
    uvec4 first = texelFetch(bending_texels, int(2u * index));
    vec3 form = uintBitsToFloat(first.yzw);
    vec4 change = uintBitsToFloat(texelFetch(bending_texels, int(2u * index + 1u)));
    PosedVertex vertex = posed_vertex_at(index);
    vec3 normal = unpack_normal(vertex.normal);
    // The tangent frame follows a neighbouring vertex, so that the frame moves with the surface.
    vec3 x = posed_vertex_at(first.x).position - vertex.position;
    x -= normal * dot(normal, x);
    x /= max(length(x), 1e-30);
    vec3 y = cross(normal, x);
    vec3 way = towards_eye(frame, vertex.position);
    float cosine = dot(normal, way);
    vec3 in_plane = way - normal * cosine;
    float sine = max(length(in_plane), 1e-4);
    vec2 w = vec2(dot(in_plane, x), dot(in_plane, y)) / sine;
    float radial = form.x * w.x * w.x + 2.0 * form.y * w.x * w.y + form.z * w.y * w.y;
    vec3 change_along = change.xyz * w.x + change.yzw * w.y;
    float third = change_along.x * w.x * w.x + 2.0 * change_along.y * w.x * w.y + change_along.z * w.y * w.y;
    float gauss = form.x * form.z - form.y * form.y;
    float growth = third + 2.0 * gauss * cosine / sine;
    float strength = min(growth / constants.least_growth - 1.0,
                         min(8.0 * (sine / constants.least_sine - 1.0), 8.0 * cosine));
    view_bends[index] = vec2(radial, strength);
}
