// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_POSE_VARIANT_GLSL_H
#define ESTAMPE_POSE_VARIANT_GLSL_H
// Bits of `variant` and constants of pose.comp.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint pose_has_skins = 1U << 0U;
SHARED_CONSTANT uint pose_has_morphs = 1U << 1U;

SHARED_CONSTANT uint most_pose_runs = 8U;

// Runs of consecutive vertices that one dispatch poses.
struct PoseRuns {
    uint run_count;
    uint item_count;             // number of vertices of all runs
    uint firsts[most_pose_runs]; // first vertex of each run
    uint ends[most_pose_runs];   // number of vertices of all runs up to the end of each run
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
