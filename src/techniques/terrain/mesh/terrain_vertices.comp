// SPDX-License-Identifier: MIT
// One thread computes one vertex of a terrain: its height, its normal, and its position in the previous
// frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Terrain
{
    TerrainGlobals terrain;
};

layout(scalar, binding = 1) readonly buffer Levels
{
    TerrainLevel levels[];
};

layout(scalar, binding = 2) readonly buffer Vertices
{
    uint vertices[];
};

layout(scalar, binding = 3) uniform Words
{
    uint words[height_words_most]; // the program: places, parameters, instructions
};

layout(binding = 4) uniform samplerBuffer texels;

layout(scalar, binding = 5) writeonly buffer PosedVertices
{
    PosedVertex posed_vertices[];
};

layout(scalar, binding = 6) writeonly buffer PosedBefore
{
    PosedVertex posed_before[];
};

layout(scalar, binding = 7) writeonly buffer StrokeCoordinates
{
    vec3 stroke_coordinates[];
};

layout(scalar, binding = 8) readonly buffer Places
{
    vec3 places[]; // world positions of vertices that are in no grid
};

layout(constant_id = 0) const uint variant = 0u;
const bool keeps_before = (variant & terrain_keeps_before) != 0u;
const bool has_places = (variant & terrain_has_places) != 0u;

#include "techniques/terrain/graph/height_program.glsl"

uvec2 index_of(uint vertex, TerrainLevel level)
{
    uint mask = (1u << terrain_index_bits) - 1u;
    uvec2 index = uvec2(vertex & mask, (vertex >> terrain_index_bits) & mask);
    uint part = (vertex >> 26) & 3u;
    uvec2 trim = part == terrain_part_trim_column
                     ? uvec2(level.hole_shift.x == 1u ? 0u : level.hole_count, 0u)
                     : uvec2(level.hole_shift.x, level.hole_shift.y == 1u ? 0u : level.hole_count);
    return part == terrain_part_grid ? index : index + level.hole_first + trim;
}

// Height of a vertex. Near the border of a level, the height blends into that of the next outer, coarser
// level. Near the border, the vertex may lie in the middle of a coarser edge, so the heights at both ends of
// that edge are evaluated.
vec4 height_of(uvec2 index, TerrainLevel level)
{
    vec2 from_eye = abs(vec2(index) - level.eye_cells);
    float coarse =
        clamp((max(from_eye.x, from_eye.y) - level.fade_from) / (level.fade_to - level.fade_from), 0.0, 1.0);
    coarse = level.fade_to > 1e30 ? 0.0 : coarse;
    vec2 place = level.origin_m + level.cell_m * vec2(index);
    vec2 odd = level.cell_m * vec2(index & 1u);
    bool is_even = odd == vec2(0.0);
    int first = coarse < 1.0 ? 0 : 1;
    int end = coarse > 0.0 ? (is_even ? 2 : 3) : 1;
    vec4 sum = vec4(0.0);
    int i = first;
    do {
        vec2 at = i == 0 ? place : (i == 1 ? place - odd : place + odd);
        float weight = i >= end ? 0.0 : i == 0 ? 1.0 - coarse : (is_even ? coarse : 0.5 * coarse);
        sum += weight * height_at(at, i == 0 ? level.cell_m : 2.0 * level.cell_m);
    } while (subgroupAny(++i < end));
    return sum;
}

// Angle in radians at the planet's centre between the eye and ground that is `far_m` metres from the eye.
// Ground farther than the point opposite of the eye ends at that point: without this bound, it would go round
// the planet again and lie among the ground before the eye.
float planet_angle(float far_m)
{
    return min(far_m / terrain.planet_radius_m, 3.14159265);
}

// If the ground has a planet's curvature, moves a place onto a sphere. The sphere's top lies straight below
// the eye, at height 0.
vec3 bent(vec2 place, float height)
{
    vec2 away = place - terrain.eye_m;
    float far = length(away);
    if (terrain.planet_radius_m <= 0.0 || far <= 0.0) {
        return vec3(place.x, height, place.y);
    }
    float angle = planet_angle(far);
    float half_sine = sin(0.5 * angle);
    vec2 across = away * ((terrain.planet_radius_m + height) * sin(angle) / far);
    return vec3(terrain.eye_m.x + across.x,
                height * cos(angle) - 2.0 * terrain.planet_radius_m * half_sine * half_sine,
                terrain.eye_m.y + across.y);
}

vec3 bent_normal(vec2 place, vec3 normal)
{
    vec2 away = place - terrain.eye_m;
    float far = length(away);
    if (terrain.planet_radius_m <= 0.0 || far <= 0.0) {
        return normal;
    }
    float angle = planet_angle(far);
    vec3 ahead = vec3(away.x / far, 0.0, away.y / far);
    float along = dot(normal, ahead);
    vec3 rest = normal - along * ahead - vec3(0.0, normal.y, 0.0);
    return rest + ahead * (along * cos(angle) + normal.y * sin(angle)) +
           vec3(0.0, normal.y * cos(angle) - along * sin(angle), 0.0);
}

void main()
{
    uint number = item_index();
    if (number >= terrain.vertex_count) {
        return;
    }
    uint vertex = vertices[number];
    TerrainLevel level = levels[vertex >> 28];
    uvec2 index = index_of(vertex, level);
    vec2 place = level.origin_m + level.cell_m * vec2(index);
    vec4 height = vec4(0.0);
    if (has_places) {
        vec3 own = places[number];
        place = own.xz + level.origin_m;
        height = height_at(place, level.cell_m) + vec4(own.y, 0.0, 0.0, 0.0);
    } else {
        height = height_of(index, level);
    }
    vec3 sea = vec3(0.0, terrain.anchor_y_m, 0.0);
    uint normal = pack_normal(bent_normal(place, normalize(vec3(-height.y, 1.0, -height.z))));
    uint at = terrain.first_vertex + number;
    posed_vertices[at].position = bent(place, height.x) - sea;
    posed_vertices[at].normal = normal;
    if (keeps_before) {
        posed_before[at].position = bent(place, height.x - terrain.before_s * height.w) - sea;
        posed_before[at].normal = normal;
    }
    stroke_coordinates[at] = (vec3(place.x, height.x, place.y) - sea) / terrain.stroke_unit_m;
}
