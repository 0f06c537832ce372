// SPDX-License-Identifier: MIT
// One thread per pixel follows the view ray through a clear body, bent by Snell's law where it enters and
// where it leaves at the body's next back face, to the background. The result is the page position at which
// the background shows what is seen through the body.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/loops.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/unit.glsl"
#include "shaders/visibility.glsl"
#include "techniques/subsurface/refract.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform usampler2D normal_image;

#define PARAMETERS_BINDING 3
#define HAS_VARIANTS ((variant & subsurface_has_variants) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/parameters.glsl"

#define MESH_TEXELS_BINDING 5
#include "shaders/mesh_texels.glsl"

layout(binding = 7) uniform usamplerBuffer background;
layout(binding = 8) uniform usamplerBuffer inside_0; // nearest surfaces of clear bodies
layout(binding = 9) uniform usamplerBuffer inside_1; // next surfaces of clear bodies

// Page position in the rendered area, in pixels. Third: 1 where lines behind a clear body are drawn, else 0.
// Fourth: 1 where the view ray is bent, else 0.
layout(binding = 10, rgba32f) writeonly uniform image2D out_seen;

layout(push_constant) uniform Constants
{
    float most_px; // largest distance on the page between a body's pixel and what is seen through it
}

constants;

const float touch = 1e-4;    // share of a depth by which surfaces that touch may differ
const int exit_rounds = 6;   // rounds of the search for the exit of a body
const int march_steps = 128; // steps over the page to the background
const int refine_rounds = 3; // rounds that move the found place onto the plane of the background's triangle

vec4 clip_of(vec3 point)
{
    return frame.clip_from_anchor * vec4(point, 1.0);
}

// Position in the rendered area, in pixels, and reversed depth.
vec3 on_page(vec4 clip)
{
    vec2 ndc = clip.xy / clip.w;
    return vec3(0.5 * (ndc + 1.0) * vec2(frame.page_px) - vec2(frame.tile_from_px), clip.z / clip.w);
}

int index_at(vec2 place_px)
{
    ivec2 pixel = clamp(ivec2(floor(place_px)), ivec2(0), ivec2(frame.size_px) - 1);
    return pixel.y * int(frame.size_px.x) + pixel.x;
}

struct Triangle {
    vec3 a;
    vec3 b;
    vec3 c;
    vec3 flat_normal; // not of unit length
    uvec3 corners;
};

Triangle triangle_of(uint number)
{
    uvec4 corners = triangle_at(number);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    float turn = (corners.w & triangle_mirrored) != 0u ? -1.0 : 1.0;
    return Triangle(a, b, c, turn * cross(b - a, c - a), corners.xyz);
}

// Distance along a ray to the plane of a triangle; negative if the ray never meets the plane.
float distance_to_plane(Triangle t, vec3 from, vec3 along)
{
    float across = dot(t.flat_normal, along);
    return abs(across) > 1e-20 ? dot(t.flat_normal, t.a - from) / across : -1.0;
}

// The smooth normal of a triangle at a point of its plane. The page shows triangles at pixel centres, so the
// point may lie a little beside the triangle; the normal then goes on beyond the triangle's edge.
vec3 normal_at(Triangle t, vec3 point)
{
    float whole = dot(t.flat_normal, t.flat_normal);
    vec3 face = cross(t.b - t.a, t.c - t.a);
    vec3 weight = vec3(dot(face, cross(t.c - t.b, point - t.b)), dot(face, cross(t.a - t.c, point - t.c)),
                       dot(face, cross(t.b - t.a, point - t.a))) /
                  whole;
    weight = clamp(weight, -1.0, 2.0);
    return unit(weight.x * unpack_normal(posed_vertex_at(t.corners.x).normal) +
                weight.y * unpack_normal(posed_vertex_at(t.corners.y).normal) +
                weight.z * unpack_normal(posed_vertex_at(t.corners.z).normal));
}

// Where a ray leaves a body, and the outward normal there.
struct Exit {
    float away_m;
    vec3 normal;
};

// Depth of the back face at a pixel, and its triangle; depth 0 if the next surface is no back face.
float back_depth_at(int index, out Triangle back)
{
    uvec2 seen = texelFetch(inside_1, index).xy;
    back = triangle_of(sees_triangle(seen) ? seen_triangle(seen) : 0u);
    bool is_back = sees_triangle(seen) && dot(back.flat_normal, towards_eye(frame, back.a)) < 0.0;
    return is_back ? seen_depth(seen) : 0.0;
}

// Searches the point at which a ray leaves a body. The first guess is the thickness along the view ray. Each
// round intersects the ray with the plane of the back face at the page position of the previous guess. A
// guess beyond the body's outline goes half of the way back. Without a back face the body is a sheet, whose
// far side is parallel to its front.
Exit find_exit(vec3 from, vec3 along, vec3 front_normal, float sheet_m, int index, vec2 middle_px)
{
    Exit left = Exit(sheet_m / max(-dot(along, front_normal), 0.05), -front_normal);
    Triangle back;
    float depth = back_depth_at(index, back);
    if (depth <= 0.0) {
        return left;
    }
    float inside_m = distance(from, anchor_at(frame, middle_px, depth));
    float away_m = inside_m;
    for (int i = 0; i < loop_rounds(exit_rounds, index); ++i) {
        depth = back_depth_at(index_at(on_page(clip_of(from + away_m * along)).xy), back);
        float found_m = depth > 0.0 ? distance_to_plane(back, from, along) : -1.0;
        if (found_m > 0.0) {
            vec3 normal = normal_at(back, from + found_m * along);
            left = Exit(found_m, dot(normal, along) < 0.0 ? -normal : normal);
            inside_m = away_m;
        }
        away_m = found_m > 0.0 ? found_m : 0.5 * (away_m + inside_m);
    }
    return left;
}

// Whether a ray that is behind the triangle `seen` at the page position `at` went behind it without meeting
// it: since the position `last`, the ray has not crossed the triangle's plane. One step is left to surfaces
// that are not flat.
bool passes_behind(uint seen, vec3 from, vec3 along, vec3 last, vec3 at)
{
    float crossed_m = distance_to_plane(triangle_of(seen), from, along);
    float last_m = dot(anchor_at(frame, last.xy, max(last.z, 1e-9)) - from, along);
    float at_m = dot(anchor_at(frame, at.xy, max(at.z, 1e-9)) - from, along);
    return crossed_m < last_m - (at_m - last_m);
}

// The place on the page where a ray meets the background, and else where the ray leaves the page or the
// allowed distance. Third: 1, or 0 if the ray left the page or the allowed distance.
vec3 find_background(vec3 from, vec3 along, vec2 middle_px)
{
    vec4 clip_from = clip_of(from);
    vec4 clip_along = frame.clip_from_anchor * vec4(along, 0.0);
    vec3 start = on_page(clip_from);
    vec4 clip_end = ray_end(clip_from, clip_along);
    vec2 low_px = max(-vec2(frame.tile_from_px), vec2(0.0));
    vec2 high_px = min(vec2(frame.page_px) - vec2(frame.tile_from_px), vec2(frame.size_px));
    start.xy = clamp(start.xy, low_px, high_px);
    vec3 end = start;
    if (clip_end.w > 1e-4 * max(abs(clip_end.x), abs(clip_end.y))) {
        end = vec3(on_page(clip_end).xy, 0.0);
    } else {
        // The ray runs along the page or back towards the eye, and leaves the page on the way.
        vec2 way = (clip_along.xy * clip_from.w - clip_from.xy * clip_along.w) * vec2(frame.page_px);
        end.xy += 2.0 * constants.most_px * way * inversesqrt(max(dot(way, way), 1e-30));
    }
    float share = share_within(start.xy, end.xy, middle_px, constants.most_px, low_px, high_px);
    end = mix(start, end, share);
    // The ray is before the background as long as the background's depth is smaller. What is nearer than the
    // ray's start stands before the body, and does not count.
    float before = 0.0;
    float crossed = 1.0;
    bool is_hit = false;
    vec3 last = start;
    for (int i = 0; i <= march_steps && !is_hit; ++i) {
        vec3 at = mix(start, end, float(i) / float(march_steps));
        uvec2 seen = texelFetch(background, index_at(at.xy)).xy;
        bool counts = seen_depth(seen) <= (1.0 + touch) * start.z;
        float ahead = counts ? seen_depth(seen) - at.z : -1.0;
        // A ray that starts on a surface meets the surface there.
        bool touches = i == 0 && counts && ahead > -touch * start.z;
        is_hit = touches ||
                 (ahead > 0.0 && (i == 0 || !passes_behind(seen_triangle(seen), from, along, last, at)));
        if (is_hit) {
            float between = before < 0.0 && before > -0.99 ? before / (before - ahead) : 1.0;
            crossed = max(float(i) - 1.0 + between, 0.0) / float(march_steps);
        }
        before = ahead;
        last = at;
    }
    vec2 place_px = mix(start, end, crossed).xy;
    for (int i = 0; is_hit && crossed > 0.0 && i < refine_rounds; ++i) {
        uvec2 seen = texelFetch(background, index_at(place_px)).xy;
        if (sees_triangle(seen)) {
            float away_m = distance_to_plane(triangle_of(seen_triangle(seen)), from, along);
            vec4 clip = clip_of(from + away_m * along);
            vec2 exact_px = away_m >= 0.0 && clip.w > 0.0 ? on_page(clip).xy : place_px;
            // At an edge of the background, the plane of the triangle leads elsewhere.
            vec2 off_px = exact_px - place_px;
            float step_px = size_of(end.xy - start.xy) / float(march_steps);
            place_px = dot(off_px, off_px) <= step_px * step_px + 4.0 ? exact_px : place_px;
        }
    }
    // The exit of a large body may already lie farther away than allowed.
    vec2 shift_px = place_px - middle_px;
    shift_px *= min(1.0, constants.most_px * inversesqrt(max(dot(shift_px, shift_px), 1e-12)));
    return vec3(clamp(middle_px + shift_px, low_px, high_px), is_hit || share >= 1.0 ? 1.0 : 0.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 middle_px = vec2(pixel) + 0.5;
    uint word = texelFetch(draw_image, pixel, 0).x;
    uint style_variant = style_variant_of(word);
    float share = takes_light_in(word) ? behind_of(style_variant).x : 0.0;
    float shows_lines = share >= least_line_share ? 1.0 : 0.0;
    float ior = share > 0.0 ? ior_of(style_variant) : 1.0;
    int index = pixel.y * int(frame.size_px.x) + pixel.x;
    uvec2 front = texelFetch(inside_0, index).xy;
    if (ior <= 1.0 || !sees_triangle(front)) {
        imageStore(out_seen, pixel, vec4(middle_px, shows_lines, 0.0));
        return;
    }
    vec3 from = anchor_at(frame, middle_px, seen_depth(front));
    vec3 view = -towards_eye(frame, from);
    vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).x);
    normal = dot(normal, view) > 0.0 ? -normal : normal;
    vec3 inside = refract(view, normal, 1.0 / ior);
    Exit left = find_exit(from, inside, normal, scatter_of(style_variant).a, index, middle_px);
    vec3 exit = from + left.away_m * inside;
    vec3 exit_page = on_page(clip_of(exit));
    float solid = seen_depth(texelFetch(background, index_at(exit_page.xy)).xy);
    // Something solid inside the body ends the ray before its exit.
    bool is_inside = solid > (1.0 + touch) * exit_page.z && solid < seen_depth(front);
    vec3 outside = refract(inside, -left.normal, ior);
    if (dot(outside, outside) < 0.5) {
        // Total reflection: the ray goes on along the surface.
        outside = unit(inside - left.normal * dot(inside, left.normal) + 1e-6 * left.normal);
    }
    vec3 place = find_background(is_inside ? from : exit, is_inside ? inside : outside, middle_px);
    imageStore(out_seen, pixel, vec4(place.xy, shows_lines * place.z, 1.0));
}
