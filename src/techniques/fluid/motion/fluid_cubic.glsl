// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_CUBIC
#define ESTAMPE_FLUID_CUBIC

// Fields by Catmull-Rom splines. Needs what fluid_fields.glsl needs, and is included after it.

// A node that may lie two beyond a wall; the second is taken for the first.
float node_value(sampler2DArray field, int component, ivec3 node, int first_layer)
{
    ivec3 size = fluid_size();
    ivec3 low = node;
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        low[axis] =
            is_periodic(axis) ? (node[axis] + size[axis]) % size[axis] : clamp(node[axis], -1, size[axis]);
    }
    vec4 near;
    vec4 far;
    box_nodes(field, component, low, first_layer, near, far);
    return near.x;
}

vec4 cubic_weights(float share)
{
    float s2 = share * share;
    float s3 = s2 * share;
    return 0.5 *
           vec4(-s3 + 2.0 * s2 - share, 3.0 * s3 - 5.0 * s2 + 2.0, -3.0 * s3 + 4.0 * s2 + share, s3 - s2);
}

float sample_cubic(sampler2DArray field, int component, ivec3 node, int first_layer, vec3 offset)
{
    vec3 whole = floor(offset);
    ivec3 low = node + ivec3(whole) - 1;
    vec4 weights_x = cubic_weights(offset.x - whole.x);
    vec4 weights_y = cubic_weights(offset.y - whole.y);
    vec4 weights_z = is_volume() ? cubic_weights(offset.z - whole.z) : vec4(0.0, 1.0, 0.0, 0.0);
    int first_z = is_volume() ? 0 : 1;
    int last_z = is_volume() ? 3 : 1;
    float sum = 0.0;
    for (int k = first_z; k <= last_z; ++k) {
        for (int i = 0; i < 16; ++i) {
            ivec3 place = low + ivec3(i & 3, i >> 2, is_volume() ? k : 1);
            sum += weights_x[i & 3] * weights_y[i >> 2] * weights_z[k] *
                   node_value(field, component, place, first_layer);
        }
    }
    return sum;
}

#endif
