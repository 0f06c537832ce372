// SPDX-License-Identifier: MIT
// One thread decides the visibility of one sample by the majority of the neighbouring samples. In a closed
// chain, the thread also looks for a place to cut the chain open: at a hidden sample, or else at a corner.
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

const int votes_each_side = 1;
const float corner_cosine = 0.5; // cosine of 60 degrees: a larger bend at a sample is a corner

bool is_visible_at(ChainOfSamples chain, int place)
{
    return (sample_at(chain.first + place_in(chain, place)).state & sample_is_visible) != 0u;
}

bool is_corner(ChainOfSamples chain, int place)
{
    vec2 here = sample_at(chain.first + place_in(chain, place)).page_px;
    vec2 arriving = here - sample_at(chain.first + place_in(chain, place - 2)).page_px;
    vec2 leaving = sample_at(chain.first + place_in(chain, place + 2)).page_px - here;
    float lengths = sqrt(dot(arriving, arriving) * dot(leaving, leaving));
    return lengths > 0.0 && dot(arriving, leaving) < corner_cosine * lengths;
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
    int votes = 0;
    for (int i = -votes_each_side; i <= votes_each_side; ++i) {
        votes += is_visible_at(chain, place + i) ? 1 : 0;
    }
    uint before = sample_at(index).state;
    bool is_seen = votes > votes_each_side && (before & sample_is_off_page) == 0u;
    bool is_first = !chain.is_closed && place == 0;
    bool is_last = !chain.is_closed && uint(place) == chain.steps;
    bool turns = !is_first && !is_last && is_corner(chain, place);
    states[index] =
        (before & ~sample_is_visible) | (is_seen ? sample_is_visible : 0u) | (turns ? sample_is_corner : 0u);
    if (chain.is_closed && uint(place) < chain.steps && (!is_seen || turns)) {
        atomicMin(rotation_of_slot[slot], uint(place) | (is_seen ? rotation_to_corner : 0u));
    }
}
