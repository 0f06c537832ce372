// SPDX-License-Identifier: MIT
// One thread per cell: spreads the values of cells along one axis of the page.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/pigment/pigment.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D cell_image;
layout(binding = 1, rgba16f) writeonly uniform image2D out_cells;

layout(push_constant, scalar) uniform Constants
{
    PigmentSpreadConstants constants;
};

vec4 value_at(ivec2 cell)
{
    return texelFetch(cell_image, clamp(cell, ivec2(0), ivec2(constants.cell_count) - 1), 0);
}

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(cell), constants.cell_count))) {
        return;
    }
    vec4 sum = value_at(cell);
    float weights = 1.0;
    for (int i = 1; i <= int(constants.radius); ++i) {
        float weight = exp(-constants.falloff * float(i * i));
        ivec2 away = i * ivec2(constants.axis);
        sum += weight * (value_at(cell - away) + value_at(cell + away));
        weights += 2.0 * weight;
    }
    imageStore(out_cells, cell, sum / weights);
}
