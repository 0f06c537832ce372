// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMOKE_VOLUME
#define ESTAMPE_SMOKE_VOLUME

// Reads smoke along rays. Include after smoke_grid.glsl and smoke_ray.glsl. Define before: `packed` and
// `brick_texels`, which smoke_pack.comp writes.

uint box_count()
{
    return has_several ? smoke.box_count : 1u;
}

// Transforms a ray to the cells of a smoke box; lengths along it stay in metres.
Ray ray_in_box(uint box, Ray ray)
{
    return Ray((smoke.boxes[box].grid_from_anchor * vec4(ray.origin, 1.0)).xyz,
               mat3(smoke.boxes[box].grid_from_anchor) * ray.direction);
}

// Density and light of smoke at a place in a box.
vec2 smoke_at(uint box, vec3 place)
{
    uvec3 cells = smoke.boxes[box].cells;
    float z = clamp(place.z - 0.5, 0.0, float(cells.z) - 1.0);
    float low = floor(z);
    vec2 uv = field_uv(place.xy, vec2(cells.xy), vec2(smoke.field_cells.xy));
    vec4 both = textureLod(packed, vec3(uv, float(smoke.boxes[box].first_layer) + low), 0.0);
    return mix(both.xy, both.zw, z - low);
}

// Distance, in lengths of `direction`, that a ray stays in an empty brick; 0 in a brick with smoke.
float empty_way(uint box, vec3 place, vec3 direction)
{
    uvec3 cells = smoke.boxes[box].cells;
    vec3 node = clamp(place - 0.5, vec3(0.0), vec3(cells) - 1.0);
    uvec3 brick = min(uvec3(node) / smoke_brick, brick_counts(cells) - 1u);
    float densest = texelFetch(brick_texels, brick_index(box, brick)).x;
    vec3 low = vec3(brick * smoke_brick) + 0.5;
    vec3 plane = mix(low, low + float(smoke_brick), greaterThan(direction, vec3(0.0)));
    vec3 way = (plane - place) / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    // Beyond the outermost planes of nodes the field is constant.
    way = mix(way, vec3(1e9), lessThanEqual(way, vec3(0.0)));
    return densest > 0.0 ? 0.0 : min(way.x, min(way.y, way.z));
}

#endif
