// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_GLSL_H
#define ESTAMPE_CLOTH_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of the variant of cloth shaders.
SHARED_CONSTANT uint cloth_bit_grid = 1U;      // sheets are regular grids: neighbours need no lists
SHARED_CONSTANT uint cloth_bit_colliders = 2U; // there are solids to collide with
SHARED_CONSTANT uint cloth_bit_last = 8U;      // this pass ends a step or a small step
SHARED_CONSTANT uint cloth_bit_gusts = 16U;    // wind speed depends on the place
SHARED_CONSTANT uint cloth_bit_descent = 64U;  // block descent has already solved the links
SHARED_CONSTANT uint cloth_bit_self = 128U;    // sheets collide with themselves
SHARED_CONSTANT uint cloth_bit_flow = 256U;    // a fluid moves the air in some boxes
SHARED_CONSTANT uint cloth_bit_grids = 32U;    // some solids are grids of heights or distances

SHARED_CONSTANT uint cloth_bit_half_held = 512U; // some particles are only partly held

SHARED_CONSTANT uint cloth_bit_seen = 1024U; // some solids are bodies seen from front and back

SHARED_CONSTANT uint cloth_bit_tear = 2048U; // links that become too long are torn

SHARED_CONSTANT uint cloth_bit_roused = 4096U; // wind blows, so no sheet rests in this run
SHARED_CONSTANT uint cloth_bit_lone = 8192U;   // there is one sheet, and ClothRun contains it

SHARED_CONSTANT uint cloth_group = 64U;         // particles of a sheet are padded to whole workgroups
SHARED_CONSTANT uint cloth_tile_side = 8U;      // on a grid, workgroups are squares of this side
SHARED_CONSTANT uint cloth_small_group = 256U;  // threads that share a small sheet
SHARED_CONSTANT uint cloth_small_sheet = 1024U; // most particles of a small sheet
SHARED_CONSTANT uint cloth_small_share = 8U;    // most particles of a small sheet per thread
SHARED_CONSTANT uint cloth_wide_group = 1024U;  // threads per small sheet on a GPU; divides cloth_small_sheet
SHARED_CONSTANT uint cloth_few_sheets = 160U;   // their records fit in the smallest uniform buffer
SHARED_CONSTANT uint cloth_most_tethers = 4U;
SHARED_CONSTANT uint cloth_met_head = 4U;   // numbers of the ball about a group, before what it may meet
SHARED_CONSTANT uint cloth_met_words = 32U; // of 32 solids each, at most: of those after it is not asked
SHARED_CONSTANT uint cloth_most_flows = 8U;
SHARED_CONSTANT uint cloth_torn_bits = 64U;  // of each particle of a sheet that may tear, see cloth_torn.glsl
SHARED_CONSTANT uint cloth_torn_cells = 32U; // on a grid, first of the bits for cells
SHARED_CONSTANT float cloth_breath_m_per_s = 0.05F; // a slower wind moves nothing visibly
SHARED_CONSTANT float cloth_rest_s = 0.5F;          // a sheet that has been calm for this time rests

// A particle's mass is shared among its links. The share of a near link is this many times that of a far one.
SHARED_CONSTANT float cloth_near_share = 3.0F;

SHARED_CONSTANT uint cloth_plane = 0U; // all space below y = 0
SHARED_CONSTANT uint cloth_ellipsoid = 1U;
SHARED_CONSTANT uint cloth_box = 2U;
SHARED_CONSTANT uint cloth_cylinder = 3U;  // with its axis along y
SHARED_CONSTANT uint cloth_capsule = 4U;   // with its axis along y
SHARED_CONSTANT uint cloth_heights = 5U;   // all below heights on an x, z grid; constant beyond the grid
SHARED_CONSTANT uint cloth_distances = 6U; // the solid of signed distances on a grid
SHARED_CONSTANT uint cloth_seen = 7U;      // the space between the front and the back of a body, along z
SHARED_CONSTANT uint cloth_kind_bits = 3U;
SHARED_CONSTANT uint cloth_grid_head = 6U;  // words before a grid's numbers: nodes per axis, half its size
SHARED_CONSTANT uint cloth_seen_head = 1U;  // texels before a body's data: nodes per axis
SHARED_CONSTANT uint cloth_seen_skirt = 5U; // nodes this far outside a body's outline count as far
SHARED_CONSTANT float cloth_seen_nowhere_m = 1e3F; // distance from the outline that means: no body

// A cloth sheet. Its particles start at index `first`; there are `count`, padded to `stride`. The k-th link
// of particle i has index first_link + k * stride + i; faces and tethers are indexed likewise.
struct ClothSheet {
    uint first;
    uint count;
    uint stride;
    uint columns; // of a grid; 0 for other sheets
    uint rows;
    uint link_width;
    uint first_link;
    uint face_width;
    uint first_face;
    uint tether_width;
    uint first_tether;
    float spacing_x_m; // spacing of a grid's particles
    float spacing_y_m;
    float softness;    // of a grid's links: compliance in m / N of a link of 1 m
    float bending_n_m; // flexural rigidity, lowered if a step is too long for it
    float fold;
    float mass_kg_m2;
    float drag;
    float lift;
    float damping_per_s;
    float friction;
    float thickness_m;
    float winding; // of a grid: side that its faces look to, 1 or -1
    float self_m;  // distance for self-collision; 0: none
    float tear;    // links tear at this multiple of their rest length; 0: never
};

// A link to a near particle. Its rest length is negative if other particles lie between the two.
struct ClothLink {
    uint other;
    float rest_m;
    float compliance_m_n;
    float bending; // at flexural rigidity 1: force per metre
};

// A box of air, measured in cells of its grid.
struct ClothFlow {
    mat4 cells_from_place; // relative to the low corner
    uvec3 cells;
    uint first; // index of the first velocity, in the middle of a cell
};

// Parameters of a run of steps, common to all sheets.
struct ClothRun {
    vec3 gravity_m_s2;
    float step_s;
    uint step_count;
    uint small_steps; // small steps per step
    uint collider_count;
    uint collider_stride; // offset from colliders at the run's beginning to the end; 0: all still
    vec3 wind_m_per_s;
    vec3 ahead_m;     // way of the wind beyond its velocity times the time
    float gustiness;  // share of the wind speed that varies
    float gust_m;     // mean distance between gusts
    float turbulence; // speed of eddies, as a share of the wind speed
    float eddy_m;     // size of eddies
    float time_s;     // at the beginning of the first step
    float air_kg_m3;
    float most_speed_m_per_s;
    vec3 origin_m;      // origin of cloth positions, in the space of the wind
    float rest_m_per_s; // slower particles are calm; negative: none is
    uint roused_steps;  // in the first steps of this number, no sheet rests
    uint bodies_move;   // bodies deform, besides the motion of their solids
    uint flow_count;
    ClothFlow flows[cloth_most_flows];
    ClothSheet lone_sheet;
};

// Position of a pass within a run.
struct ClothMoment {
    uint step;
    uint small_step;
    uint first_group; // index into the list of sheets by group
};

// Parameters of the search for near particles, for the self-collision of a sheet.
struct ClothNearConstants {
    uint first_group;
    uint cell_mask; // number of cells of the hash table, less 1
    uint is_search; // 1: particles search; 0: particles enter themselves
    uint step;
};

// A collider at the beginning or the end of a run: rotated first, then translated.
struct ClothCollider {
    vec3 centre_m;
    uint kind;     // kind; above cloth_kind_bits, the index of its grid's numbers
    vec4 rotation; // quaternion, with the scalar last
    vec3 half_m;   // radii of an ellipsoid, half a box or grid, radius, half height and radius of the others
    float reach_m; // places farther from the centre are outside
};

// A body that is seen along its z axis, with the rotation of its solid.
struct ClothBody {
    vec4 rotation;
    vec3 centre_m;
    uint first_triangle;
    vec3 half_m;
    uint triangle_count;
    uvec2 nodes;
    uint first; // index of its head
};

// The posed vertex that holds a particle, and how strongly.
struct ClothHold {
    uint vertex;
    float share;
};

SHARED_CONSTANT uint cloth_no_vertex = 0xffffffffU; // marks padding of a workgroup

// A vertex of the drawn mesh.
struct ClothVertex {
    uint vertex;
    uint particle; // index within its sheet; with cloth_on_back on the back
};

SHARED_CONSTANT uint cloth_on_back = 0x80000000U;

#ifdef __cplusplus
static_assert(sizeof(ClothSheet) == 100);
static_assert(cloth_few_sheets * sizeof(ClothSheet) <= 16384); // as Vulkan has it
static_assert(cloth_small_sheet % cloth_wide_group == 0);
static_assert(sizeof(ClothLink) == 16);
static_assert(sizeof(ClothCollider) == 48);
} // namespace estampe::shared
#endif

#endif
