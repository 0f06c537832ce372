// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SKY_GLSL_H
#define ESTAMPE_SKY_GLSL_H
// Data that the shaders of sky and clouds share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bit (compiled-in feature) of sky.comp: paints only the tiles in a list.
SHARED_CONSTANT uint sky_has_tiles = 1U << 0U;
// Variant bit of sky.comp: skips pixels that show a surface nearer than `far_m`, because the surface hides
// the sky.
SHARED_CONSTANT uint sky_has_depth = 1U << 1U;

SHARED_CONSTANT uint sky_has_halo = 1U << 2U; // strokes thin out around things

struct SkyConstants {
    vec3 horizon_color;
    float stroke_width_px;
    vec3 zenith_color;
    float darkness; // darkness of the strokes at the zenith, on the side away from the sun
    vec3 towards_sun;
    vec3 high_color; // linear colour of the band high in the sky
    float high_rad;  // elevation angle of the middle of the high band's soft lower edge, in radians
    vec3 low_color;
    float low_rad;
    vec3 disc_color;
    float disc_rad; // angular radius of the disc of sun or moon; 0: no disc
    vec3 towards_disc;
    float disc_lit; // lit share of the disc's width
    float steps;    // number of flat tones of the wash; 0: a smooth gradient
    float far_m;    // only with sky_has_depth: surfaces nearer to the eye than `far_m` hide the sky
    float halo_px;  // width of the halo around things in which strokes thin out
};

// Variant bits: each bit compiles one feature into the shader clouds.comp.
SHARED_CONSTANT uint clouds_have_hatching = 1U << 0U;
SHARED_CONSTANT uint clouds_have_streaks = 1U << 1U;

// An input image of the share of sunlight exists; the image contains the shadows of other objects.
SHARED_CONSTANT uint clouds_have_share = 1U << 2U;
SHARED_CONSTANT uint clouds_keep_cover = 1U << 3U; // also outputs the clouds' coverage of each pixel
SHARED_CONSTANT uint clouds_have_tiles = 1U << 4U; // paints only tiles in a list
SHARED_CONSTANT uint clouds_have_depth = 1U << 5U; // skips pixels that show a surface nearer than `far_m`
SHARED_CONSTANT uint clouds_by_groups = 1U << 6U;  // the pixels of a workgroup find their puffs together

SHARED_CONSTANT uint most_puff_layers = 2U;
SHARED_CONSTANT float puff_wavers = 1.2F; // largest radius of a wavering outline, in radii of its puff

// The space of a cloud layer: coordinates along the wind, above the base and across the wind, in cells. The
// clouds repeat after a tile of `cells` x `cells` cells. Puffs (parts of a cloud) are balls in the cloud
// layer's coordinates, but may be flat or long in metres.

// A puff, a ball of cloud. The puff is stored in two texels of four floats.
struct CloudPuff {
    vec3 centre; // position in cells of the cloud layer, on the repeated tile or next to it
    float radius;
    vec3 lean;   // unit vector in metres: direction in which the cloud mass around the puff thins out
    float trait; // random number of the puff, 0 to 1
};

// A layer of puffs (balls of cloud), cut flat by its base.
struct PuffLayer {
    vec3 eye;      // position of the eye in layer space, wrapped to the tile
    float base_m;  // height of the base above the eye
    vec3 per_m;    // cells per metre along each axis of the cloud layer
    float thick_m; // thickness of the layer
    float pen;     // factor on the width of the outlines
    float under;   // how much darker the base of the clouds is
    uint cells;
    // Index of the first cell in the list of starts, for lists of all puffs that touch a cell.
    uint first_cell;
    // Index of the first cell in the list of starts, for lists of puffs whose centre lies in a cell.
    uint first_home;
    float reach; // largest radius of a puff including its outline, in cells
};

// A layer of cirrus clouds: white strokes on a plane. The density of the strokes is stored at the corners of
// cells.
struct StreakLayer {
    vec2 eye; // position of the eye on the tile, along and across the wind, in cells
    float base_m;
    float cell_m;
    uint cells;
    float width_px;
};

struct CloudGlobals {
    PuffLayer puffs[most_puff_layers]; // the layers of puffs, the lowest layer first
    StreakLayer streaks;
    uint puff_layer_count;
    vec2 along_wind;  // unit vector of the wind's direction, as (x, z)
    vec3 towards_sun; // unit vector in the wind's axes: along, up, across
    vec3 lit_color;   // transmittance of the paint on lit surfaces
    vec3 middle_color;
    vec3 shade_color;
    float shade_below; // light below which a surface is shaded
    float middle_band; // range of light below `shade_below` that is drawn in the middle tone
    float outline_px;
    float broken; // share of the outline on the lit side that is left out
    float hatch_darkness;
    float hatch_width_px;
    float reach_m; // distance from the eye at which clouds have dissolved
};

// Constants of clouds.comp for skipping pixels whose surface hides the clouds; used only with
// clouds_have_depth.
struct CloudCover {
    float far_m; // distance from the eye; no clouds are painted over nearer surfaces
};

struct CloudShadow {
    float strength;
};

#ifdef __cplusplus
static_assert(sizeof(CloudPuff) == 32);
} // namespace estampe::shared
#endif

#endif
