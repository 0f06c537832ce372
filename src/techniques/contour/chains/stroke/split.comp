// SPDX-License-Identifier: MIT
// One thread stores one sample at the sample's place in its chain, after closed chains are cut open. The
// thread also decides whether a line runs on to the next sample, and whether a stroke starts at the sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/unit.glsl"
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

layout(scalar, binding = 3) readonly buffer RotationOfSlot
{
    uint rotation_of_slot[];
};

#define SAMPLES_BEFORE_BINDING 1
#define SAMPLES_BINDING 4
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 5) readonly buffer States
{
    uint states[];
};

layout(scalar, binding = 6) writeonly buffer CutSamples
{
    LineSample cut_samples[];
};

layout(scalar, binding = 7) writeonly buffer Starts
{
    uint starts[]; // for each sample: 1 if a stroke starts at the sample
};

#include "techniques/contour/chains/visibility/sample_list.glsl"

layout(constant_id = 0) const uint variant = 0u;
const bool wants_hidden = (variant & split_wants_hidden) != 0u;

// Largest length of a line from one sample to the next, in usual sample distances. A longer line leaves the
// page and returns, so the line is not drawn.
const float most_stretch = 3.0;

bool leads_on(ChainOfSamples chain, uint place)
{
    if (place >= chain.steps) {
        return false;
    }
    uint from = chain.first + place;
    bool is_wanted = (states[from] & states[from + 1u] & sample_is_visible) != 0u;
    if (wants_hidden) {
        is_wanted = !is_wanted && ((states[from] | states[from + 1u]) & sample_is_off_page) == 0u;
    }
    return is_wanted && size_of(sample_at(from).page_px - sample_at(from + 1u).page_px) <
                            most_stretch * max(spacing_of(states[from]), 1.0);
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
    uint cut_place = index - chain.first;
    uint rotation = rotation_of_slot[slot];
    bool is_whole = chain.is_closed && rotation == no_rotation;
    uint shift = chain.is_closed && !is_whole ? rotation & ~rotation_to_corner : 0u;
    uint place = chain.is_closed && cut_place < chain.steps ? (cut_place + shift) % chain.steps : cut_place;
    if (chain.is_closed && cut_place == chain.steps) {
        place = shift;
    }
    // In a closed chain the last sample repeats the first. So every line segment leads to the next sample in
    // the list.
    bool is_last = cut_place == chain.steps;
    bool goes_on = !is_last && leads_on(chain, place);
    uint previous = chain.is_closed ? (place + chain.steps - 1u) % chain.steps : place - 1u;
    bool was_on = cut_place > 0u && leads_on(chain, previous);
    bool starts_here = goes_on && (!was_on || (states[chain.first + place] & sample_is_corner) != 0u);
    LineSample cut = sample_at(chain.first + place);
    cut.state =
        states[chain.first + place] | (goes_on ? piece_is_there : 0u) | (is_whole ? sample_in_ring : 0u);
    cut_samples[index] = cut;
    starts[index] = starts_here ? 1u : 0u;
}
