// SPDX-License-Identifier: MIT
// One thread tests one side of the page lattice (a grid of points on the page): do the two surfaces seen at
// the ends of the side intersect in between? The shader extends each surface to a plane. The surfaces
// intersect if each plane is nearer to the eye than the other plane at its own end of the side. False lines
// beside an outline are dropped later, in drop.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"
#include "techniques/contour/chains/extract/seen_plane.glsl"

#define VISIBILITY_BINDING 3
#include "shaders/visibility_texels.glsl"

layout(binding = 4) uniform usamplerBuffer neighbor_texels;

#define MEETINGS_BINDING 5
#define MEETINGS_ACCESS readonly
#include "techniques/contour/chains/extract/meeting_list.glsl"

layout(scalar, binding = 6) buffer Crossings
{
    // Two words per point of the page lattice: where a line crosses the side to the right, and the side
    // downwards.
    uint crossings[];
};

layout(push_constant, scalar) uniform Constants
{
    CellConstants constants;
};

#include "techniques/contour/chains/extract/page_cells.glsl"

const float slack = 0.5;        // tolerance in pixels, because surfaces may curve between two pixels
const float least_angle = 0.09; // smallest angle in radians between intersecting planes that get a line

uint shell_of(uint triangle)
{
    return texelFetch(neighbor_texels, int(triangle)).w >> neighbor_shell_shift;
}

// Finds the crossing on the side from `pixel` in the direction `way`. If a pixel lies between the two ends of
// the side, the pixel replaces the end that shows the pixel's shell (connected surface).
uint crossing_on(ivec2 pixel, ivec2 way)
{
    uint from = seen_triangle(visibility_at(pixel));
    uint between = seen_triangle(visibility_at(pixel + way));
    uint to = seen_triangle(visibility_at(pixel + 2 * way));
    bool rises = shell_of(from) < shell_of(to);
    bool is_beyond = shell_of(between) == shell_of(from);
    from = is_beyond ? between : from;
    to = is_beyond ? to : between;
    SeenPlane a = seen_plane(from);
    SeenPlane b = seen_plane(to);
    vec2 from_px = vec2(pixel + (is_beyond ? way : ivec2(0))) + 0.5;
    vec2 to_px = from_px + vec2(way);
    float lead_from = nearness(a, ray_at(from_px)) - nearness(b, ray_at(from_px));
    float lead_to = nearness(a, ray_at(to_px)) - nearness(b, ray_at(to_px));
    float share = lead_from / max(lead_from - lead_to, 1e-30);
    vec3 bend = cross(a.normal, b.normal);
    bool do_cross =
        lead_from > lead_to && abs(share - 0.5) < 0.5 + slack &&
        dot(bend, bend) > least_angle * least_angle * dot(a.normal, a.normal) * dot(b.normal, b.normal);
    return pack_crossing(Crossing(do_cross, rises, is_beyond, 0.5 * (share + (is_beyond ? 1.0 : 0.0))));
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= meeting_count) {
        return;
    }
    uint side = meeting_sides[index];
    bool is_down = (side & 1u) != 0u;
    crossings[side] =
        crossing_on(pixel_of_point(point_of_cell(side / 2u)), is_down ? ivec2(0, 1) : ivec2(1, 0));
}
