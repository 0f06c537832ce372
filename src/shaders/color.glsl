// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_COLOR
#define ESTAMPE_COLOR

// Relative luminance of linear Rec. 709 colour.
float luminance(vec3 linear)
{
    return dot(linear, vec3(0.2126, 0.7152, 0.0722));
}

vec3 srgb_from_linear(vec3 linear)
{
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

// Red in the lowest byte, opaque.
uint srgb_bytes(vec3 linear)
{
    return packUnorm4x8(vec4(srgb_from_linear(clamp(linear, 0.0, 1.0)), 1.0));
}

vec3 linear_from_srgb(vec3 encoded)
{
    vec3 high = pow((encoded + 0.055) / 1.055, vec3(2.4));
    return mix(high, encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}

// A vertex's colour: linear, stored as its square root; alpha as it is.
vec4 vertex_color(uint packed)
{
    vec4 stored = unpackUnorm4x8(packed);
    return vec4(stored.rgb * stored.rgb, stored.a);
}

// Colour of a light alone, its brightest channel 1. Darkness has none, and counts as white.
vec3 light_tint(vec3 light)
{
    return (light + 1e-3) / (max(light.r, max(light.g, light.b)) + 1e-3);
}

#endif
