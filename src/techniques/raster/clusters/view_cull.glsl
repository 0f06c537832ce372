// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VIEW_CULL
#define ESTAMPE_VIEW_CULL

// Tests whether a view may show any part of a cluster of triangles.

#include "techniques/raster/raster.glsl.h"

// Whether some corner of the box lies on the inner side of a plane, where the plane's equation gives 0 or
// more.
bool reaches_side(vec3 centre, vec3 half_size, vec4 plane)
{
    return dot(plane.xyz, centre) + plane.w + dot(abs(plane.xyz), half_size) >= 0.0;
}

// Whether a view may show a cluster's box. False only if the box is entirely outside a side plane or the near
// plane of the view.
bool may_show(ClusterBounds bounds, mat4 clip_from_anchor)
{
    vec3 centre = 0.5 * (bounds.low + bounds.high);
    // The box is enlarged slightly, to allow for rounding.
    vec3 half_size = 0.50001 * (bounds.high - bounds.low) + 1e-6 * abs(centre);
    mat4 rows = transpose(clip_from_anchor);
    return reaches_side(centre, half_size, rows[3] + rows[0]) &&
           reaches_side(centre, half_size, rows[3] - rows[0]) &&
           reaches_side(centre, half_size, rows[3] + rows[1]) &&
           reaches_side(centre, half_size, rows[3] - rows[1]) &&
           reaches_side(centre, half_size, rows[3] - rows[2]);
}

// Whether one of many views may show a cluster's box. Also false if the view skips the batch, or if the box
// is beyond the view's reach.
bool may_show(ClusterBounds bounds, uint groups, RasterView view)
{
    if ((view.groups & groups) == 0u) {
        return false;
    }
    vec3 gap = max(max(bounds.low - view.eye_anchor, view.eye_anchor - bounds.high), vec3(0.0));
    if (dot(gap, gap) > view.reach_m * view.reach_m) {
        return false;
    }
    return may_show(bounds, view.clip_from_anchor);
}

#endif
