// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_GLSL_H
#define ESTAMPE_FLUID_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of the fluid shaders' `variant`. The first six bits give the boundary conditions of the axes x, y, z.
SHARED_CONSTANT uint fluid_bit_periodic = 0x1U;  // the axis is periodic; shift left by the axis
SHARED_CONSTANT uint fluid_bit_free_slip = 0x8U; // fluid slides along the axis' walls; shift left by the axis
SHARED_CONSTANT uint fluid_bit_volume = 0x40U;
SHARED_CONSTANT uint fluid_bit_solids = 0x80U;
// Bits of `variant` for advection.
SHARED_CONSTANT uint fluid_bit_scalars = 0x100U; // the pass advects quantities, not the velocity
SHARED_CONSTANT uint fluid_bit_cubic = 0x200U;   // Catmull-Rom splines, not linear interpolation
// Bits of `variant` for forces and for changes of quantities.
SHARED_CONSTANT uint fluid_bit_confined = 0x400U;
SHARED_CONSTANT uint fluid_bit_buoyant = 0x800U; // density and temperature cause weight and lift
SHARED_CONSTANT uint fluid_bit_burning = 0x1000U;
SHARED_CONSTANT uint fluid_bit_condensing = 0x2000U;
SHARED_CONSTANT uint fluid_bit_few = 0x800000U; // the fluid has no quantities beyond density and temperature
// Advection reads displacements that an earlier pass computed.
SHARED_CONSTANT uint fluid_bit_ways = 0x400000U;
SHARED_CONSTANT uint fluid_bit_standing = 0x200000U;   // some cells are solid permanently
SHARED_CONSTANT uint fluid_bit_expanding = 0x1000000U; // fluid above a temperature expands
SHARED_CONSTANT uint fluid_bit_massive = 0x2000000U;   // the expansion adds mass, and no outflow
// Bits of `variant` for Fourier and cosine transforms. Without an axis bit, transforms run along x.
SHARED_CONSTANT uint fluid_bit_along_y = 0x4000U;
SHARED_CONSTANT uint fluid_bit_along_z = 0x8000U;
SHARED_CONSTANT uint fluid_bit_long = 0x10000U; // the rows to transform are longer than fluid_transform_pairs
SHARED_CONSTANT uint fluid_bit_reversed = 0x20000U; // the pass computes the inverse transform
SHARED_CONSTANT uint fluid_bit_dividing =
    // The pass does a forward transform, divides by the eigenvalues of the Laplacian, and transforms back.
    0x40000U;
// Bits of `variant` for one half sweep of the 3D multigrid solver.
SHARED_CONSTANT uint fluid_bit_from_zero = 0x80000U; // the pressure starts at zero
// The sweep first adds the pressure of the next coarser multigrid level.
SHARED_CONSTANT uint fluid_bit_prolonging = 0x100000U;

// Indices of the quantities that have a physical effect; quantities with higher indices are only advected.
SHARED_CONSTANT int fluid_density = 0;
SHARED_CONSTANT int fluid_temperature = 1; // temperature relative to the surroundings
SHARED_CONSTANT int fluid_fuel = 2;
SHARED_CONSTANT int fluid_vapour = 3;
SHARED_CONSTANT int fluid_cloud = 4; // condensed water, as in clouds

// A fluid's grid. Velocities are stored on faces: a cell's component along axis number i is on the face to
// the cell's lower neighbour along that axis. The image array stores component i in layer i * depth + z.
// Quantities are stored at cell centres, channel by channel.
struct FluidGrid {
    uint width; // number of cells along x
    uint height;
    uint depth;     // number of cells along z; 1 in 2D
    float texel_x;  // width of a cell in texture coordinates: 1 / width
    float texel_y;  // height of a cell in texture coordinates: 1 / height
    vec3 lid_speed; // velocity of the wall at the high end of y
};

// Constants of a pass that advects the velocity or quantities (moves them with the flow).
struct FluidAdvect {
    float cells_per_speed; // displacement in cells at speed 1 in the current step
    uint channels;
};

// Constants of one stage of diffusion: weights of the velocity, and of the velocity's rates of change, in
// earlier stages.
struct FluidDiffuse {
    float of_last;
    float of_before_last;
    float of_start;
    float of_last_rate; // weight of the last stage's rate of change, for a Laplacian on cells of size 1
    float of_start_rate;
    vec3 speed_gain; // gain of speed in the step by the uniform force
};

struct FluidForces {
    vec3 speed_gain; // gain of speed in the step by the uniform force
    float kept;      // factor on the speed in a step, because of friction
    float lift;      // gain of vertical speed per unit of temperature
    float weight;    // loss of vertical speed per unit of density
    float confinement;
    float rim_share; // rate of replacement by outside air next to the faces of an open box
    float rim_cells; // thickness of the layer in which air is replaced
    vec3 outside;    // velocity of the air outside an open box
};

// Confinement of slow swirls in a volume.
struct FluidConfine {
    float surplus;    // further confinement of slow swirls, as a share of the confinement
    float swirl_most; // vorticity, for cells of size 1, of a swirl that gets no surplus
};

// A rounded box turned about z, used for obstacles and sources: all points within `radius_m` of the box.
struct FluidShape {
    vec3 centre_m;
    float radius_m;
    vec3 half_m; // half size of the box along the box's own axes
    float angle_rad;
    vec3 speed;     // velocity of the shape in metres per second
    float spin;     // angular speed of the shape in radians per second
    vec4 gain;      // gain of the first four quantities inside, per second
    vec4 more_gain; // gain of quantities five to eight inside, per second
    float push;     // rate at which fluid inside approaches the shape's speed, 1 / s
    float least_density;
    float least_vapour;
};

// A list of moving shapes: obstacles of the fluid first, then sources.
struct FluidShapes {
    float cell_m;
    float age_s; // time since the positions of obstacles and sources in the buffer were valid
    float step_s;
    uint obstacle_count;
    uint count;
    uint channels;
};

// Constants of a field of mass that is counted in whole units.
struct FluidMass {
    float cells_per_speed;
    float gain_per_unit; // gain of speed for a difference in mass of one unit between two neighbour cells
    float damping; // share of the difference in outflow between two cells that is added to the speed of the
                   // face between them
    uint channels; // masses per cell; all masses of a cell move along equal paths
};

// Changes of quantities in a step, in addition to advection.
struct FluidMatter {
    float density_kept;
    float heat_kept;
    float burnt;    // share of the fuel that burns in a hot cell
    float ignition; // lowest temperature at which fuel burns
    float heat_of_fuel;
    float smoke_of_fuel;
    float condensed;  // share of excess vapour that condenses, or of missing vapour that evaporates
    float saturation; // vapour that air holds at the height y = 0, at the temperature of the surroundings
    float saturation_heat;   // growth of the logarithm of saturation per unit of temperature
    float saturation_height; // fall of the logarithm of saturation per metre of height
    float latent_heat;
    float rim_share;      // share of the quantities that leaves next to the faces of an open box
    float rim_cells;      // thickness of the layer in which quantities leave
    float outside_vapour; // vapour of the outside air, limited by the air's saturation
    float expands_above;  // temperature above which the fluid expands
    float excess_kept;    // share of the excess above that temperature that a step of expansion keeps
};

// Expansion of hot fluid in a step.
struct FluidExpansion {
    float expands_above;
    float excess_kept;
    float speed_per_log; // outflow of a cell, per unit of the logarithm of the cell's growth in a step
    float rim_cells;     // thickness of the layer through which fluid leaves; 0: fluid leaves everywhere
    uint part_count;     // number of partial sums
};

// One level of the multigrid solver, or of data stored per multigrid level. A cell of the level with number
// `level` spans 2^level cells of the grid. Buffers store all levels, finest first; the level's data start at
// index `first`.
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
    uint color; // colour (red or black) of the cells that the half sweep changes
    uint coarse_width;
    uint coarse_height;
};

struct FluidTile {
    FluidLevel level;
    FluidLevel coarse; // the next coarser level of the multigrid
    uint rounds;       // number of Jacobi iterations
};

struct FluidSmall {
    FluidLevel level;
    uint level_count;  // number of multigrid levels from the current level down to a level of a few cells
    uint level_number; // number of the multigrid level; level 0 is the grid itself
    uint width;        // width of the grid in cells
    uint height;
};

struct FluidWeights {
    uint level_count;
    uint cell_count; // number of cells of all multigrid levels together
};

// A transform along one axis: a cosine transform between walls, a Fourier transform on a periodic axis.
struct FluidTransform {
    uint width;
    uint height;
    uint depth;
    uint log_length; // logarithm to base 2 of a transformed row's length
    uint log_pairs;  // logarithm to base 2 of the number of row pairs per workgroup
    uint log_turn;   // logarithm to base 2 of the angle table's entries for a full turn
    float share;     // factor on the results of the transform
};

// Mass is counted in whole units. The weights of the four or eight cells that share a mass add up to exactly
// fluid_mass_whole.
SHARED_CONSTANT uint fluid_mass_unit = 65536U; // number of units for a mass of 1
SHARED_CONSTANT uint fluid_mass_whole = 32768U;
SHARED_CONSTANT float fluid_most_quantity = 2048.0F; // larger quantities are clamped before counting

SHARED_CONSTANT uint fluid_most_shapes = 64U;
// Marks a permanently solid cell, which belongs to no moving obstacle.
SHARED_CONSTANT uint fluid_stands_still = 0xffffffffU;
SHARED_CONSTANT uint fluid_most_channels = 8U;

// Side of a tile in the passes that compute several iterations in one dispatch: a workgroup computes a square
// of cells and loads a halo around the square.
SHARED_CONSTANT uint fluid_tile = 32U;
SHARED_CONSTANT uint fluid_halo = 5U;
SHARED_CONSTANT uint fluid_most_rounds = 4U; // most Jacobi iterations per pass
SHARED_CONSTANT uint fluid_transform_pairs =
    2048U; // complex numbers in a workgroup's memory; rows that are longer take twice that number
// Largest number of cells in the coarsest level of the 3D multigrid.
SHARED_CONSTANT uint fluid_coarsest_cells = 64U;
SHARED_CONSTANT uint fluid_small_cells =
    1024U; // largest multigrid level, in cells, that one workgroup computes together with all coarser levels

#ifdef __cplusplus
static_assert(sizeof(FluidGrid) == 32);
} // namespace estampe::shared
#endif

#endif
