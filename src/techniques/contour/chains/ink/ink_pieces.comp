// SPDX-License-Identifier: MIT
// One thread inks the part of a line between two samples, with round ends and interpolated width. Where lines
// cross, the darker ink remains.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define SAMPLES_BINDING 1
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 2) readonly buffer LinePoints
{
    LinePoint line_points[];
};

layout(scalar, binding = 3) buffer Inked
{
    uint inked[]; // one word per pixel: coverage in the upper 16 bits, number of the ink in the lower 16 bits
};

#define INK_TILES_BINDING 4
#define INK_TILES_ACCESS
#include "techniques/contour/chains/ink/ink_tiles.glsl"

layout(push_constant, scalar) uniform Constants
{
    InkConstants constants;
};

#include "techniques/contour/chains/ink/inked_pieces.glsl"

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count || (sample_at(index).state & piece_is_there) == 0u) {
        return;
    }
    LinePoint a = line_points[2u * index];
    LinePoint b = line_points[2u * index + 3u];
    float reach = min(max(a.half_width_px, b.half_width_px), widest_px) + 1.0;
    vec2 size = vec2(constants.width, constants.height);
    ivec2 low = ivec2(clamp(floor(min(a.page_px, b.page_px) - reach), vec2(0.0), size));
    ivec2 high = ivec2(clamp(ceil(max(a.page_px, b.page_px) + reach), vec2(0.0), size));
    list_tiles(low, high);
    vec2 way = b.page_px - a.page_px;
    float inverse = 1.0 / max(dot(way, way), 1e-12);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            vec2 from_a = vec2(x, y) + 0.5 - a.page_px;
            float along = clamp(dot(from_a, way) * inverse, 0.0, 1.0);
            float half_width = mix(a.half_width_px, b.half_width_px, along);
            float ink = coverage(half_width, size_of(from_a - along * way));
            uint word = uint(65535.0 * ink + 0.5) << 16 | min(a.ink, 0xffffu);
            if (ink > 0.0) {
                atomicMax(inked[uint(y) * constants.width + uint(x)], word);
            }
        }
    }
}
