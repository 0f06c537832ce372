// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_EXPOSURE_GLSL_H
#define ESTAMPE_EXPOSURE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

// What is remembered of a page's brightness from frame to frame. A bin is an eighth of a stop; the first one
// begins 16 stops below one.
struct ExposureState {
    float stops;   // that the page is brightened by
    uint is_known; // 0 before the first frame
    uint bins[256];
};

struct AdaptConstants {
    float compensation_stops;
    float most_change_stops; // from the frame before; negative: any
};

#ifdef __cplusplus
static_assert(sizeof(ExposureState) == 1032);
} // namespace estampe::shared
#else
#define EXPOSURE_BINS 256u
#define EXPOSURE_BINS_PER_STOP 8.0
#define EXPOSURE_DARKEST_STOPS (-16.0)
#endif

#endif
