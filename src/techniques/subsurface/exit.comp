// SPDX-License-Identifier: MIT
// One thread per pixel of the half page (every second pixel) finds where the view ray leaves the body that it
// entered. The ray leaves at the next surface behind, if that surface is a back face. Otherwise the body is a
// thin sheet, and the ray leaves at the entry point. The thread lists the tiles whose exits need lighting.
// Bodies that let almost no light through need no lighting.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/unit.glsl"
#include "shaders/visibility.glsl"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform usampler2D normal_image;

// Visibility buffer of the next surfaces behind the visible ones.
layout(binding = 4) uniform usamplerBuffer behind_texels;

#define MESH_TEXELS_BINDING 5
#include "shaders/mesh_texels.glsl"

#define PARAMETERS_BINDING 7
#define HAS_VARIANTS ((variant & subsurface_has_variants) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/parameters.glsl"

layout(binding = 9, r32ui) writeonly uniform uimage2D out_draw;
layout(binding = 10, r32f) writeonly uniform image2D out_depth;
// Normals on the far side of bodies, which point away from the eye.
layout(binding = 11, rg32ui) writeonly uniform uimage2D out_normal;

#define TILE_LIST_BINDING 12
#include "shaders/tile_list_fill.glsl"

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

#include "techniques/subsurface/scatter.glsl"

// Smallest share of transmitted light that counts. Below this share, even white light sixteen times as bright
// changes no pixel.
const float least_through = 1.0 / 4096.0;

// One bit per tile, set if light passes through bodies in the tile; a workgroup has four tiles, one below the
// other.
shared uint shining_tiles;

// Adds to the tile list the tiles of a column whose bits are set in `rows`, at least one; bit 0 is the first
// tile.
void list_rows(uvec2 first, uint rows)
{
    uint number = list_room(uint(bitCount(rows)));
    for (; rows != 0u; rows &= rows - 1u) {
        put_tile(number, first + uvec2(0u, uint(findLSB(rows))));
        ++number;
    }
}

void main()
{
    ivec2 half_pixel = ivec2(gl_GlobalInvocationID.xy);
    bool is_on_page = is_on_half_page(half_pixel);
    half_pixel = min(half_pixel, ivec2(constants.half_px) - 1);
    ivec2 pixel = whole_pixel(half_pixel);
    if (gl_LocalInvocationIndex == 0u) {
        shining_tiles = 0u;
    }
    barrier();
    uint word = texelFetch(draw_image, pixel, 0).x;
    uint style_variant = style_variant_of(word);
    vec4 through = takes_light_in(word) ? light_through(style_variant) : vec4(0.0);
    float own_depth = texelFetch(depth_image, pixel, 0).x;
    float depth = own_depth;
    vec3 normal = -unpack_normal(texelFetch(normal_image, pixel, 0).y);
    uvec2 seen = texelFetch(behind_texels, half_pixel.y * int(constants.half_px.x) + half_pixel.x).xy;
    if (through.a > 0.0 && sees_triangle(seen)) {
        uvec4 corners = triangle_at(seen_triangle(seen));
        vec3 a = posed_vertex_at(corners.x).position;
        vec3 b = posed_vertex_at(corners.y).position;
        vec3 c = posed_vertex_at(corners.z).position;
        vec3 flat_normal = cross(b - a, c - a) * ((corners.w & triangle_mirrored) != 0u ? -1.0 : 1.0);
        vec3 eye = towards_eye(frame, a);
        bool turns_its_back = dot(flat_normal, eye) < 0.0;
        normal = turns_its_back ? unit(flat_normal) : normal;
        depth = turns_its_back ? seen_depth(seen) : depth;
    }
    float inside_m = thickness_m(vec2(pixel) + 0.5, own_depth, depth, scatter_of(style_variant).a);
    vec3 left = through.a * exp(-through.rgb * inside_m);
    bool shines = is_on_page && max(max(left.r, left.g), left.b) > least_through;
    if (shines) {
        atomicOr(shining_tiles, 1u << (gl_LocalInvocationID.y / 8u));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && shining_tiles != 0u) {
        list_rows(gl_WorkGroupID.xy * uvec2(1u, 4u), shining_tiles);
    }
    if (!is_on_page) {
        return;
    }
    uint packed = pack_normal(normal);
    imageStore(out_draw, half_pixel, uvec4(shines ? draw_of(word) + 1u : 0u));
    imageStore(out_depth, half_pixel, vec4(through.a > 0.0 ? depth : 0.0));
    imageStore(out_normal, half_pixel, uvec4(packed, packed, 0u, 0u));
}
