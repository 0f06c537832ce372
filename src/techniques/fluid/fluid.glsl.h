// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_GLSL_H
#define ESTAMPE_FLUID_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of the shader variants. The first six give the boundary conditions of the axes x, y, z.
SHARED_CONSTANT uint fluid_bit_periodic = 0x1U;  // shifted left by the axis
SHARED_CONSTANT uint fluid_bit_free_slip = 0x8U; // shifted left by the axis
SHARED_CONSTANT uint fluid_bit_volume = 0x40U;
SHARED_CONSTANT uint fluid_bit_solids = 0x80U;
// Bits of advection.
SHARED_CONSTANT uint fluid_bit_scalars = 0x100U; // quantities are advected, not the velocity
SHARED_CONSTANT uint fluid_bit_cubic = 0x200U;   // Catmull-Rom splines in place of linear weights
// Bits of forces and matter.
SHARED_CONSTANT uint fluid_bit_confined = 0x400U;
SHARED_CONSTANT uint fluid_bit_buoyant = 0x800U; // quantities cause lift and weight
SHARED_CONSTANT uint fluid_bit_burning = 0x1000U;
SHARED_CONSTANT uint fluid_bit_condensing = 0x2000U;
SHARED_CONSTANT uint fluid_bit_few = 0x800000U;      // no quantities beyond density and temperature
SHARED_CONSTANT uint fluid_bit_ways = 0x400000U;     // advection: an earlier pass computed displacements
SHARED_CONSTANT uint fluid_bit_standing = 0x200000U; // solids: some cells are solid permanently
// Bits of transforms. Without an axis bit they run along x.
SHARED_CONSTANT uint fluid_bit_along_y = 0x4000U;
SHARED_CONSTANT uint fluid_bit_along_z = 0x8000U;
SHARED_CONSTANT uint fluid_bit_long = 0x10000U;     // rows are longer than fluid_transform_pairs
SHARED_CONSTANT uint fluid_bit_reversed = 0x20000U; // inverse transform
SHARED_CONSTANT uint fluid_bit_dividing =
    0x40000U; // forward transform, division by the eigenvalues of the Laplacian, inverse transform
// Bits of one half sweep in 3D multigrid.
SHARED_CONSTANT uint fluid_bit_from_zero = 0x80000U;   // the pressure starts at zero
SHARED_CONSTANT uint fluid_bit_prolonging = 0x100000U; // adds the coarser level's pressure first

// Channels with a physical effect; later channels are only advected.
SHARED_CONSTANT int fluid_density = 0;
SHARED_CONSTANT int fluid_temperature = 1; // relative to the surroundings
SHARED_CONSTANT int fluid_fuel = 2;
SHARED_CONSTANT int fluid_vapour = 3;
SHARED_CONSTANT int fluid_cloud = 4; // condensed water

// Velocities are stored on faces: component i of cell c is on the face between c and its lower neighbour
// along axis i, in layer i * depth + z of an image array. Quantities are stored at cell centres, channel by
// channel.
struct FluidGrid {
    uint width; // cells
    uint height;
    uint depth;     // 1 in 2D
    float texel_x;  // 1 / width
    float texel_y;  // 1 / height
    vec3 lid_speed; // velocity of the wall at the high end of y
};

// Constants of an advection pass.
struct FluidAdvect {
    float cells_per_speed; // displacement in cells at speed 1 in this step
    uint channels;
};

// One stage of diffusion: weights of the states and of their rates of change.
struct FluidDiffuse {
    float of_last;
    float of_before_last;
    float of_start;
    float of_last_rate; // for a Laplacian on cells of size 1
    float of_start_rate;
    vec3 speed_gain; // gain by the uniform force
};

struct FluidForces {
    vec3 speed_gain; // gain by the uniform force
    float kept;      // factor on the speed after friction
    float lift;      // gain of y speed per unit of temperature
    float weight;    // loss of y speed per unit of density
    float confinement;
    float rim_share; // rate of replacement by outside air next to the faces of an open box
    float rim_cells; // thickness of the layer in which air is replaced
    vec3 outside;    // speed of the outside air
};

// A rounded box turned about z: all points within `radius_m` of the box. Used for obstacles and sources.
struct FluidShape {
    vec3 centre_m;
    float radius_m;
    vec3 half_m; // half size of the box along its own axes
    float angle_rad;
    vec3 speed;     // metres per second
    float spin;     // radians per second
    vec4 gain;      // gain of the first four channels, per second
    vec4 more_gain; // gain of channels five to eight, per second
    float push;     // rate at which fluid inside approaches the shape's speed, 1 / s
    float least_density;
    float least_vapour;
};

// Positions of shapes: obstacles first, then sources.
struct FluidShapes {
    float cell_m;
    float age_s; // time since the positions in the buffer were valid
    float step_s;
    uint obstacle_count;
    uint count;
    uint channels;
};

// Constants for mass that is counted in whole units.
struct FluidMass {
    float cells_per_speed;
    float gain_per_unit; // gain of speed per difference of one unit between neighbours
    uint channels;       // masses per cell; all masses of a cell move along the same paths
};

// How quantities change in a step, besides advection.
struct FluidMatter {
    float density_kept;
    float heat_kept;
    float burnt;    // share of the fuel that burns in a hot cell
    float ignition; // lowest temperature at which fuel burns
    float heat_of_fuel;
    float smoke_of_fuel;
    float condensed;         // share of excess vapour that condenses, or of missing vapour that evaporates
    float saturation;        // vapour that air holds at y = 0 at the temperature of the surroundings
    float saturation_heat;   // growth of the logarithm of saturation per unit of temperature
    float saturation_height; // fall of the logarithm of saturation per metre of height
    float latent_heat;
    float rim_share;      // share of the quantities that leaves next to the faces of an open box
    float rim_cells;      // thickness of the layer in which quantities leave
    float outside_vapour; // vapour of the outside air, limited by its saturation
};

// One level of the multigrid, or of data with the layout of the multigrid; a cell spans 2^level cells of the
// grid. Buffers store all levels, finest first; this level starts at `first`.
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
    uint color; // colour of the cells that are swept
    uint coarse_width;
    uint coarse_height;
};

struct FluidTile {
    FluidLevel level;
    FluidLevel coarse; // the next coarser level
    uint rounds;       // of Jacobi's iteration
};

struct FluidSmall {
    FluidLevel level;
    uint level_count;  // from this level down to a handful of cells
    uint level_number; // number of this level; the grid is level 0
    uint width;        // width of the grid in cells
    uint height;
};

struct FluidWeights {
    uint level_count;
    uint cell_count; // sum over all levels
};

// A transform along one axis: cosines between walls, sines and cosines where the ends are connected.
struct FluidTransform {
    uint width;
    uint height;
    uint depth;
    uint log_length; // of a transformed row
    uint log_pairs;  // row pairs per workgroup
    uint log_turn;   // entries of the angle table for a full turn
    float share;     // factor on the results
};

// Mass is counted in whole units. The weights of the four or eight cells that share a mass add up to exactly
// fluid_mass_whole.
SHARED_CONSTANT uint fluid_mass_unit = 65536U; // units per mass of 1; a power of two, so that floats are exact
SHARED_CONSTANT uint fluid_mass_whole = 32768U;
SHARED_CONSTANT float fluid_most_quantity = 2048.0F; // in whole units; larger quantities are cut to this

SHARED_CONSTANT uint fluid_most_shapes = 64U;
SHARED_CONSTANT uint fluid_stands_still = 0xffffffffU; // a permanently solid cell, which belongs to no shape
SHARED_CONSTANT uint fluid_most_channels = 8U;

// Tiles of the fused passes: a workgroup computes a square of cells and loads a halo around it.
SHARED_CONSTANT uint fluid_tile = 32U;
SHARED_CONSTANT uint fluid_halo = 5U;
SHARED_CONSTANT uint fluid_most_rounds = 4U; // rounds of Jacobi's iteration per pass
SHARED_CONSTANT uint fluid_transform_pairs =
    2048U; // complex numbers in a workgroup's memory; longer rows take twice as many
SHARED_CONSTANT uint fluid_coarsest_cells = 64U; // most cells in the coarsest level of a volume
SHARED_CONSTANT uint fluid_small_cells =
    1024U; // a level with at most this many cells, and all coarser levels, are done by one workgroup

#ifdef __cplusplus
static_assert(sizeof(FluidGrid) == 32);
} // namespace estampe::shared
#endif

#endif
