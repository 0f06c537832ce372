// SPDX-License-Identifier: MIT
// One thread handles one seed on a moving body. From the seed, the thread walks back along the motion to the
// body's trailing edge, where the body uncovers the background. A smear stroke may begin at that edge.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/hash.glsl"
#include "shaders/loops.glsl"
#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"
#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usamplerBuffer seeds;
layout(binding = 4) uniform usamplerBuffer vertex_texels_before;
layout(binding = 5) uniform usampler2D page_image;
layout(binding = 6) uniform sampler2D owner_depth_image;

layout(scalar, binding = 7) writeonly buffer Strokes
{
    SmearStroke strokes[];
};

layout(push_constant, scalar) uniform Constants
{
    SmearConstants constants;
};

const float step_px = 2.0;
const int most_steps = 2048;
const float hair_half_px = 0.75;

vec3 vertex_before(uint vertex)
{
    return uintBitsToFloat(texelFetch(vertex_texels_before, int(vertex)).xyz);
}

float length_of(vec2 way)
{
    return sqrt(dot(way, way));
}

vec2 way_at(ivec2 pixel)
{
    return unpackHalf2x16(texelFetch(page_image, pixel, 0).w);
}

bool is_on_page(ivec2 pixel)
{
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(constants.size_px)));
}

bool goes_along(vec2 way, vec2 own_way)
{
    return dot(way, own_way) > 0.5 * dot(own_way, own_way);
}

// Position of a seed on the page, and its displacement in half the exposure. The displacement is 0 if the
// seed is behind the eye.
vec4 place_and_way(uvec4 seed)
{
    uvec4 corners = triangle_at(seed.x);
    vec2 part = uintBitsToFloat(seed.yz);
    vec3 weight = vec3(1.0 - part.x - part.y, part);
    vec3 place = mat3(posed_vertex_at(corners.x).position, posed_vertex_at(corners.y).position,
                      posed_vertex_at(corners.z).position) *
                 weight;
    vec3 place_before =
        mat3(vertex_before(corners.x), vertex_before(corners.y), vertex_before(corners.z)) * weight;
    vec4 now = frame.clip_from_anchor * vec4(place, 1.0);
    vec4 before = constants.clip_from_anchor_before * vec4(place_before, 1.0);
    bool is_seen = min(now.w, before.w) > 1e-6;
    vec2 half_page = 0.5 * vec2(frame.size_px);
    vec2 ndc = now.xy / max(now.w, 1e-6);
    vec2 way = constants.scale * half_page * (ndc - before.xy / max(before.w, 1e-6));
    way *= min(constants.most_px / max(length_of(way), 1e-6), 1.0);
    return vec4(half_page * (ndc + 1.0), is_seen ? way : vec2(0.0));
}

void main()
{
    uint item = item_index();
    if (item >= constants.count) {
        return;
    }
    uvec4 seed = texelFetch(seeds, int(item));
    vec4 moving = place_and_way(seed);
    vec2 way = moving.zw;
    vec2 back = -way / max(length_of(way), 1e-6);
    ivec2 last = ivec2(constants.size_px) - 1;
    ivec2 first = ivec2(floor(clamp(moving.xy, vec2(-1.0), vec2(constants.size_px))));
    // The pixel at the seed must show the seed's own surface, or a surface that moves in the same way.
    // Otherwise the seed is hidden and has no stroke.
    vec2 off = way_at(clamp(first, ivec2(0), last)) - way;
    bool is_its = length_of(off) < 0.05 * length_of(way) + 0.25;
    bool goes_on = is_on_page(first) && is_its && length_of(way) > max(constants.from_px, blur_still_px);
    bool was_going = goes_on;
    float along_px = 0.0;
    for (int i = 0; i < most_steps && goes_on; ++i) {
        along_px += step_px;
        ivec2 at = ivec2(floor(moving.xy + along_px * back));
        goes_on = is_on_page(at) && goes_along(way_at(clamp(at, ivec2(0), last)), way);
    }
    ivec2 between = ivec2(floor(moving.xy + (along_px - 0.5 * step_px) * back));
    along_px -= goes_along(way_at(clamp(between, ivec2(0), last)), way) ? 0.0 : 0.5 * step_px;
    // The background just behind the body's trailing edge must be farther away than the body.
    ivec2 inner = clamp(ivec2(floor(moving.xy + (along_px - 0.5 * step_px) * back)), ivec2(0), last);
    ivec2 left = ivec2(floor(moving.xy + (along_px + 1.0) * back));
    float depth = texelFetch(owner_depth_image, inner, 0).x;
    bool ends = was_going && !goes_on && is_on_page(left) &&
                texelFetch(owner_depth_image, clamp(left, ivec2(0), last), 0).x < 0.98 * depth;
    vec2 edge_way = way_at(inner);
    uint random = hash(seed.w, constants.seed);
    float uneven = unit_float(hash(random, 1u));
    float weight = unit_float(hash(random, 2u));
    SmearStroke stroke;
    stroke.from_px = moving.xy + along_px * back;
    // The random factors are chosen so that only few strokes are long, and only few are wide.
    stroke.way_px = ends && goes_along(edge_way, way)
                        ? -edge_way * (constants.length_share * (0.2 + 0.8 * uneven * uneven))
                        : vec2(0.0);
    // The width of a stroke is limited by its length, so that a short stroke does not look like a tuft.
    stroke.half_px = min(0.5 * constants.width_px * (0.15 + 0.85 * weight * weight * weight),
                         length_of(stroke.way_px) / 14.0);
    // A smear stroke starts inside the body, as if a wide brush were set down there. Where the body's edge is
    // parallel to the motion, a wide start would lie partly outside of the body. The stroke is then only as
    // thick as a hair.
    vec2 begin = stroke.from_px - 3.0 * stroke.half_px * back;
    vec2 aside = stroke.half_px * vec2(-back.y, back.x);
    bool has_body = goes_along(way_at(clamp(ivec2(floor(begin + aside)), ivec2(0), last)), way) &&
                    goes_along(way_at(clamp(ivec2(floor(begin - aside)), ivec2(0), last)), way);
    stroke.half_px = has_body ? stroke.half_px : min(stroke.half_px, hair_half_px);
    stroke.depth = depth;
    stroke.random = random;
    stroke.least_px = 0.5 * length_of(edge_way);
    strokes[item] = stroke;
}
