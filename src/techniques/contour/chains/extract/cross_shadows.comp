// SPDX-License-Identifier: MIT
// One thread handles one point of the page lattice (a grid of points on the page) and its sides to the right
// and downwards. The edge of the sun's shadow crosses a side if more than half of the sun is visible at one
// end of the side and less than half at the other end. The visible share at a lattice point is the mean of 4
// x 4 pixels around the point, so that the edge is smooth.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/loops.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

// Visible share of the sun; negative on surfaces that face away from the sun.
layout(binding = 1) uniform sampler2D share_image;
layout(binding = 2) uniform usampler2D draw_image;
layout(binding = 3) uniform sampler2D depth_image;
layout(binding = 4) uniform usampler2D normal_image;

layout(scalar, binding = 5) writeonly buffer Crossings
{
    uvec2 crossings[];
};

layout(push_constant, scalar) uniform Constants
{
    CellConstants constants;
};

#include "techniques/contour/chains/extract/page_cells.glsl"

// Smallest cosine of the angle between the normals at both ends of a side; at a larger bend no shadow line is
// drawn.
const float least_cosine = 0.8;

// The surface seen at one point of the page lattice (a grid of points on the page).
struct Place {
    float share;
    uint draw;
    vec3 point;
    vec3 normal;
    bool counts;
};

Place place_at(uvec2 point)
{
    ivec2 last = ivec2(frame.size_px) - 1;
    ivec2 pixel = min(pixel_of_point(point), last);
    uint draw = draw_of(texelFetch(draw_image, pixel, 0).x);
    Cells around = Cells(clamp(pixel - 2, ivec2(0), last), clamp(pixel + 1, ivec2(0), last));
    float sum = 0.0;
    float count = 0.0;
    for (ivec2 at = around.low; at.y <= around.high.y; at = next_cell(at, around)) {
        float share = texelFetch(share_image, at, 0).x;
        bool is_alike = share >= 0.0 && draw_of(texelFetch(draw_image, at, 0).x) == draw;
        sum += is_alike ? share : 0.0;
        count += is_alike ? 1.0 : 0.0;
    }
    float depth = max(texelFetch(depth_image, pixel, 0).x, 1e-9);
    bool counts = texelFetch(share_image, pixel, 0).x >= 0.0 &&
                  all(lessThan(point, uvec2(constants.columns, constants.rows)));
    return Place(sum / max(count, 1.0), draw, anchor_at(frame, vec2(pixel) + 0.5, depth),
                 unpack_normal(texelFetch(normal_image, pixel, 0).y), counts);
}

// Whether two lattice points lie on one surface that is smooth between them.
bool is_one_surface(Place a, Place b)
{
    vec3 way = b.point - a.point;
    vec3 normal = unit(a.normal + b.normal);
    float off = dot(way, normal);
    return a.counts && b.counts && a.draw == b.draw && dot(a.normal, b.normal) > least_cosine &&
           off * off < (1.0 - least_cosine * least_cosine) * dot(way, way);
}

uint crossing_between(Place a, Place b)
{
    bool is_dark = a.share < 0.5;
    bool ends = is_dark != (b.share < 0.5);
    float share = clamp((0.5 - a.share) / (ends ? b.share - a.share : 1.0), 0.0, 1.0);
    return pack_crossing(Crossing(ends && is_one_surface(a, b), is_dark, false, share));
}

void main()
{
    uvec2 point = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(point, uvec2(constants.columns, constants.rows)))) {
        return;
    }
    Place here = place_at(point);
    crossings[point.y * constants.columns + point.x] =
        uvec2(crossing_between(here, place_at(point + uvec2(1u, 0u))),
              crossing_between(here, place_at(point + uvec2(0u, 1u))));
}
