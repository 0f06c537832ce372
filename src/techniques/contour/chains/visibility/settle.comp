// SPDX-License-Identifier: MIT
// One thread decides whether the line is drawn at one sample: a hidden part of a chain that is narrower than
// the pen is drawn, and a visible part that is shorter than the shortest stroke is not. In a closed chain,
// the thread also looks for a place to cut the chain open: at a sample that is not drawn, or else at a
// corner.
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

// A walk along a chain from a sample, in one direction.
struct Walk {
    int seen;     // steps up to the last visible sample that a gap does not separate from the start
    bool is_open; // the line goes on as far as the walk goes, or up to the chain's end or the page's edge
};

// Walks up to `reach` steps from a sample. Up to `gap` hidden samples in a row do not end the walk.
Walk walk_from(ChainOfSamples chain, int place, int way, int reach, int gap)
{
    Walk walk = Walk(0, true);
    int hidden = 0;
    for (int i = 1; walk.is_open && i <= reach; ++i) {
        int at = place + way * i;
        bool is_past_end = !chain.is_closed && (at < 0 || at > int(chain.steps));
        uint state = sample_at(chain.first + place_in(chain, at)).state;
        if (is_past_end || (state & sample_is_off_page) != 0u) {
            break;
        }
        bool is_visible = (state & sample_is_visible) != 0u;
        hidden = is_visible ? 0 : hidden + 1;
        walk.seen = is_visible ? i : walk.seen;
        walk.is_open = hidden <= gap;
    }
    return walk;
}

// Whether the line is drawn at a sample: the sample is visible, or in a gap that is narrower than the pen.
// A visible part that is shorter than the shortest stroke is not drawn, unless the whole chain is as short.
bool is_drawn(ChainOfSamples chain, int place, float spacing_px)
{
    int gap = clamp(samples_in(constants.widest_gap_px, spacing_px) - 1, 1, int(chain.steps));
    int shortest = max(samples_in(constants.shortest_px, spacing_px), 2);
    int reach = min(shortest, int(chain.steps));
    Walk back = walk_from(chain, place, -1, reach, gap);
    Walk on = walk_from(chain, place, 1, reach, gap);
    bool is_in_gap = false;
    if (!is_visible_at(chain, place)) {
        int before = 1;
        while (before <= gap && !is_visible_at(chain, place - before)) {
            ++before;
        }
        int after = 1;
        while (before + after - 1 <= gap && !is_visible_at(chain, place + after)) {
            ++after;
        }
        is_in_gap = before + after - 1 <= gap;
    }
    bool is_whole = back.is_open && on.is_open;
    return (is_visible_at(chain, place) || is_in_gap) && (is_whole || back.seen + on.seen >= shortest);
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
    // A chain that is too short for two strokes has no corners: a speck stays one ring.
    bool turns = !is_first && !is_last && 2 * reach <= int(chain.steps) && is_corner(chain, place, reach);
    bool is_left_out = !is_seen && (before & sample_is_visible) != 0u;
    states[index] = (before & ~sample_is_visible) | (is_seen ? sample_is_visible : 0u) |
                    (turns ? sample_is_corner : 0u) | (is_left_out ? sample_is_left_out : 0u);
    if (chain.is_closed && uint(place) < chain.steps && (!is_seen || turns)) {
        atomicMin(rotation_of_slot[slot], uint(place) | (is_seen ? rotation_to_corner : 0u));
    }
}
