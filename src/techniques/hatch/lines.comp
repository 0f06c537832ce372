// SPDX-License-Identifier: MIT
// One thread draws the strokes at one pixel, so that their mean ink is the target darkness. Only tiles that
// are not blank are processed.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "shaders/lines.glsl"
#include "shaders/unit.glsl"
#include "shaders/stroke_field.glsl"
#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D darkness_image;
layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform usampler2D normal_image;
layout(binding = 3) uniform sampler2D coordinate_image;
layout(binding = 4) uniform usampler2D footprint_image;
// For each pixel: the pixel whose strokes extend into the first pixel, see overrun.comp.
layout(binding = 5) uniform usampler2D source_image;
// Packed direction towards the strongest local light; 0 for none.
layout(binding = 6) uniform usampler2D strongest_image;

// List of tiles that are not blank, in the format of darkness.comp, two words per texel.
layout(binding = 7) uniform usamplerBuffer dark_tile_texels;

layout(binding = 8, r16f) uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    LineConstants constants;
};

#include "techniques/hatch/line_families.glsl"
#include "techniques/hatch/loose_ends.glsl"

const bool has_ink = (variant & lines_has_ink) != 0u;

float strokes(vec3 p, Footprint f, vec3 normal, uint kind, float dark)
{
    HatchLineStyle style = line_style();
    Families families = Families(0u, false, dark);
    float white = 1.0;
    do {
        uint family;
        float family_dark = next_family(families, normal, kind, family);
        LineField field = family_field(p, f, kind, family);
        white *= 1.0 - line_ink(field, style, family_dark, family_seed(family));
    } while (subgroupAny(is_any_left(families)));
    return 1.0 - white;
}

// Ink of the strokes at a pixel if their ends are loose: each family has its own darkness.
float loose_strokes(ivec2 source, float share, vec3 p, Footprint f, vec3 normal, uint word)
{
    HatchLineStyle style = line_style();
    uint kind = strokes_of(word);
    float white = 1.0;
    for (uint family = 0u; family < 2u * constants.layers; ++family) {
        float dark = share * family_darkness(source, p, f, normal, word, family);
        white *= 1.0 - line_ink(family_field(p, f, kind, family), style, dark, family_seed(family));
    }
    return 1.0 - white;
}

#define OVERRUN_PX constants.overrun_px
#include "techniques/hatch/overrun_source.glsl"

void main()
{
    uint tile = has_all_tiles ? gl_WorkGroupID.y << 16 | gl_WorkGroupID.x
                              : texelFetch(dark_tile_texels, 2 + int(gl_WorkGroupID.x)).x;
    ivec2 pixel = 8 * ivec2(tile & 0xffffu, tile >> 16) + ivec2(gl_LocalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float share;
    ivec2 source = source_of(pixel, share);
    vec2 beyond = vec2(pixel - source);
    float dark = texelFetch(darkness_image, source, 0).x * share;
    uint word = texelFetch(draw_image, source, 0).x;
    Footprint f = unpack_footprint(texelFetch(footprint_image, source, 0));
    vec3 p = texelFetch(coordinate_image, source, 0).xyz + f.dx * beyond.x + f.dy * beyond.y;
    vec3 normal = unpack_normal(texelFetch(normal_image, source, 0).y);
    uint strongest = has_local_light ? texelFetch(strongest_image, source, 0).x : 0u;
    towards_light = towards_light_of(strongest);
    float ink = 0.0;
    if (!has_loose_ends) {
        ink = strokes(p, f, normal, strokes_of(word), dark);
    } else if (sees_draw(word)) {
        ink = loose_strokes(source, share, p, f, normal, word);
    }
    float solid =
        source == pixel ? smoothstep(constants.black_above, constants.black_above + 0.02, dark) : 0.0;
    ink = marks_solid && solid >= 1.0 ? solid_ink : max(ink, solid);
    if (has_ink) {
        ink = max(ink, imageLoad(out_ink, pixel).x);
    }
    imageStore(out_ink, pixel, vec4(ink));
}
