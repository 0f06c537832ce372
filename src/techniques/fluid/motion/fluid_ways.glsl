// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_WAYS
#define ESTAMPE_FLUID_WAYS

// Ways that fluid_ways.comp found: those back in the first layers, a slice each, those forth in the layers
// after. Needs what fluid_fields.glsl needs, is included after it, and needs `ways`, a sampler2DArray.

vec3 way_of_cell(ivec3 cell, int first_layer)
{
    return texelFetch(ways, ivec3(cell.xy, first_layer + cell.z), 0).xyz;
}

// Of a node of `component`, when its cell goes `own`: a face lies between two cells.
vec3 way_of_node(int component, ivec3 cell, int first_layer, vec3 own)
{
    return component == fluid_scalar ? own
                                     : 0.5 * (own + way_of_cell(neighbour(cell, component, -1), first_layer));
}

#endif
