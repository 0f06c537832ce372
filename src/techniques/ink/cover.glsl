// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_COVER
#define ESTAMPE_INK_COVER

// The appearance of flowing ink on the page. Requires before inclusion: `globals`.

const float dry_cover = 0.5; // coverage of dry ink as a share of the coverage of wet ink

// Darkens the edges of an ink area, because drying water carries pigment to the edge of a wash.
float edged(float body)
{
    return body * mix(1.0, 4.0 * body * (1.0 - body), globals.edge);
}

// x: coverage of the page by ink, before the coverage budget limits the ink; y: density of the ink.
vec2 ink_cover(vec2 wet_and_dry)
{
    vec2 body = smoothstep(vec2(globals.thin), vec2(globals.full), wet_and_dry);
    float wet = globals.opacity * edged(body.x);
    float dry = globals.opacity * dry_cover * edged(body.y);
    return vec2(1.0 - (1.0 - wet) * (1.0 - dry), max(body.x, dry_cover * body.y));
}

// Size of the grid of pixels where ink coverage is measured, each second pixel in x and y.
uvec2 measured_size()
{
    return (globals.measured_px + 1u) / 2u;
}

float mean_cover(uint sum)
{
    uvec2 size = measured_size();
    return float(sum) / (ink_measured * float(size.x) * float(size.y));
}

#endif
