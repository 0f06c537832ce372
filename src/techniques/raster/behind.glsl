// SPDX-License-Identifier: MIT
// Peeling: whether a triangle lies behind what another visibility buffer holds at a pixel. BEHIND_BINDING is
// its binding.

#include "shaders/visibility.glsl"

layout(scalar, binding = BEHIND_BINDING) readonly buffer Behind
{
    uvec2 peeled[];
};

bool lies_behind(uint index, uint depth_bits, uint triangle)
{
    uvec2 word = peeled[index];
    return sees_triangle(word) &&
           (depth_bits < word.y || (depth_bits == word.y && triangle < seen_triangle(word)));
}
