// SPDX-License-Identifier: MIT
// One thread per cell of ink: how much ink the drawing gives there, 0 to 1, in spots.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/surface_images.glsl"
#include "techniques/ink/flow/flow.glsl"
#include "techniques/ink/ink.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Ink
{
    InkGlobals globals;
};

layout(binding = 2) uniform sampler2D hatch_image;
layout(binding = 3) uniform sampler2D line_image;
layout(binding = 4) uniform sampler2D light_image;
layout(binding = 5) uniform usampler2D draw_image;
// One word per draw call: whether the draw call gives ink; only with the variant bit ink_has_mask.
layout(binding = 6) uniform usamplerBuffer mask_texels;
layout(binding = 7) uniform usamplerBuffer state_texels; // cells of ink, used by grid.glsl
layout(binding = 8) uniform sampler2D coordinate_image;  // surface coordinates, for ink_spots_on_things
layout(binding = 9) uniform usampler2D footprint_image;  // pixel footprints, for ink_spots_on_things
layout(binding = 10) uniform sampler2D depth_image;      // depths of surfaces, for ink_spots_on_things

layout(binding = 11) uniform samplerBuffer zone_shapes; // fields of zones with the shape of a mesh

layout(scalar, binding = 12) writeonly buffer Source
{
    uint source[]; // ink that the drawing gives, one word per cell
};

layout(push_constant, scalar) uniform Constants
{
    InkSpots life;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_around = (variant & ink_is_around) != 0u;
const bool has_zones = (variant & ink_has_zones) != 0u;
const bool has_mask = (variant & ink_has_mask) != 0u;
const bool is_on_things = (variant & ink_spots_on_things) != 0u;
const bool from_strokes = (variant & ink_from_strokes) != 0u;
const bool from_light = (variant & ink_from_light) != 0u;
const int strip = (variant & ink_in_strips) != 0u ? int(ink_strip) : 1;

#include "techniques/ink/flow/zones.glsl"
#include "techniques/ink/front.glsl"
#include "techniques/ink/grid.glsl"

// Small spots give ink. Each cell of a lattice has one spot, which swells, fades, and is then replaced by a
// new spot.

#include "shaders/hash.glsl"

// A spot of ink at a place. x: the share of the spot's ink that the spot gives, 0 to 1; y: the spot's rank, 0
// to 1. When the area covered by ink nears the style's limit, spots of high rank give no ink.
vec2 no_spot()
{
    return vec2(0.0, 1.0);
}

// The ink spot of a lattice cell. `within` is the place in the cell, 0 to 1. `normal` is the surface's
// normal: a spot above or below the surface is projected onto it.
vec2 spot_of_cell(uint id, vec3 within, vec3 normal)
{
    float lives = life.share + unit_float(id);
    uint own = hash(id ^ hash(life.round + uint(lives)));
    float radius = globals.spot_mm / globals.spacing_mm * (0.5 + 0.5 * unit_float(hash(own ^ 1u)));
    vec3 place = vec3(unit_float(hash(own ^ 2u)), unit_float(hash(own ^ 3u)), unit_float(hash(own ^ 4u)));
    vec3 away = within - mix(vec3(radius), vec3(1.0 - radius), place);
    away -= normal * dot(away, normal);
    float swell = fract(lives);
    float gives = clamp(1.0 - dot(away, away) / (radius * radius), 0.0, 1.0);
    return vec2(gives * min(1.0, 5.0 * min(swell, 1.0 - swell)), unit_float(hash(own ^ 5u)));
}

// The ink spot at a place of the page.
vec2 spot_on_page(vec2 place_mm)
{
    vec2 at = place_mm / globals.spacing_mm;
    ivec2 cell = ivec2(floor(at));
    return spot_of_cell(hash(uint(cell.x), uint(cell.y), globals.seed), vec3(fract(at), 0.0),
                        vec3(0.0, 0.0, 1.0));
}

// The ink spot on an object, at a surface coordinate of hatching strokes with the footprint `footprint` per
// pixel. Spots stay on the object when the object or the camera moves. The spots' size on the page matches
// the style within a factor of 1.4.
vec2 spot_on_thing(vec3 coordinate, Footprint footprint, float px_per_mm, uint thing)
{
    vec3 across = cross(footprint.dx, footprint.dy);
    float area = length(across); // area of a pixel's footprint in surface coordinates
    if (!(area > 0.0)) {
        return no_spot();
    }
    float scale = exp2(round(log2(sqrt(area) * globals.spacing_mm * px_per_mm)));
    vec3 at = coordinate / scale;
    ivec3 cell = ivec3(floor(at));
    uint id = hash(hash(uint(cell.x), uint(cell.y), uint(cell.z)), thing, globals.seed);
    return spot_of_cell(id, fract(at), across / area);
}

vec2 page_place_of_cell(ivec2 cell)
{
    if (!is_around) {
        return page_place_of_grid(vec2(cell) + 0.5);
    }
    vec4 clip = frame.clip_from_anchor * vec4(direction_of_cell(cell), 0.0);
    return clip.w > 0.0 ? (0.5 * clip.xy / clip.w + 0.5) * vec2(globals.page_px) : vec2(-1.0);
}

// Strength of the ink source at a place: dark strokes, bright light, or any object.
float drawn_at(vec2 page_px)
{
    uint word = texelFetch(draw_image, pixel_at(page_px), 0).x;
    vec2 at = page_px / vec2(globals.page_px);
    bool is_seen = sees_draw(word);
    float strength = 0.0;
    if (from_strokes) {
        strength = 1.0 - (1.0 - texture(hatch_image, at).x) * (1.0 - texture(line_image, at).a);
    } else if (from_light) {
        strength = is_seen ? texture(light_image, at).a : 0.0;
    } else {
        strength = is_seen ? 1.0 : 0.0;
    }
    if (has_mask) {
        strength *= is_seen && texelFetch(mask_texels, int(draw_of(word))).x != 0u ? 1.0 : 0.0;
    }
    return clamp((strength - globals.threshold) / (1.0 - globals.threshold), 0.0, 1.0);
}

float given_in_zones(float given, vec2 page_mm)
{
    for (uint i = 0u; i < globals.zone_count; ++i) {
        InkZone zone = globals.zones[i];
        float share = share_of_zone(zone, page_mm);
        given = clamp(max(given * mix(1.0, zone.amount, share), share * zone.gives), 0.0, 1.0);
    }
    return given;
}

float mm_per_px()
{
    return 1.0 / globals.px_per_mm;
}

vec2 spot_seen_at(ivec2 pixel)
{
    uint word = texelFetch(draw_image, pixel, 0).x;
    if (!sees_draw(word)) {
        return no_spot();
    }
    return spot_on_thing(texelFetch(coordinate_image, pixel, 0).xyz,
                         unpack_footprint(texelFetch(footprint_image, pixel, 0)), globals.px_per_mm,
                         draw_of(word));
}

// Position of a cell in the lattice of spots, on the page or on the cube. A cell in a face's gutter uses the
// position on the neighbouring face.
vec2 lattice_place_mm(ivec2 cell)
{
    vec2 grid = is_around ? grid_place_of_direction(direction_of_cell(cell)) : vec2(cell) + 0.5;
    return (grid - globals.margin_cells) * globals.mm_per_cell;
}

// Ink that the drawing gives at a place of the page, before spots modulate the ink.
float given_at(vec2 page_px)
{
    float given = drawn_at(page_px);
    if (has_zones) {
        given = given_in_zones(given, page_px * mm_per_px());
    }
    bool is_within = all(greaterThanEqual(page_px, globals.window_min_px)) &&
                     all(lessThan(page_px, globals.window_max_px));
    return is_within ? given : 0.0;
}

uint packed_source(float given, float rank)
{
    return packUnorm4x8(vec4(given, rank, 0.0, 0.0));
}

int place_of_cell(ivec2 cell)
{
    return cell.y * int(globals.grid_size.x) + cell.x;
}

vec2 spot_at(ivec2 cell, vec2 page_px)
{
    return is_on_things ? spot_seen_at(pixel_at(front_place(page_px, line_reach_px())))
                        : spot_on_page(lattice_place_mm(cell));
}

// Most cells give no ink and need no spot. So on CPUs each thread jumps from one ink-giving cell of the
// thread's strip to the next such cell.
void main()
{
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * ivec2(1, strip);
    if (any(greaterThanEqual(uvec2(first), globals.grid_size))) {
        return;
    }
    int count = min(strip, int(globals.grid_size.y) - first.y);
    float given[ink_strip];
    uint giving = 0u;
    for (int i = 0; i < strip; ++i) {
        ivec2 cell = first + ivec2(0, i);
        given[i] = given_at(page_place_of_cell(cell));
        bool gives = given[i] > 0.0 && i < count;
        giving |= gives ? 1u << i : 0u;
        if (!gives && i < count) {
            source[place_of_cell(cell)] = packed_source(0.0, 1.0);
        }
    }
    do {
        int i = max(findLSB(giving), 0);
        ivec2 cell = first + ivec2(0, i);
        vec2 spot = spot_at(cell, page_place_of_cell(cell));
        if (giving != 0u) {
            source[place_of_cell(cell)] = packed_source(given[i] * spot.x, spot.y);
        }
        giving &= giving - 1u;
    } while (subgroupAny(giving != 0u));
}
