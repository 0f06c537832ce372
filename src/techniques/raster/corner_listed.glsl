// SPDX-License-Identifier: MIT
// One corner of one triangle of a list of those that are worth it. LISTED_BINDING is the list's binding.

#include "techniques/raster/draw.glsl"

#include "techniques/raster/corner.glsl"

layout(binding = LISTED_BINDING) uniform usamplerBuffer listed; // numbers within the batch

void main()
{
    uint number = texelFetch(listed, gl_VertexIndex / 3).x;
    draw_corner(constants.first_triangle + number, uint(gl_VertexIndex) % 3u);
}
