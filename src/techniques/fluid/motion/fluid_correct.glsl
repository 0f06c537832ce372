// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_CORRECT
#define ESTAMPE_FLUID_CORRECT

// MacCormack's correction of the blur of semi-Lagrangian advection. The advected field, when advected
// backwards, should equal the original; half of the difference is added, clamped to the range of the source
// nodes. Requires `field` and `advected`, two sampler2DArray. Include fluid_correct.glsl after
// fluid_fields.glsl; the requirements of fluid_fields.glsl apply.

// Value of a cell's node of `component` after MacCormack's correction. The component's layers start at
// `first_layer`; `back` and `forth` are the node's displacements.
float corrected(int component, ivec3 cell, int first_layer, vec3 back, vec3 forth)
{
    ivec3 texel = ivec3(cell.xy, first_layer + cell.z);
    float returned = sample_linear(advected, component, cell, first_layer, forth);
    float value = texelFetch(advected, texel, 0).x + 0.5 * (texelFetch(field, texel, 0).x - returned);
    vec2 range = range_of_nodes(field, component, cell, first_layer, back);
    return is_on_wall(component, cell) ? 0.0 : clamp(value, range.x, range.y);
}

#endif
