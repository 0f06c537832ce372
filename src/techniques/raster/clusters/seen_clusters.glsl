// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SEEN_CLUSTERS
#define ESTAMPE_SEEN_CLUSTERS

// The clusters that may be in sight, as found by culling by cells: one bit each. SEEN_CLUSTERS is the binding
// of their buffer; without it, all clusters may be in sight.

#ifdef SEEN_CLUSTERS
layout(scalar, binding = SEEN_CLUSTERS) readonly buffer Seen
{
    uint seen[];
};

bool is_in_sight(uint cluster)
{
    return (seen[cluster / 32u] >> (cluster % 32u) & 1u) != 0u;
}
#else
bool is_in_sight(uint cluster)
{
    return true;
}
#endif

#endif
