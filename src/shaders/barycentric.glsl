// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_BARYCENTRIC
#define ESTAMPE_BARYCENTRIC

// Barycentric weights of a triangle's corners at a pixel, with their screen-space derivatives.
struct Barycentric {
    vec3 weight; // perspective-correct weights of the three corners; their sum is 1
    vec3 dx;     // change of the weights per pixel to the right
    vec3 dy;     // change of the weights per pixel down
};

// Computes barycentric weights by homogeneous edge functions (Olano and Greer, "Triangle Scan Conversion
// using 2D Homogeneous Coordinates", 1997). The functions below do not divide by w (the fourth homogeneous
// coordinate), so triangles that cross the plane of the eye require no clipping. Corners are first made
// relative to the pixel, so that the cross products are precise for very small and very large triangles.
Barycentric barycentric_at(vec4 a, vec4 b, vec4 c, vec2 position_px, uvec2 size_px)
{
    vec2 ndc = 2.0 * position_px / vec2(size_px) - 1.0;
    vec2 p0 = a.xy - ndc * a.w;
    vec2 p1 = b.xy - ndc * b.w;
    vec2 p2 = c.xy - ndc * c.w;
    vec3 edge = vec3(p1.x * p2.y - p1.y * p2.x, p2.x * p0.y - p2.y * p0.x, p0.x * p1.y - p0.y * p1.x);
    vec3 edge_dx = vec3(p1.y * c.w - p2.y * b.w, p2.y * a.w - p0.y * c.w, p0.y * b.w - p1.y * a.w);
    vec3 edge_dy = vec3(p2.x * b.w - p1.x * c.w, p0.x * c.w - p2.x * a.w, p1.x * a.w - p0.x * b.w);
    float sum = edge.x + edge.y + edge.z;
    float inverse = sum != 0.0 ? 1.0 / sum : 0.0;
    Barycentric result;
    result.weight = edge * inverse;
    vec2 pixel_ndc = 2.0 / vec2(size_px);
    result.dx = (edge_dx - result.weight * (edge_dx.x + edge_dx.y + edge_dx.z)) * inverse * pixel_ndc.x;
    result.dy = (edge_dy - result.weight * (edge_dy.x + edge_dy.y + edge_dy.z)) * inverse * pixel_ndc.y;
    return result;
}

#endif
