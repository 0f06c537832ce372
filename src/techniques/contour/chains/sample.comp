// SPDX-License-Identifier: MIT
// One thread takes one step along a chain: where that is, and whether it is seen. What may hide it is the
// triangle seen there, as a plane: the sample is hidden when the eye and it are on two sides of that plane.
// It is asked a little outside of its own surface, which so never hides it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/visibility.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/page_piece.glsl"

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"

layout(scalar, binding = 3) readonly buffer Visibility
{
    uvec2 visibility[];
};

layout(scalar, binding = 4) readonly buffer Sizes
{
    ListSize sizes[];
};

#define SLOTS_BINDING 5
#include "techniques/contour/chains/slots.glsl"

layout(scalar, binding = 6) readonly buffer PointsBefore
{
    uint points_before[];
};

layout(scalar, binding = 7) readonly buffer LengthsBefore
{
    uint lengths_before[];
};

layout(scalar, binding = 8) readonly buffer Points
{
    ChainPoint points[];
};

layout(binding = 9) uniform usamplerBuffer neighbor_texels;

layout(scalar, binding = 10) writeonly buffer Samples
{
    LineSample samples[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

const float outside_px = 0.75;

// The last point of a chain, but not the very last, that lies no farther than `length` along.
uint point_at(uint first, uint end, uint length)
{
    uint low = first;
    uint high = end - 1u;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (lengths_before[middle] <= length) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

bool is_own(uint triangle, uint own)
{
    uvec3 neighbors = texelFetch(neighbor_texels, int(own)).xyz >> 2;
    return triangle == own || any(equal(neighbors, uvec3(triangle)));
}

// Whether the triangle's plane, no farther away than the triangle itself, comes between the eye and a point.
bool hides(uint triangle, vec3 point, float tolerance_m)
{
    uvec4 corners = triangle_at(triangle);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    vec3 plane = cross(b - a, c - a);
    bool is_parallel = frame.is_orthographic != 0u;
    vec3 way = is_parallel ? frame.view_forward : point - frame.eye_anchor;
    // Distances along the view, of the point and of the plane before or behind it.
    vec3 origin = is_parallel ? point - frame.view_forward : frame.eye_anchor;
    float scale = dot(way, frame.view_forward);
    float crossing = dot(a - origin, plane) / dot(way, plane) * scale;
    vec3 corners_at = vec3(dot(a - origin, frame.view_forward), dot(b - origin, frame.view_forward),
                           dot(c - origin, frame.view_forward));
    float nearest = min(corners_at.x, min(corners_at.y, corners_at.z));
    float farthest = max(corners_at.x, max(corners_at.y, corners_at.z));
    bool is_beside = !is_parallel && crossing < 0.0;
    return !is_beside && clamp(crossing, nearest, farthest) < scale - tolerance_m;
}

bool is_visible(vec3 anchor, vec3 normal, float bulge_m, uint own)
{
    float pixel_m = pixel_size_m(anchor);
    vec3 outside = anchor + normal * (bulge_m + outside_px * pixel_m);
    vec4 clip = frame.clip_from_anchor * vec4(outside, 1.0);
    ivec2 corner = ivec2(floor(page_position(clip) - 0.5));
    ivec2 last = ivec2(frame.size_px) - 1;
    bool is_seen = false;
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), last);
        uvec2 word = visibility[uint(pixel.y) * frame.size_px.x + uint(pixel.x)];
        bool is_free = !sees_triangle(word) || is_own(seen_triangle(word), own);
        is_seen = is_seen || is_free || !hides(seen_triangle(word), outside, 0.5 * pixel_m);
    }
    return is_seen;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[LIST_SAMPLES].count) {
        return;
    }
    uint slot = slot_of_sample(index);
    uint first = points_before[slot];
    uint end = points_before[slot + 1u];
    uint steps = samples_before[slot + 1u] - samples_before[slot] - 1u;
    uint step = index - samples_before[slot];
    uint whole = lengths_before[end - 1u] - lengths_before[first];
    uint length = lengths_before[first] + uint(float(whole) * (float(step) / float(steps)));
    uint at = point_at(first, end, length);
    ChainPoint from = points[at];
    ChainPoint to = points[at + 1u];
    PagePiece piece = piece_on_page(from.anchor, to.anchor);
    float along = float(length - lengths_before[at]) / max(LENGTH_UNIT_PX * piece.length_px, 1e-6);
    float share = share_at(piece, clamp(along, 0.0, 1.0));
    vec3 anchor = mix(from.anchor, to.anchor, share);
    vec3 normal = normalize(mix(unpack_normal(from.normal), unpack_normal(to.normal), share) +
                            1e-6 * towards_eye(frame, anchor));
    vec2 page_px = page_position(frame.clip_from_anchor * vec4(anchor, 1.0));
    bool is_on_page = all(greaterThan(page_px, vec2(-0.5 * page_margin_px))) &&
                      all(lessThan(page_px, vec2(frame.size_px) + 0.5 * page_margin_px));
    uint own = (from.source & 0x0fffffffu) >> 2;
    uint state = is_on_page && from.bulge_m >= 0.0 && is_visible(anchor, normal, from.bulge_m, own)
                     ? SAMPLE_IS_VISIBLE
                     : 0u;
    state |= is_on_page ? 0u : SAMPLE_IS_OFF_PAGE;
    float spacing_px = float(whole) / (LENGTH_UNIT_PX * float(steps));
    samples[index] = LineSample(anchor, pack_normal(normal), page_px, from.source,
                                state | packHalf2x16(vec2(0.0, spacing_px)));
}
