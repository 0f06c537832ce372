// SPDX-License-Identifier: MIT
// One thread inks the part of a line between two samples with a brush (a picture that bends with the line).
// The part covers the pixels between the two perpendiculars at its ends, so the picture continues from part
// to part without a seam.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

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

layout(scalar, binding = 3) readonly buffer LineTouches
{
    LineTouch touches[];
};

layout(binding = 4) uniform sampler2DArray brushes;

layout(scalar, binding = 5) buffer Inked
{
    uint inked[]; // one word per pixel: coverage in the upper 16 bits, number of the ink in the lower 16 bits
};

#define INK_TILES_BINDING 6
#define INK_TILES_ACCESS
#include "techniques/contour/chains/ink/ink_tiles.glsl"

layout(push_constant, scalar) uniform Constants
{
    BrushConstants constants;
};

#include "techniques/contour/chains/ink/inked_pieces.glsl"

const float most_taps = 4.0;
// Smallest and largest factor by which a repeated brush may be stretched along a line; 1 is unstretched.
const vec2 repeated_pace = vec2(0.5, 1.5);
const vec2 stretched_pace = vec2(0.0, 8.0);

// Filtered ink of a brush's picture. `place` is the position along and across the picture, as shares of the
// picture's length and width. `step` is the size of a pixel in the picture. Where a pixel is longer than wide
// in the picture, several lookups along the pixel's length are averaged.
float brush_ink(uint layer, vec2 place, vec2 step, bool repeats)
{
    vec2 texels = max(step * vec2(brush_columns, brush_rows), vec2(1e-6));
    float longer = max(texels.x, texels.y);
    float lod = max(log2(max(min(texels.x, texels.y), longer / most_taps)), 0.0);
    vec2 margin = 0.5 * exp2(min(vec2(lod), vec2(10.0, 5.0))) / vec2(brush_columns, brush_rows);
    vec2 stride = texels.x > texels.y ? vec2(step.x, 0.0) : vec2(0.0, step.y);
    float sum = 0.0;
    for (float i = 0.5; i < most_taps; i += 1.0) {
        vec2 tap = place + stride * (i / most_taps - 0.5);
        vec2 inside = clamp(tap, margin, 1.0 - margin);
        sum += textureLod(brushes, vec3(repeats ? tap.x : inside.x, inside.y, float(layer)), lod).x;
    }
    return sum / most_taps;
}

struct End {
    LinePoint point;
    LineTouch touch;
    vec2 way;
};

End end_at(uint i)
{
    return End(line_points[i], touches[i], unpackHalf2x16(touches[i].way));
}

// Coverage of a pixel by the line from the sample `a` to the sample `b`.
float inked_by(vec2 pixel, End a, End b)
{
    vec2 from_a = pixel - a.point.page_px;
    vec2 way = b.point.page_px - a.point.page_px;
    float past_a = dot(from_a, a.way);
    float before_b = dot(b.point.page_px - pixel, b.way);
    uint use = a.touch.uses & touch_use;
    float period_px = constants.period_px[use];
    uint layer = constants.layer_of_use[use];
    bool repeats = period_px > 0.0;
    // The ends of a stroke are round if the stroke is drawn with the pen or a repeated brush. The picture of
    // a stretched brush already contains the stroke's ends.
    bool has_cap = repeats || layer == no_brush;
    bool is_inside = (past_a >= 0.0 || (has_cap && (a.touch.uses & touch_is_start) != 0u)) &&
                     (before_b > 0.0 || (has_cap && (b.touch.uses & touch_is_end) != 0u));
    float along = clamp(dot(from_a, way) / max(dot(way, way), 1e-12), 0.0, 1.0);
    float half_width = mix(a.point.half_width_px, b.point.half_width_px, along);
    vec2 off = from_a - along * way;
    float ink = is_inside ? coverage(half_width, length(off)) : 0.0;
    if (ink > 0.0 && layer != no_brush) {
        float share = clamp(past_a / max(past_a + before_b, 1e-6), 0.0, 1.0);
        float across = 0.5 + 0.5 * (way.x * off.y - way.y * off.x >= 0.0 ? 1.0 : -1.0) * length(off) /
                                 max(half_width, 0.5);
        float length_px = b.touch.along_px - a.touch.along_px;
        float phase = b.touch.phase_px - a.touch.phase_px;
        // Where two brushes meet between two samples, each of the two brushes continues at its own scale.
        vec2 same_brush = (repeats ? repeated_pace : stretched_pace) * length_px;
        phase = phase > same_brush.x && phase < same_brush.y ? phase : length_px;
        float beyond = min(past_a, 0.0) - min(before_b, 0.0);
        float picture_px = repeats ? period_px : max(a.touch.whole_px, 1.0);
        float place = (a.touch.phase_px + share * phase + beyond) / picture_px;
        vec2 step = vec2(phase / max(length_px, 1e-6) / picture_px, 0.5 / max(half_width, 0.5));
        ink *= brush_ink(layer, vec2(place, clamp(across, 0.0, 1.0)), step, repeats);
    }
    return ink;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count || (sample_at(index).state & piece_is_there) == 0u) {
        return;
    }
    End a = end_at(2u * index);
    End b = end_at(2u * index + 3u);
    float reach = min(max(a.point.half_width_px, b.point.half_width_px), widest_px) + 1.0;
    vec2 size = vec2(constants.width, constants.height);
    vec2 least = min(a.point.page_px, b.point.page_px);
    vec2 most = max(a.point.page_px, b.point.page_px);
    ivec2 low = ivec2(clamp(floor(least - reach), vec2(0.0), size));
    ivec2 high = ivec2(clamp(ceil(most + reach), vec2(0.0), size));
    list_tiles(low, high);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            float ink = inked_by(vec2(x, y) + 0.5, a, b);
            uint word = uint(65535.0 * ink + 0.5) << 16 | min(a.point.ink, 0xffffu);
            if (ink > 0.0) {
                atomicMax(inked[uint(y) * constants.width + uint(x)], word);
            }
        }
    }
}
