// SPDX-License-Identifier: MIT
// One workgroup takes large triangles in turn, and its threads list the tiles that each one touches. When the
// list is full a thread draws the tile itself: slow, but whole.

#include "techniques/raster/raster.glsl"

layout(local_size_x = 64) in;

// Whether some pixel centre of the tile may lie on the inner side of all three edges.
bool touches(PageTriangle t, ivec2 low, ivec2 high)
{
    for (int i = 0; i < 3; ++i) {
        ivec2 from = t.p[i];
        ivec2 d = t.p[(i + 1) % 3] - from;
        ivec2 farthest = ivec2(d.y < 0 ? high.x : low.x, d.x > 0 ? high.y : low.y) * 256 + 128;
        int64_t value =
            int64_t(d.x) * int64_t(farthest.y - from.y) - int64_t(d.y) * int64_t(farthest.x - from.x);
        if (value < 0) {
            return false;
        }
    }
    return true;
}

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
            ivec2 tile = first + ivec2(k % across.x, k / across.x);
            ivec2 tile_low = max(low, tile * tile_px);
            ivec2 tile_high = min(high, tile * tile_px + tile_px - 1);
            if (!touches(t, tile_low, tile_high)) {
                continue;
            }
            uint slot = atomicAdd(counters.tile_count, 1u);
            if (slot < constants.tile_capacity) {
                tiles[slot] = TriangleTile(large.triangle, pack_tile(part, large.part_and_view >> 1, tile));
                continue;
            }
            ivec2 top = first_drawn(tile_low);
            for (; top.x <= tile_high.x; top.x += drawn_step()) {
                fill_column(t, top, tile_high.y, drawn_step(), large.triangle);
            }
        }
    }
}
