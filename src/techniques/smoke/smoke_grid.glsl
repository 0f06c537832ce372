// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMOKE_GRID
#define ESTAMPE_SMOKE_GRID

// Needs `smoke`, a SmokeGlobals. Places are counted in cells from the low corner of the box.

// Between nodes in the middle of cells, of which a field has `size` each way; constant beyond the outermost.
float sample_layers(sampler2DArray field, vec3 place, vec3 size)
{
    float z = clamp(place.z - 0.5, 0.0, size.z - 1.0);
    vec2 uv = place.xy / size.xy;
    float low = floor(z);
    float high = min(low + 1.0, size.z - 1.0);
    return mix(textureLod(field, vec3(uv, low), 0.0).x, textureLod(field, vec3(uv, high), 0.0).x, z - low);
}

uvec3 brick_counts()
{
    return (smoke.cells + smoke_brick - 1u) / smoke_brick;
}

// Where along a ray it is within the box: enters and leaves, in the ray's own lengths; leaves first if never.
vec2 range_in_box(vec3 origin, vec3 direction)
{
    vec3 safe = mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec3 to_low = -origin / safe;
    vec3 to_high = (vec3(smoke.cells) - origin) / safe;
    vec3 first = min(to_low, to_high);
    vec3 last = max(to_low, to_high);
    return vec2(max(first.x, max(first.y, first.z)), min(last.x, min(last.y, last.z)));
}

#endif
