// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMOKE_GRID
#define ESTAMPE_SMOKE_GRID

// Positions and interpolation in the grid of a smoke box. Define before: `smoke`, a SmokeGlobals, and
// `has_several`. Positions are in cells from the low corner of a box.

// Texture coordinate of a position in a field. Positions beyond the outermost nodes are clamped to them.
vec2 field_uv(vec2 place, vec2 size, vec2 image_size)
{
    return (has_several ? clamp(place, vec2(0.5), size - 0.5) : place) / image_size;
}

// Trilinear interpolation of a field between nodes at the middles of cells, constant beyond the outermost
// nodes. The field has `size` nodes from layer `first_layer` on, in an image of `image_size`.
float sample_layers(sampler2DArray field, vec3 place, vec3 size, vec2 image_size, float first_layer)
{
    float z = clamp(place.z - 0.5, 0.0, size.z - 1.0);
    vec2 uv = field_uv(place.xy, size.xy, image_size);
    float low = floor(z);
    float high = min(low + 1.0, size.z - 1.0);
    return mix(textureLod(field, vec3(uv, first_layer + low), 0.0).x,
               textureLod(field, vec3(uv, first_layer + high), 0.0).x, z - low);
}

uvec3 light_counts(uvec3 cells)
{
    return (cells + (smoke_light_cells - 1u)) / smoke_light_cells;
}

uvec3 brick_counts(uvec3 cells)
{
    return (cells + (smoke_brick - 1u)) / smoke_brick;
}

int brick_index(uint box, uvec3 brick)
{
    uvec3 counts = brick_counts(smoke.field_cells);
    uint layer = smoke.boxes[box].first_layer / smoke_brick + brick.z;
    return int((layer * counts.y + brick.y) * counts.x + brick.x);
}

// Distances at which a ray enters and leaves a box of `cells`, in lengths of `direction`. If the ray misses
// the box, the second distance is less than the first.
vec2 range_in_box(vec3 cells, vec3 origin, vec3 direction)
{
    vec3 safe = mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec3 to_low = -origin / safe;
    vec3 to_high = (cells - origin) / safe;
    vec3 first = min(to_low, to_high);
    vec3 last = max(to_low, to_high);
    return vec2(max(first.x, max(first.y, first.z)), min(last.x, min(last.y, last.z)));
}

#endif
