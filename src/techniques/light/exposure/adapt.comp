// SPDX-License-Identifier: MIT
// A single thread reads the histogram, moves the exposure towards its target, and clears the histogram for
// the next frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/light/light.glsl.h"

layout(local_size_x = 1) in;

layout(scalar, binding = 0) buffer State
{
    ExposureState state;
};

layout(push_constant, scalar) uniform Constants
{
    AdaptConstants constants;
};

// The exposure is measured on the pixels from the 70th to the 90th percentile of the page's brightness.
const float key_from = 0.7;
const float key_to = 0.9;

void main()
{
    uint total = 0u;
    for (uint i = 0u; i < exposure_bins; ++i) {
        total += state.bins[i];
    }
    float first = key_from * float(total);
    float last = max(key_to * float(total), first + 1e-3);
    float passed = 0.0;
    float sum = 0.0;
    float weight = 0.0;
    for (uint i = 0u; i < exposure_bins; ++i) {
        float count = float(state.bins[i]);
        float part = max(min(passed + count, last) - max(passed, first), 0.0);
        sum += part * ((float(i) + 0.5) / exposure_bins_per_stop + exposure_darkest_stops);
        weight += part;
        passed += count;
        state.bins[i] = 0u;
    }
    bool jumps = state.is_known == 0u || constants.most_change_stops < 0.0;
    float wanted = weight > 0.0 ? constants.compensation_stops - sum / weight : state.stops;
    float change = wanted - state.stops;
    float most = constants.most_change_stops;
    state.stops = jumps ? wanted : state.stops + clamp(change, -most, most);
    state.is_known = weight > 0.0 ? 1u : state.is_known;
}
