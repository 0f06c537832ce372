// SPDX-License-Identifier: MIT
// One thread lights one pixel; the 64 threads of a tile first cull the local lights together.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/light_variant.glsl.h"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/light/light.glsl.h"
#include "techniques/light/local_light.glsl"
#include "techniques/shadow/shadow.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Lighting
{
    LightGlobals lighting;
};

layout(binding = 2) uniform usamplerBuffer light_texels;

layout(binding = 3) uniform usampler2D draw_image;
layout(binding = 4) uniform sampler2D depth_image;
layout(binding = 5) uniform usampler2D normal_image;

#define DRAW_TEXELS_BINDING 6
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 7
#include "shaders/material_texels.glsl"

layout(binding = 8) uniform samplerBuffer sun_map;

layout(scalar, binding = 9) uniform Sun
{
    SunShadow sun_shadow;
};

// Surface coordinates of strokes, read only for shadow edges with teeth (short strokes at the shadow's edge).
layout(binding = 10) uniform sampler2D coordinate_image;
layout(binding = 11) uniform usampler2D footprint_image;

layout(scalar, binding = 12) uniform EdgeLooks
{
    EdgeProfile edge_profile;
};

layout(scalar, binding = 13) readonly buffer Lists
{
    uint lists[]; // lists of local lights per large tile, from light_tiles.comp
};

// Irradiance divided by pi in rgb; the luminance of rgb in alpha.
layout(binding = 14, rgba16f) writeonly uniform image2D out_light;
// Direction towards the strongest local light, see LitPixels.
layout(binding = 15, r32ui) writeonly uniform uimage2D out_strongest;

layout(binding = 16) uniform usamplerBuffer local_shadow_texels;
layout(binding = 17) uniform samplerBuffer local_maps;
// Baked irradiance divided by pi; in alpha, the share of ambient light that the lightmap replaces.
layout(binding = 18) uniform sampler2D lightmap_image;
layout(binding = 19, r32f) writeonly uniform image2D out_sun; // visible share of the sun, see LitPixels
// Share of sunlight that terrain, smoke and clouds let through.
layout(binding = 20) uniform sampler2D sun_share_image;
layout(binding = 21) uniform sampler2D occlusion_image; // share of ambient light that occlusion lets through

// Light that occluders reflect to the pixel, as a share of ambient light.
layout(binding = 22) uniform sampler2D bounced_image;
// Positions of points to light; if given, visible surfaces are not lit.
layout(binding = 23) uniform sampler2D points_image;

#define TILE_LIST_BINDING 24
#include "shaders/tile_list.glsl"

layout(push_constant, scalar) uniform Constants
{
    ListTiles list_tiles;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_shadow = (variant & light_has_shadow) != 0u;
const bool has_local_lights = (variant & light_has_local_lights) != 0u;
const bool has_emissive = (variant & light_has_emissive) != 0u;
const bool has_links = (variant & light_has_links) != 0u;
const bool has_lists = (variant & light_has_lists) != 0u;
const bool counts_visits = (variant & light_counts_visits) != 0u;
const bool keeps_strongest = (variant & light_keeps_strongest) != 0u;
const bool looks_at_all = (variant & light_looks_at_all) != 0u;
const bool has_lightmap = (variant & light_has_lightmap) != 0u;
const bool has_stroke_edges = (variant & light_has_stroke_edges) != 0u;
const bool has_wave_edges = (variant & light_has_wave_edges) != 0u;
const bool has_edges = has_stroke_edges || has_wave_edges;
const bool has_soft_sun = (variant & light_has_soft_sun) != 0u;
const bool has_sun_levels = (variant & light_has_sun_levels) != 0u;
const bool has_sun_warp = (variant & light_has_sun_warp) != 0u;
const bool has_soft_lamps = (variant & light_has_soft_lamps) != 0u;
const bool keeps_sun = (variant & light_keeps_sun) != 0u;
const bool has_local_shadows = (variant & light_has_local_shadows) != 0u;
const bool has_sun_share = (variant & light_has_sun_share) != 0u;
const bool occludes_ambient = (variant & light_occludes_ambient) != 0u;
const bool occludes_all = (variant & light_occludes_all) != 0u;
const bool has_bounced = (variant & light_has_bounced) != 0u;
const bool has_points = (variant & light_has_points) != 0u;
const bool has_tiles = (variant & light_has_tiles) != 0u;

const float most_light = 65504.0; // largest number that a half float can hold
const uint lights_per_round = 256u;
const float least_sun_cosine = 0.05; // cosine of incidence below which sun shadows are not recorded

// The strongest light of the current pixel, for `out_strongest`.
float strongest = 0.0;
// Direction towards the strongest light if that light is local; zero if the strongest light is directional.
vec3 towards_strongest = vec3(0.0);

void weigh(vec3 arriving, vec3 towards_local)
{
    float weight = luminance(arriving);
    if (keeps_strongest && weight > strongest) {
        strongest = weight;
        towards_strongest = towards_local;
    }
}

LightRecord light_at(uint light)
{
    uvec4 a = texelFetch(light_texels, int(5u * light));
    uvec4 b = texelFetch(light_texels, int(5u * light + 1u));
    uvec4 c = texelFetch(light_texels, int(5u * light + 2u));
    uvec4 d = texelFetch(light_texels, int(5u * light + 3u));
    uvec4 e = texelFetch(light_texels, int(5u * light + 4u));
    return LightRecord(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w,
                       uintBitsToFloat(c.xyz), uintBitsToFloat(c.w), uintBitsToFloat(d.x),
                       uintBitsToFloat(d.yzw), e.x, e.y, uintBitsToFloat(e.z), e.w);
}

LocalShadow local_shadow_at(uint shadow)
{
    uvec4 a = texelFetch(local_shadow_texels, int(4u * shadow));
    uvec4 b = texelFetch(local_shadow_texels, int(4u * shadow + 1u));
    uvec4 c = texelFetch(local_shadow_texels, int(4u * shadow + 2u));
    uvec4 d = texelFetch(local_shadow_texels, int(4u * shadow + 3u));
    return LocalShadow(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w,
                       uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.x), d.y, uintBitsToFloat(d.z), d.w);
}

shared uint reaching[lights_per_round / 32u];

// Culls local lights per tile. A tile of 8 x 8 pixels is one workgroup of 64 threads.

shared uint tile_nearest; // smallest distance of a visible point along the tile's axis, encoded by ordered()
shared uint tile_farthest;
shared uint tile_slices;

// Maps floats of either sign to integers that compare in the order of the floats.
uint ordered(float x)
{
    uint bits = floatBitsToUint(x);
    return (bits >> 31) != 0u ? ~bits : bits | 0x80000000u;
}

float from_ordered(uint bits)
{
    return uintBitsToFloat((bits >> 31) != 0u ? bits & 0x7fffffffu : ~bits);
}

// The visible part of a tile of pixels, for light culling: a cone about the middle ray, or in parallel
// projection a cylinder. The nearest and the farthest visible point limit the cone or cylinder.
struct Tile {
    vec3 origin;
    vec3 axis;
    float radius_m; // radius of the cone or cylinder at the tile's origin
    float widening; // growth of the cone's radius per metre along the axis
    float nearest_m;
    float farthest_m;
};

// Number of the depth slice in a tile, 0 to 31 (as in a 2.5D depth mask).
uint slice_at(Tile tile, float along_m)
{
    float share = (along_m - tile.nearest_m) / max(tile.farthest_m - tile.nearest_m, 1e-6);
    return uint(clamp(32.0 * share, 0.0, 31.0));
}

// Computes the visible part of a tile. `from_px` is the tile's upper left pixel.
Tile find_tile(uvec2 from_px, bool sees, vec3 point)
{
    if (gl_LocalInvocationIndex == 0u) {
        tile_nearest = 0xffffffffu;
        tile_farthest = 0u;
        tile_slices = 0u;
    }
    barrier();
    vec2 corner = vec2(from_px);
    // The points at the tile's corners are taken at a depth of about the scene's size, so that directions are
    // precise.
    bool is_parallel = frame.is_orthographic != 0u;
    float depth = is_parallel ? 0.5 : min(frame.near_m / frame.scene_radius_m, 0.5);
    vec3 middle = anchor_at(frame, corner + 4.0, depth);
    Tile tile;
    tile.origin = is_parallel ? middle : frame.eye_anchor;
    tile.axis = is_parallel ? frame.view_forward : normalize(middle - frame.eye_anchor);
    float widest = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 to_corner = anchor_at(frame, corner + 8.0 * vec2(i & 1, i >> 1), depth) - tile.origin;
        float along = is_parallel ? 1.0 : dot(to_corner, tile.axis);
        widest = max(widest, length(cross(to_corner, tile.axis)) / along);
    }
    tile.radius_m = is_parallel ? widest : 0.0;
    tile.widening = is_parallel ? 0.0 : widest;
    float along_m = dot(point - tile.origin, tile.axis);
    if (sees) {
        atomicMin(tile_nearest, ordered(along_m));
        atomicMax(tile_farthest, ordered(along_m));
    }
    barrier();
    tile.nearest_m = from_ordered(tile_nearest);
    tile.farthest_m = from_ordered(tile_farthest);
    if (sees) {
        atomicOr(tile_slices, 1u << slice_at(tile, along_m));
    }
    barrier();
    return tile;
}

// Whether the sphere that a local light reaches intersects the tile in a depth slice with visible points.
bool reaches(LightRecord light, Tile tile)
{
    vec4 reach = reach_of(light);
    vec3 from_origin = reach.xyz - tile.origin;
    float along_m = dot(from_origin, tile.axis);
    float aside_m = length(from_origin - along_m * tile.axis);
    float widest_at_m = max(min(along_m + reach.w, tile.farthest_m), 0.0);
    float gap_m = max(aside_m - tile.radius_m - tile.widening * widest_at_m, 0.0);
    float half_m = sqrt(max(reach.w * reach.w - gap_m * gap_m, 0.0));
    uint first = slice_at(tile, along_m - half_m);
    uint last = slice_at(tile, along_m + half_m);
    uint slices = (0xffffffffu >> (31u - last)) & (0xffffffffu << first);
    bool apart = along_m - half_m > tile.farthest_m || along_m + half_m < tile.nearest_m;
    return gap_m < reach.w && !apart && (slices & tile_slices) != 0u;
}

#include "techniques/shadow/shadow_share.glsl"

vec3 local_light(LightRecord light, vec3 point, vec3 normal)
{
    vec3 to_light = light.position - point;
    float distance_2 = max(dot(to_light, to_light), 1e-6);
    vec3 direction = to_light * inversesqrt(distance_2);
    float attenuation = weakened(light, distance_2) * in_cone(light, -direction);
    return light.color * (attenuation * pow(max(dot(normal, direction), 1e-6), lighting.falloff));
}

// Index of a local light, from the light's position in the light list of a part of the page.
uint listed_light(uint first, uint place)
{
    return lighting.directional_count + (has_lists ? lists[first + place] : place);
}

// A surface point that is lit, and the point's light links (the groups of lights that light the point).
struct Receiver {
    vec3 point;
    vec3 normal;
    vec3 smooth_normal;
    uint groups; // bits of the light groups that light the point
    bool takes_shadow;
    Edge edge;
};

// Light that arrives at a point from a local light, with the light's shadow.
vec3 shadowed_light(LightRecord light, Receiver at)
{
    vec3 arriving = local_light(light, at.point, at.normal);
    bool lit = !has_links || (light.groups & at.groups) != 0u;
    if (has_local_shadows && lit && at.takes_shadow && light.shadow != 0u) {
        arriving *= local_share(local_shadow_at(light.shadow - 1u), light.position, at.point,
                                at.smooth_normal, at.edge);
    }
    return lit ? arriving : vec3(0.0);
}

// Skips words of the light mask that have no bit set; `bits` is the remainder of the current word.
void step_over_none(inout uint word, inout uint bits)
{
    while (bits == 0u && word + 1u < lights_per_round / 32u) {
        bits = reaching[++word];
    }
}

// Sum of the local lights that reach a point. CPU implementations of Vulkan execute a loop body one time too
// many: once even for zero rounds, and once after the last round of a longer loop. So each costly part is
// inside a condition at the loop's end.
vec3 local_lights(uvec2 from_px, Tile tile, Receiver at)
{
    uvec2 part = from_px / list_tiles.tile_px;
    uint first = (part.y * list_tiles.columns + part.x) * (lighting.local_count + 1u);
    uint count = has_lists ? lists[first] : lighting.local_count;
    uint thread = gl_LocalInvocationIndex;
    vec3 sum = vec3(0.0);
    vec2 visits = vec2(0.0);
    uint done = 0u;
    do {
        if (thread < lights_per_round / 32u) {
            reaching[thread] = 0u;
        }
        barrier();
        uint looked_at = min(lights_per_round, count - done);
        uint i = thread;
        do {
            if (i < looked_at &&
                (looks_at_all ||
                 (tile_slices != 0u && reaches(light_at(listed_light(first + 1u, done + i)), tile)))) {
                atomicOr(reaching[i >> 5], 1u << (i & 31u));
            }
            i += 64u;
        } while (i < looked_at);
        barrier();
        uint word = 0u;
        uint bits = reaching[0];
        step_over_none(word, bits);
        do {
            if (bits != 0u) {
                uint bit = uint(findLSB(bits));
                LightRecord light = light_at(listed_light(first + 1u, done + word * 32u + bit));
                vec3 arriving = shadowed_light(light, at);
                weigh(arriving, light.position - at.point);
                sum += arriving;
                visits += vec2(1.0, distance(at.point, light.position) < light.range_m ? 1.0 : 0.0);
            }
            bits &= bits - 1u;
            step_over_none(word, bits);
        } while (bits != 0u);
        barrier();
        done += lights_per_round;
    } while (done < count);
    return counts_visits ? vec3(visits, 0.0) : sum;
}

void main()
{
    uvec2 from_px = 8u * gl_WorkGroupID.xy;
    if (has_tiles) {
        from_px = listed_from_px();
    }
    ivec2 pixel = ivec2(from_px + gl_LocalInvocationID.xy);
    bool on_page = all(lessThan(uvec2(pixel), frame.size_px));
    uint word = on_page ? texelFetch(draw_image, pixel, 0).x : 0u;
    float depth = sees_draw(word) ? texelFetch(depth_image, pixel, 0).x : 0.0;
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, max(depth, 1e-9));
    if (has_points) {
        point = texelFetch(points_image, min(pixel, ivec2(frame.size_px) - 1), 0).xyz;
    }
    uvec4 normals = texelFetch(normal_image, min(pixel, ivec2(frame.size_px) - 1), 0);
    vec3 normal = unpack_normal(normals.x);
    vec3 smooth_normal = unpack_normal(normals.y);

    // Bits of the light groups that light the pixel's draw call: all, unless the scene links lights to
    // objects.
    uint groups = 0xffffu;
    bool takes_shadow = true;
    if (has_links && sees_draw(word)) {
        DrawLinks draw = draw_links_at(draw_of(word));
        groups = draw.groups & 0xffffu;
        takes_shadow = (draw.flags & draw_unshadowed) == 0u;
    }

    float open = 1.0;
    if (occludes_ambient || occludes_all) {
        open = texelFetch(occlusion_image, min(pixel, ivec2(frame.size_px) - 1), 0).x;
    }
    vec3 light = mix(lighting.ground_ambient, lighting.sky_ambient, 0.5 + 0.5 * normal.y);
    vec3 bounced = vec3(0.0);
    if (has_bounced) {
        bounced = light * texelFetch(bounced_image, min(pixel, ivec2(frame.size_px) - 1), 0).rgb;
    }
    if (occludes_ambient) {
        light *= open;
    }
    if (has_lightmap) {
        // The lightmap contains the bounced light, so the lightmap replaces the ambient light.
        vec4 known = texelFetch(lightmap_image, min(pixel, ivec2(frame.size_px) - 1), 0);
        light = mix(light, known.rgb, known.a);
    }
    Edge edge;
    if (has_edges) {
        edge = edge_at(pixel, word, max(depth, 1e-9), point, smooth_normal);
    }
    float sun_visible = has_shadow ? sun_share(point, smooth_normal, light_at(0u).direction, edge) : 1.0;
    if (has_sun_share) {
        sun_visible *= texelFetch(sun_share_image, min(pixel, ivec2(frame.size_px) - 1), 0).x;
    }
    sun_visible = takes_shadow ? sun_visible : 1.0;
    // For pixels without a surface, no lights are summed. A loop over a count from a buffer also keeps
    // lavapipe from compiling a shader per count.
    uint directional_count = sees_draw(word) ? lighting.directional_count : 0u;
    uint i = 0u;
    do {
        LightRecord sun = light_at(i);
        bool is_linked = i < directional_count && (!has_links || (sun.groups & groups) != 0u);
        float lambert = dot(smooth_normal, sun.direction) > 0.0 ? max(dot(normal, sun.direction), 0.0) : 0.0;
        float visible = i == 0u ? sun_visible : 1.0;
        if (i == 0u && is_paper(word)) {
            // Blank ground is drawn as paper: the ground has no shading, and the shadow on the ground fades
            // with distance.
            lambert = lambert > 0.0 ? 1.0 : 0.0;
            visible =
                mix(visible, 1.0, clamp(dot(lighting.paling, point) + lighting.paling_at_anchor, 0.0, 1.0));
        }
        vec3 arriving =
            is_linked && lambert > 0.0 ? sun.color * (pow(lambert, lighting.falloff) * visible) : vec3(0.0);
        if (occludes_ambient && sun.is_fill != 0u) {
            arriving *= open;
        }
        weigh(arriving, vec3(0.0));
        light += arriving;
    } while (subgroupAny(++i < directional_count));
    if (has_local_lights) {
        Tile tile = find_tile(from_px, sees_draw(word), point);
        vec3 local =
            local_lights(from_px, tile, Receiver(point, normal, smooth_normal, groups, takes_shadow, edge));
        light = counts_visits ? local : light + local;
    }
    if (!on_page) {
        return;
    }
    if (occludes_all) {
        light *= open;
    }
    light += bounced;
    if (has_emissive && (word & DRAW_EMISSIVE) != 0u) {
        light += emissive_of(draw_at(draw_of(word)).material);
    }
    if (!sees_draw(word) || (word & DRAW_UNLIT) != 0u) {
        light = vec3(counts_visits ? 0.0 : 1.0);
    }
    light = min(light, vec3(most_light));
    imageStore(out_light, pixel, vec4(light, luminance(light)));
    if (keeps_sun) {
        LightRecord sun = light_at(0u);
        bool is_linked = directional_count == 0u || !has_links || (sun.groups & groups) != 0u;
        bool has_edge = directional_count > 0u && is_linked && takes_shadow && (word & DRAW_UNLIT) == 0u &&
                        dot(smooth_normal, sun.direction) > least_sun_cosine;
        // Where the sun grazes the surface, the shadow map cannot tell the surface from what shades it.
        imageStore(out_sun, pixel, vec4(has_edge ? sun_visible : is_linked ? -2.0 : -1.0));
    }
    if (keeps_strongest) {
        bool is_local = dot(towards_strongest, towards_strongest) > 0.0;
        uint packed = is_local ? max(pack_normal(normalize(towards_strongest)), 1u) : 0u;
        imageStore(out_strongest, pixel, uvec4(packed));
    }
}
