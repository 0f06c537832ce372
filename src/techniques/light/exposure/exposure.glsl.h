// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_EXPOSURE_GLSL_H
#define ESTAMPE_EXPOSURE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint exposure_bins = 256U;
SHARED_CONSTANT float exposure_bins_per_stop = 8.0F;
SHARED_CONSTANT float exposure_darkest_stops = -16.0F; // where the first bin begins

// What is remembered of a page's brightness from frame to frame.
struct ExposureState {
    float stops;   // that the page is brightened by
    uint is_known; // 0 before the first frame
    uint bins[exposure_bins];
};

struct AdaptConstants {
    float compensation_stops;
    float most_change_stops; // from the frame before; negative: any
};

#ifdef __cplusplus
static_assert(sizeof(ExposureState) == 1032);
} // namespace estampe::shared
#endif

#endif
