// SPDX-License-Identifier: MIT
// One thread per cell: the mean ink of the strokes in a square of the page.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/smudge/smudge.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D hatch_image;
layout(binding = 1, r16f) writeonly uniform image2D out_cells;

layout(push_constant, scalar) uniform Constants
{
    SmudgeGatherConstants constants;
};

void main()
{
    uvec2 cell = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(cell, constants.cell_count))) {
        return;
    }
    // Every cell has at least one pixel inside the tile.
    ivec2 corner =
        ivec2((cell + constants.from_px / constants.cell_px) * constants.cell_px) - ivec2(constants.from_px);
    ivec2 low = max(corner, ivec2(0));
    ivec2 high = min(corner + int(constants.cell_px), ivec2(constants.size_px));
    float sum = 0.0;
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            sum += texelFetch(hatch_image, ivec2(x, y), 0).x;
        }
    }
    imageStore(out_cells, ivec2(cell), vec4(sum / float((high.x - low.x) * (high.y - low.y))));
}
