// SPDX-License-Identifier: MIT
// One thread per cell: semi-Lagrangian advection. Samples the field at the point from which the flow brings
// each node's value.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform sampler2DArray field;
layout(binding = 2) uniform sampler2DArray ways; // displacements of cells, only with fluid_bit_ways
layout(binding = 3, r32f) writeonly uniform image2DArray out_field;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidAdvect advect;
};

#include "techniques/fluid/fluid_fields.glsl"

// Interpolation by Catmull-Rom splines.

struct CubicSample {
    float value;
    vec2 range; // minimum and maximum of the four or eight nodes nearest to the sampled place
};

vec4 cubic_weights(float share)
{
    float s2 = share * share;
    float s3 = s2 * share;
    return 0.5 *
           vec4(-s3 + 2.0 * s2 - share, 3.0 * s3 - 5.0 * s2 + 2.0, -3.0 * s3 + 4.0 * s2 + share, s3 - s2);
}

bool are_four_far_from_wall(int low, int axis)
{
    return is_periodic(axis) || low >= 1 && low < fluid_size()[axis] - 3;
}

vec4 beyond_wall(vec4 inner, int component, int axis, bool is_high)
{
    return vec4(beyond_wall(inner.xy, component, axis, is_high),
                beyond_wall(inner.zw, component, axis, is_high));
}

// Corrects four nodes along an axis, for four rows at once, if some nodes lie on or beyond a wall; `low` is
// the first node's index. A second node beyond the wall gets the first one's value.
void mend_four(inout mat4 nodes, int low, int component, int axis)
{
    if (are_four_far_from_wall(low, axis)) {
        return;
    }
    int high = fluid_size()[axis] - low; // index of the first node beyond the high wall, relative to `low`
    if (component == axis) {
        for (int k = 0; k < 4; ++k) {
            nodes[k] = low + k <= 0 || k >= high ? vec4(0.0) : nodes[k];
        }
        return;
    }
    nodes[1] = low <= -2 ? beyond_wall(nodes[2], component, axis, false) : nodes[1];
    nodes[0] = low <= -2 ? nodes[1] : low == -1 ? beyond_wall(nodes[1], component, axis, false) : nodes[0];
    nodes[2] = high <= 2 ? beyond_wall(nodes[1], component, axis, true) : nodes[2];
    nodes[3] = high <= 2 ? nodes[2] : high == 3 ? beyond_wall(nodes[2], component, axis, true) : nodes[3];
}

// Values of four nodes from the node `low` on; x varies fastest, then y.
vec4 four_nodes(sampler2DArray field, ivec2 low, float layer)
{
    vec2 corner = (vec2(low) + 1.0) * vec2(grid.texel_x, grid.texel_y);
    return textureGather(field, vec3(corner, layer)).wzxy;
}

// Values of sixteen nodes of a layer, from `low` on, row by row.
mat4 sixteen_nodes(sampler2DArray field, int component, ivec2 low, int layer)
{
    vec4 near = four_nodes(field, low, float(layer));
    vec4 right = four_nodes(field, low + ivec2(2, 0), float(layer));
    vec4 above = four_nodes(field, low + ivec2(0, 2), float(layer));
    vec4 high = four_nodes(field, low + 2, float(layer));
    mat4 columns = mat4(near.xz, above.xz, near.yw, above.yw, right.xz, high.xz, right.yw, high.yw);
    mend_four(columns, low.x, component, 0);
    mat4 rows = transpose(columns);
    mend_four(rows, low.y, component, 1);
    return rows;
}

vec2 with_middle(vec2 range, mat4 rows)
{
    vec2 least = min(rows[1].yz, rows[2].yz);
    vec2 most = max(rows[1].yz, rows[2].yz);
    return vec2(min(range.x, min(least.x, least.y)), max(range.y, max(most.x, most.y)));
}

CubicSample sample_cubic(sampler2DArray field, int component, ivec3 node, int first_layer, vec3 offset)
{
    const vec2 no_range = vec2(3.4e38, -3.4e38);
    vec3 whole = floor(offset);
    ivec3 low = node + ivec3(whole) - 1;
    vec4 across = cubic_weights(offset.x - whole.x);
    vec4 up = cubic_weights(offset.y - whole.y);
    if (!is_volume()) {
        mat4 rows = sixteen_nodes(field, component, low.xy, first_layer);
        return CubicSample(dot(up, across * rows), with_middle(no_range, rows));
    }
    // Wall corrections are linear, so the corrections may be applied to sums over a slice and not to single
    // nodes.
    mat4 slices = mat4(0.0);
    vec2 range = no_range;
    for (int k = 0; k < 4; ++k) {
        mat4 rows = sixteen_nodes(field, component, low.xy, first_layer + layer_of_slice(low.z + k));
        slices[k].x = dot(up, across * rows);
        range = k == 1 || k == 2 ? with_middle(range, rows) : range;
    }
    mend_four(slices, low.z, component, 2);
    vec4 along = cubic_weights(offset.z - whole.z);
    return CubicSample(
        along.x * slices[0].x + along.y * slices[1].x + along.z * slices[2].x + along.w * slices[3].x, range);
}

#include "techniques/fluid/motion/fluid_ways.glsl"

vec3 way_back(int component, ivec3 cell, vec3 own)
{
    if ((variant & fluid_bit_ways) != 0u) {
        return way_of_node(component, cell, 0, own);
    }
    vec3 here = velocity_at_node(velocity, component, cell);
    return way_along(velocity, here, cell, place_of_node(component), -advect.cells_per_speed);
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    bool are_scalars = (variant & fluid_bit_scalars) != 0u;
    vec3 own = (variant & fluid_bit_ways) != 0u ? way_of_cell(cell, 0) : vec3(0.0);
    vec3 way = vec3(0.0);
    int count = are_scalars ? int(advect.channels) : fluid_dimensions();
    for (int i = 0; i < count; ++i) {
        int component = are_scalars ? fluid_scalar : i;
        if (!are_scalars || i == 0) {
            way = way_back(component, cell, own);
        }
        int first_layer = i * int(grid.depth);
        float value;
        if ((variant & fluid_bit_cubic) == 0u) {
            value = sample_linear(field, component, cell, first_layer, way);
        } else {
            CubicSample found = sample_cubic(field, component, cell, first_layer, way);
            value = are_scalars ? clamp(found.value, found.range.x, found.range.y) : found.value;
        }
        value = is_on_wall(component, cell) ? 0.0 : value;
        imageStore(out_field, ivec3(cell.xy, first_layer + cell.z), vec4(value));
    }
}
