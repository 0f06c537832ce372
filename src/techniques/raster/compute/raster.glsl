// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_RASTER
#define ESTAMPE_RASTER

#include "techniques/raster/raster.glsl.h"

// Rasterisation in compute shaders. Edge functions are exact integers, computed from positions snapped to
// 1/256 pixel, with the top-left rule. So triangles with a shared edge never overlap and never leave a gap.
// The winner of a pixel is the largest 64-bit value: reversed depth in the high half, triangle number in the
// low half. So the winner does not depend on the order of execution.

const int tile_px = int(raster_tile_px); // signed integer, for arithmetic with positions

#define MESH_TEXELS_BINDING 0
#include "shaders/mesh_texels.glsl"

layout(scalar, binding = 2) buffer Counters
{
    RasterCounters counters;
};

layout(scalar, binding = 3) buffer LargeTriangles
{
    LargeTriangle large_triangles[];
};

layout(scalar, binding = 4) buffer Tiles
{
    TriangleTile tiles[];
};
#ifdef RASTER_DEPTH_ONLY
layout(scalar, binding = 5) buffer Target
{
    uint target[];
};
#else
layout(scalar, binding = 5) buffer Target
{
    uint64_t target[];
};
#endif

#ifdef RASTER_VIEWS
layout(scalar, binding = 6) readonly buffer Views
{
    RasterView views[];
};

layout(push_constant, scalar) uniform Constants
{
    ViewsConstants constants;
};

RasterView view; // the view that this thread is drawing
#define CLIP_FROM_ANCHOR view.clip_from_anchor
#define PICTURE_PX uvec2(view.size_px)
#else
layout(push_constant, scalar) uniform Constants
{
    RasterConstants constants;
};

#define CLIP_FROM_ANCHOR constants.clip_from_anchor
#define PICTURE_PX constants.size_px
#define LEAST_ALPHA constants.least_alpha
#define ALPHA_BELOW constants.alpha_below
#endif

// Encoding of views and tiles in the records LargeTriangle and TriangleTile.
#ifdef RASTER_VIEWS
void select_view(uint index)
{
    view = views[index];
}

uint pack_tile(uint part, uint index, ivec2 tile)
{
    return part << 31 | index << 16 | uint(tile.y) << 8 | uint(tile.x);
}

uint view_of_tile(uint part_and_tile)
{
    return (part_and_tile >> 16) & 0x7fffu;
}

ivec2 place_of_tile(uint part_and_tile)
{
    return ivec2(part_and_tile & 0xffu, (part_and_tile >> 8) & 0xffu);
}
#else
void select_view(uint index) {}

uint pack_tile(uint part, uint index, ivec2 tile)
{
    return part << 31 | uint(tile.y) << 15 | uint(tile.x);
}

uint view_of_tile(uint part_and_tile)
{
    return 0u;
}

ivec2 place_of_tile(uint part_and_tile)
{
    return ivec2(part_and_tile & 0x7fffu, (part_and_tile >> 15) & 0xffffu);
}
#endif

const float subpixels = 256.0;
// Limit of 2^21 pixels for differences of positions: smaller differences fit 32 bits, and their edge
// functions fit 64 bits.
const float guard_px = 2097152.0;

// A triangle on the page: positions in 1/256 pixel, y down, ordered so that its area is positive.
struct PageTriangle {
    ivec2 p[3];
    vec3 depth; // reversed depth at the three corners
};

struct ClippedTriangle {
    vec4 clip[4];
    int count;
};

// Clips a triangle against the near plane, where the clip coordinates w and z are equal. New corners are
// always computed from the inside outwards, so that both triangles of a shared edge get identical bits.
ClippedTriangle clip_near(vec4 a, vec4 b, vec4 c)
{
    vec4 corner[3] = vec4[3](a, b, c);
    ClippedTriangle result;
    result.count = 0;
    for (int i = 0; i < 3; ++i) {
        vec4 here = corner[i];
        vec4 next = corner[(i + 1) % 3];
        float here_inside = here.w - here.z;
        float next_inside = next.w - next.z;
        if (here_inside >= 0.0) {
            result.clip[result.count++] = here;
        }
        if ((here_inside >= 0.0) != (next_inside >= 0.0)) {
            vec4 inside = here_inside >= 0.0 ? here : next;
            vec4 outside = here_inside >= 0.0 ? next : here;
            float inside_distance = max(here_inside, next_inside);
            float t = inside_distance / (inside_distance - min(here_inside, next_inside));
            result.clip[result.count++] = inside + t * (outside - inside);
        }
    }
    return result;
}

ClippedTriangle clip_corners(vec3 p0, vec3 p1, vec3 p2)
{
    vec4 a = CLIP_FROM_ANCHOR * vec4(p0, 1.0);
    vec4 b = CLIP_FROM_ANCHOR * vec4(p1, 1.0);
    vec4 c = CLIP_FROM_ANCHOR * vec4(p2, 1.0);
    bool all_inside = a.w - a.z >= 0.0 && b.w - b.z >= 0.0 && c.w - c.z >= 0.0;
    if (all_inside) {
        ClippedTriangle whole;
        whole.clip[0] = a;
        whole.clip[1] = b;
        whole.clip[2] = c;
        whole.count = 3;
        return whole;
    }
    return clip_near(a, b, c);
}

ClippedTriangle load_clipped(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    return clip_corners(posed_vertex_at(corners.x).position, posed_vertex_at(corners.y).position,
                        posed_vertex_at(corners.z).position);
}

ivec2 snap(vec4 clip)
{
    vec2 px = (0.5 * clip.xy / clip.w + 0.5) * vec2(PICTURE_PX);
    return ivec2(round(clamp(px, vec2(-guard_px), vec2(guard_px)) * subpixels));
}

// Projects a triangle to the page. False if the triangle is degenerate, culled as a back face, or outside the
// picture.
bool to_page(vec4 a, vec4 b, vec4 c, uint flags, out PageTriangle t)
{
    t.p[0] = snap(a);
    t.p[1] = snap(b);
    t.p[2] = snap(c);
    t.depth = vec3(a.z / a.w, b.z / b.w, c.z / c.w);
    ivec2 u = t.p[1] - t.p[0];
    ivec2 v = t.p[2] - t.p[0];
    int64_t area = int64_t(u.x) * int64_t(v.y) - int64_t(u.y) * int64_t(v.x);
    bool front = (area < 0) != ((flags & triangle_mirrored) != 0u); // y points down the page
#ifdef RASTER_VIEWS
    bool culled = false;
#else
    bool culled = constants.cull_back_faces != 0u && !front && (flags & triangle_two_sided) == 0u;
#endif
    if (area == 0 || culled) {
        return false;
    }
    if (area < 0) {
        ivec2 swapped = t.p[1];
        t.p[1] = t.p[2];
        t.p[2] = swapped;
        t.depth = t.depth.xzy;
    }
    ivec2 low = min(min(t.p[0], t.p[1]), t.p[2]);
    ivec2 high = max(max(t.p[0], t.p[1]), t.p[2]);
    ivec2 limit = ivec2(PICTURE_PX) * int(subpixels);
    return high.x >= 0 && high.y >= 0 && low.x < limit.x && low.y < limit.y;
}

bool page_part(ClippedTriangle clipped, uint part, uint flags, out PageTriangle t)
{
    if (clipped.count < 3 + int(part)) {
        return false;
    }
    return to_page(clipped.clip[0], clipped.clip[1 + part], clipped.clip[2 + part], flags, t);
}

// First and last pixel, inclusive, whose centres the triangle may cover; empty if high < low.
void pixel_bounds(PageTriangle t, out ivec2 low, out ivec2 high)
{
    ivec2 smallest = min(min(t.p[0], t.p[1]), t.p[2]);
    ivec2 largest = max(max(t.p[0], t.p[1]), t.p[2]);
    low = max((smallest + 127) >> 8, ivec2(0));
    high = min((largest - 128) >> 8, ivec2(PICTURE_PX) - 1);
}

// 0 for an edge that owns the pixel centres exactly on it (a top or left edge), else -1.
int owns_its_pixels(ivec2 from, ivec2 to)
{
    ivec2 d = to - from;
    return (d.y < 0 || (d.y == 0 && d.x > 0)) ? 0 : -1;
}

#ifdef RASTER_MASKED
#ifdef RASTER_VIEWS
#define MASK_BINDING 8
#else
#define MASK_BINDING 6
#endif
#include "techniques/raster/mask.glsl"
#endif
#ifdef RASTER_BEHIND
#define BEHIND_BINDING (MASK_BINDING + 8)
#include "techniques/raster/behind.glsl"
#endif

// Depth peeling at half resolution draws only every second pixel in x and y.
#ifdef RASTER_BEHIND
#define DRAWN_SECOND constants.second
#else
#define DRAWN_SECOND 0u
#endif

int drawn_step()
{
    return DRAWN_SECOND == 0u ? 1 : 2;
}

// The first pixel in x and y that depth peeling at half resolution draws, from `low` on.
ivec2 first_drawn(ivec2 low)
{
    ivec2 first = ivec2(DRAWN_SECOND >> 1, DRAWN_SECOND >> 2);
    return low + ((low - first) & (drawn_step() - 1));
}

uint drawn_index(ivec2 pixel)
{
    uint width = DRAWN_SECOND == 0u ? PICTURE_PX.x : (PICTURE_PX.x + 1u - ((DRAWN_SECOND >> 1) & 1u)) / 2u;
    return uint(pixel.y / drawn_step()) * width + uint(pixel.x / drawn_step());
}

void write_pixel(ivec2 pixel, float depth, uint triangle)
{
    uint depth_bits = floatBitsToUint(clamp(depth, 1e-30, 1.0));
#ifdef RASTER_BEHIND
    if (!lies_behind(uint(pixel.y) * PICTURE_PX.x + uint(pixel.x), depth_bits, triangle)) {
        return;
    }
#endif
#ifdef RASTER_MASKED
    if ((variant & draw_has_no_masks) == 0u && !passes_mask(triangle, pixel)) {
        return;
    }
#endif
#ifdef RASTER_VIEWS
    uvec2 turned = uvec2(pixel) + view.turn_px;
    turned -= mix(uvec2(0u), PICTURE_PX, greaterThanEqual(turned, PICTURE_PX));
    uint index = view.first_texel + turned.y * view.size_px + turned.x;
#else
    uint index = drawn_index(pixel);
#endif
#ifdef RASTER_DEPTH_ONLY
    atomicMax(target[index], depth_bits);
#else
    atomicMax(target[index], (uint64_t(depth_bits) << 32) | uint64_t(triangle));
#endif
}

// Depth of a triangle at a pixel with the edge functions `edges`. All code paths must give identical bits,
// because a triangle can take another code path in a picture that begins at another pixel.
float depth_of(vec3 edges, float inverse_area, vec3 depth)
{
    precise vec3 weights = edges * inverse_area;
    precise float sum = weights.x * depth.x + weights.y * depth.y + weights.z * depth.z;
    return sum;
}

// Fills the part of a triangle inside [low, high], for triangles of at most 64 pixels per side, in 32-bit
// arithmetic.
void fill_small(PageTriangle t, ivec2 low, ivec2 high, uint triangle)
{
    ivec2 e0 = t.p[2] - t.p[1];
    ivec2 e1 = t.p[0] - t.p[2];
    ivec2 e2 = t.p[1] - t.p[0];
    float inverse_area = 1.0 / float(e2.x * -e1.y + e2.y * e1.x);
    ivec3 owned = ivec3(owns_its_pixels(t.p[1], t.p[2]), owns_its_pixels(t.p[2], t.p[0]),
                        owns_its_pixels(t.p[0], t.p[1]));
    int drawn = drawn_step();
    ivec2 first = first_drawn(low);
    ivec2 start = first * 256 + 128;
    ivec3 row = ivec3(e0.x * (start.y - t.p[1].y) - e0.y * (start.x - t.p[1].x),
                      e1.x * (start.y - t.p[2].y) - e1.y * (start.x - t.p[2].x),
                      e2.x * (start.y - t.p[0].y) - e2.y * (start.x - t.p[0].x));
    ivec3 right = -256 * drawn * ivec3(e0.y, e1.y, e2.y);
    ivec3 down = 256 * drawn * ivec3(e0.x, e1.x, e2.x);
    for (int y = first.y; y <= high.y; y += drawn) {
        ivec3 edge = row;
        for (int x = first.x; x <= high.x; x += drawn) {
            if (all(greaterThanEqual(edge + owned, ivec3(0)))) {
                write_pixel(ivec2(x, y), depth_of(vec3(edge), inverse_area, t.depth), triangle);
            }
            edge += right;
        }
        row += down;
    }
}

// One edge of a large triangle: its edge function at a pixel's centre, and the increments to the right and
// down, in 64 bits.
struct LargeEdge {
    int64_t value;
    int64_t right;
    int64_t down;
    int64_t owned;
};

LargeEdge large_edge(ivec2 from, ivec2 to, ivec2 pixel)
{
    ivec2 d = to - from;
    ivec2 centre = pixel * 256 + 128;
    LargeEdge edge;
    edge.value = int64_t(d.x) * int64_t(centre.y - from.y) - int64_t(d.y) * int64_t(centre.x - from.x);
    edge.right = int64_t(-256) * int64_t(d.y);
    edge.down = int64_t(256) * int64_t(d.x);
    edge.owned = int64_t(owns_its_pixels(from, to));
    return edge;
}

// Fills a triangle's pixels in one column of a tile, in steps of `apart` rows, down to row `last`.
void fill_column(PageTriangle t, ivec2 top, int last, int apart, uint triangle)
{
    LargeEdge e0 = large_edge(t.p[1], t.p[2], top);
    LargeEdge e1 = large_edge(t.p[2], t.p[0], top);
    LargeEdge e2 = large_edge(t.p[0], t.p[1], top);
    float inverse_area = 1.0 / float(e0.value + e1.value + e2.value);
    e0.down *= int64_t(apart);
    e1.down *= int64_t(apart);
    e2.down *= int64_t(apart);
    for (int y = top.y; y <= last; y += apart) {
        if (e0.value + e0.owned >= 0 && e1.value + e1.owned >= 0 && e2.value + e2.owned >= 0) {
            vec3 edges = vec3(float(e0.value), float(e1.value), float(e2.value));
            write_pixel(ivec2(top.x, y), depth_of(edges, inverse_area, t.depth), triangle);
        }
        e0.value += e0.down;
        e1.value += e1.down;
        e2.value += e2.down;
    }
}

// Whether some pixel centre of a tile may be inside all three edges of a triangle.
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

// Adds a tile to the list if the triangle, whose bounds are `low` to `high`, touches the tile. If the list is
// full, the thread draws the tile itself, which is slow but leaves nothing out.
void list_tile(PageTriangle t, ivec2 low, ivec2 high, ivec2 tile, uint part, uint view_index, uint triangle)
{
    ivec2 tile_low = max(low, tile * tile_px);
    ivec2 tile_high = min(high, tile * tile_px + tile_px - 1);
    if (!touches(t, tile_low, tile_high)) {
        return;
    }
    uint slot = atomicAdd(counters.tile_count, 1u);
    if (slot < constants.tile_capacity) {
        tiles[slot] = TriangleTile(triangle, pack_tile(part, view_index, tile));
        return;
    }
    ivec2 top = first_drawn(tile_low);
    for (; top.x <= tile_high.x; top.x += drawn_step()) {
        fill_column(t, top, tile_high.y, drawn_step(), triangle);
    }
}

// First pass over the triangles, with one thread per triangle. The thread draws a small triangle, lists the
// tiles of a triangle that touches few tiles, or puts a large triangle into a list.

#ifndef RASTER_MASKED
layout(constant_id = 0) const uint variant = 0u;
#endif

const int small_side_px = 63; // side in pixels up to which a triangle's edge functions fit 32 bits
const int most_tiles_a_thread = 4;

void draw_part(ClippedTriangle clipped, uint part, uint view_index, uint triangle, uint flags)
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
    ivec2 first = low / tile_px;
    ivec2 across = high / tile_px - first + 1;
    if ((variant & draw_lists_tiles) != 0u && across.x * across.y <= most_tiles_a_thread) {
        for (int k = 0; k < across.x * across.y; ++k) {
            list_tile(t, low, high, first + ivec2(k % across.x, k / across.x), part, view_index, triangle);
        }
        return;
    }
    uint slot = atomicAdd(counters.large_count, 1u);
    if (slot < constants.large_capacity) {
        large_triangles[slot] = LargeTriangle(triangle, view_index << 1 | part);
        return;
    }
#ifdef RASTER_VIEWS
    // A list with room for all triangles in all views would be too long. The thread draws triangles that do
    // not fit into the list, which is slow but leaves nothing out.
    for (int x = low.x; x <= high.x; ++x) {
        fill_column(t, ivec2(x, low.y), high.y, 1, triangle);
    }
#endif
}

#endif
