// SPDX-License-Identifier: MIT
// One workgroup lists the lights whose sphere touches one large tile of the page, in the lights' order. The
// workgroup ignores depth; the light pass culls again per small tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "techniques/light/local_light.glsl"

layout(local_size_x = 64) in;

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

layout(scalar, binding = 3) writeonly buffer Lists
{
    // Per large tile: the number of lights, then their indices, counted from the first local light.
    uint lists[];
};

layout(push_constant, scalar) uniform Constants
{
    ListTiles list_tiles;
};

shared uint touching[2]; // one bit for each of 64 lights that are tested; set if the light reaches the tile

// The plane through three points, as the normal n in xyz and the offset d in w. The point `inside` is on the
// side of the plane with the points p for which dot(n, p) >= d.
vec4 side_through(vec3 a, vec3 b, vec3 c, vec3 inside)
{
    vec3 n = normalize(cross(b - a, c - a));
    n *= dot(n, inside - a) < 0.0 ? -1.0 : 1.0;
    return vec4(n, dot(n, a));
}

// The four side planes of the tile's frustum.
vec4[4] sides_of(uint tile)
{
    vec2 low = vec2(uvec2(tile % list_tiles.columns, tile / list_tiles.columns) * list_tiles.tile_px);
    vec2 high = min(low + float(list_tiles.tile_px), vec2(frame.size_px));
    vec2 corners[4] = vec2[](low, vec2(high.x, low.y), high, vec2(low.x, high.y));
    bool is_parallel = frame.is_orthographic != 0u;
    // The points at the tile's corners are taken at a depth of about the scene's size, so that the planes are
    // precise.
    float depth = is_parallel ? 0.5 : min(frame.near_m / frame.scene_radius_m, 0.5);
    vec3 from[4];
    vec3 far[4];
    for (int i = 0; i < 4; ++i) {
        far[i] = anchor_at(frame, corners[i], depth);
        from[i] = is_parallel ? far[i] - frame.view_forward * frame.scene_radius_m : frame.eye_anchor;
    }
    vec3 inside = 0.25 * (far[0] + far[1] + far[2] + far[3]);
    return vec4[](
        side_through(from[0], far[0], far[1], inside), side_through(from[1], far[1], far[2], inside),
        side_through(from[2], far[2], far[3], inside), side_through(from[3], far[3], far[0], inside));
}

bool touches(vec4 sides[4], vec4 reach)
{
    vec3 from_eye = reach.xyz - frame.eye_anchor;
    float radius = reach.w + 1e-4 * length(from_eye); // enlarged by a margin against rounding
    bool ahead = frame.is_orthographic != 0u || dot(frame.view_forward, from_eye) > -radius;
    for (int i = 0; i < 4; ++i) {
        ahead = ahead && dot(sides[i].xyz, reach.xyz) - sides[i].w > -radius;
    }
    return ahead;
}

void main()
{
    uint tile = gl_WorkGroupID.x;
    vec4 sides[4] = sides_of(tile);
    uint stride = lighting.local_count + 1u;
    uint listed = 0u;
    uint thread = gl_LocalInvocationIndex;
    for (uint done = 0u; done < lighting.local_count; done += 64u) {
        if (thread < 2u) {
            touching[thread] = 0u;
        }
        barrier();
        uint light = done + thread;
        if (light < lighting.local_count) {
            if (touches(sides, reach_of(lights[lighting.directional_count + light]))) {
                atomicOr(touching[thread >> 5], 1u << (thread & 31u));
            }
        }
        barrier();
        uint first = touching[0];
        uint second = touching[1];
        uint lower = (1u << (thread & 31u)) - 1u;
        uint before = thread < 32u ? bitCount(first & lower) : bitCount(first) + bitCount(second & lower);
        if ((((thread < 32u ? first : second) >> (thread & 31u)) & 1u) != 0u) {
            lists[tile * stride + 1u + listed + before] = light;
        }
        listed += bitCount(first) + bitCount(second);
        barrier();
    }
    if (thread == 0u) {
        lists[tile * stride] = listed;
    }
}
