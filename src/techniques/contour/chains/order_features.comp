// SPDX-License-Identifier: MIT
// One thread puts one point of a feature where it comes in its chain.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/items.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/page_piece.glsl"

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"

layout(scalar, binding = 3) readonly buffer FeaturePoints
{
    FeaturePoint feature_points[];
};

layout(scalar, binding = 4) readonly buffer FeatureChains
{
    FeatureChain feature_chains[];
};

layout(scalar, binding = 5) readonly buffer PointsBefore
{
    uint points_before[]; // each slot
};

layout(scalar, binding = 6) buffer Points
{
    ChainPoint points[];
};

layout(scalar, binding = 7) buffer Lengths
{
    uint lengths[]; // of the piece from each point to the next
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

void main()
{
    uint index = item_index();
    if (index >= constants.feature_point_count) {
        return;
    }
    FeaturePoint point = feature_points[index];
    FeatureChain chain = feature_chains[point.chain];
    uint place = index - chain.first_point;
    uint at = points_before[point.chain] + place;
    if (at >= constants.point_capacity) {
        return;
    }
    PosedVertex vertex = posed_vertex_at(point.vertex);
    points[at] = ChainPoint(vertex.position, vertex.normal, 0.0, point.kind << 28 | point.side);
    bool is_last = place + 1u == chain.point_count;
    vec3 onwards = posed_vertex_at(feature_points[is_last ? index : index + 1u].vertex).position;
    lengths[at] =
        is_last ? 0u : uint(LENGTH_UNIT_PX * piece_on_page(vertex.position, onwards).length_px + 0.5);
}
