// SPDX-License-Identifier: MIT
// One workgroup converts the inked pixels of one tile (one word per pixel) to pixels of the ink layer.
// Outside of the listed tiles, the layer stays blank.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/scene.glsl.h"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) readonly buffer Inked
{
    uint inked[];
};

#define MATERIAL_TEXELS_BINDING 1
#include "shaders/material_texels.glsl"

#define INK_TILES_BINDING 2
#define INK_TILES_ACCESS readonly
#include "techniques/contour/chains/ink/ink_tiles.glsl"

// The ink layer: square root of the ink's linear colour in rgb, coverage in alpha.
layout(binding = 3, rgba8) uniform image2D ink_image;

#define VARIANT_LINES_BINDING 4
#include "techniques/contour/chains/stroke/variant_lines.glsl"

layout(push_constant, scalar) uniform Constants
{
    InkConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_own_outlines = (variant & ink_layer_has_own_outlines) != 0u;
const bool has_variants = (variant & ink_layer_has_variants) != 0u;

void main()
{
    uint columns = (constants.width + 7u) / 8u;
    uint tile = ink_tiles[gl_WorkGroupID.x].tile;
    uvec2 pixel = 8u * uvec2(tile % columns, tile / columns) + gl_LocalInvocationID.xy;
    if (pixel.x >= constants.width || pixel.y >= constants.height) {
        return;
    }
    uint word = inked[pixel.y * constants.width + pixel.x];
    vec3 color = constants.ink_color;
    uint ink = word & 0xffffu;
    if (has_variants && (ink & ink_of_variant) != 0u) {
        color = ink_color_of(ink);
    } else if (has_own_outlines && ink != 0u) {
        color = outline_color_of(ink - 1u);
    }
    // Where earlier passes already inked lines, the darker ink remains.
    vec4 ink_before = imageLoad(ink_image, ivec2(pixel));
    float coverage = float(word >> 16) / 65535.0;
    imageStore(ink_image, ivec2(pixel), coverage >= ink_before.a ? vec4(sqrt(color), coverage) : ink_before);
}
