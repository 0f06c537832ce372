// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LEVEL
#define ESTAMPE_LEVEL

// Tells ground, floors and table tops from the things that stand on them.

#include "shaders/surface_images.glsl"

// Height of the normal from which a surface counts as level, like the ground.
const float least_level = 0.8;
const float most_level = 0.95;
// Largest difference of the normals of pixels a few pixels apart on a flat surface.
const float most_bend = 0.003;

// Whether the draw call of a pixel's word is the ground or the terrain. `ground_draws` has both draw calls.
bool is_ground(uint word, uvec2 ground_draws)
{
    return sees_draw(word) && any(equal(uvec2(draw_of(word)), ground_draws));
}

// Whether a surface with these normals, at two pixels close to each other, is level and flat.
bool is_flat_and_level(vec3 normal, vec3 beside)
{
    return normal.y > least_level && distance(normal, beside) < most_bend;
}

#endif
