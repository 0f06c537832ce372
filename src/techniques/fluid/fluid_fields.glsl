// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_FIELDS
#define ESTAMPE_FLUID_FIELDS

// Interpolates a fluid's velocities and quantities, also next to walls. Requires `variant`, and `grid`, a
// FluidGrid. Samplers wrap around at the image's ends; the functions here correct values that were read
// across a wall.

const int fluid_scalar = 3; // "component" number that stands for a quantity, not for a velocity component

bool is_volume()
{
    return (variant & fluid_bit_volume) != 0u;
}

bool is_periodic(int axis)
{
    return (variant & (fluid_bit_periodic << axis)) != 0u;
}

int fluid_dimensions()
{
    return is_volume() ? 3 : 2;
}

ivec3 fluid_size()
{
    return ivec3(grid.width, grid.height, grid.depth);
}

bool is_in_grid(ivec3 cell)
{
    return all(lessThan(cell, fluid_size()));
}

// Maps an index at most `size` beyond either end into the grid: wrapped on a periodic axis, else clamped. The
// code compares and does not divide, because a division by a run-time value takes some twenty instructions.
int place_in_grid(int place, int size, bool is_round)
{
    int turned = place < 0 ? place + size : place >= size ? place - size : place;
    return is_round ? turned : clamp(place, 0, size - 1);
}

// The cell that is `steps` cells away along an axis; `steps` is at most the number of cells along `axis`.
ivec3 neighbour(ivec3 cell, int axis, int steps)
{
    cell[axis] = place_in_grid(cell[axis] + steps, fluid_size()[axis], is_periodic(axis));
    return cell;
}

uint fluid_cell_index(ivec3 cell)
{
    return (uint(cell.z) * grid.height + uint(cell.y)) * grid.width + uint(cell.x);
}

float lid_speed_of(int component)
{
    return component == 0 ? grid.lid_speed.x : component == 1 ? grid.lid_speed.y : grid.lid_speed.z;
}

// The value beyond a wall, at the mirror image of the place where `inner` was read.
vec2 beyond_wall(vec2 inner, int component, int axis, bool is_high)
{
    if (component == fluid_scalar || (variant & (fluid_bit_free_slip << axis)) != 0u) {
        return inner;
    }
    return (axis == 1 && is_high ? 2.0 * lid_speed_of(component) : 0.0) - inner;
}

// Corrects the values of two neighbour nodes along an axis if the nodes lie on or beyond a wall; `low` is the
// first node's index.
void mend(inout vec2 first, inout vec2 second, int low, int component, int axis)
{
    if (is_periodic(axis)) {
        return;
    }
    int size = fluid_size()[axis];
    if (component == axis) {
        first = low <= 0 || low >= size ? vec2(0.0) : first;
        second = low <= -1 || low >= size - 1 ? vec2(0.0) : second;
    } else {
        first = low < 0 ? beyond_wall(second, component, axis, false) : first;
        second = low >= size - 1 ? beyond_wall(first, component, axis, true) : second;
    }
}

// Whether two neighbour nodes from index `low` on need no wall correction, for any component.
bool is_far_from_wall(int low, int axis)
{
    return is_periodic(axis) || low >= 1 && low < fluid_size()[axis] - 1;
}

// Values of four nodes of a layer, from the node `low` on; x varies fastest, then y.
vec4 plane_nodes(sampler2DArray field, int component, ivec2 low, int layer)
{
    vec2 corner = (vec2(low) + 1.0) * vec2(grid.texel_x, grid.texel_y);
    vec4 quad = textureGather(field, vec3(corner, float(layer)));
    if (is_far_from_wall(low.x, 0) && is_far_from_wall(low.y, 1)) {
        return quad.wzxy;
    }
    vec2 left = quad.wx;
    vec2 right = quad.zy;
    mend(left, right, low.x, component, 0);
    vec2 below = vec2(left.x, right.x);
    vec2 above = vec2(left.y, right.y);
    mend(below, above, low.y, component, 1);
    return vec4(below, above);
}

int layer_of_slice(int slice)
{
    return place_in_grid(slice, int(grid.depth), is_periodic(2));
}

// Values at the eight nodes of a cube that starts at node `low`: four values in `near`, and in `far` the four
// values one layer farther along z. In 2D both are equal.
void box_nodes(sampler2DArray field, int component, ivec3 low, int first_layer, out vec4 near, out vec4 far)
{
    if (!is_volume()) {
        near = plane_nodes(field, component, low.xy, first_layer);
        far = near;
        return;
    }
    near = plane_nodes(field, component, low.xy, first_layer + layer_of_slice(low.z));
    far = plane_nodes(field, component, low.xy, first_layer + layer_of_slice(low.z + 1));
    vec2 near_below = near.xy;
    vec2 far_below = far.xy;
    mend(near_below, far_below, low.z, component, 2);
    vec2 near_above = near.zw;
    vec2 far_above = far.zw;
    mend(near_above, far_above, low.z, component, 2);
    near = vec4(near_below, near_above);
    far = vec4(far_below, far_above);
}

float blend(vec4 nodes, vec2 share)
{
    vec2 columns = mix(nodes.xy, nodes.zw, share.y);
    return mix(columns.x, columns.y, share.x);
}

// Linear interpolation of a field at `offset` cells from node `node`.
float sample_linear(sampler2DArray field, int component, ivec3 node, int first_layer, vec3 offset)
{
    vec3 whole = floor(offset);
    vec3 share = offset - whole;
    vec4 near;
    vec4 far;
    box_nodes(field, component, node + ivec3(whole), first_layer, near, far);
    float value = blend(near, share.xy);
    return is_volume() ? mix(value, blend(far, share.xy), share.z) : value;
}

// Minimum and maximum of a field's nodes around a place.
vec2 range_of_nodes(sampler2DArray field, int component, ivec3 node, int first_layer, vec3 offset)
{
    vec4 near;
    vec4 far;
    box_nodes(field, component, node + ivec3(floor(offset)), first_layer, near, far);
    vec4 least = min(near, far);
    vec4 most = max(near, far);
    return vec2(min(min(least.x, least.y), min(least.z, least.w)),
                max(max(most.x, most.y), max(most.z, most.w)));
}

// Velocity at the place `at`, given in cells from the low corner of `cell`.
vec3 velocity_at(sampler2DArray velocity, ivec3 cell, vec3 at)
{
    int depth = int(grid.depth);
    vec3 centred = at - 0.5;
    vec3 speed = vec3(0.0);
    speed.x = sample_linear(velocity, 0, cell, 0, vec3(at.x, centred.y, centred.z));
    speed.y = sample_linear(velocity, 1, cell, depth, vec3(centred.x, at.y, centred.z));
    if (is_volume()) {
        speed.z = sample_linear(velocity, 2, cell, 2 * depth, vec3(centred.x, centred.y, at.z));
    }
    return speed;
}

// Limits a displacement so that the displacement ends inside the walls; on a periodic axis, limits it to half
// the grid.
vec3 kept_inside(vec3 way, ivec3 cell, vec3 at)
{
    vec3 size = vec3(fluid_size());
    vec3 place = vec3(cell) + at;
    for (int axis = 0; axis < 3; ++axis) {
        way[axis] = is_periodic(axis) ? clamp(way[axis], -0.5 * size[axis], 0.5 * size[axis])
                                      : clamp(way[axis], -place[axis], size[axis] - place[axis]);
    }
    return is_volume() ? way : vec3(way.xy, 0.0);
}

// Velocity after half a step from the place `at` (midpoint rule); `here` is the velocity at the start.
vec3 velocity_half_way(sampler2DArray velocity, vec3 here, ivec3 cell, vec3 at, float cells_per_speed)
{
    return velocity_at(velocity, cell, at + kept_inside(0.5 * cells_per_speed * here, cell, at));
}

// Displacement of fluid that starts at the place `at`, by the midpoint rule.
vec3 way_along(sampler2DArray velocity, vec3 here, ivec3 cell, vec3 at, float cells_per_speed)
{
    vec3 half_way = velocity_half_way(velocity, here, cell, at, cells_per_speed);
    return kept_inside(cells_per_speed * half_way, cell, at);
}

// Position of a velocity component's node within the node's cell; z is ignored in 2D.
vec3 place_of_node(int component)
{
    vec3 at = vec3(0.5);
    if (component < 3) {
        at[component] = 0.0;
    }
    return at;
}

// Whether a node of `component` lies on a wall, where the velocity along the wall's normal is zero.
bool is_on_wall(int component, ivec3 cell)
{
    return component < 3 && !is_periodic(component) && cell[component] == 0;
}

// Velocity at the node of `component`: the stored value of that component, and the averages of the remaining
// components from the nodes around the node. Equals velocity_at() with fewer texture reads.
vec3 velocity_at_node(sampler2DArray velocity, int component, ivec3 cell)
{
    vec3 speed = vec3(0.0);
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        int first_layer = axis * int(grid.depth);
        if (axis == component) {
            float own = texelFetch(velocity, ivec3(cell.xy, first_layer + cell.z), 0).x;
            speed[axis] = is_on_wall(axis, cell) ? 0.0 : own;
        } else {
            vec3 offset = place_of_node(component) - place_of_node(axis);
            if (offset.z == 0.0) {
                ivec2 whole = ivec2(floor(offset.xy));
                speed[axis] = blend(plane_nodes(velocity, axis, cell.xy + whole, first_layer + cell.z),
                                    offset.xy - vec2(whole));
            } else {
                speed[axis] = sample_linear(velocity, axis, cell, first_layer, offset);
            }
        }
    }
    return speed;
}

// Velocity at a cell's centre: the mean of opposite faces.
vec3 velocity_in_middle(sampler2DArray velocity, ivec3 cell)
{
    vec3 speed = vec3(0.0);
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        int first_layer = axis * int(grid.depth);
        ivec3 next = neighbour(cell, axis, 1);
        float low = texelFetch(velocity, ivec3(cell.xy, first_layer + cell.z), 0).x;
        float high = texelFetch(velocity, ivec3(next.xy, first_layer + next.z), 0).x;
        speed[axis] = 0.5 * ((is_on_wall(axis, cell) ? 0.0 : low) + (next == cell ? 0.0 : high));
    }
    return speed;
}

// Closeness of a place to a face of an open box: 1 at the face, 0 at a distance of `rim_cells` cells or more.
// The low face of y is ignored.
float closeness_to_rim(vec3 place, float rim_cells)
{
    vec3 size = vec3(fluid_size());
    vec3 inside = min(place, size - place);
    inside.y = size.y - place.y;
    float nearest = is_volume() ? min(inside.x, min(inside.y, inside.z)) : min(inside.x, inside.y);
    return rim_cells > 0.0 ? clamp(1.0 - nearest / rim_cells, 0.0, 1.0) : 0.0;
}

#endif
