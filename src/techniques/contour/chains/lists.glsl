// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CHAIN_LISTS
#define ESTAMPE_CHAIN_LISTS

// Access to the chain lists through texel buffers, because CPU drivers can gather several texels at once. A
// list is available in a shader that defined the list's binding before including lists.glsl.

#include "techniques/contour/chains/chains.glsl.h"

#ifdef SEGMENTS_BINDING
layout(binding = SEGMENTS_BINDING) uniform usamplerBuffer segment_texels;

Segment segment_at(uint segment)
{
    uvec4 from = texelFetch(segment_texels, int(3u * segment));
    uvec4 to = texelFetch(segment_texels, int(3u * segment + 1u));
    uvec4 links = texelFetch(segment_texels, int(3u * segment + 2u));
    return Segment(uintBitsToFloat(from.xyz), from.w, uintBitsToFloat(to.xyz), to.w, links.x, links.y,
                   links.z, uintBitsToFloat(links.w));
}
#endif

#ifdef RANKS_BINDING
layout(binding = RANKS_BINDING) uniform usamplerBuffer rank_texels;

Rank rank_at(uint segment)
{
    uvec4 words = texelFetch(rank_texels, int(segment));
    return Rank(words.x, words.y, words.z, words.w);
}
#endif

#ifdef POINTS_BEFORE_BINDING
layout(binding = POINTS_BEFORE_BINDING) uniform usamplerBuffer points_before_texels;

uint points_before(uint slot)
{
    return texelFetch(points_before_texels, int(slot)).x;
}
#endif

#ifdef POINTS_BINDING
layout(binding = POINTS_BINDING) uniform usamplerBuffer point_texels;

ChainPoint point_at(uint point)
{
    uvec4 place = texelFetch(point_texels, int(2u * point));
    uvec4 piece = texelFetch(point_texels, int(2u * point + 1u));
    return ChainPoint(uintBitsToFloat(place.xyz), place.w, uintBitsToFloat(piece.x), piece.y, piece.z, 0u);
}
#endif

#ifdef LENGTHS_BEFORE_BINDING
layout(binding = LENGTHS_BEFORE_BINDING) uniform usamplerBuffer lengths_before_texels;

uint lengths_before(uint point)
{
    return texelFetch(lengths_before_texels, int(point)).x;
}
#endif

#ifdef SAMPLES_BEFORE_BINDING
layout(binding = SAMPLES_BEFORE_BINDING) uniform usamplerBuffer samples_before_texels;

uint samples_before(uint slot)
{
    return texelFetch(samples_before_texels, int(slot)).x;
}

// The slot (entry of the list of chains) of the chain that contains a sample. `slot_count` is the number of
// slots.
uint slot_of_sample(uint index, uint slot_count)
{
    uint low = 0u;
    uint high = slot_count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (samples_before(middle) <= index) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}
#endif

#ifdef SAMPLES_BINDING
layout(binding = SAMPLES_BINDING) uniform usamplerBuffer sample_texels;

LineSample sample_at(uint index)
{
    uvec4 place = texelFetch(sample_texels, int(2u * index));
    uvec4 page = texelFetch(sample_texels, int(2u * index + 1u));
    return LineSample(uintBitsToFloat(place.xyz), place.w, uintBitsToFloat(page.xy), page.z, page.w);
}
#endif

#ifdef STROKES_BEFORE_BINDING
layout(binding = STROKES_BEFORE_BINDING) uniform usamplerBuffer strokes_before_texels;

uint strokes_before(uint index)
{
    return texelFetch(strokes_before_texels, int(index)).x;
}
#endif

#endif
