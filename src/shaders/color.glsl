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

// A transparent picture as bytes. Programs lay such pictures on each other in sRGB-encoded values, where the
// covers of linear light would draw bolder strokes; so alpha and colour are found such that the result over
// the drawing's own paper is the opaque drawing. output/layer_bytes.cpp does the same on the processor.

// The least alpha by which some colour turns `below` into `wanted`, both 0 to 1.
float least_alpha(vec3 below, vec3 wanted)
{
    vec3 darker = (below - wanted) / max(below, 1e-6);
    vec3 lighter = (wanted - below) / max(1.0 - below, 1e-6);
    vec3 least = max(max(darker, lighter), vec3(0.0));
    return min(max(least.r, max(least.g, least.b)), 1.0);
}

// What was laid on paper that now shows `color`, of that alpha: linear colour times alpha, and alpha.
vec4 lifted_off(vec3 paper, vec3 color, float alpha)
{
    return vec4(max(color - (1.0 - alpha) * paper, vec3(0.0)), alpha);
}

// Bytes of a pixel, red in the lowest: its colour not multiplied by alpha. `color` is what the drawing's own
// paper shows there, and `shown` that as an opaque picture would have it.
uint straight_srgb_bytes(vec3 paper, vec3 color, float page_alpha, vec3 shown)
{
    if (page_alpha <= 0.0) {
        return 0u;
    }
    if (page_alpha >= 1.0) {
        return srgb_bytes(shown);
    }
    vec4 page = lifted_off(paper, color, page_alpha);
    vec3 wanted = srgb_from_linear(clamp(shown, 0.0, 1.0));
    vec3 below = srgb_from_linear(clamp(paper, 0.0, 1.0));
    vec3 pigment = srgb_from_linear(clamp(page.rgb / page.a, 0.0, 1.0));
    // The alpha by which the pigment comes nearest; where it differs too little from the paper to tell, its
    // share of the pixel.
    const float least_way = 0.02;
    vec3 way = below - pigment;
    float length_2 = dot(way, way);
    float share = length_2 > least_way * least_way ? dot(below - wanted, way) / length_2 : page.a;
    vec3 wanted_byte = round(255.0 * wanted);
    vec3 below_byte = round(255.0 * below);
    float least = max(least_alpha(below, wanted), least_alpha(below_byte / 255.0, wanted_byte / 255.0));
    float alpha = clamp(max(ceil(255.0 * least - 1e-3), round(255.0 * share)), 0.0, 255.0);
    if (alpha <= 0.0) {
        return 0u;
    }
    vec3 straight = below_byte + (wanted_byte - below_byte) * (255.0 / alpha);
    // The pigment itself, wherever that gives the same byte: rounding is not blown up at a small alpha.
    vec3 own = round(255.0 * pigment);
    vec3 off = abs(mix(below_byte, own, alpha / 255.0) - wanted_byte);
    straight = mix(straight, own, lessThan(off, vec3(0.5)));
    return packUnorm4x8(vec4(clamp(straight, 0.0, 255.0), alpha) / 255.0);
}

#endif
