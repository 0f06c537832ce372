// SPDX-License-Identifier: MIT
// One thread draws the sprites over one pixel of the layers, farthest first.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/noise.glsl"
#include "techniques/particles/particles.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform samplerBuffer sprite_texels;
layout(binding = 2) uniform usamplerBuffer start_texels;
layout(binding = 3) uniform usamplerBuffer listed_texels;
layout(binding = 4) uniform samplerBuffer sheet_texels;
layout(binding = 5) uniform sampler2D depth_image;
layout(binding = 6) uniform sampler2D sky_image; // colour of the sky, into which haze fades particles
layout(binding = 7, rgba16f) uniform image2D wash_image;
layout(binding = 8, r16f) uniform image2D hatch_image;
layout(binding = 9, rgba8) uniform image2D line_image;

#define TILE_LIST_BINDING 10
#include "shaders/tile_list.glsl"

layout(push_constant, scalar) uniform Constants
{
    ParticleConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool by_groups = (variant & particles_by_groups) != 0u;

// Distance of the visible surface along the view direction; very large for the background.
float seen_at_m(ivec2 pixel)
{
    float depth = texelFetch(depth_image, min(pixel, ivec2(frame.size_px) - 1), 0).x;
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, max(depth, 1e-9));
    return depth > 0.0 ? (frame.clip_from_anchor * vec4(point, 1.0)).w : 1e12;
}

// Brightness of frame `which` of the sprite sheet, at the place `at`, 0 to 1 in both directions.
float sheet_at(vec2 at, int which)
{
    ivec2 cell_px = ivec2(constants.sheet_px / constants.frames);
    ivec2 from = cell_px * ivec2(which % int(constants.frames.x), which / int(constants.frames.x));
    vec2 texel = clamp(at, 0.0, 1.0) * vec2(cell_px - 1);
    ivec2 low = ivec2(texel);
    ivec2 high = min(low + 1, cell_px - 1);
    vec2 f = texel - vec2(low);
    int width = int(constants.sheet_px.x);
    int upper = (from.y + low.y) * width + from.x;
    int lower = (from.y + high.y) * width + from.x;
    return mix(
        mix(texelFetch(sheet_texels, upper + low.x).x, texelFetch(sheet_texels, upper + high.x).x, f.x),
        mix(texelFetch(sheet_texels, lower + low.x).x, texelFetch(sheet_texels, lower + high.x).x, f.x), f.y);
}

// Density of a sprite at an offset from its centre, in radii: a ragged disc, or a frame of the sprite sheet.
float density_at(vec2 uv, float trait, float shown)
{
    float ragged = value_noise(2.6 * uv + 97.0 * trait, 3u) + 0.2 * value_noise(5.6 * uv - 61.0 * trait, 4u);
    float r = length(uv) * (0.8 + 0.4 * ragged);
    float density = max(1.0 - r * r, 0.0);
    density *= density * 1.6;
    if (constants.frames.x > 0u) {
        vec2 at = 0.5 * uv + 0.5;
        int last = int(constants.frames.x * constants.frames.y) - 1;
        int which = clamp(int(shown), 0, last);
        density = mix(sheet_at(at, which), sheet_at(at, min(which + 1, last)), fract(shown));
    }
    return max(abs(uv.x), abs(uv.y)) < 1.0 ? density : 0.0;
}

// Sums over all sprites at a place of the page.
struct Mass {
    float density;
    vec2 beside;  // density of sprites one pixel to the right, and one pixel below
    float soft;   // density, with sprites composited over each other
    float shade;  // shade on the lower side of the nearest sprite, 0 to 1
    float fold;   // ink of the line where a sprite overlaps others
    float away_m; // mean distance of the visible sprites along the view direction
};

struct SpriteOver {
    Sprite sprite;
    vec2 away; // offset of the place from the sprite's centre, in radii
};

SpriteOver sprite_of(vec2 place, vec4 a, vec4 b, vec4 c)
{
    return SpriteOver(Sprite(a.xy, a.z, a.w, b.xy, b.z, b.w, c.x, c.y, c.zw), (place - a.xy) / a.z);
}

SpriteOver sprite_over(vec2 place, int i)
{
    int sprite = 3 * int(texelFetch(listed_texels, i).x);
    return sprite_of(place, texelFetch(sprite_texels, sprite), texelFetch(sprite_texels, sprite + 1),
                     texelFetch(sprite_texels, sprite + 2));
}

// Offset from a sprite's centre in the sprite's rotated axes: along it and across it.
vec2 turned(Sprite sprite, vec2 away)
{
    return vec2(dot(away, sprite.turn) / sprite.stretch, dot(away, vec2(-sprite.turn.y, sprite.turn.x)));
}

// Whether the sprite covers the place or a pixel next to the place.
bool is_near(SpriteOver over)
{
    vec2 uv = abs(turned(over.sprite, over.away));
    return max(uv.x, uv.y) < 1.0 + (constants.outline_px + 2.0) / over.sprite.radius_px;
}

// Index of the next sprite in the list that is near any place of the subgroup (threads that run together);
// `last` if there is none. This small loop skips sprites at low cost on CPUs.
int find_sprite(vec2 place, int i, int last)
{
    bool is_far;
    do {
        bool is_listed = i < last;
        is_far = is_listed && !is_near(sprite_over(place, is_listed ? i : 0));
        is_far = !subgroupAny(is_listed && !is_far) && subgroupAny(is_listed);
        i += is_far ? 1 : 0;
    } while (is_far);
    return i;
}

void add_sprite(inout Mass mass, SpriteOver over, float opacity, float surface_m, bool is_crisp)
{
    // Radius of a sprite's outline, in radii of the sprite; within it, sprites behind are hidden.
    const float edge = 0.6;
    Sprite sprite = over.sprite;
    vec2 away = over.away;
    vec2 uv = turned(sprite, away);
    float before = clamp((surface_m - sprite.away_m) / constants.soft_m, 0.0, 1.0);
    float density = density_at(uv, sprite.trait, sprite.frame) * opacity * before;
    mass.away_m = mass.density > 0.0 ? mix(mass.away_m, sprite.away_m, min(density, 1.0)) : sprite.away_m;
    mass.density += density;
    mass.soft = mass.soft + min(density, 1.0) * (1.0 - mass.soft);
    if (is_crisp) {
        vec2 right = turned(sprite, away + vec2(1.0 / sprite.radius_px, 0.0));
        vec2 below = turned(sprite, away + vec2(0.0, 1.0 / sprite.radius_px));
        mass.beside += vec2(density_at(right, sprite.trait, sprite.frame),
                            density_at(below, sprite.trait, sprite.frame)) *
                       (opacity * before);
    }
    // Frames of a sprite sheet have their own inner shading.
    float solid = constants.frames.x > 0u ? 0.0 : opacity * before;
    float beyond_px = (length(away) - edge) * sprite.radius_px;
    float hides = clamp(0.5 - beyond_px, 0.0, 1.0) * smoothstep(0.1, 0.3, solid);
    float lower = clamp((length(away + vec2(0.24, 0.4)) - 0.68) * sprite.radius_px + 0.5, 0.0, 1.0);
    // The line where a sprite overlaps others is an arc on its upper side, widest in the middle.
    float up = dot(normalize(away + 1e-6), normalize(vec2(sprite.trait - 0.5, -1.0)));
    float width_px =
        constants.outline_px * smoothstep(0.35, 1.0, up) * smoothstep(0.3, 0.8, fract(7.3 * sprite.trait));
    float arc = clamp(width_px + 0.5 - abs(beyond_px), 0.0, min(width_px, 1.0));
    mass.shade = mix(mass.shade, lower, hides);
    mass.fold = max(mass.fold * (1.0 - hides), arc * smoothstep(0.2, 0.5, solid));
}

// Sums over all sprites at a place. If only a tile of the page is drawn, a subgroup may read the sprite lists
// of two tiles. Lanes past the end of their list add nothing.
Mass mass_at(vec2 place, float surface_m, bool is_crisp)
{
    uvec2 tile = min(uvec2(place), frame.page_px - 1u) / particle_tile_px;
    int index = int(tile.y * constants.tiles_across + tile.x);
    int i = int(texelFetch(start_texels, index).x);
    int last = int(texelFetch(start_texels, index + 1).x);
    Mass mass = Mass(0.0, vec2(0.0), 0.0, 0.0, 0.0, 0.0);
    i = find_sprite(place, i, last);
    do {
        bool is_listed = i < last;
        SpriteOver over = sprite_over(place, is_listed ? i : 0);
        add_sprite(mass, over, is_listed ? over.sprite.opacity : 0.0, surface_m, is_crisp);
        i = find_sprite(place, i + 1, last);
    } while (subgroupAny(i < last));
    return mass;
}

// Number of sprites that a workgroup reads together, one per thread, for particles_by_groups.
const int read_at_once = 64;
shared vec4 held[3 * read_at_once];

void read_sprites(int first, int last)
{
    int own = int(gl_LocalInvocationIndex);
    barrier(); // waits until all threads have finished with the previous sprites
    if (first + own < last) {
        int sprite = 3 * int(texelFetch(listed_texels, first + own).x);
        for (int k = 0; k < 3; ++k) {
            held[3 * own + k] = texelFetch(sprite_texels, sprite + k);
        }
    }
    barrier();
}

// Sums over all sprites at a place like mass_at(), for a workgroup whose pixels are all in one tile.
Mass mass_by_groups(vec2 place, float surface_m, bool is_crisp)
{
    uvec2 tile = min(listed_from_px() + frame.tile_from_px, frame.page_px - 1u) / particle_tile_px;
    int index = int(tile.y * constants.tiles_across + tile.x);
    int last = int(texelFetch(start_texels, index + 1).x);
    Mass mass = Mass(0.0, vec2(0.0), 0.0, 0.0, 0.0, 0.0);
    for (int first = int(texelFetch(start_texels, index).x); first < last; first += read_at_once) {
        read_sprites(first, last);
        for (int k = 0; k < min(last - first, read_at_once); ++k) {
            SpriteOver over = sprite_of(place, held[3 * k], held[3 * k + 1], held[3 * k + 2]);
            if (over.sprite.away_m < surface_m && is_near(over)) {
                add_sprite(mass, over, over.sprite.opacity, surface_m, is_crisp);
            }
        }
    }
    return mass;
}

// Distance in pixels from the contour where the sprites' density reaches its threshold, positive inside.
float within_px(Mass mass)
{
    return (mass.density - 0.35) / max(length(mass.beside - mass.density), 1e-4);
}

// Number of times that haze halves the particles' contrast.
float halvings(ivec2 pixel, float away_m)
{
    vec3 way = frame.is_orthographic != 0u ? frame.view_forward
                                           : -towards_eye(frame, anchor_at(frame, vec2(pixel) + 0.5, 1e-5));
    float distance_m = away_m / max(dot(way, frame.view_forward), 1e-3);
    return max(distance_m - constants.haze_start_m, 0.0) * constants.haze_halves_per_m;
}

void main()
{
    ivec2 pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    bool is_crisp = constants.look != particles_wash;
    vec2 place = page_place(frame, vec2(pixel) + 0.5);
    Mass mass = by_groups ? mass_by_groups(place, seen_at_m(pixel), is_crisp)
                          : mass_at(place, seen_at_m(pixel), is_crisp);
    if (mass.density <= 0.0 || !has_listed_tile() || any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float inside_px = within_px(mass);
    float cover = is_crisp ? clamp(inside_px + 0.5, 0.0, 1.0) : mass.soft;
    bool is_ink = constants.look == particles_blots || constants.look == particles_strokes;
    float outline = constants.look == particles_drawn
                        ? max(clamp(constants.outline_px - inside_px + 0.5, 0.0, 1.0), mass.fold) * cover
                        : 0.0;
    float halved = halvings(pixel, mass.away_m);
    float ink = (is_ink ? cover : outline) * exp2(-constants.haze_ink * halved);
    vec4 line = imageLoad(line_image, pixel);
    float hidden = is_ink ? 0.0 : cover;
    if (!is_ink) {
        vec4 wash = imageLoad(wash_image, pixel);
        const vec3 shaded = vec3(0.8, 0.83, 0.84);
        vec3 color = constants.color * mix(vec3(1.0), shaded, is_crisp ? mass.shade : 0.0);
        vec3 sky = texelFetch(sky_image, min(pixel, textureSize(sky_image, 0) - 1), 0).rgb;
        color = mix(sky, color, exp2(-halved));
        imageStore(wash_image, pixel, vec4(mix(wash.rgb, color, cover), max(wash.a, cover)));
        imageStore(hatch_image, pixel, imageLoad(hatch_image, pixel) * (1.0 - hidden));
    }
    float below = line.a * (1.0 - hidden);
    float both = ink + below * (1.0 - ink);
    vec3 color = mix(line.rgb, sqrt(constants.ink), ink / max(both, 1e-6));
    imageStore(line_image, pixel, vec4(color, both));
}
