// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_CORRECT
#define ESTAMPE_FLUID_CORRECT

// MacCormack's correction of what semi-Lagrangian advection blurred. Carried back, its result should be what
// was there; half of the difference is added, within the range of the nodes that it came from. Needs what
// fluid_fields.glsl needs, is included after it, and needs `field` and `advected`, two sampler2DArray.

// Of a cell's node of `component`, whose layers begin at `first_layer`, and which goes these ways.
float corrected(int component, ivec3 cell, int first_layer, vec3 back, vec3 forth)
{
    ivec3 texel = ivec3(cell.xy, first_layer + cell.z);
    float returned = sample_linear(advected, component, cell, first_layer, forth);
    float value = texelFetch(advected, texel, 0).x + 0.5 * (texelFetch(field, texel, 0).x - returned);
    vec2 range = range_of_nodes(field, component, cell, first_layer, back);
    return is_on_wall(component, cell) ? 0.0 : clamp(value, range.x, range.y);
}

#endif
