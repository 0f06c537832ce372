// SPDX-License-Identifier: MIT
// One thread draws the strokes of a tonal art map at one pixel. For every texel, the map stores the ink of
// every tone, and a threshold: the darkness at which the texel turns to ink. Every mip level is drawn
// separately and is not a filtered image. Near the eye, the finest mip level is repeated at half the size,
// again and again, so that strokes do not get wider.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D darkness_image;
layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D coordinate_image;
layout(binding = 3) uniform usampler2D footprint_image;
layout(binding = 4) uniform sampler2DArray tones;
layout(binding = 5) uniform sampler2DArray thresholds;

layout(scalar, binding = 6) readonly buffer Ramp
{
    float ramp[];
};

// For each pixel: the pixel whose strokes extend into the first pixel, see overrun.comp.
layout(binding = 7) uniform usampler2D source_image;
layout(binding = 8, r16f) uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    MapConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool in_order = (variant & map_tone_mask) == map_in_order;
const bool in_steps = (variant & map_tone_mask) == map_in_steps;
const bool has_overrun = (variant & map_has_overrun) != 0u;
const bool has_ink = (variant & map_has_ink) != 0u;
const bool marks_solid = (variant & map_marks_solid) != 0u;

#define OVERRUN_PX constants.overrun_px
#include "techniques/hatch/overrun_source.glsl"

struct Place {
    vec2 at;   // position in the map, in units of the map's side
    float lod; // level of detail: 0 is the finest mip level; below 0 that level is repeated at smaller size
};

// Position in the tonal art map. The surface in its rest pose is projected along the coordinate axis that the
// surface faces most, so strokes stay attached to the surface.
Place place_on(uint kind, vec3 p, Footprint f)
{
    vec3 facing = abs(cross(f.dx, f.dy));
    bool is_flat = kind == strokes_uv || kind == strokes_form || kind == strokes_page;
    bool along_z = is_flat || (facing.z >= facing.x && facing.z >= facing.y);
    bool along_y = !along_z && facing.y >= facing.x;
    Place place;
    place.at = along_z ? p.xy : along_y ? p.xz : p.zy;
    vec2 dx = along_z ? f.dx.xy : along_y ? f.dx.xz : f.dx.zy;
    vec2 dy = along_z ? f.dy.xy : along_y ? f.dy.xz : f.dy.zy;
    // On a tilted surface, a pixel covers different lengths of the map in two directions. The mip level is
    // chosen by the mean of the two lengths, so that the mean width of strokes is constant.
    float area = abs(dx.x * dy.y - dx.y * dy.x);
    float widest = max(dot(dx, dx), dot(dy, dy));
    float texels = float(constants.map_size_texels) / constants.texels_per_px;
    place.lod = log2(max(sqrt(max(area, 0.04 * widest)), 1e-12) * texels);
    return place;
}

struct Levels {
    vec2 fine;   // position in the finer of two mip levels
    vec2 coarse; // position in the coarser of two mip levels
    int level;   // number of the finer of two mip levels
    float towards_coarse;
    bool repeats;
};

Levels levels_at(Place place)
{
    Levels levels;
    float lod = clamp(place.lod, -24.0, float(constants.level_count - 2u) - 0.001);
    float whole = floor(lod);
    levels.towards_coarse = lod - whole;
    levels.repeats = whole < 0.0;
    levels.level = int(max(whole, 0.0));
    float times = exp2(max(-whole, 0.0));
    levels.fine = place.at * times;
    levels.coarse = levels.repeats ? place.at * 0.5 * times : place.at;
    return levels;
}

float ramp_in(uint row, float x)
{
    float at = clamp(x, 0.0, 1.0) * float(ramp_length - 1u);
    uint first = min(uint(at), ramp_length - 2u);
    uint index = row * ramp_length + first;
    return mix(ramp[index], ramp[index + 1u], at - float(first));
}

// Converts a darkness to the value to look up in the map, by the ramp that hatch.glsl.h describes.
float asked_of(Levels levels, float dark)
{
    uint first = (levels.repeats ? 0u : uint(levels.level) + 1u) * ramp_steps;
    float at = levels.towards_coarse * float(ramp_steps - 1u);
    uint step = min(uint(at), ramp_steps - 2u);
    return mix(ramp_in(first + step, dark), ramp_in(first + step + 1u, dark), at - float(step));
}

// The four texels around a position, and their weights.
struct Four {
    vec4 value;
    vec4 share;
};

Four thresholds_at(vec2 place, int level)
{
    int side = int(constants.map_size_texels) >> level;
    vec2 texel = fract(place) * float(side) - 0.5;
    ivec2 corner = ivec2(floor(texel));
    vec2 part = texel - vec2(corner);
    ivec2 low = corner & (side - 1);
    ivec2 high = (corner + 1) & (side - 1);
    Four four;
    four.value = vec4(texelFetch(thresholds, ivec3(low, 0), level).x,
                      texelFetch(thresholds, ivec3(high.x, low.y, 0), level).x,
                      texelFetch(thresholds, ivec3(low.x, high.y, 0), level).x,
                      texelFetch(thresholds, ivec3(high, 0), level).x);
    four.share = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y,
                      part.x * part.y);
    return four;
}

// In each of two mip levels, compares the darkness with the thresholds of four texels, and blends the
// results. So the edges of strokes are smooth but not grey, and mip levels change without a jump.
float ordered_ink(Levels levels, float dark)
{
    float asked = asked_of(levels, dark);
    Four fine = thresholds_at(levels.fine, levels.level);
    Four coarse = thresholds_at(levels.coarse, levels.repeats ? 0 : levels.level + 1);
    float ink = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 threshold = mix(fine.value, vec4(coarse.value[i]), levels.towards_coarse);
        vec4 inked = clamp((asked - threshold) * constants.contrast + 0.5, 0.0, 1.0);
        ink += coarse.share[i] * dot(fine.share, inked);
    }
    return ink;
}

float tone_ink(Levels levels, float tone)
{
    float last = float(constants.tone_count);
    float layer = clamp(tone - 1.0, 0.0, last - 1.0);
    float fine = textureLod(tones, vec3(levels.fine, layer), float(levels.level)).x;
    float coarse =
        textureLod(tones, vec3(levels.coarse, layer), float(levels.repeats ? 0 : levels.level + 1)).x;
    float ink = mix(fine, coarse, levels.towards_coarse);
    return tone < 0.5 ? 0.0 : tone > last + 0.5 ? 1.0 : ink;
}

float layered_ink(Levels levels, float dark)
{
    float tone = asked_of(levels, dark);
    tone = in_steps ? round(tone) : tone;
    float ink = mix(tone_ink(levels, floor(tone)), tone_ink(levels, floor(tone) + 1.0), fract(tone));
    return clamp((ink - 0.5) * constants.contrast + 0.5, 0.0, 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float share;
    ivec2 source = source_of(pixel, share);
    vec2 beyond = vec2(pixel - source);
    float dark = texelFetch(darkness_image, source, 0).x * share;
    uint kind = strokes_of(texelFetch(draw_image, source, 0).x);
    Footprint f = unpack_footprint(texelFetch(footprint_image, source, 0));
    vec3 p = texelFetch(coordinate_image, source, 0).xyz + f.dx * beyond.x + f.dy * beyond.y;
    Levels levels = levels_at(place_on(kind, p, f));
    float ink = in_order ? ordered_ink(levels, dark) : layered_ink(levels, dark);
    ink = dark > 0.002 ? ink : 0.0;
    float solid =
        source == pixel ? smoothstep(constants.black_above, constants.black_above + 0.02, dark) : 0.0;
    ink = marks_solid && solid >= 1.0 ? solid_ink : max(ink, solid);
    if (has_ink) {
        ink = max(ink, imageLoad(out_ink, pixel).x);
    }
    imageStore(out_ink, pixel, vec4(ink));
}
