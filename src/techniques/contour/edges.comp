// SPDX-License-Identifier: MIT
// One thread compares one pixel with its neighbours to the right and below, and lists the pixel if the
// visible surface breaks (ends, folds or changes its material) between the pixel and a neighbour.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "shaders/frame.glsl.h"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/contour/contour.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define DRAW_TEXELS_BINDING 1
#include "shaders/draw_texels.glsl"

layout(binding = 2) uniform usampler2D draw_image;
layout(binding = 3) uniform sampler2D depth_image;
layout(binding = 4) uniform usampler2D normal_image;
layout(binding = 5) uniform usampler2D screen_image;

layout(scalar, binding = 6) buffer Count
{
    uint edge_count;
};

layout(scalar, binding = 7) writeonly buffer Edges
{
    EdgePixel edges[];
};

layout(binding = 8, r32ui) writeonly uniform uimage2D out_nearest;

layout(push_constant, scalar) uniform Constants
{
    EdgeConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_screen = (variant & edges_has_screen) != 0u;
const bool only_cut = (variant & edges_only_cut) != 0u;
const bool has_clumps = (variant & edges_has_clumps) != 0u;

ivec2 on_page(ivec2 pixel)
{
    return clamp(pixel, ivec2(0), ivec2(frame.size_px) - 1);
}

vec3 normal_at(ivec2 pixel)
{
    return unpack_normal(texelFetch(normal_image, on_page(pixel), 0).y);
}

float depth_at(ivec2 pixel)
{
    return texelFetch(depth_image, on_page(pixel), 0).x;
}

struct Seen {
    uint word;
    float depth;
    vec3 normal;
};

Seen seen_at(ivec2 pixel)
{
    return Seen(texelFetch(draw_image, on_page(pixel), 0).x, depth_at(pixel), normal_at(pixel));
}

// The smallest step in reversed depth (1 at the near plane, 0 at infinity) that counts as a break of the
// surface. In perspective, the step is a share of the depth; in parallel projection, the step is constant.
float least_step(float depth)
{
    vec3 fall = vec3(frame.clip_from_anchor[0].z, frame.clip_from_anchor[1].z, frame.clip_from_anchor[2].z);
    return constants.depth_step * (frame.is_orthographic != 0u ? size_of(fall) : depth);
}

// Full width in pixels of the line between two neighbouring pixels that both show a surface; 0 for no line.
// On a plane, reversed depth is linear in page coordinates. So the surface breaks where the step in depth
// differs from what the slopes on both sides predict.
float line_within_scene(Seen a, Seen b, ivec2 before, ivec2 after)
{
    bool same_draw = ((a.word ^ b.word) & DRAW_NUMBER_MASK) == 0u;
    DrawPart draw_a = draw_at(draw_of(a.word));
    DrawPart draw_b = draw_at(draw_of(b.word));
    float step = b.depth - a.depth;
    float surprise = min(abs(step - (a.depth - depth_at(before))), abs(step - (depth_at(after) - b.depth)));
    float bend = dot(a.normal, b.normal);
    // A fold is sharp if the surface bends more at the fold than on both sides of the fold together.
    float around = 2.0 - dot(normal_at(before), a.normal) - dot(b.normal, normal_at(after));
    bool is_crease = bend < constants.crease_cosine && around < 0.5 * (1.0 - bend);
    if (!same_draw && draw_a.object != draw_b.object) {
        return constants.outline_px;
    }
    if (surprise > least_step(max(a.depth, b.depth))) {
        return 0.9 * constants.outline_px;
    }
    if (!same_draw && draw_a.material != draw_b.material) {
        return constants.boundary_px;
    }
    return is_crease ? constants.crease_px : 0.0;
}

// Whether the surface gets lines between pixels although other surfaces have chains.
bool is_cut(uint word)
{
    uint flags = sees_draw(word) ? draw_links_at(draw_of(word)).flags : 0u;
    return (flags & draw_is_cut) != 0u && !(has_clumps && (flags & draw_is_foliage) != 0u);
}

float line_width(Seen a, Seen b, ivec2 before, ivec2 after)
{
    if ((is_paper(a.word) && is_paper(b.word)) || (only_cut && !is_cut(a.word) && !is_cut(b.word))) {
        return 0.0;
    }
    return sees_draw(a.word) && sees_draw(b.word) ? line_within_scene(a, b, before, after)
                                                  : constants.outline_px;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = ivec2(frame.size_px) - 1;
    if (any(greaterThan(pixel, last))) {
        return;
    }
    const ivec2 right = ivec2(1, 0);
    const ivec2 down = ivec2(0, 1);
    Seen here = seen_at(pixel);
    float width_right =
        pixel.x < last.x ? line_width(here, seen_at(pixel + right), pixel - right, pixel + 2 * right) : 0.0;
    float width_down =
        pixel.y < last.y ? line_width(here, seen_at(pixel + down), pixel - down, pixel + 2 * down) : 0.0;
    if (has_screen) {
        uint screen = texelFetch(screen_image, pixel, 0).x;
        bool ends_right = pixel.x < last.x && screen != texelFetch(screen_image, pixel + right, 0).x;
        bool ends_below = pixel.y < last.y && screen != texelFetch(screen_image, pixel + down, 0).x;
        width_right = max(width_right, ends_right ? constants.boundary_px : 0.0);
        width_down = max(width_down, ends_below ? constants.boundary_px : 0.0);
    }
    uint place = uint(pixel.y) << 16 | uint(pixel.x);
    bool is_edge = width_right > 0.0 || width_down > 0.0;
    if (is_edge) {
        uint slot = atomicAdd(edge_count, 1u);
        if (slot < constants.capacity) {
            edges[slot] = EdgePixel(place, packHalf2x16(vec2(width_right, width_down)));
        }
    }
    imageStore(out_nearest, pixel, uvec4(is_edge ? place : no_seed));
}
