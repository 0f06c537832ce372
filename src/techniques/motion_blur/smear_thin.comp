// SPDX-License-Identifier: MIT
// One thread decides whether one smear stroke is kept: the stroke is dropped if a stroke of higher priority
// is too near.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/hash.glsl"
#include "shaders/loops.glsl"
#define SMEAR_TEXELS_BINDING 0
#include "techniques/motion_blur/smear_texels.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 1) writeonly buffer Kept
{
    SmearStroke kept[];
};

layout(push_constant, scalar) uniform Constants
{
    SmearConstants constants;
};

void main()
{
    uint item = item_index();
    if (item >= constants.count) {
        return;
    }
    SmearStroke own = stroke_at(int(item));
    float length_px = sqrt(dot(own.way_px, own.way_px));
    vec2 back = own.way_px / max(length_px, 1e-6);
    // The minimum distance is random, so that some strokes are close together and others leave a gap. The
    // mean of the minimum distance is half the spacing, because the neighbouring stroke has a minimum
    // distance as well.
    float apart_px = constants.spacing_px * mix(0.15, 0.85, unit_float(hash(own.random, 4u)));
    int count = length_px > 0.0 ? int(constants.count) : 0;
    bool is_kept = length_px > 0.0;
    for (int i = 0; i < count; ++i) {
        SmearStroke other = stroke_at(i);
        vec2 off = other.from_px - own.from_px;
        float aside_px = abs(back.x * off.y - back.y * off.x);
        float along_px = abs(dot(off, back));
        bool goes_before = other.random > own.random || (other.random == own.random && i < int(item));
        bool is_near = aside_px < apart_px && along_px < length_px;
        is_kept = is_kept && !(goes_before && is_near && other.way_px != vec2(0.0));
    }
    own.way_px = is_kept ? own.way_px : vec2(0.0);
    kept[item] = own;
}
