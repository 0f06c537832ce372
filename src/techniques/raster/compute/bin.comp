// SPDX-License-Identifier: MIT
// Workgroups take large triangles in turn; their threads list the tiles that each triangle touches. If the
// list is full, a thread draws the tile itself, which is slow but complete.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require

#include "techniques/raster/compute/raster.glsl"

layout(local_size_x = 64) in;

void main()
{
    uint count = min(counters.large_count, constants.large_capacity);
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        LargeTriangle large = large_triangles[i];
        uint part = large.part_and_view & 1u;
        select_view(large.part_and_view >> 1);
        PageTriangle t;
        ivec2 low, high;
        if (!page_part(load_clipped(large.triangle), part, triangle_at(large.triangle).w, t)) {
            continue;
        }
        pixel_bounds(t, low, high);
        ivec2 first = low / tile_px;
        ivec2 across = high / tile_px - first + 1;
        for (int k = int(gl_LocalInvocationID.x); k < across.x * across.y; k += 64) {
            list_tile(t, low, high, first + ivec2(k % across.x, k / across.x), part, large.part_and_view >> 1,
                      large.triangle);
        }
    }
}
