// SPDX-License-Identifier: MIT
// Depth peeling: tests whether a triangle is behind the surface in another visibility buffer. BEHIND_BINDING
// is that buffer's binding.

#include "shaders/visibility.glsl"

layout(binding = BEHIND_BINDING) uniform usamplerBuffer peeled;

// Depth peeling test for pictures of every second pixel: whether a triangle lies behind the previous layer's
// surface. Depths in pictures of every second pixel are not bit-identical to depths in the full picture. So
// the previous layer's surface could appear again beside an edge. For triangles that face the eye, the test
// needs a tolerance from the surface's slope.
bool lies_clearly_behind(uint index, float depth, float change, uint triangle, bool faces_eye)
{
    uvec2 word = texelFetch(peeled, int(index)).xy;
    float tolerance = faces_eye ? 0.1 * change + 1e-6 * depth : 0.0;
    return sees_triangle(word) && triangle != seen_triangle(word) && depth + tolerance < seen_depth(word);
}

bool lies_behind(uint index, uint depth_bits, uint triangle)
{
    uvec2 word = texelFetch(peeled, int(index)).xy;
    return sees_triangle(word) &&
           (depth_bits < word.y || (depth_bits == word.y && triangle < seen_triangle(word)));
}
