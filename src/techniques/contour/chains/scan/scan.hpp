// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

struct ScanInputs {
    gpu::BufferId sizes; ///< ListSize of each list
    gpu::BufferId values;
    bool sizes_are_new = false; ///< nothing has been written there yet
    uint32_t value_capacity = 0;
    bool is_spread = false; ///< over many workgroups: a GPU's run side by side
    shared::ScanConstants constants;
};

struct Scanned {
    gpu::BufferId sizes;
    gpu::BufferId before; ///< sum of all values before each; the total at the end
};

/// Sums the values of the list `values_of`, into the size of the list `total_to` where that is one, which is
/// cut at `capacity`.
[[nodiscard]] inline shared::ScanConstants scan_of_list(uint32_t values_of, uint32_t total_to,
                                                        uint32_t capacity)
{
    return {.fixed_count = 0,
            .count_of = values_of,
            .total_to = total_to,
            .capacity = capacity,
            .slots_before = shared::no_list,
            .counts_bits = 0};
}

/// Sums up a list whose length only the device knows. Cost: one workgroup, or twice as many as scan_parts.
[[nodiscard]] Scanned add_scan(gpu::Graph& graph, const gpu::Name& name, const ScanInputs& in);

/// Where the size of a list, as the arguments of a dispatch, lies in `sizes`.
[[nodiscard]] inline uint64_t indirect_offset(uint32_t list)
{
    return list * sizeof(shared::ListSize) + sizeof(uint32_t);
}

/// Room for `count` items, and for one where there are none.
[[nodiscard]] inline gpu::BufferDesc list_of(uint64_t count, uint64_t item_bytes)
{
    return {.size_bytes = (count > 0 ? count : 1) * item_bytes};
}

} // namespace estampe::contour
