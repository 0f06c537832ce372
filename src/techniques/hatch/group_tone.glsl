// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_GROUP_TONE
#define ESTAMPE_GROUP_TONE

// Rounds the darkness of strokes to one of `count` tones, counted from 0 for paper.

uint group_of(float dark, uint count)
{
    return uint(clamp(dark, 0.0, 1.0) * float(count - 1u) + 0.5);
}

// Darkness of a tone.
float tone_of_group(uint group, uint count)
{
    return float(group) / float(count - 1u);
}

#endif
