// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_WAYS
#define ESTAMPE_FLUID_WAYS

// Displacements that fluid_ways.comp computed: the first layers store the backward displacements, one layer
// per slice, the later layers the forward displacements. Requires `ways`, a sampler2DArray. Include
// fluid_ways.glsl after fluid_fields.glsl; the requirements of fluid_fields.glsl apply.

vec3 way_of_cell(ivec3 cell, int first_layer)
{
    return texelFetch(ways, ivec3(cell.xy, first_layer + cell.z), 0).xyz;
}

// Displacement of a node of `component`, as the mean of two cells for a face; `own` is the displacement of
// the node's cell.
vec3 way_of_node(int component, ivec3 cell, int first_layer, vec3 own)
{
    return component == fluid_scalar ? own
                                     : 0.5 * (own + way_of_cell(neighbour(cell, component, -1), first_layer));
}

#endif
