// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_FLOW
#define ESTAMPE_INK_FLOW

// What drives ink, as stream functions, square millimetres a second. The velocity is the curl, (d psi / dy,
// -d psi / dx), so ink gathers nowhere and thins nowhere. y points down on the page.

float wind_stream(vec2 place_mm, vec2 wind_mm_per_s)
{
    return wind_mm_per_s.x * place_mm.y - wind_mm_per_s.y * place_mm.x;
}

const float rad_per_turn = 6.2831853f;

// `wave` in turns a millimetre, `phase` in turns.
float wave_stream(vec2 wave, float amplitude, float phase, vec2 place_mm)
{
    return amplitude * sin(rad_per_turn * (dot(wave, place_mm) + phase));
}

// How far a zone is in charge at a squared distance from its middle of `square` radii: wholly up to half its
// radius, not at all beyond it.
float zone_share(float square)
{
    return 1.0f - smoothstep(0.25f, 1.0f, square);
}

// Within a zone its own flow takes the place of the one around. Stream functions are mixed, not velocities:
// the flow goes round where they differ. `in_middle` is the outer stream function in the zone's middle.
float in_zone(float outer, vec2 from_middle_mm, float radius_mm, vec2 velocity_mm_per_s, float turn_rad_s,
              float in_middle)
{
    float square_mm = dot(from_middle_mm, from_middle_mm);
    float inner = in_middle + wind_stream(from_middle_mm, velocity_mm_per_s) - 0.5f * turn_rad_s * square_mm;
    return mix(outer, inner, zone_share(square_mm / (radius_mm * radius_mm)));
}

// On the unit sphere around the eye the velocity is direction x gradient.
vec3 wave_gradient(vec3 wave, float amplitude, float phase, vec3 direction)
{
    return wave * (rad_per_turn * amplitude * cos(rad_per_turn * (dot(wave, direction) + phase)));
}

#endif
