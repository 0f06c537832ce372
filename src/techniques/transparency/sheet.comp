// SPDX-License-Identifier: MIT
// One thread per pixel blends a transparent surface, painted like solid surfaces, over the picture behind it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/scene.glsl.h"

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

#define MATERIAL_TEXELS_BINDING 6
#include "shaders/material_texels.glsl"

layout(binding = 7) uniform sampler2DArray texture_class_0;
layout(binding = 8) uniform sampler2DArray texture_class_1;
layout(binding = 9) uniform sampler2DArray texture_class_2;
layout(binding = 10) uniform sampler2DArray texture_class_3;
layout(binding = 11) uniform sampler2DArray texture_class_4;

layout(binding = 12) uniform usamplerBuffer sheet; // visibility buffer of the transparent layer

layout(binding = 13) uniform sampler2D painted_image; // the transparent layer's own paint
layout(binding = 14, rgba16f) uniform image2D wash;

layout(constant_id = 0) const uint variant = 31u;
#define TEXTURE_CLASSES (variant & texture_class_mask)

#include "techniques/transparency/transparency_layer.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uvec2 seen = texelFetch(sheet, pixel.y * int(frame.size_px.x) + pixel.x).xy;
    if (!sees_triangle(seen) || seen_depth(seen) <= seen_depth(visibility_at(pixel))) {
        return;
    }
    Layer layer = layer_at(seen, pixel);
    vec4 behind = imageLoad(wash, pixel);
    float cover = layer.draw != 0u ? layer.color.a : 0.0;
    vec3 paint = mix(behind.rgb, texelFetch(painted_image, pixel, 0).rgb, cover);
    imageStore(wash, pixel, vec4(paint, max(behind.a, cover)));
}
