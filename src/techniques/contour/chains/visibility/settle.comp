// SPDX-License-Identifier: MIT
// One thread decides whether the line is drawn at one sample: a hidden part of a chain that is narrower than
// the pen is drawn. In a closed chain, the thread also looks for a place to cut the chain open: at a sample
// that is not drawn, or else at a corner.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 2) readonly buffer FlagsOfSlot
{
    uint flags_of_slot[];
};

#define SAMPLES_BEFORE_BINDING 1
#define SAMPLES_BINDING 3
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 4) writeonly buffer States
{
    uint states[];
};

layout(scalar, binding = 5) buffer RotationOfSlot
{
    uint rotation_of_slot[];
};

#include "techniques/contour/chains/visibility/sample_list.glsl"

layout(push_constant, scalar) uniform Constants
{
    SettleConstants constants;
};

const float corner_cosine = 0.5; // cosine of 60 degrees: a larger bend at a sample is a corner

bool is_visible_at(ChainOfSamples chain, int place)
{
    return (sample_at(chain.first + place_in(chain, place)).state & sample_is_visible) != 0u;
}

// Number of samples that a length on the page takes along a chain.
int samples_in(float length_px, float spacing_px)
{
    return int(ceil(length_px / max(spacing_px, 1.0)));
}

// Whether the line is drawn at a sample: the sample is visible, or in a gap that is narrower than the pen.
bool is_drawn(ChainOfSamples chain, int place, float spacing_px)
{
    bool is_there = is_visible_at(chain, place);
    int gap = clamp(samples_in(constants.widest_gap_px, spacing_px) - 1, 1, int(chain.steps));
    if (!is_there) {
        int before = 1;
        while (before <= gap && !is_visible_at(chain, place - before)) {
            ++before;
        }
        int after = 1;
        while (before + after - 1 <= gap && !is_visible_at(chain, place + after)) {
            ++after;
        }
        is_there = before + after - 1 <= gap;
    }
    return is_there;
}

// Cosine of the bend at a sample.
float bend_at(ChainOfSamples chain, int place)
{
    vec2 here = sample_at(chain.first + place_in(chain, place)).page_px;
    vec2 arriving = here - sample_at(chain.first + place_in(chain, place - 2)).page_px;
    vec2 leaving = sample_at(chain.first + place_in(chain, place + 2)).page_px - here;
    float lengths = sqrt(dot(arriving, arriving) * dot(leaving, leaving));
    return lengths > 0.0 ? dot(arriving, leaving) / lengths : 1.0;
}

// Whether a stroke may end at a corner: it is the sharpest bend within `reach` samples on either side, where
// the chain is visible. Neighbouring samples see the same corner, and only the sharpest counts.
bool is_corner(ChainOfSamples chain, int place, int reach)
{
    float bend = bend_at(chain, place);
    bool is_sharpest = bend < corner_cosine;
    for (int i = 1; is_sharpest && i <= reach; ++i) {
        bool is_there = chain.is_closed || (place >= i && place + i <= int(chain.steps));
        is_sharpest = is_there && is_visible_at(chain, place - i) && is_visible_at(chain, place + i) &&
                      bend_at(chain, place - i) > bend && bend_at(chain, place + i) >= bend;
    }
    return is_sharpest;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count) {
        return;
    }
    uint slot = slot_of_sample(index, sizes[list_slots].count);
    ChainOfSamples chain =
        ChainOfSamples(samples_before(slot), samples_before(slot + 1u) - samples_before(slot) - 1u,
                       (flags_of_slot[slot] & chain_is_closed) != 0u);
    int place = int(index - chain.first);
    uint before = sample_at(index).state;
    float spacing = spacing_of(before);
    bool is_seen = (before & sample_is_off_page) == 0u && is_drawn(chain, place, spacing);
    bool is_first = !chain.is_closed && place == 0;
    bool is_last = !chain.is_closed && uint(place) == chain.steps;
    int reach = samples_in(constants.shortest_px, spacing);
    // A chain that is too short for two strokes has no corners: a speck stays one ring. The bulges of a clump
    // of leaves are drawn in one stroke, too.
    bool has_corners = 2 * reach <= int(chain.steps) && !is_of_foliage(sample_at(index).source);
    bool turns = has_corners && !is_first && !is_last && is_corner(chain, place, reach);
    states[index] =
        (before & ~sample_is_visible) | (is_seen ? sample_is_visible : 0u) | (turns ? sample_is_corner : 0u);
    if (chain.is_closed && uint(place) < chain.steps && (!is_seen || turns)) {
        atomicMin(rotation_of_slot[slot], uint(place) | (is_seen ? rotation_to_corner : 0u));
    }
}
