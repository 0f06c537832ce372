// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_GLSL_H
#define ESTAMPE_CLOTH_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of the specialization constant `variant` of cloth shaders.
SHARED_CONSTANT uint cloth_bit_grid = 1U;      // the sheets are regular grids, so neighbours need no lists
SHARED_CONSTANT uint cloth_bit_colliders = 2U; // the cloth collides with solids
SHARED_CONSTANT uint cloth_bit_last = 8U;      // the pass ends a step or a small step of the cloth solver
SHARED_CONSTANT uint cloth_bit_gusts = 16U;    // the wind has gusts, so its speed depends on the place
SHARED_CONSTANT uint cloth_bit_descent = 64U;  // block descent has already solved the links
SHARED_CONSTANT uint cloth_bit_self = 128U;    // sheets collide with themselves
SHARED_CONSTANT uint cloth_bit_flow = 256U;    // a fluid simulation moves the air in some boxes
SHARED_CONSTANT uint cloth_bit_grids = 32U;    // some solids are grids of heights or of signed distances

// Some particles are only partly held by the object to which the cloth is attached.
SHARED_CONSTANT uint cloth_bit_half_held = 512U;

// Some solids are deforming bodies, measured from the front and the back.
SHARED_CONSTANT uint cloth_bit_seen = 1024U;

SHARED_CONSTANT uint cloth_bit_tear = 2048U; // links that become too long are torn

// Wind blows, so no sheet comes to rest in the current run of steps.
SHARED_CONSTANT uint cloth_bit_roused = 4096U;
SHARED_CONSTANT uint cloth_bit_lone = 8192U; // only one sheet exists, and ClothRun contains its record

// Threads per workgroup; each sheet's particles are padded to whole workgroups.
SHARED_CONSTANT uint cloth_group = 64U;
// Side of a square workgroup, in particles, for sheets that are regular grids.
SHARED_CONSTANT uint cloth_tile_side = 8U;
SHARED_CONSTANT uint cloth_small_group = 256U;  // threads per small sheet on a CPU
SHARED_CONSTANT uint cloth_small_sheet = 1024U; // largest number of particles of a small sheet
SHARED_CONSTANT uint cloth_small_share = 8U;    // largest number of particles per thread, for a small sheet
SHARED_CONSTANT uint cloth_wide_group = 1024U;  // threads per small sheet on a GPU; divides cloth_small_sheet
// Largest number of sheets in the uniform buffer; fits the smallest uniform buffer of Vulkan.
SHARED_CONSTANT uint cloth_few_sheets = 160U;
SHARED_CONSTANT uint cloth_most_tethers = 4U;
// Number of floats of a group's bounding ball, which precede the bits of nearby solids.
SHARED_CONSTANT uint cloth_met_head = 4U;
// Most words of nearby-solid bits per group, 32 solids per word; solids beyond are always tested.
SHARED_CONSTANT uint cloth_met_words = 32U;
SHARED_CONSTANT uint cloth_most_flows = 8U;
// Bits of torn links per particle of a sheet that may tear, see cloth_torn.glsl.
SHARED_CONSTANT uint cloth_torn_bits = 64U;
// First bit, in a particle's word of torn bits, that stands for a grid cell and not for a link.
SHARED_CONSTANT uint cloth_torn_cells = 32U;
// Wind speed below which wind moves nothing visibly and is ignored.
SHARED_CONSTANT float cloth_breath_m_per_s = 0.05F;
// A sheet comes to rest when all particles of the sheet have been calm (slow) for cloth_rest_s seconds.
SHARED_CONSTANT float cloth_rest_s = 0.5F;

// A particle's mass is shared among its links. The share of a link to a near particle, as a multiple of the
// share of a link to a far particle.
SHARED_CONSTANT float cloth_near_share = 3.0F;

SHARED_CONSTANT uint cloth_plane = 0U; // kind of solid: all space below y = 0
SHARED_CONSTANT uint cloth_ellipsoid = 1U;
SHARED_CONSTANT uint cloth_box = 2U;
SHARED_CONSTANT uint cloth_cylinder = 3U; // kind of solid: cylinder with its axis along y
SHARED_CONSTANT uint cloth_capsule = 4U;  // kind of solid: capsule with its axis along y
// Kind of solid: all space below heights on an x, z grid; heights are constant beyond the grid.
SHARED_CONSTANT uint cloth_heights = 5U;
SHARED_CONSTANT uint cloth_distances = 6U; // kind of solid: signed distances to a surface, on a grid
// Kind of solid: the space between the front and the back surface of a body, along z.
SHARED_CONSTANT uint cloth_seen = 7U;
SHARED_CONSTANT uint cloth_kind_bits = 3U;
// Words before a solid's grid numbers: nodes per axis, half the grid's size.
SHARED_CONSTANT uint cloth_grid_head = 6U;
SHARED_CONSTANT uint cloth_seen_head = 1U; // texels before the data of a body with two surfaces
// Width, in nodes, of the band outside a body's outline where distances are computed.
SHARED_CONSTANT uint cloth_seen_skirt = 5U;
SHARED_CONSTANT float cloth_seen_nowhere_m = 1e3F; // distance from the outline at places without a body

// A cloth sheet. The sheet's particles start at index `first`; the sheet has `count` particles, padded to
// `stride`. Link number k of particle number i has the index first_link + k * stride + i; faces and tethers
// are indexed likewise.
struct ClothSheet {
    uint first;
    uint count;
    uint stride;
    uint columns; // columns of the sheet's regular grid; 0 if the sheet is no grid
    uint rows;
    uint link_width;
    uint first_link;
    uint face_width;
    uint first_face;
    uint tether_width;
    uint first_tether;
    float spacing_x_m; // spacing of particles in a regular grid
    float spacing_y_m;
    float softness;    // compliance of a grid's links, in m / N for a link of 1 m
    float bending_n_m; // bending stiffness of the cloth, lowered if a step is too long to be stable
    float fold;
    float mass_kg_m2;
    float drag;
    float lift;
    float damping_per_s;
    float friction;
    float thickness_m;
    float winding; // side that the faces of a grid look to, 1 or -1
    float self_m;  // distance that self-collision keeps between particles; 0: no self-collision
    float tear;    // length at which a link tears, as a multiple of the link's rest length; 0: never
};

// A link to a nearby particle. The link's rest length is negative if other particles lie between the two
// linked particles.
struct ClothLink {
    uint other;
    float rest_m;
    float compliance_m_n;
    float bending; // bending force per metre of displacement, at a flexural rigidity of 1
};

// A box of air whose velocity a fluid simulation gives, measured in cells of the fluid's grid.
struct ClothFlow {
    mat4 cells_from_place; // converts a place to grid cells, relative to the box's low corner
    uvec3 cells;
    uint first; // index of the box's first velocity; velocities are in the middle of cells
};

// Parameters of a run of simulation steps, common to all cloth sheets.
struct ClothRun {
    vec3 gravity_m_s2;
    float step_s;
    uint step_count;
    uint small_steps; // small steps per simulation step
    uint collider_count;
    // Number of collider records from the run's beginning to its end in the collider buffer; 0: all colliders
    // are still.
    uint collider_stride;
    vec3 wind_m_per_s;
    vec3 ahead_m;     // distance that the wind's pattern has moved, in addition to wind velocity times time
    float gustiness;  // share of the wind speed that varies with gusts
    float gust_m;     // mean distance between gusts of the wind
    float turbulence; // speed of eddies, as a share of the wind speed
    float eddy_m;     // size of eddies in the wind
    float time_s;     // time at the beginning of the first step
    float air_kg_m3;
    float most_speed_m_per_s;
    vec3 origin_m;      // origin of cloth positions, in the coordinates of the wind
    float rest_m_per_s; // speed below which a particle is calm; negative: no particle is calm
    uint roused_steps;  // number of steps at the run's beginning in which no sheet rests
    uint bodies_move;   // 1 if bodies deform in the run of steps, in addition to moving as rigid solids
    uint flow_count;
    ClothFlow flows[cloth_most_flows];
    ClothSheet lone_sheet;
};

// Position of a compute pass within a run of cloth steps.
struct ClothMoment {
    uint step;
    uint small_step;
    uint first_group; // index of the first workgroup in the list of sheets by workgroup
};

// Parameters of the search for nearby particles, for the self-collision of a sheet.
struct ClothNearConstants {
    uint first_group;
    uint cell_mask; // number of cells of the hash table, minus 1
    uint is_search; // 1: particles search the hash table; 0: particles enter themselves into the table
    uint step;
};

// A collider at the beginning or the end of a run. The collider is rotated first, then translated.
struct ClothCollider {
    vec3 centre_m;
    uint kind;     // kind of solid in the low bits; above cloth_kind_bits, the index of the grid's numbers
    vec4 rotation; // rotation as a quaternion, with the scalar last
    // Radii of an ellipsoid, half size of a box or grid, or radius, half height and radius of other solids.
    vec3 half_m;
    float reach_m; // distance from the centre beyond which every place is outside
};

// A deforming body that cloth collides with. The body's front and back surfaces are measured along the z axis
// of the body's solid.
struct ClothBody {
    vec4 rotation;
    vec3 centre_m;
    uint first_triangle;
    vec3 half_m;
    uint triangle_count;
    uvec2 nodes;
    uint first; // index of the body's first texel, which holds the number of its nodes per axis
};

// The posed vertex that holds a particle, and the strength of the hold.
struct ClothHold {
    uint vertex;
    float share;
};

SHARED_CONSTANT uint cloth_no_vertex = 0xffffffffU; // vertex number that marks the padding of a workgroup

// A vertex of the drawn cloth mesh.
struct ClothVertex {
    uint vertex;
    uint particle; // index of the particle within its sheet; cloth_on_back is added for a vertex on the back
};

SHARED_CONSTANT uint cloth_on_back = 0x80000000U;

#ifdef __cplusplus
static_assert(sizeof(ClothSheet) == 100);
// The sheets must fit in the smallest uniform buffer that Vulkan guarantees.
static_assert(cloth_few_sheets * sizeof(ClothSheet) <= 16384);
static_assert(cloth_small_sheet % cloth_wide_group == 0);
static_assert(sizeof(ClothLink) == 16);
static_assert(sizeof(ClothCollider) == 48);
} // namespace estampe::shared
#endif

#endif
