// SPDX-License-Identifier: MIT
// Peeling: whether a triangle lies behind what another visibility buffer holds at a pixel. BEHIND_BINDING is
// its binding.

#include "shaders/visibility.glsl"

layout(binding = BEHIND_BINDING) uniform usamplerBuffer peeled;

// Whether what a picture of every second pixel shows lies behind, whose depths are not the same to the bit,
// and which sees beside an edge what the whole one sees on it: the surface itself, which faces the eye as
// what is peeled does, is told by its slope.
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
