// SPDX-License-Identifier: MIT
// One thread per node: the stream function of everything that drives ink over the page.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/ink/flow/flow.glsl"
#include "techniques/ink/ink.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Ink
{
    InkGlobals globals;
};

layout(binding = 1) uniform samplerBuffer map_texels;    // stream function of the flow map, for ink_has_map
layout(binding = 2) uniform samplerBuffer stream_texels; // stream function at nodes, used by carried.glsl

layout(binding = 3) uniform samplerBuffer zone_shapes; // fields of zones with the shape of a mesh

layout(scalar, binding = 4) writeonly buffer Nodes
{
    float stream[];
};

layout(push_constant, scalar) uniform Constants
{
    InkStep step;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_map = (variant & ink_has_map) != 0u;
const bool has_zones = (variant & ink_has_zones) != 0u;

#include "techniques/ink/flow/carried.glsl"
#include "techniques/ink/flow/flow_map.glsl"
#include "techniques/ink/flow/zones.glsl"

void main()
{
    uvec2 node = gl_GlobalInvocationID.xy;
    uvec2 count = uvec2(nodes_across(globals.grid_size.x), nodes_across(globals.grid_size.y));
    if (any(greaterThanEqual(node, count))) {
        return;
    }
    float node_mm = globals.mm_per_cell * float(ink_node_cells);
    vec2 place_mm = (vec2(node) - 1.0) * node_mm - globals.margin_cells * globals.mm_per_cell;
    float psi = wind_stream(place_mm, globals.wind_mm_per_s);
    for (uint i = 0u; i < ink_wave_count; ++i) {
        psi += wave_stream(globals.waves[i].wave.xy, globals.waves[i].amplitude, step.phases[i], place_mm);
    }
    if (has_map) {
        psi += flow_map_stream(place_mm);
    }
    if (has_zones) {
        for (uint i = 0u; i < globals.zone_count; ++i) {
            InkZone zone = globals.zones[i];
            psi = in_zone(psi, place_mm - zone.middle_mm, share_of_zone(zone, place_mm),
                          zone.velocity_mm_per_s, zone.turn_rad_s, step.zone_streams[i]);
        }
    }
    stream[node.y * count.x + node.x] = psi / (node_mm * node_mm);
}
