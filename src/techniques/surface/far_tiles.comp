// SPDX-License-Identifier: MIT
// One thread per tile of 8 x 8 pixels lists the tile if any pixel shows the background or a distant surface.
// CPUs test several tiles in lockstep, pixel by pixel, until all are decided.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/loops.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;

#define TILE_LIST_BINDING 2
#include "shaders/tile_list_fill.glsl"

layout(push_constant, scalar) uniform Constants
{
    float from_m; // distance from the eye from which surfaces count as far
};

// Cosine of the angle between the view direction and the ray to a corner of the tile.
float straight_at(vec2 corner_px)
{
    return dot(normalize(anchor_at(frame, corner_px, 1e-5) - frame.eye_anchor), frame.view_forward);
}

// Upper bound on the reversed depth of surfaces at `distance_m` or farther, anywhere in the tile. Some nearer
// surfaces may also pass the test.
float depth_at_most(vec2 from_px, float distance_m)
{
    float least = min(min(straight_at(from_px), straight_at(from_px + vec2(8.0, 0.0))),
                      min(straight_at(from_px + vec2(0.0, 8.0)), straight_at(from_px + 8.0)));
    return frame.near_m / max(0.999 * distance_m * least, 1e-9);
}

void main()
{
    uvec2 tile = gl_GlobalInvocationID.xy;
    uvec2 from_px = 8u * tile;
    bool is_on_page = all(lessThan(from_px, frame.size_px));
    ivec2 last_px = ivec2(frame.size_px) - 1;
    // In parallel projection, depth does not give the distance from the eye, so all tiles pass.
    float limit = frame.is_orthographic != 0u ? 1e30 : depth_at_most(vec2(from_px), from_m);
    bool is_far = false;
    int i = 0;
    do {
        ivec2 pixel = min(ivec2(from_px) + ivec2(i & 7, i >> 3), last_px);
        is_far = is_far || texelFetch(depth_image, pixel, 0).x <= limit;
        ++i;
    } while (subgroupAny(!is_far && i < loop_rounds(64, int(tile.x))));
    if (is_on_page && is_far) {
        list_tile(tile);
    }
}
