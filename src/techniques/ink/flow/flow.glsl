// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_FLOW
#define ESTAMPE_INK_FLOW

// The flow of ink as stream functions, in square millimetres per second. The velocity is the curl of the
// stream function psi, (d psi / dy, -d psi / dx), so the flow has no divergence. The page coordinate y points
// down.

float wind_stream(vec2 place_mm, vec2 wind_mm_per_s)
{
    return wind_mm_per_s.x * place_mm.y - wind_mm_per_s.y * place_mm.x;
}

const float rad_per_turn = 6.2831853f;

// Stream function of one wave. `wave` is in turns per millimetre, `phase` in turns.
float wave_stream(vec2 wave, float amplitude, float phase, vec2 place_mm)
{
    return amplitude * sin(rad_per_turn * (dot(wave, place_mm) + phase));
}

// Weight of a zone's own flow at a place. `square` is the squared distance of the place from the zone's
// middle, divided by the squared distance from the middle to the edge. The weight of the zone's flow is 1 up
// to half-way from the middle, and 0 beyond the zone's edge.
float zone_share(float square)
{
    return 1.0f - smoothstep(0.25f, 1.0f, square);
}

// Stream function inside a zone, where the zone's own flow replaces the surrounding flow. The blend mixes
// stream functions, not velocities, so the flow stays free of divergence. `in_middle` is the outer stream
// function in the zone's middle, `share` the zone's weight.
float in_zone(float outer, vec2 from_middle_mm, float share, vec2 velocity_mm_per_s, float turn_rad_s,
              float in_middle)
{
    float square_mm = dot(from_middle_mm, from_middle_mm);
    float inner = in_middle + wind_stream(from_middle_mm, velocity_mm_per_s) - 0.5f * turn_rad_s * square_mm;
    return mix(outer, inner, share);
}

// Gradient of a wave's stream function in a direction from the eye. On the unit sphere around the eye the
// velocity is cross(direction, gradient).
vec3 wave_gradient(vec3 wave, float amplitude, float phase, vec3 direction)
{
    return wave * (rad_per_turn * amplitude * cos(rad_per_turn * (dot(wave, direction) + phase)));
}

#endif
