// SPDX-License-Identifier: MIT
// One thread lists the smear strokes that may touch one block of the page: first their count, then their
// numbers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#define SMEAR_TEXELS_BINDING 0
#include "techniques/motion_blur/smear_texels.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 1) writeonly buffer Lists
{
    uint lists[];
};

layout(push_constant, scalar) uniform Constants
{
    SmearConstants constants;
};

void main()
{
    uint block = item_index();
    uvec2 blocks = (constants.size_px + smear_block_px - 1u) / smear_block_px;
    if (block >= blocks.x * blocks.y) {
        return;
    }
    float side_px = float(smear_block_px);
    vec2 middle = (vec2(block % blocks.x, block / blocks.x) + 0.5) * side_px;
    uint first = block * (most_smear_strokes + 1u);
    uint listed = 0u;
    for (int i = 0; i < int(constants.count); ++i) {
        SmearStroke stroke = stroke_at(i);
        float length_px = sqrt(dot(stroke.way_px, stroke.way_px));
        vec2 from_middle = middle - stroke.from_px;
        float along = clamp(dot(from_middle, stroke.way_px) / max(length_px * length_px, 1e-6), 0.0, 1.0);
        vec2 off = from_middle - along * stroke.way_px;
        float within_px = 0.75 * side_px + 3.0 * stroke.half_px + smear_bow * length_px + 1.0;
        bool passes = length_px > 0.0 && dot(off, off) < within_px * within_px;
        if (passes && listed < most_smear_strokes) {
            ++listed;
            lists[first + listed] = uint(i);
        }
    }
    lists[first] = listed;
}
