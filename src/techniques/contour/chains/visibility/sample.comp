// SPDX-License-Identifier: MIT
// One thread computes the position and visibility of one sample on a chain. The sample is hidden if a
// triangle that is seen at the sample's pixels lies between the eye and the sample. The test point lies
// slightly outside of the sample's own surface, so that the sample's own surface never hides the sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/loops.glsl"
#include "shaders/unit.glsl"
#include "shaders/visibility.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/link/page_piece.glsl"

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

#define SAMPLES_BEFORE_BINDING 5
#define POINTS_BEFORE_BINDING 6
#define LENGTHS_BEFORE_BINDING 7
#define POINTS_BINDING 8
#include "techniques/contour/chains/lists.glsl"
#include "techniques/contour/chains/visibility/round_curve.glsl"

layout(scalar, binding = 9) readonly buffer FlagsOfSlot
{
    uint flags_of_slot[];
};

layout(binding = 10) uniform usamplerBuffer neighbor_texels;

layout(scalar, binding = 11) writeonly buffer Samples
{
    LineSample samples[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

const float outside_px = 0.75;
const float beyond_px = 3.0; // distance from the line at which the surface behind the line is looked at
const float tolerance_px = 0.05;
// A bump of a rough surface: its depth is at most so many edges of the line's triangle, the line lies within
// `bump_mm` of the outline, and the next surface at least `behind_bump_mm` behind. Millimetres on the page.
const float bump_edges = 3.0;
const float bump_mm = 0.8;
const float behind_bump_mm = 3.0;
const float least_rise = 0.1; // sine of the least angle between two surfaces that touch along an edge

// Finds the chain point before the place with the arc length `length`. Returns the last point before the
// chain's end whose arc length is at most `length`.
uint piece_at(uint first, uint end, uint length)
{
    uint low = first;
    uint high = end - 1u;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (lengths_before(middle) <= length) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

struct Cover {
    bool is_over; // seen from the eye, the tested point lies within the outline of the triangle
    // The triangle's plane, limited to the triangle's range of depth, lies in front of the tested point.
    bool hides;
    float behind_m; // depth of the triangle's plane behind the tested point
};

Cover cover_of(uint triangle, vec3 point, float tolerance_m)
{
    uvec4 corners = triangle_at(triangle);
    bool is_parallel = frame.is_orthographic != 0u;
    // All positions are relative to an origin between the eye and the point, which keeps the numbers small.
    vec3 origin = is_parallel ? point - frame.view_forward : frame.eye_anchor;
    vec3 way = point - origin;
    vec3 a = posed_vertex_at(corners.x).position - origin;
    vec3 b = posed_vertex_at(corners.y).position - origin;
    vec3 c = posed_vertex_at(corners.z).position - origin;
    vec3 plane = cross(b - a, c - a);
    vec3 sides = vec3(dot(cross(a, b), way), dot(cross(b, c), way), dot(cross(c, a), way));
    bool is_over = all(greaterThanEqual(sides, vec3(0.0))) || all(lessThanEqual(sides, vec3(0.0)));
    float scale = dot(way, frame.view_forward);
    float crossing = dot(a, plane) / dot(way, plane) * scale;
    vec3 depths = vec3(dot(a, frame.view_forward), dot(b, frame.view_forward), dot(c, frame.view_forward));
    float nearest = min(depths.x, min(depths.y, depths.z));
    float farthest = max(depths.x, max(depths.y, depths.z));
    bool is_beside = !is_parallel && crossing < 0.0;
    float behind_m = clamp(crossing, nearest, farthest) - scale;
    return Cover(is_over, !is_beside && behind_m < -tolerance_m, behind_m);
}

// Whether a triangle's surface rises from a plane at a point, towards the eye's side of the plane. `plane` is
// the plane's unit normal on that side.
bool rises_from(uint triangle, vec3 point, vec3 plane)
{
    uvec4 corners = triangle_at(triangle);
    vec3 middle = (posed_vertex_at(corners.x).position + posed_vertex_at(corners.y).position +
                   posed_vertex_at(corners.z).position) /
                  3.0;
    return dot(middle - point, plane) > least_rise * size_of(middle - point);
}

// Whether an edge touches the surface that hides the place outside of it: a vase that is narrow at its foot
// stands on the ground, and the outside of the foot's edge is below the ground.
bool is_contact(uint hiding, vec3 anchor, uint side, float pixel_m)
{
    uvec4 corners = triangle_at(hiding);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 plane = cross(posed_vertex_at(corners.y).position - a, posed_vertex_at(corners.z).position - a);
    plane = unit(plane * (dot(plane, towards_eye(frame, anchor)) < 0.0 ? -1.0 : 1.0));
    uint beyond = texelFetch(neighbor_texels, int(side >> 2))[side & 3u];
    return abs(dot(anchor - a, plane)) < touching_mm * frame.pixels_per_mm * pixel_m &&
           (rises_from(side >> 2, anchor, plane) ||
            (beyond != no_side && rises_from(beyond >> 2, anchor, plane)));
}

// Whether a point is visible. Among the triangles seen around the point, a triangle that covers the point
// decides. If no triangle covers the point, because all are smaller than a pixel, the point counts as hidden
// if the triangles at three of four pixels hide it.
bool is_visible(vec3 anchor, vec3 normal, float bulge_m, uint side)
{
    uint own = side >> 2;
    float pixel_m = pixel_size_m(frame, anchor);
    vec3 outside = anchor + normal * (bulge_m + outside_px * pixel_m);
    vec2 place = page_position(frame.clip_from_anchor * vec4(outside, 1.0));
    ivec2 last = ivec2(frame.size_px) - 1;
    ivec2 corner = ivec2(floor(place - 0.5));
    Cells around = Cells(clamp(corner, ivec2(0), last), clamp(corner + 1, ivec2(0), last));
    bool is_covered = false;
    bool is_free = false;
    int hiding = 0;
    uint hiding_triangle = own;
    ivec2 pixel = around.low;
    do {
        uvec2 word = visibility[uint(pixel.y) * frame.size_px.x + uint(pixel.x)];
        bool may_hide = sees_triangle(word) && seen_triangle(word) != own;
        Cover cover = cover_of(may_hide ? seen_triangle(word) : own, outside, tolerance_px * pixel_m);
        bool hides = may_hide && cover.hides;
        is_covered = is_covered || (hides && cover.is_over);
        is_free = is_free || (may_hide && cover.is_over && !cover.hides);
        // The point is hidden if triangles at three or more of the four pixels around the point hide it.
        hiding += hides ? 1 : -3;
        hiding_triangle =
            hides && (cover.is_over || hiding_triangle == own) ? seen_triangle(word) : hiding_triangle;
        pixel = next_cell(pixel, around);
    } while (pixel.y <= around.high.y);
    bool is_seen = !is_covered && (is_free || hiding < 0);
    bool is_edge = (side & 3u) != 3u;
    return is_seen || (is_edge && is_contact(hiding_triangle, anchor, side, pixel_m));
}

// How far behind a line the surface lies that is seen beside the line, on the side to which the normal
// points, as the bits of LineSample::state.
uint depth_step_of(vec3 anchor, vec3 normal, vec2 page_px, float away_px)
{
    float pixel_m = pixel_size_m(frame, anchor);
    vec2 way = page_position(frame.clip_from_anchor * vec4(anchor + normal * pixel_m, 1.0)) - page_px;
    vec2 beyond = page_px + away_px * way * inversesqrt(max(dot(way, way), 1e-20));
    ivec2 pixel = clamp(ivec2(floor(beyond)), ivec2(0), ivec2(frame.size_px) - 1);
    uvec2 word = visibility[uint(pixel.y) * frame.size_px.x + uint(pixel.x)];
    if (!sees_triangle(word)) {
        return sample_step_most << sample_step_shift;
    }
    float behind_mm = cover_of(seen_triangle(word), anchor, 0.0).behind_m / (pixel_m * frame.pixels_per_mm);
    return uint(clamp(sample_steps_a_mm * behind_mm, 0.0, float(sample_step_most))) << sample_step_shift;
}

// Whether a line that counts as hidden closes the outline of a rough surface: a bump of the line's own shell,
// hardly larger than the triangles there, lies before it, and close beside the line the next surface is far
// behind.
bool is_under_bump(vec3 anchor, vec3 normal, vec2 page_px, uint own)
{
    ivec2 pixel = clamp(ivec2(floor(page_px)), ivec2(0), ivec2(frame.size_px) - 1);
    uvec2 word = visibility[uint(pixel.y) * frame.size_px.x + uint(pixel.x)];
    uint seen = sees_triangle(word) ? seen_triangle(word) : own;
    bool is_own_shell = texelFetch(neighbor_texels, int(seen)).w >> neighbor_shell_shift ==
                        texelFetch(neighbor_texels, int(own)).w >> neighbor_shell_shift;
    uvec4 corners = triangle_at(own);
    vec3 a = posed_vertex_at(corners.x).position;
    float edge_m = max(size_of(posed_vertex_at(corners.y).position - a),
                       size_of(posed_vertex_at(corners.z).position - a));
    uint step_bits = depth_step_of(anchor, normal, page_px, bump_mm * frame.pixels_per_mm);
    return is_own_shell && cover_of(seen, anchor, 0.0).behind_m > -bump_edges * edge_m &&
           step_bits >> sample_step_shift >= uint(behind_bump_mm * sample_steps_a_mm);
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count) {
        return;
    }
    uint slot = slot_of_sample(index, sizes[list_slots].count);
    uint first = points_before(slot);
    uint end = points_before(slot + 1u);
    uint steps = samples_before(slot + 1u) - samples_before(slot) - 1u;
    uint step = index - samples_before(slot);
    uint whole = lengths_before(end - 1u) - lengths_before(first);
    uint length = lengths_before(first) + uint(float(whole) * (float(step) / float(steps)));
    uint at = piece_at(first, end, length);
    ChainPoint from = point_at(at);
    ChainPoint to = point_at(at + 1u);
    PagePiece piece = piece_on_page(from.anchor, to.anchor);
    float along = float(length - lengths_before(at)) / max(length_unit_px * piece.length_px, 1e-6);
    float share = share_at(piece, clamp(along, 0.0, 1.0));
    vec3 anchor = mix(from.anchor, to.anchor, share);
    // A line within a triangle has interpolated normals; a line along an edge has one constant normal.
    bool is_smooth = (from.source & 3u) == 3u;
    vec3 normal = unit(mix(unpack_normal(from.normal), unpack_normal(to.normal), is_smooth ? share : 0.0) +
                       1e-6 * towards_eye(frame, anchor));
    vec2 page_px = page_position(frame.clip_from_anchor * vec4(anchor, 1.0));
    bool is_on_page = all(greaterThan(page_px, vec2(-0.5 * page_margin_px))) &&
                      all(lessThan(page_px, vec2(frame.size_px) + 0.5 * page_margin_px));
    uint side = from.source & 0x0fffffffu;
    uint state = is_on_page ? depth_step_of(anchor, normal, page_px, beyond_px) : sample_is_off_page;
    bool is_smooth_outline = is_smooth && from.source >> 28 == line_silhouette;
    state |= is_on_page && (is_of_page(from.source) ||
                            (from.bulge_m >= 0.0 && is_visible(anchor, normal, from.bulge_m, side)) ||
                            (is_smooth_outline && is_under_bump(anchor, normal, page_px, side >> 2)))
                 ? sample_is_visible
                 : 0u;
    bool is_of_clump = is_of_foliage(from.source);
    state |= is_of_clump && from.bulge_m > 0.0 ? sample_is_within : 0u;
    if (is_on_page && (is_of_clump || !is_of_page(from.source))) {
        ChainOfPoints chain = ChainOfPoints(first, end, (flags_of_slot[slot] & chain_is_closed) != 0u);
        int place = int(at - first);
        page_px = is_of_clump ? evened_position(chain, place, page_px)
                              : rounded_position(chain, place, page_px, constants.most_rounding_px);
    }
    float spacing_px = float(whole) / (length_unit_px * float(steps));
    samples[index] = LineSample(anchor, pack_normal(normal), page_px, from.source,
                                state | packHalf2x16(vec2(0.0, spacing_px)));
}
