// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_GLSL_H
#define ESTAMPE_FLUID_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of the shaders' variants. The first six say what bounds the grid, axis by axis: x, y, z.
SHARED_CONSTANT uint fluid_bit_periodic = 0x1U;  // shifted by the axis
SHARED_CONSTANT uint fluid_bit_free_slip = 0x8U; // shifted by the axis
SHARED_CONSTANT uint fluid_bit_volume = 0x40U;   // three dimensions
SHARED_CONSTANT uint fluid_bit_solids = 0x80U;   // there are obstacles
// Of advection.
SHARED_CONSTANT uint fluid_bit_scalars = 0x100U; // what is moved are quantities, not the velocity
SHARED_CONSTANT uint fluid_bit_cubic = 0x200U;   // Catmull-Rom splines in place of linear weights
// Of forces and matter.
SHARED_CONSTANT uint fluid_bit_confined = 0x400U; // vortices are fed
SHARED_CONSTANT uint fluid_bit_buoyant = 0x800U;  // quantities weigh
SHARED_CONSTANT uint fluid_bit_burning = 0x1000U;
SHARED_CONSTANT uint fluid_bit_condensing = 0x2000U;
SHARED_CONSTANT uint fluid_bit_few = 0x800000U;      // no more quantities than density and temperature
SHARED_CONSTANT uint fluid_bit_ways = 0x400000U;     // of advection: ways back are there already
SHARED_CONSTANT uint fluid_bit_standing = 0x200000U; // of solids: some stand still for good
// Of transforms, which go along x unless said.
SHARED_CONSTANT uint fluid_bit_along_y = 0x4000U;
SHARED_CONSTANT uint fluid_bit_along_z = 0x8000U;
SHARED_CONSTANT uint fluid_bit_long = 0x10000U;     // rows have more numbers than fluid_transform_pairs
SHARED_CONSTANT uint fluid_bit_reversed = 0x20000U; // back
SHARED_CONSTANT uint fluid_bit_dividing =
    0x40000U; // forth, divide by what differences make of waves, and back
// Of half a sweep of a volume.
SHARED_CONSTANT uint fluid_bit_from_zero = 0x80000U;   // there is no pressure yet
SHARED_CONSTANT uint fluid_bit_prolonging = 0x100000U; // the coarser level's pressure is added

// Channels of quantities that do something; those after them are only carried.
SHARED_CONSTANT int fluid_density = 0;
SHARED_CONSTANT int fluid_temperature = 1; // above that of the surroundings
SHARED_CONSTANT int fluid_fuel = 2;
SHARED_CONSTANT int fluid_vapour = 3;
SHARED_CONSTANT int fluid_cloud = 4; // water that condensed

// Velocities are kept on faces: component i of cell c on the face between c and its lower neighbour along
// axis i, in layer i * depth + z of an image array. Quantities are kept in the middle of cells, channel by
// channel.
struct FluidGrid {
    uint width; // cells
    uint height;
    uint depth;     // 1 in two dimensions
    float texel_x;  // 1 / width
    float texel_y;  // 1 / height
    vec3 lid_speed; // of the wall at the high end of y
};

// What is moved along the flow.
struct FluidAdvect {
    float cells_per_speed; // how far what moves at speed 1 goes in this step
    uint channels;
};

// A stage of diffusion: weights of the states and of their rates of change.
struct FluidDiffuse {
    float of_last;
    float of_before_last;
    float of_start;
    float of_last_rate; // per Laplacian of unit cells
    float of_start_rate;
    vec3 speed_gain; // by a force everywhere
};

struct FluidForces {
    vec3 speed_gain; // everywhere
    float kept;      // of the speed, by friction
    float lift;      // of y's speed by a unit of temperature
    float weight;    // the same down, by a unit of density
    float confinement;
    float rim_share; // of the difference to the air outside, next to the faces of an open box
    float rim_cells; // how far in that is felt
    vec3 outside;    // speed of the air there
};

// A box, turned about z and rounded: all that is no farther than `radius_m` from it. Of an obstacle, or of a
// source.
struct FluidShape {
    vec3 centre_m;
    float radius_m;
    vec3 half_m; // of the box, along its own axes
    float angle_rad;
    vec3 speed;     // metres a second
    float spin;     // radians a second
    vec4 gain;      // of the first four channels, a second
    vec4 more_gain; // of the next four
    float push;     // how quickly what is within takes up its speed, 1 / s
    float least_density;
    float least_vapour;
};

// Where shapes are: obstacles first, then sources.
struct FluidShapes {
    float cell_m;
    float age_s; // since they were where they are said to be
    float step_s;
    uint obstacle_count;
    uint count;
    uint channels;
};

// Mass that is moved in whole units.
struct FluidMass {
    float cells_per_speed;
    float gain_per_unit; // of speed, by a difference of one unit between neighbours
};

// What becomes of quantities in a step.
struct FluidMatter {
    float density_kept;
    float heat_kept;
    float burnt;    // share of the fuel, where it burns
    float ignition; // least temperature of that
    float heat_of_fuel;
    float smoke_of_fuel;
    float condensed;         // share of what vapour is too much, or too little
    float saturation;        // vapour that air takes up at y = 0 at the temperature of the surroundings
    float saturation_heat;   // growth of its logarithm by a unit of temperature
    float saturation_height; // fall of its logarithm by a metre of height
    float latent_heat;
    float rim_share;      // of what leaves next to the faces of an open box
    float rim_cells;      // how far in that is felt
    float outside_vapour; // at most what the air there holds
};

// A level of the multigrid, or of what is laid out as one: cells of 2^level cells of the grid's. In buffers
// of all levels, level after level from the finest, it begins at `first`.
struct FluidLevel {
    uint width;
    uint height;
    uint first;
};

struct FluidVolumeLevel {
    uint width;
    uint height;
    uint depth;
    uint first;
};

struct FluidVolumeSweep {
    uint color;        // of the cells that are swept
    uint coarse_width; // of the next level
    uint coarse_height;
};

struct FluidTile {
    FluidLevel level;
    FluidLevel coarse; // the next one
    uint rounds;       // of Jacobi's iteration
};

struct FluidSmall {
    FluidLevel level;
    uint level_count;  // from this one on, down to a handful of cells
    uint level_number; // of this one, counted from the grid itself
    uint width;        // of the grid
    uint height;
};

struct FluidWeights {
    uint level_count;
    uint cell_count; // of all levels
};

// Of a transform along an axis: cosines where it has walls, sines and cosines where its ends meet.
struct FluidTransform {
    uint width;
    uint height;
    uint depth;
    uint log_length; // of what is transformed
    uint log_pairs;  // of rows in a workgroup
    uint log_turn;   // of the angles in a full turn
    float share;     // that numbers are multiplied by
};

// Mass is whole units. Weights of the four or eight cells that share some add up to fluid_mass_whole exactly.
SHARED_CONSTANT uint fluid_mass_unit = 65536U; // of mass 1
SHARED_CONSTANT uint fluid_mass_whole = 32768U;

SHARED_CONSTANT uint fluid_most_shapes = 64U;
SHARED_CONSTANT uint fluid_stands_still = 0xffffffffU; // the solid in a cell is none of the shapes
SHARED_CONSTANT uint fluid_most_channels = 8U;

// Tiles of the fused passes: a workgroup works on a square, and on so many cells about it.
SHARED_CONSTANT uint fluid_tile = 32U;
SHARED_CONSTANT uint fluid_halo = 5U;
SHARED_CONSTANT uint fluid_most_rounds = 4U; // of Jacobi's iteration in one pass
SHARED_CONSTANT uint fluid_transform_pairs =
    2048U; // complex numbers in a workgroup's memory, but for longer rows
SHARED_CONSTANT uint fluid_coarsest_cells = 64U; // of a volume's last level
SHARED_CONSTANT uint fluid_small_cells =
    1024U; // a level of so many goes into one workgroup, and all after it

#ifdef __cplusplus
static_assert(sizeof(FluidGrid) == 32);
} // namespace estampe::shared
#endif

#endif
