// SPDX-License-Identifier: MIT
// One thread stores one point of a feature line (a crease or other line fixed to the surface) at the point's
// place in the list of chain points.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/loops.glsl"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/link/page_piece.glsl"

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"

layout(binding = 3) uniform usamplerBuffer neighbor_texels;

layout(scalar, binding = 4) readonly buffer FeaturePoints
{
    FeaturePoint feature_points[];
};

layout(scalar, binding = 5) readonly buffer FeatureChains
{
    FeatureChain feature_chains[];
};

#define POINTS_BEFORE_BINDING 6
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 7) buffer Points
{
    ChainPoint points[];
};

layout(scalar, binding = 8) buffer Lengths
{
    uint lengths[]; // length on the page from each point to the next, in 1/1024 pixel
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

#include "techniques/contour/chains/link/shaded_round.glsl"

layout(constant_id = 0) const uint variant = 0u;
const bool leave_edges = (variant & order_features_leave_edges) != 0u;

// Normal of a triangle by the order of the triangle's corners, not normalised.
vec3 triangle_normal(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 n = cross(posed_vertex_at(corners.y).position - a, posed_vertex_at(corners.z).position - a);
    return (corners.w & triangle_mirrored) != 0u ? -n : n;
}

bool is_turned(uint triangle)
{
    return (texelFetch(neighbor_texels, int(triangle)).w & neighbor_is_turned) != 0u;
}

// Outward normal at an edge: the mean over the sides that face the eye, or over both sides if neither does.
// So the visibility test of a box's edges is not made below the ground on which the box stands. Of a surface
// that is drawn from both sides, the eye may see the back: then the normals of the back count.
vec3 edge_normal(uint side, vec3 place)
{
    uint beyond = texelFetch(neighbor_texels, int(side >> 2))[side & 3u];
    bool has_other = beyond != no_side;
    uint other_triangle = (has_other ? beyond : side) >> 2;
    vec3 way = towards_eye(frame, place);
    vec3 normal = triangle_normal(side >> 2);
    normal /= max(size_of(normal), 1e-30);
    vec3 other =
        triangle_normal(other_triangle) * (is_turned(side >> 2) != is_turned(other_triangle) ? -1.0 : 1.0);
    other /= max(size_of(other), 1e-30);
    bool is_front = dot(normal, way) > 0.0;
    bool is_other_front = dot(other, way) > 0.0;
    bool has_back = (triangle_at(side >> 2).w & triangle_two_sided) != 0u;
    vec3 ruling = normal + other;
    if (is_front != is_other_front) {
        uint opposite = ((beyond & 3u) + 2u) % 3u;
        vec3 far_corner = posed_vertex_at(triangle_at(other_triangle)[has_other ? opposite : 0u]).position;
        bool is_hollow = has_back && dot(normal, far_corner - place) > 0.0;
        ruling = is_hollow ? -(is_front ? other : normal) : is_front ? normal : other;
    } else if (has_back && !is_front) {
        ruling = -ruling;
    }
    return size_of(ruling) > 1e-6 ? unit(ruling) : vec3(0.0, 1.0, 0.0);
}

vec3 place_of(FeaturePoint point)
{
    vec3 place = posed_vertex_at(point.vertex).position;
    return leave_edges ? mix(place, posed_vertex_at(point.other_vertex).position, point.share) : place;
}

// Outward normal at a point of a feature line (a crease or other line fixed to the surface): the normal of
// its edge, or of the smooth surface if the line crosses a triangle.
vec3 normal_at(FeaturePoint point, vec3 place)
{
    if (leave_edges && (point.side & 3u) == 3u) {
        vec3 a = unpack_normal(posed_vertex_at(point.vertex).normal);
        vec3 b = unpack_normal(posed_vertex_at(point.other_vertex).normal);
        return unit(mix(a, b, point.share) + 1e-6 * towards_eye(frame, place));
    }
    return edge_normal(point.side, place);
}

uint source_of(FeaturePoint point)
{
    return point.kind << 28 | point.side;
}

// Whether a feature line is round at the point after point number `place`. The last point of a closed line
// repeats the first.
bool is_round_after(FeatureChain chain, uint place, FeaturePoint point, FeaturePoint next)
{
    bool is_end = place + 2u == chain.point_count;
    uint first = chain.first_point;
    FeaturePoint leaving = feature_points[is_end ? first : first + place + 1u];
    vec3 beyond = place_of(feature_points[is_end ? first + 1u : first + place + 2u]);
    return (!is_end || chain.is_closed != 0u) &&
           is_round_at(uvec2(source_of(point), source_of(leaving)), place_of(point), place_of(next), beyond);
}

void main()
{
    uint index = item_index();
    if (index >= constants.feature_point_count) {
        return;
    }
    FeaturePoint point = feature_points[index];
    FeatureChain chain = feature_chains[point.chain];
    uint place = index - chain.first_point;
    uint at = points_before(point.chain) + place;
    if (at >= constants.point_capacity) {
        return;
    }
    vec3 place_here = place_of(point);
    bool is_last = place + 1u == chain.point_count;
    FeaturePoint next = feature_points[is_last ? index : index + 1u];
    vec3 onwards = place_of(next);
    bool ends_round = !is_last && is_round_after(chain, place, point, next);
    points[at] = ChainPoint(place_here, pack_normal(normal_at(point, place_here)), 0.0, source_of(point),
                            ends_round ? 1u : 0u, 0u);
    lengths[at] = is_last ? 0u : uint(length_unit_px * piece_on_page(place_here, onwards).length_px + 0.5);
}
