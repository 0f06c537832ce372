// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_CUBIC
#define ESTAMPE_FLUID_CUBIC

// Fields by Catmull-Rom splines. Needs what fluid_fields.glsl needs, and is included after it.

struct CubicSample {
    float value;
    vec2 range; // least and greatest of the four or eight nodes about
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

// Four nodes along an axis, of four places each, the first with index `low`, where some lie on or beyond a
// wall. Of two beyond it the second is taken for the first.
void mend_four(inout mat4 nodes, int low, int component, int axis)
{
    if (are_four_far_from_wall(low, axis)) {
        return;
    }
    int high = fluid_size()[axis] - low; // index of the first beyond the high wall, counted from `low`
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

// 00, 10, 01, 11 from `low` on.
vec4 four_nodes(sampler2DArray field, ivec2 low, float layer)
{
    vec2 corner = (vec2(low) + 1.0) * vec2(grid.texel_x, grid.texel_y);
    return textureGather(field, vec3(corner, layer)).wzxy;
}

// Sixteen nodes from `low` on in a layer, row by row.
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
    // What is beyond a wall is so of sums over a slice as of nodes.
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

#endif
