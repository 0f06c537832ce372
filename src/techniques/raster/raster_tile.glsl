// SPDX-License-Identifier: MIT
// One workgroup draws one triangle in one tile of the picture after another; each thread takes one column.

#include "techniques/raster/raster.glsl"

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
        int x = corner.x + int(gl_LocalInvocationID.x);
        if (x >= low.x && x <= high.x && high.y >= low.y) {
            fill_column(t, ivec2(x, low.y), high.y - low.y + 1, tile.triangle);
        }
    }
}
