// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_SHARES
#define ESTAMPE_FLUID_SHARES

// Distributes a mass over the cells around a place, in whole numbers. Include fluid_shares.glsl after
// fluid_fields.glsl; the requirements of fluid_fields.glsl apply.

const int fluid_most_sharers = 8;

int sharer_count()
{
    return is_volume() ? 8 : 4;
}

// Cells and weights that share the mass at displacement `way` from the middle of `cell`. The last cell takes
// the rounding error.
void share_out(ivec3 cell, vec3 way, out uint index[fluid_most_sharers], out uint weight[fluid_most_sharers])
{
    vec3 whole = floor(way);
    uvec3 far = uvec3(round((way - whole) * float(fluid_mass_whole)));
    ivec3 low = cell + ivec3(whole);
    ivec3 size = fluid_size();
    uint left = fluid_mass_whole;
    for (int i = 0; i < sharer_count(); ++i) {
        ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        ivec3 place = low + step;
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] = is_periodic(axis) ? (place[axis] + size[axis]) % size[axis]
                                            : clamp(place[axis], 0, size[axis] - 1);
        }
        uint share = step.x == 1 ? far.x : fluid_mass_whole - far.x;
        share = share * (step.y == 1 ? far.y : fluid_mass_whole - far.y) / fluid_mass_whole;
        if (is_volume()) {
            share = share * (step.z == 1 ? far.z : fluid_mass_whole - far.z) / fluid_mass_whole;
        }
        index[i] = fluid_cell_index(place);
        weight[i] = i == sharer_count() - 1 ? left : share;
        left -= share;
    }
}

// `part` / 65536 of a mass, rounded down.
uint part_of(uint mass, uint part)
{
    bool is_negative = (variant & fluid_bit_scalars) != 0u && int(mass) < 0;
    uint high;
    uint low;
    umulExtended(is_negative ? -mass : mass, part, high, low);
    uint result = (high << 16u) | (low >> 16u);
    return is_negative ? -result : result;
}

// Place of a mass in the buffers, which hold all cells of a channel before all cells of the next channel.
uint mass_index(uint cell_index, uint channel)
{
    return channel * grid.width * grid.height * grid.depth + cell_index;
}

// Displacement of the mass at the middle of `cell` in a step.
vec3 way_from_middle(sampler2DArray velocity, ivec3 cell, float cells_per_speed)
{
    vec3 here = velocity_at(velocity, cell, vec3(0.5));
    return way_along(velocity, here, cell, vec3(0.5), cells_per_speed);
}

#endif
