// SPDX-License-Identifier: MIT
// One thread per cell: the mean ink of the strokes, or the mean density of the paint, in a square of the
// page.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/pigment/pigment.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D layer_image;
layout(binding = 1, rgba16f) writeonly uniform image2D out_cells;

layout(push_constant, scalar) uniform Constants
{
    PigmentGatherConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool gathers_paint = (variant & pigment_gathers_paint) != 0u;

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
    vec4 sum = vec4(0.0);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            vec4 texel = texelFetch(layer_image, ivec2(x, y), 0);
            sum += gathers_paint ? vec4(density_of(texel.rgb), 0.0) : texel;
        }
    }
    imageStore(out_cells, ivec2(cell), sum / float((high.x - low.x) * (high.y - low.y)));
}
