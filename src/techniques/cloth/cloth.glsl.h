// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_GLSL_H
#define ESTAMPE_CLOTH_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of the shaders' variants.
SHARED_CONSTANT uint cloth_bit_grid = 1U;      // sheets are regular grids: neighbours need no lists
SHARED_CONSTANT uint cloth_bit_colliders = 2U; // there is something to run into
SHARED_CONSTANT uint cloth_bit_last = 8U;      // this pass ends a step, or a small one
SHARED_CONSTANT uint cloth_bit_gusts = 16U;    // the wind is not the same everywhere
SHARED_CONSTANT uint cloth_bit_descent = 64U;  // links have been solved before, by block descent
SHARED_CONSTANT uint cloth_bit_self = 128U;    // sheets do not pass through themselves
SHARED_CONSTANT uint cloth_bit_flow = 256U;    // there are boxes of air that a fluid moves
SHARED_CONSTANT uint cloth_bit_grids = 32U;    // among what it runs into are grids of heights or distances

SHARED_CONSTANT uint cloth_bit_half_held = 512U; // some particles are held a little

SHARED_CONSTANT uint cloth_bit_seen = 1024U; // and bodies that are seen from the front and the back

SHARED_CONSTANT uint cloth_bit_tear = 2048U; // links that become too long are gone

SHARED_CONSTANT uint cloth_bit_roused = 4096U; // wind blows: no sheet rests in this run
SHARED_CONSTANT uint cloth_bit_lone = 8192U;   // there is one sheet, which the run tells of

SHARED_CONSTANT uint cloth_group = 64U;         // particles of a sheet are padded to whole workgroups
SHARED_CONSTANT uint cloth_tile_side = 8U;      // of a grid they go by squares of so many each way
SHARED_CONSTANT uint cloth_small_group = 256U;  // threads that share a small sheet
SHARED_CONSTANT uint cloth_small_sheet = 1024U; // particles that it has at most
SHARED_CONSTANT uint cloth_small_share = 8U;    // those of one of them, at most
SHARED_CONSTANT uint cloth_wide_group = 1024U; // threads that share one on a GPU; a part of cloth_small_sheet
SHARED_CONSTANT uint cloth_few_sheets = 160U;  // whose numbers fit in the smallest uniform buffer
SHARED_CONSTANT uint cloth_most_tethers = 4U;
SHARED_CONSTANT uint cloth_met_head = 4U;   // numbers of the ball about a group, before what it may meet
SHARED_CONSTANT uint cloth_met_words = 32U; // of 32 solids each, at most: of those after it is not asked
SHARED_CONSTANT uint cloth_most_flows = 8U;
SHARED_CONSTANT uint cloth_torn_bits = 64U;  // of each particle of a sheet that may tear, see cloth_torn.glsl
SHARED_CONSTANT uint cloth_torn_cells = 32U; // where of a grid those of cells begin
SHARED_CONSTANT float cloth_breath_m_per_s = 0.05F; // what blows less moves nothing of note
SHARED_CONSTANT float cloth_rest_s = 0.5F;          // a sheet that has been calm for so long rests

// A particle's mass is shared among its links: those to direct neighbours have so much more than far ones.
SHARED_CONSTANT float cloth_near_share = 3.0F;

SHARED_CONSTANT uint cloth_plane = 0U; // all below y = 0
SHARED_CONSTANT uint cloth_ellipsoid = 1U;
SHARED_CONSTANT uint cloth_box = 2U;
SHARED_CONSTANT uint cloth_cylinder = 3U; // about y
SHARED_CONSTANT uint cloth_capsule = 4U;  // along y
SHARED_CONSTANT uint cloth_heights =
    5U; // all below heights on a grid in x and z, which go on level beyond it
SHARED_CONSTANT uint cloth_distances = 6U; // what distances on a grid say
SHARED_CONSTANT uint cloth_seen = 7U;      // what lies between the front and the back of a body, along z
SHARED_CONSTANT uint cloth_kind_bits = 3U;
SHARED_CONSTANT uint cloth_grid_head = 6U;  // numbers before those of a grid: nodes each way, half its size
SHARED_CONSTANT uint cloth_seen_head = 1U;  // texels before those of a body: nodes each way
SHARED_CONSTANT uint cloth_seen_skirt = 5U; // nodes from its outline from which on it is far
SHARED_CONSTANT float cloth_seen_nowhere_m = 1e3F; // is as far from the outline

// A sheet. Its particles begin at `first` and are `count`, padded to `stride`; the k-th link of particle i is
// at first_link + k * stride + i, and so are faces and tethers.
struct ClothSheet {
    uint first;
    uint count;
    uint stride;
    uint columns; // of a grid, 0 of others
    uint rows;
    uint link_width;
    uint first_link;
    uint face_width;
    uint first_face;
    uint tether_width;
    uint first_tether;
    float spacing_x_m; // of a grid
    float spacing_y_m;
    float softness;    // of a grid's links: compliance in m / N for a link of 1 m
    float bending_n_m; // flexural rigidity, less where a step is too long for it
    float fold;
    float mass_kg_m2;
    float drag;
    float lift;
    float damping_per_s;
    float friction;
    float thickness_m;
    float winding; // of a grid: which way its faces look, 1 or -1
    float self_m;  // how far it keeps from itself, 0 where it does not
    float tear;    // how many times as long as at rest links tear at, 0 where they never do
};

// To a particle nearby. Its rest length is negative where others lie between the two.
struct ClothLink {
    uint other;
    float rest_m;
    float compliance_m_n;
    float bending; // of flexural rigidity 1: force a metre
};

// A box of air, in cells.
struct ClothFlow {
    mat4 cells_from_place; // from the low corner
    uvec3 cells;
    uint first; // where the speeds in the middle of cells begin
};

// Of a run of steps, all sheets alike.
struct ClothRun {
    vec3 gravity_m_s2;
    float step_s;
    uint step_count;
    uint small_steps; // a step is cut into
    uint collider_count;
    uint collider_stride; // from the beginning of the run to its end, 0 where all stand still
    vec3 wind_m_per_s;
    vec3 ahead_m;     // that it has blown farther than that times the time
    float gustiness;  // share of the speed that comes and goes
    float gust_m;     // from one gust to the next, about
    float turbulence; // speed of eddies, as a share
    float eddy_m;     // their size
    float time_s;     // of the first step's beginning
    float air_kg_m3;
    float most_speed_m_per_s;
    vec3 origin_m;      // of places, in that of the wind
    float rest_m_per_s; // what is slower is calm; negative: nothing is
    uint roused_steps;  // in so many no sheet rests, whatever it does
    uint bodies_move;   // otherwise than their solids do
    uint flow_count;
    ClothFlow flows[cloth_most_flows];
    ClothSheet lone_sheet;
};

// Where a pass is within a run.
struct ClothMoment {
    uint step;
    uint small_step;
    uint first_group; // into the list of sheets by group
};

// Who is near whom in a sheet that keeps from itself.
struct ClothNearConstants {
    uint first_group;
    uint cell_mask; // cells of the table less 1
    uint is_search; // else all enter themselves
    uint step;
};

// At the beginning of a run, or at its end: turned, then moved.
struct ClothCollider {
    vec3 centre_m;
    uint kind;     // and, above cloth_kind_bits, where the numbers of its grid begin
    vec4 rotation; // quaternion, the scalar last
    vec3 half_m;   // radii of an ellipsoid, half a box or grid, radius, half height and radius of the others
    float reach_m; // what is farther from the centre is outside
};

// A body that is seen along its z, turned as its solid.
struct ClothBody {
    vec4 rotation;
    vec3 centre_m;
    uint first_triangle;
    vec3 half_m;
    uint triangle_count;
    uvec2 nodes;
    uint first; // of its head
};

// Where a particle is held: at a posed vertex, and how much.
struct ClothHold {
    uint vertex;
    float share;
};

SHARED_CONSTANT uint cloth_no_vertex = 0xffffffffU; // of what fills a workgroup up

// A vertex that is drawn.
struct ClothVertex {
    uint vertex;
    uint particle; // within its sheet; cloth_on_back for one of the other side
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
