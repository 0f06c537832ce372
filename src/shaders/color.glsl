// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_COLOR
#define ESTAMPE_COLOR

// Relative luminance of a linear Rec. 709 colour.
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

// Packs an opaque sRGB-encoded pixel, with red in the lowest byte.
uint srgb_bytes(vec3 linear)
{
    return packUnorm4x8(vec4(srgb_from_linear(clamp(linear, 0.0, 1.0)), 1.0));
}

vec3 linear_from_srgb(vec3 encoded)
{
    vec3 high = pow((encoded + 0.055) / 1.055, vec3(2.4));
    return mix(high, encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}

// Unpacks a vertex colour to linear colour and alpha. Colour is stored as its square root; alpha is stored
// unchanged.
vec4 vertex_color(uint packed)
{
    vec4 stored = unpackUnorm4x8(packed);
    return vec4(stored.rgb * stored.rgb, stored.a);
}

// Hue of a light's colour, scaled so that the brightest channel is 1. White for no light.
vec3 light_tint(vec3 light)
{
    return (light + 1e-3) / (max(light.r, max(light.g, light.b)) + 1e-3);
}

// Conversion of a transparent picture to bytes. Programs composite transparent pictures in sRGB-encoded
// values, where coverage computed in linear light would give bolder strokes. Alpha and colour are therefore
// chosen so that the transparent picture over the drawing's own paper equals the opaque drawing.
// output/layer_bytes.cpp has the CPU version of the conversion.

// Smallest alpha with which some colour turns the colour `below` into `wanted`; channels are 0 to 1.
float least_alpha(vec3 below, vec3 wanted)
{
    vec3 darker = (below - wanted) / max(below, 1e-6);
    vec3 lighter = (wanted - below) / max(1.0 - below, 1e-6);
    vec3 least = max(max(darker, lighter), vec3(0.0));
    return min(max(least.r, max(least.g, least.b)), 1.0);
}

// Premultiplied linear colour of ink or paint that has this alpha and shows `color` on `paper`.
vec4 lifted_off(vec3 paper, vec3 color, float alpha)
{
    return vec4(max(color - (1.0 - alpha) * paper, vec3(0.0)), alpha);
}

// Packs a pixel with straight alpha, red in the lowest byte. `color` is the linear colour of the drawing on
// its own paper, and `shown` the colour of the opaque picture.
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
    // If pigment and paper differ by less than this value, alpha is the pigment's coverage of the pixel. If
    // pigment and paper differ by more, alpha is chosen so that the pigment comes nearest to the wanted
    // colour.
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
    // The pigment's colour is kept where it gives an equal byte, so that a small alpha does not amplify
    // rounding.
    vec3 own = round(255.0 * pigment);
    vec3 off = abs(mix(below_byte, own, alpha / 255.0) - wanted_byte);
    straight = mix(straight, own, lessThan(off, vec3(0.5)));
    return packUnorm4x8(vec4(clamp(straight, 0.0, 255.0), alpha) / 255.0);
}

#endif
