// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRAILS_GLSL_H
#define ESTAMPE_TRAILS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// The texels of a window on the ground. A texel of the ground is kept at its number modulo the side, so that
// nothing is moved when the window is.
struct TrailWindow {
    uint side;    // texels, a power of two
    uint first_x; // where the window's first texel is kept
    uint first_y;
};

struct TrailPress {
    TrailWindow window;
    int base_x; // the texel that places are counted from, seen from the window's first
    int base_y;
    int low_x; // what is touched, in texels from the base
    int low_y;
    int high_x;
    int high_y;
    vec2 from; // ends of what is pressed in, metres from the base's centre
    vec2 to;
    float from_radius_m;
    float to_radius_m;
    float depth_m;
    float rim_m; // width of the rim
    float texel_m;
    float steepness; // of the sole's edge
    int moved_x;     // of the window: texels that it has kept are left, if what is pressed is known
    int moved_y;
    uint is_known; // pressed in before, on ground that was level
};

struct TrailSlump {
    TrailWindow window;
    uint skip_x; // 0 or 1: where blocks of two by two begin in the window
    uint skip_y;
    float beside_m; // that a texel may be higher than the one beside it
    float aslant_m; // the same across a corner
};

struct TrailFill {
    TrailWindow window;
    int moved_x; // of the window since the texels were made
    int moved_y;
    uint steps; // that pass
    float kept; // of a height in a step
};

struct TrailImageConstants {
    TrailWindow window;
    uint edge; // texels over which trails fade towards the window's edge
};

struct TrailRelief {
    vec2 corner_m; // of the image, from the anchor
    float texel_m;
    uint draw;        // whose surface is trodden
    vec3 towards_sun; // unit; 0: there is none
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
