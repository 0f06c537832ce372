// SPDX-License-Identifier: MIT
// One thread draws one small triangle whole, and puts a large one on the list.

#include "shaders/items.glsl"
#include "techniques/raster/raster.glsl"
#include "techniques/raster/raster_small_part.glsl"

layout(local_size_x = 64) in;

void main()
{
    uint index = item_index();
    if (index >= constants.triangle_count) {
        return;
    }
    uint triangle = constants.first_triangle + index;
    uint flags = triangle_at(triangle).w;
    ClippedTriangle clipped = load_clipped(triangle);
    draw_part(clipped, 0u, 0u, triangle, flags);
    if (clipped.count == 4) {
        draw_part(clipped, 1u, 0u, triangle, flags);
    }
}
