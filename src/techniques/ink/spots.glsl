// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_SPOTS
#define ESTAMPE_INK_SPOTS

// Small spots that give ink. There is one in each cell of a lattice; it swells and dies down, and then there
// is another. Wanted before: `globals`, and `life`, an InkSpots.

#include "shaders/footprint.glsl"
#include "shaders/hash.glsl"

// x: how much of what it can a spot gives at a place, 0 to 1; y: its rank, 0 to 1: where ink is to be spared,
// the highest give none.
vec2 no_spot()
{
    return vec2(0.0, 1.0);
}

// The spot of a cell. `within` is the place in it, 0 to 1; `normal` that of the surface, which sees a spot
// above or below it as if it lay there; of the page none.
vec2 spot_of_cell(uint id, vec3 within, vec3 normal)
{
    float lives = life.share + unit_float(id);
    uint own = hash(id ^ hash(life.round + uint(lives)));
    float radius = globals.spot_mm / globals.spacing_mm * (0.5 + 0.5 * unit_float(hash(own ^ 1u)));
    vec3 place = vec3(unit_float(hash(own ^ 2u)), unit_float(hash(own ^ 3u)), unit_float(hash(own ^ 4u)));
    vec3 away = within - mix(vec3(radius), vec3(1.0 - radius), place);
    away -= normal * dot(away, normal);
    float swell = fract(lives);
    float gives = clamp(1.0 - dot(away, away) / (radius * radius), 0.0, 1.0);
    return vec2(gives * min(1.0, 5.0 * min(swell, 1.0 - swell)), unit_float(hash(own ^ 5u)));
}

// On the page.
vec2 spot_on_page(vec2 place_mm)
{
    vec2 at = place_mm / globals.spacing_mm;
    ivec2 cell = ivec2(floor(at));
    return spot_of_cell(hash(uint(cell.x), uint(cell.y), globals.seed), vec3(fract(at), 0.0),
                        vec3(0.0, 0.0, 1.0));
}

// On a thing, where strokes have this coordinate, which changes so over a pixel: spots stay on it as it and
// the camera move. Their size on the page is that of the style to a factor of 1.4.
vec2 spot_on_thing(vec3 coordinate, Footprint footprint, float px_per_mm, uint thing)
{
    vec3 across = cross(footprint.dx, footprint.dy);
    float area = length(across); // of a pixel
    if (!(area > 0.0)) {
        return no_spot();
    }
    float scale = exp2(round(log2(sqrt(area) * globals.spacing_mm * px_per_mm)));
    vec3 at = coordinate / scale;
    ivec3 cell = ivec3(floor(at));
    uint id = hash(hash(uint(cell.x), uint(cell.y), uint(cell.z)), thing, globals.seed);
    return spot_of_cell(id, fract(at), across / area);
}

#endif
