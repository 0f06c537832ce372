// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_FLOW
#define ESTAMPE_INK_FLOW

// Where ink flows: the curl of a stream function, so that it gathers nowhere and thins nowhere. y points down
// on the page; the velocity is (d psi / dy, -d psi / dx).

// A stream function at a place.
struct Stream {
    float psi;
    vec2 gradient;
};

vec2 velocity_of(Stream stream)
{
    return vec2(stream.gradient.y, -stream.gradient.x);
}

Stream wind_stream(vec2 place_mm, vec2 wind_mm_s)
{
    return Stream(wind_mm_s.x * place_mm.y - wind_mm_s.y * place_mm.x, vec2(-wind_mm_s.y, wind_mm_s.x));
}

Stream add_wave(Stream stream, vec2 wave, float amplitude, float phase, vec2 place_mm)
{
    float angle = dot(wave, place_mm) + phase;
    return Stream(stream.psi + amplitude * sin(angle), stream.gradient + wave * (amplitude * cos(angle)));
}

// How far a zone is in charge at a squared distance from its middle of `square` radii: wholly up to half its
// radius, not at all beyond it. x: share; y: its derivative by `square`.
vec2 zone_share(float square)
{
    float t = clamp((1.0f - square) * (4.0f / 3.0f), 0.0f, 1.0f);
    return vec2(t * t * (3.0f - 2.0f * t), -8.0f * t * (1.0f - t));
}

// Within a zone its own flow takes the place of the one around. Stream functions are mixed, not velocities:
// the flow goes round where they differ. `around` is the outer stream function in the zone's middle.
Stream in_zone(Stream outer, vec2 from_middle_mm, float radius_mm, vec2 velocity_mm_s, float turn_rad_s,
               float around)
{
    vec2 share = zone_share(dot(from_middle_mm, from_middle_mm) / (radius_mm * radius_mm));
    Stream inner = wind_stream(from_middle_mm, velocity_mm_s);
    inner.psi += around - 0.5f * turn_rad_s * dot(from_middle_mm, from_middle_mm);
    inner.gradient -= turn_rad_s * from_middle_mm;
    vec2 share_gradient = from_middle_mm * (2.0f * share.y / (radius_mm * radius_mm));
    return Stream(mix(outer.psi, inner.psi, share.x),
                  mix(outer.gradient, inner.gradient, share.x) + share_gradient * (inner.psi - outer.psi));
}

// On the unit sphere around the eye the velocity is direction x gradient.
vec3 wave_gradient(vec3 wave, float amplitude, float phase, vec3 direction)
{
    return wave * (amplitude * cos(dot(wave, direction) + phase));
}

#endif
