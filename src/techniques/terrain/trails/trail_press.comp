// SPDX-License-Identifier: MIT
// One workgroup presses one stamp into the ground. A stamp is a bar whose round ends may have different
// radii. The displaced sand becomes a rim around the bar, by weights that are first summed in a fixed order.
// A known stamp (pressed earlier) only changes texels that are new in the window.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

const uint threads = 64u;
layout(local_size_x = threads) in;

layout(scalar, binding = 0) buffer Heights
{
    float height_m[];
};

layout(push_constant, scalar) uniform Constants
{
    TrailPress press;
};

#include "techniques/terrain/trails/trail_texels.glsl"

shared float displaced_by[threads];
shared float weight_of[threads];

// Distance of a texel from the edge of the stamp, in metres; negative inside the stamp.
float distance_m(ivec2 texel)
{
    vec2 place = press.texel_m * vec2(texel);
    vec2 along = press.to - press.from;
    float share = clamp(dot(place - press.from, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
    return distance(place, press.from + share * along) - mix(press.from_radius_m, press.to_radius_m, share);
}

// Height profile of the pressed area at a distance from its edge: flat inside, with a sloping edge.
float sole_m(float distance)
{
    return -min(press.depth_m, press.steepness * max(-distance, 0.0));
}

float height_before(ivec2 texel)
{
    bool is_seen = press.is_known == 0u && is_within(press.window, texel);
    return is_seen ? height_m[kept_at(press.window, texel)] : 0.0;
}

bool is_pressed(ivec2 texel)
{
    return is_within(press.window, texel) &&
           (press.is_known == 0u || !is_within(press.window, texel + ivec2(press.moved_x, press.moved_y)));
}

// Weight of a texel in the distribution of sand to the rim. Ground that is already low gets little sand.
float rim_weight(float distance, float height)
{
    float across = clamp(distance / press.rim_m, 0.0, 1.0);
    float bump = distance < 0.0 ? 0.0 : (1.0 - across) * (1.0 - across) * (0.25 + across);
    return bump * (0.01 + clamp(1.0 + 2.0 * height / press.depth_m, 0.0, 1.0));
}

void main()
{
    ivec2 low = ivec2(press.low_x, press.low_y);
    ivec2 size = ivec2(press.high_x, press.high_y) - low + 1;
    ivec2 base = ivec2(press.base_x, press.base_y);
    uint id = gl_LocalInvocationID.x;
    uint count = uint(size.x * size.y);
    float displaced = 0.0;
    float weight = 0.0;
    for (uint i = id; i < count; i += threads) {
        ivec2 texel = low + ivec2(int(i) % size.x, int(i) / size.x);
        float height = height_before(base + texel);
        float away = distance_m(texel);
        displaced += away < 0.0 ? max(height - sole_m(away), 0.0) : 0.0;
        weight += rim_weight(away, height);
    }
    displaced_by[id] = displaced;
    weight_of[id] = weight;
    barrier();
    displaced = 0.0;
    weight = 0.0;
    for (uint i = 0u; i < threads; ++i) {
        displaced += displaced_by[i];
        weight += weight_of[i];
    }
    if (weight <= 0.0) {
        return;
    }
    for (uint i = id; i < count; i += threads) {
        ivec2 texel = low + ivec2(int(i) % size.x, int(i) / size.x);
        if (!is_pressed(base + texel)) {
            continue;
        }
        uint at = kept_at(press.window, base + texel);
        float height = height_m[at];
        float away = distance_m(texel);
        height_m[at] =
            away < 0.0 ? min(height, sole_m(away)) : height + displaced / weight * rim_weight(away, height);
    }
}
