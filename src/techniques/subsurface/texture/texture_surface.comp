// SPDX-License-Identifier: MIT
// One thread per texel of the map places the texel on the posed surface, to be lit.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

#define MAP_TEXELS_BINDING 0
#include "shaders/surface_map.glsl"

#define MAP_CORNERS_BINDING 1
#include "shaders/map_corners.glsl"

#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"

#define DRAW_TEXELS_BINDING 4
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 5
#include "shaders/material_texels.glsl"

// Draw call and flags, see shaders/surface_images.glsl.
layout(binding = 6, r32ui) writeonly uniform uimage2D out_draw;
layout(binding = 7, rg32ui) writeonly uniform uimage2D out_normal; // packed normal, stored twice
// Position in anchor space (relative to a nearby origin) in xyz; size of a texel in w.
layout(binding = 8, rgba32f) writeonly uniform image2D out_point;

layout(push_constant, scalar) uniform Constants
{
    TextureConstants constants;
};

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(texel), uvec2(constants.size)))) {
        return;
    }
    MapPoint at = map_point_at(uint(texel.y) * constants.size + uint(texel.x));
    uvec4 corners = triangle_at(at.triangle);
    PosedVertex a = posed_vertex_at(corners.x);
    PosedVertex b = posed_vertex_at(corners.y);
    PosedVertex c = posed_vertex_at(corners.z);
    vec3 normal = unit(
        mat3(unpack_normal(a.normal), unpack_normal(b.normal), unpack_normal(c.normal)) * at.weight + 1e-12);
    vec2 first = map_corner_at(3u * at.triangle);
    vec2 second = map_corner_at(3u * at.triangle + 1u) - first;
    vec2 third = map_corner_at(3u * at.triangle + 2u) - first;
    float texels = abs(second.x * third.y - second.y * third.x);
    float area_m2 = length(cross(b.position - a.position, c.position - a.position));
    uint draw = corners.w & triangle_draw_mask;
    uint flags = flags_of(draw_at(draw).material);
    uint word = (draw + 1u) | ((flags & material_paper) != 0u ? DRAW_PAPER : 0u) |
                ((flags & material_unlit) != 0u ? DRAW_UNLIT : 0u) |
                ((flags & material_emissive) != 0u ? DRAW_EMISSIVE : 0u);
    imageStore(out_draw, texel, uvec4(at.is_there ? word : 0u));
    imageStore(out_normal, texel, uvec4(pack_normal(normal), pack_normal(normal), 0u, 0u));
    imageStore(
        out_point, texel,
        vec4(mat3(a.position, b.position, c.position) * at.weight, sqrt(area_m2 / max(texels, 1e-12))));
}
