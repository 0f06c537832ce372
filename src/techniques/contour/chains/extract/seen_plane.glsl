// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SEEN_PLANE
#define ESTAMPE_SEEN_PLANE

// The planes of the triangles that are seen at pixels. Requires before inclusion: `frame`, a FrameGlobals,
// and mesh_texels.glsl.

#include "shaders/camera.glsl"

struct Ray {
    vec3 from;
    vec3 way; // direction of the ray, not normalised; linear in page coordinates
};

// The ray through a position on the page. The ray's direction is scaled so that nearby and distant surfaces
// need no large numbers.
Ray ray_at(vec2 place_px)
{
    vec3 way = (frame.anchor_from_clip * vec4(ndc_at(place_px, frame.size_px), 0.0, 1.0)).xyz;
    return frame.is_orthographic != 0u ? Ray(anchor_at(frame, place_px, 1.0), frame.view_forward)
                                       : Ray(frame.eye_anchor, way);
}

struct SeenPlane {
    vec3 place;
    vec3 normal; // surface normal, not normalised
};

SeenPlane seen_plane(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    return SeenPlane(a, cross(b - a, c - a));
}

// Nearness of a plane along a ray: larger values are nearer to the eye. Linear in page coordinates.
float nearness(SeenPlane plane, Ray ray)
{
    float away = dot(plane.normal, plane.place - ray.from);
    float along = dot(plane.normal, ray.way);
    return frame.is_orthographic != 0u ? -away / along : along / away;
}

vec3 seen_point(SeenPlane plane, Ray ray)
{
    return ray.from + ray.way * (dot(plane.normal, plane.place - ray.from) / dot(plane.normal, ray.way));
}

#endif
