// SPDX-License-Identifier: MIT
// One thread per pixel computes two values from a surface with a second texture: the colour in the shade, and
// the share of the lit colour, by the step of the surface's material.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/shade.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/surface/shade.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define VISIBILITY_BINDING 1
#include "shaders/visibility_texels.glsl"

#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"

#define DRAW_TEXELS_BINDING 4
#include "shaders/draw_texels.glsl"

#define REST_TEXELS_BINDING 5
#include "shaders/rest_texels.glsl"

#define SHADE_TEXELS_BINDING 6
#include "techniques/surface/shade_texels.glsl"

layout(binding = 7) uniform sampler2DArray texture_class_0;
layout(binding = 8) uniform sampler2DArray texture_class_1;
layout(binding = 9) uniform sampler2DArray texture_class_2;
layout(binding = 10) uniform sampler2DArray texture_class_3;
layout(binding = 11) uniform sampler2DArray texture_class_4;
layout(binding = 12) uniform sampler2DArray pictures; // pictures that the style names
layout(binding = 13) uniform usampler2D normal_image; // see Surface::normal
// Visible share of the sun; -1 where the sun does not shine, -2 where its share is not known.
layout(binding = 14) uniform sampler2D sun_image;
// Linear colour in the shade in rgb; alpha as in shaders/shade.glsl.h.
layout(binding = 15, rgba16f) writeonly uniform image2D out_shade;

#define TILE_LIST_BINDING 16
#include "shaders/tile_list.glsl"

layout(push_constant, scalar) uniform Constants
{
    ShadeConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_pictures = (variant & shade_has_pictures) != 0u;
const bool has_tiles = (variant & shade_has_tiles) != 0u;
const bool has_steps = (variant & shade_has_steps) != 0u;
#define TEXTURE_CLASSES variant

#include "shaders/texture.glsl"

UvFootprint uv_at(uvec3 rest, uint uv_set, Barycentric b)
{
    RestVertex x = rest_vertex_at(rest.x);
    RestVertex y = rest_vertex_at(rest.y);
    RestVertex z = rest_vertex_at(rest.z);
    mat3x2 uv = uv_set != 0u ? mat3x2(x.uv_1, y.uv_1, z.uv_1) : mat3x2(x.uv_0, y.uv_0, z.uv_0);
    return UvFootprint(uv * b.weight, uv * b.dx, uv * b.dy);
}

vec4 sample_picture(TextureSlot slot, UvFootprint footprint)
{
    UvFootprint f = transform_uv(slot, footprint);
    float texel_uv = max(1.0 / float(textureSize(pictures, 0).x), max(length(f.dx), length(f.dy)));
    return textureGrad(pictures, texture_place(slot, f.uv, texel_uv), f.dx, f.dy);
}

// MToon's step: the cosine of incidence, which a cast shadow lowers towards -1, between the ends of the step.
float lit_share(ShadeRecord record, ivec2 pixel)
{
    vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).x);
    float sun = texelFetch(sun_image, pixel, 0).x;
    float seen_sun = sun < 0.0 ? -1.0 - sun : sun; // counts as whole where it is not known
    float cosine = mix(-1.0, dot(normal, constants.towards_sun), seen_sun);
    return clamp((cosine - record.step_from) / max(record.step_to - record.step_from, 1e-4), 0.0, 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (has_tiles) {
        pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    }
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uvec2 seen = visibility_at(pixel);
    uvec4 corners = sees_triangle(seen) ? triangle_at(seen_triangle(seen)) : uvec4(0u);
    uint draw_index = corners.w & triangle_draw_mask;
    ShadeRecord record = shade_at(draw_index);
    if (!sees_triangle(seen) || (record.flags & shade_is_there) == 0u) {
        imageStore(out_shade, pixel, vec4(vec3(0.0), shade_absent));
        return;
    }
    Barycentric at = barycentric_at(frame.clip_from_anchor * vec4(posed_vertex_at(corners.x).position, 1.0),
                                    frame.clip_from_anchor * vec4(posed_vertex_at(corners.y).position, 1.0),
                                    frame.clip_from_anchor * vec4(posed_vertex_at(corners.z).position, 1.0),
                                    page_place(frame, vec2(pixel) + 0.5), frame.page_px);
    DrawPart draw = draw_at(draw_index);
    uvec3 rest = corners.xyz - draw.first_posed_vertex + draw.first_rest_vertex;
    UvFootprint footprint = uv_at(rest, uv_set_of(record.texture), at);
    vec4 texel = vec4(1.0);
    if ((TEXTURE_CLASSES & texture_class_mask) != 0u) {
        texel = sample_texture(record.texture, footprint);
    }
    if (has_pictures && (record.texture.location & 15u) == shade_picture_class) {
        texel = sample_picture(record.texture, footprint);
    }
    vec3 color = mix(record.mean_color, record.color * linear_from_srgb(texel.rgb), record.detail);
    bool has_step = has_steps && (record.flags & shade_has_step) != 0u;
    imageStore(out_shade, pixel, vec4(color, has_step ? lit_share(record, pixel) : shade_by_wash));
}
