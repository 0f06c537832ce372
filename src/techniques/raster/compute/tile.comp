// SPDX-License-Identifier: MIT
// Each workgroup draws one triangle in one tile of the picture at a time. Each thread takes a column, or a
// part of a column if the triangle is narrow.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require

#include "techniques/raster/compute/raster.glsl"

layout(local_size_x = raster_tile_px) in;

void main()
{
    uint count = min(counters.tile_count, constants.tile_capacity);
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        TriangleTile tile = tiles[i];
        uint part = tile.part_and_tile >> 31;
        select_view(view_of_tile(tile.part_and_tile));
        ivec2 corner = place_of_tile(tile.part_and_tile) * tile_px;
        PageTriangle t;
        ivec2 low, high;
        if (!page_part(load_clipped(tile.triangle), part, triangle_at(tile.triangle).w, t)) {
            continue;
        }
        pixel_bounds(t, low, high);
        low = max(low, corner);
        high = min(high, corner + tile_px - 1);
        // The fewer columns of the tile the triangle covers, the more threads share a column.
        int drawn = drawn_step();
        ivec2 first = first_drawn(low);
        int width_bits = findMSB(max((high.x - first.x) / drawn, 0)) + 1;
        int thread = int(gl_LocalInvocationID.x);
        ivec2 top = first + drawn * ivec2(thread & ((1 << width_bits) - 1), thread >> width_bits);
        if (top.x <= high.x) {
            fill_column(t, top, high.y, drawn * (tile_px >> width_bits), tile.triangle);
        }
    }
}
