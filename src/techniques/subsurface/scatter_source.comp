// SPDX-License-Identifier: MIT
// One thread per pixel of the half page (every second pixel) collects the light that spreads from the pixel,
// with transmitted light from the far side. The thread also records which blurs are needed, and lists the
// squares of the page that receive light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D light_image;

#define PARAMETERS_BINDING 4
#define HAS_VARIANTS ((variant & subsurface_has_variants) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/parameters.glsl"
const bool shines = (variant & subsurface_shines) != 0u;
const bool spreads = (variant & subsurface_spreads) != 0u;
const bool looks_less = (variant & subsurface_looks_less) != 0u;
const bool in_perspective = (variant & subsurface_in_perspective) != 0u;

// Images of the bodies' far side, on the half page (every second pixel).
layout(binding = 6) uniform usampler2D far_draw_image; // draw call + 1; 0 where no light is transmitted
layout(binding = 7) uniform sampler2D far_depth_image;
layout(binding = 8) uniform sampler2D far_light_image;

// Light in rgb, distance along the view in alpha.
layout(binding = 9, rgba32f) writeonly uniform image2D out_light;
// Scattering distance per colour, in pixels of the page.
layout(binding = 10, rgba16f) writeonly uniform image2D out_spread;
// Sum of the blur levels so far in rgb; distance along the view in alpha.
layout(binding = 11, rgba32f) writeonly uniform image2D out_sum;
// Transmitted light in rgb; in alpha, the kinds of light transport (takes_... constants of scatter.glsl).
layout(binding = 12, rgba16f) writeonly uniform image2D out_through;

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

#define TILE_LIST_BINDING 13
#include "shaders/tile_list_fill.glsl"

#include "techniques/subsurface/scatter.glsl"

const float most_light = 65504.0; // largest number that a half float can hold

shared uint widest_of_group; // largest scattering distance in the workgroup, on the page, as float bits
// One bit for each square of the page in and around the workgroup; set if the square receives light.
shared uint reached_about;
shared uint newly_reached; // number of squares that the workgroup lists
shared uint first_listed;  // index in the list of the workgroup's first square

// A workgroup has four squares, one below the other. With a border of one square there are 3 x 6 squares.
const uint squares_across = 3u;
const uint squares_about = 18u;

// Bits of the squares whose page pixels read the thread's pixel of the half page (every second pixel). Near a
// square's edge, neighbouring squares are included.
uint squares_that_look(uvec2 local)
{
    uvec2 within = local % 8u;
    uint columns = 2u | (within.x == 0u ? 1u : 0u) | (within.x == 7u ? 4u : 0u);
    uint row = squares_across * (local.y / 8u); // row of the square above the thread's square
    uint about = columns << (row + squares_across);
    about |= within.y == 0u ? columns << row : 0u;
    return about | (within.y == 7u ? columns << (row + 2u * squares_across) : 0u);
}

// Position on the page of a square in or around the workgroup.
ivec2 square_about(uint about)
{
    ivec2 own = ivec2(gl_WorkGroupID.xy) * ivec2(1, 4);
    return own + ivec2(about % squares_across, about / squares_across) - 1;
}

// Index of the words behind the tile list: dispatch sizes of the blurs, four words each, then one flag per
// square that is listed.
uint needs_word(uint level)
{
    uvec2 squares = squares_of(frame.size_px);
    return tile_list_first + squares.x * squares.y + 4u * level;
}

uint reached_word(uvec2 square)
{
    return needs_word(most_scatter_levels) + square.y * squares_of(frame.size_px).x + square.x;
}

// Whether the thread's workgroup is the first that reaches a square, so that it must list the square.
bool reaches_first(ivec2 square)
{
    ivec2 squares = ivec2(squares_of(frame.size_px));
    return all(greaterThanEqual(square, ivec2(0))) && all(lessThan(square, squares)) &&
           atomicOr(tile_list[reached_word(uvec2(square))], 1u) == 0u;
}

void main()
{
    bool is_there = is_on_half_page(ivec2(gl_GlobalInvocationID.xy));
    ivec2 half_pixel = min(ivec2(gl_GlobalInvocationID.xy), ivec2(constants.half_px) - 1);
    if (gl_LocalInvocationIndex == 0u) {
        widest_of_group = 0u;
        reached_about = 0u;
        newly_reached = 0u;
    }
    barrier();
    ivec2 pixel = whole_pixel(half_pixel);
    uint word = texelFetch(draw_image, pixel, 0).x;
    uint style_variant = style_variant_of(word);
    vec4 scatter_m = takes_light_in(word) ? scatter_of(style_variant) : vec4(0.0);
    float depth = texelFetch(depth_image, pixel, 0).x;
    float ahead = ahead_at(vec2(pixel) + 0.5, depth, in_perspective);
    vec3 through = vec3(0.0);
    float takes = takes_nothing;
    if (shines) {
        vec4 absorbed = takes_light_in(word) ? light_through(style_variant) : vec4(0.0);
        bool is_lit = texelFetch(far_draw_image, half_pixel, 0).x != 0u;
        float inside_m =
            thickness_m(vec2(pixel) + 0.5, depth, texelFetch(far_depth_image, half_pixel, 0).x, scatter_m.a);
        vec3 left = absorbed.a * exp(-absorbed.rgb * inside_m);
        vec3 far_light = is_lit ? texelFetch(far_light_image, half_pixel, 0).rgb : vec3(0.0);
        through = min(left * far_light, vec3(most_light));
        takes = absorbed.a > 0.0 ? takes_light_through : takes_nothing;
        if (is_there && through != vec3(0.0)) {
            atomicOr(reached_about, squares_that_look(gl_LocalInvocationID.xy));
        }
    }
    vec3 kept = vec3(0.0);
    if (spreads) {
        vec3 spread_px = spread_px_of(scatter_m.rgb, pixel_m_at(ahead));
        float widest = max(max(spread_px.r, spread_px.g), spread_px.b);
        bool scatters = !holds_all(kept_below_px(), widest);
        // The light of neighbouring pixels is averaged, so that the edge of a shadow does not jump between
        // pixels of the half page (every second pixel).
        vec4 sum = vec4(0.0);
        int i = 0;
        int corners = scatters || !looks_less ? 4 : 1;
        do {
            ivec2 looked = min(pixel + ivec2(i & 1, i >> 1), ivec2(frame.size_px) - 1);
            float share = texelFetch(draw_image, looked, 0).x == word ? 1.0 : 0.0;
            sum += share * vec4(texelFetch(light_image, looked, 0).rgb, 1.0);
            ++i;
        } while (i < corners);
        float found = scatters ? ahead : nowhere_m;
        vec3 light = sum.rgb / max(sum.w, 1.0) + through;
        vec3 share = share_up_to(level_from_px(0), spread_px) - share_up_to(kept_below_px(), spread_px);
        imageStore(out_light, half_pixel, vec4(light, found));
        imageStore(out_spread, half_pixel, vec4(spread_px, 0.0));
        kept = share * light;
        takes += scatters ? takes_light_about : takes_nothing;
        atomicMax(widest_of_group, floatBitsToUint(widest));
        if (is_there && scatters) {
            atomicOr(reached_about, squares_that_look(gl_LocalInvocationID.xy));
        }
    }
    imageStore(out_sum, half_pixel, vec4(kept, takes > takes_nothing ? ahead : nowhere_m));
    if (shines) {
        imageStore(out_through, half_pixel, vec4(through, takes));
    }
    barrier();
    // One thread per blur level requests the dispatch of its level, unless another workgroup already did.
    // Atomics on one address are slow, because they are serialized.
    uint item = gl_LocalInvocationIndex;
    uint need = needs_word(item);
    if (item < uint(constants.level) &&
        !holds_all(level_from_px(int(item)), uintBitsToFloat(widest_of_group)) &&
        tile_list[need + 2u] == 0u) {
        uvec2 groups = looks_less ? (constants.half_px + 7u) / 8u : blur_groups(item);
        atomicMax(tile_list[need], groups.x);
        atomicMax(tile_list[need + 1u], groups.y);
        atomicMax(tile_list[need + 2u], 1u);
    }
    ivec2 square = square_about(item);
    bool lists = item < squares_about && (reached_about >> item & 1u) != 0u && reaches_first(square);
    uint number = lists ? atomicAdd(newly_reached, 1u) : 0u;
    barrier();
    if (item == 0u && newly_reached > 0u) {
        first_listed = list_room(newly_reached);
    }
    barrier();
    if (lists) {
        put_tile(first_listed + number, tiles_a_side * uvec2(square));
    }
}
