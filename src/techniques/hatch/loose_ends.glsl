// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LOOSE_ENDS
#define ESTAMPE_LOOSE_ENDS

// Strokes of a quick hand end a little before or beyond the edge of a tone. Each stroke reads its darkness at
// a place farther along the stroke, by a random distance of its own. Where the tone is even, its ink does not
// change. Requires before inclusion: line_families.glsl, darkness_image, draw_image, normal_image.

// Random number from -1 to 1 of each strip of a surface of the width 2^level in the coordinate v. Strips lie
// around the lines of that spacing, and their numbers run into each other between the lines.
float number_of_strip(LineField field, int level, uint seed)
{
    int count = 1 << clamp(-level, 0, 30);
    float at = field.v * power_of_two(-level);
    float low = floor(at);
    vec2 ends = vec2(0.0);
    for (int i = 0; i < 2; ++i) {
        int number = int(low) + i;
        ends[i] = trait(dyadic_identity(field.wraps ? folded(number, count) : number, level, seed), 8u);
    }
    return 2.0 * mix(ends.x, ends.y, smoothstep(0.25, 0.75, at - low)) - 1.0;
}

// Distance in pixels along a stroke at which the stroke reads its darkness. The strips are as wide as the
// spacing of the lines of a full first layer. Where their width changes to the next power of two, both widths
// are blended, so that ends do not jump as the eye moves.
float loose_px_at(LineField field, uint seed)
{
    float spacing = constants.width_px * max(field.v_per_px, 1e-12) / FIRST_LAYER_SHARE;
    spacing = max(spacing, max(abs(field.v), 1e-6) * power_of_two(-22));
    int level = ceil_log2(spacing);
    float blend = log2(spacing * power_of_two(1 - level));
    int narrow = field.wraps ? min(level, 0) : level;
    int wide = field.wraps ? min(level + 1, 0) : level + 1;
    float number = mix(number_of_strip(field, narrow, seed), number_of_strip(field, wide, seed), blend);
    return number * constants.loose_px;
}

// Darkness that a family of strokes must reach at a pixel whose surface has the stroke coordinate `p`. The
// darkness is read farther along the stroke, if the surface goes on there.
float family_darkness(ivec2 pixel, vec3 p, Footprint f, vec3 normal, uint word, uint family)
{
    uint kind = strokes_of(word);
    vec3 axis = family_axis(kind, family);
    vec2 across = vec2(dot(axis, f.dx), dot(axis, f.dy));
    vec2 along = vec2(-across.y, across.x) / max(size_of(across), 1e-18);
    float away_px = loose_px_at(family_field(p, f, kind, family), family_seed(family));
    ivec2 there = clamp(pixel + ivec2(round(away_px * along)), ivec2(0), ivec2(constants.size_px) - 1);
    bool goes_on = texelFetch(draw_image, there, 0).x == word &&
                   dot(unpack_normal(texelFetch(normal_image, there, 0).y), normal) > 0.5;
    float dark = texelFetch(darkness_image, goes_on ? there : pixel, 0).x;
    Families families = Families(0u, false, dark);
    while (is_any_left(families)) {
        uint next;
        float of_next = next_family(families, normal, kind, next);
        if (next == family) {
            return of_next;
        }
    }
    return 0.0;
}

#endif
