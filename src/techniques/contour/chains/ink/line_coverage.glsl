// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_COVERAGE
#define ESTAMPE_LINE_COVERAGE

const float widest_px = 96.0; // half width

// A line thinner than a pixel keeps its width and loses darkness.
float coverage(float half_width, float distance)
{
    return clamp(max(half_width, 0.5) + 0.5 - distance, 0.0, 1.0) * min(half_width / 0.5, 1.0);
}

#endif
