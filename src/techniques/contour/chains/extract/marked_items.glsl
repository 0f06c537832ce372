// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MARKED_ITEMS
#define ESTAMPE_MARKED_ITEMS

// Mark bits of the items (triangles, loose edges, cells) that contain a line segment, and prefix sums of the
// mark bits by word. With the bits and their sums, a segment's item is found without a table. Requires before
// inclusion: MARKS_BINDING, the binding of the mark words; the next binding holds the prefix sums.

layout(binding = MARKS_BINDING) uniform usamplerBuffer mark_texels;
layout(binding = MARKS_BINDING + 1) uniform usamplerBuffer marks_before_texels;

uint marks(uint word)
{
    return texelFetch(mark_texels, int(word)).x;
}

uint marks_before(uint word)
{
    return texelFetch(marks_before_texels, int(word)).x;
}

bool is_marked(uint item)
{
    return (marks(item / 32u) >> (item & 31u) & 1u) != 0u;
}

uint segment_of(uint item)
{
    uint word = item / 32u;
    return marks_before(word) + uint(bitCount(marks(word) & ((1u << (item & 31u)) - 1u)));
}

// The item (triangle, loose edge or cell of the page) that contains a segment. `word_count` is the number of
// words of mark bits.
uint item_of(uint segment, uint word_count)
{
    uint low = 0u;
    uint high = word_count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (marks_before(middle) <= segment) {
            low = middle;
        } else {
            high = middle;
        }
    }
    uint word = marks(low);
    for (uint skipped = segment - marks_before(low); skipped > 0u; --skipped) {
        word &= word - 1u;
    }
    return 32u * low + uint(findLSB(word));
}

#endif
