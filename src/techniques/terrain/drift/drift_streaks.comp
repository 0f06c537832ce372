// SPDX-License-Identifier: MIT
// One thread draws one streak of sand that the wind blows off a dune's crest. The streak is a stroke that
// tapers at both ends; its position depends on its age. Where streaks cross, the darker streak remains, so
// the order of threads does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/hash.glsl"
#include "shaders/loops.glsl"
#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

// Height of the ground, in metres above the anchor (a nearby origin).
layout(binding = 1) uniform sampler2D height_image;
layout(binding = 2) uniform sampler2D depth_image;

layout(scalar, binding = 3) buffer Ink
{
    uint ink_at[]; // ink of each pixel, row by row; 255 is full ink
};

layout(push_constant, scalar) uniform Constants
{
    DriftConstants drift;
};

const int search = 6; // number of samples in each direction along the wind, in the search for a crest
const float search_m = 1.5;
// Change of slope across a crest. At the first of the two changes, a gentle swell loses no sand; at the
// second change, a sharp brink loses most sand.
const vec2 crest = vec2(0.3, 0.65);
const float sinking_m_s2 = 0.5; // speed at which grains sink in moving air
const float longest_px = 160.0;

float ground_m(vec2 place_m)
{
    vec2 size = vec2(textureSize(height_image, 0));
    return textureLod(height_image, ((place_m - drift.corner_m) / drift.cell_m + 0.5) / size, 0.0).x;
}

// Finds a dune's crest along the wind near a place. Returns the distance to the crest, its height, and how
// pronounced it is, from 0 to 1.
vec3 crest_near(vec2 place_m)
{
    float height[2 * search + 1];
    for (int i = -search; i <= search; ++i) {
        height[i + search] = ground_m(place_m + float(i) * search_m * drift.wind);
    }
    vec3 found = vec3(0.0);
    for (int i = 2; i <= 2 * search - 2; ++i) {
        float bend = (2.0 * height[i] - height[i - 2] - height[i + 2]) / (2.0 * search_m);
        if (height[i + 2] < height[i] && bend > found.z) {
            found = vec3(float(i - search) * search_m, height[i], bend);
        }
    }
    return vec3(found.xy, smoothstep(crest.x, crest.y, found.z));
}

vec3 flown(vec3 from, float age_s, float rises, float swerves)
{
    float away_m = drift.speed_m_per_s * age_s;
    vec2 across = vec2(-drift.wind.y, drift.wind.x);
    vec2 place = from.xz + away_m * drift.wind + swerves * away_m * across;
    float up = rises * drift.lift_m * (1.0 - exp(-2.5 * age_s)) - 0.5 * sinking_m_s2 * age_s * age_s;
    return vec3(place.x, from.y + up, place.y);
}

// Position of a point on the page, in pixels, and its reversed depth. The depth is negative if the point is
// behind the eye.
vec3 on_page(vec3 place)
{
    vec4 clip = frame.clip_from_anchor * vec4(place, 1.0);
    if (clip.w <= 1e-4) {
        return vec3(0.0, 0.0, -1.0);
    }
    return vec3((0.5 * clip.xy / clip.w + 0.5) * vec2(frame.page_px) - vec2(frame.tile_from_px),
                clip.z / clip.w);
}

void ink_pixel(ivec2 pixel, vec3 tail, vec3 head, float strength)
{
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(frame.size_px)))) {
        return;
    }
    vec2 along = head.xy - tail.xy;
    vec2 from_tail = vec2(pixel) + 0.5 - tail.xy;
    float share = clamp(dot(from_tail, along) / max(dot(along, along), 1e-6), 0.0, 1.0);
    float half_width = drift.half_width_px * sqrt(4.0 * share * (1.0 - share));
    // A stroke thinner than a pixel is drawn one pixel wide with less ink.
    float edge = max(half_width, 0.5) + 0.5 - length(from_tail - share * along);
    float ink = strength * clamp(edge, 0.0, 1.0) * min(2.0 * half_width, 1.0);
    float depth = mix(tail.z, head.z, share);
    if (ink > 0.004 && depth > 0.99 * texelFetch(depth_image, pixel, 0).x) {
        atomicMax(ink_at[uint(pixel.y) * frame.size_px.x + uint(pixel.x)], uint(255.0 * min(ink, 1.0) + 0.5));
    }
}

void main()
{
    uint number = item_index();
    uint cell = number / drift_streaks_a_cell;
    if (cell >= drift.side * drift.side) {
        return;
    }
    uvec2 at = uvec2(cell % drift.side, cell / drift.side);
    uint key = hash(drift.first_x + at.x, drift.first_y + at.y, number % drift_streaks_a_cell);
    float born = unit_float(key);
    float passed = drift.life_share + born;
    key = hash(key, drift.life + uint(passed), 1u);
    float age_s = fract(passed) * drift_life_s;
    vec2 place =
        drift.corner_m +
        drift.cell_m * (vec2(at) + vec2(unit_float(hash(key, 2u, 0u)), unit_float(hash(key, 3u, 0u))) - 0.5);
    vec3 crest_there = crest_near(place);
    place += crest_there.x * drift.wind;
    float height = crest_there.y;
    if (crest_there.z * drift.amount <= unit_float(hash(key, 4u, 0u))) {
        return;
    }
    float rises = unit_float(hash(key, 5u, 0u));
    float swerves = 0.14 * (unit_float(hash(key, 6u, 0u)) - 0.5);
    float streak_s = drift.length_m / drift.speed_m_per_s * (0.5 + unit_float(hash(key, 7u, 0u)));
    vec3 from = vec3(place.x, height + 0.05, place.y);
    vec3 tail = on_page(flown(from, age_s, rises, swerves));
    vec3 head = on_page(flown(from, age_s + streak_s, rises, swerves));
    float away_m = distance(from, frame.eye_anchor);
    float strength = smoothstep(0.0, 0.15 * drift_life_s, age_s) *
                     (1.0 - smoothstep(0.5 * drift_life_s, drift_life_s, age_s)) *
                     (1.0 - smoothstep(0.6 * drift.reach_m, drift.reach_m, away_m));
    vec2 along = head.xy - tail.xy;
    vec2 span = abs(along);
    if (tail.z < 0.0 || head.z < 0.0 || strength <= 0.0 || max(span.x, span.y) > longest_px) {
        return;
    }
    // Steps pixel by pixel along the axis in which the stroke is longer. At each step, draws the pixels
    // across the stroke.
    bool is_steep = span.y > span.x;
    vec2 first = (is_steep ? along.y : along.x) > 0.0 ? tail.xy : head.xy;
    float longer = is_steep ? along.y : along.x;
    vec2 step_px = abs(longer) > 1e-3 ? along / longer : vec2(1.0, 0.0);
    int margin = 1 + int(ceil(drift.half_width_px));
    int count = int(ceil(is_steep ? span.y : span.x)) + 2 * margin;
    for (int i = 0; i < loop_rounds(count, margin); ++i) {
        vec2 middle = first + float(i - margin) * step_px;
        ivec2 pixel = ivec2(floor(middle));
        for (int j = -margin; j <= margin; ++j) {
            ink_pixel(pixel + (is_steep ? ivec2(j, 0) : ivec2(0, j)), tail, head, strength);
        }
    }
}
