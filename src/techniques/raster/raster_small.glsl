// SPDX-License-Identifier: MIT
// One thread draws one small triangle whole, and puts a large one on the list.

#include "shaders/items.glsl"
#include "techniques/raster/raster.glsl"

layout(local_size_x = 64) in;

const int small_side_px = 63; // edge functions of such triangles fit 32 bits

void draw_part(ClippedTriangle clipped, uint part, uint triangle, uint flags)
{
    PageTriangle t;
    ivec2 low, high;
    if (!page_part(clipped, part, flags, t)) {
        return;
    }
    pixel_bounds(t, low, high);
    if (any(lessThan(high, low))) {
        return;
    }
    ivec2 extent = max(max(t.p[0], t.p[1]), t.p[2]) - min(min(t.p[0], t.p[1]), t.p[2]);
    ivec2 covered = high - low + 1;
    if (all(lessThan(extent, ivec2(small_side_px * 256))) &&
        uint(covered.x * covered.y) <= constants.small_area_px) {
        fill_small(t, low, high, triangle);
        return;
    }
    uint slot = atomicAdd(counters.large_count, 1u);
    if (slot < constants.large_capacity) {
        large_triangles[slot] = LargeTriangle(triangle, part);
    }
}

void main()
{
    uint index = item_index();
    if (index >= constants.triangle_count) {
        return;
    }
    uint triangle = constants.first_triangle + index;
    uint flags = triangles[triangle].w;
    ClippedTriangle clipped = load_clipped(triangle);
    draw_part(clipped, 0u, triangle, flags);
    if (clipped.count == 4) {
        draw_part(clipped, 1u, triangle, flags);
    }
}
