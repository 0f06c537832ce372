// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

struct ScanInputs {
    gpu::BufferId sizes; ///< ListSize of each list
    gpu::BufferId values;
    bool sizes_are_new = false; ///< the buffer `sizes` has not been written yet
    uint32_t value_capacity = 0;
    bool is_spread = false; ///< uses many workgroups, which run in parallel on a GPU
    shared::ScanConstants constants;
};

struct Scanned {
    gpu::BufferId sizes;
    gpu::BufferId before; ///< sum of all values before each; the last entry is the total
};

/// Constants for summing the values of the list `values_of`. If `total_to` is a list, its size becomes the
/// total, limited to `capacity`.
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

/// Computes prefix sums of a list whose length only the GPU knows. Cost: one workgroup, or twice as many as
/// scan_parts.
[[nodiscard]] Scanned add_scan(gpu::Graph& graph, const gpu::Name& name, const ScanInputs& in);

/// Byte offset in `sizes` of the dispatch arguments for a list.
[[nodiscard]] inline uint64_t indirect_offset(uint32_t list)
{
    return list * sizeof(shared::ListSize) + sizeof(uint32_t);
}

/// Buffer for `count` items, but at least for one.
[[nodiscard]] inline gpu::BufferDesc list_of(uint64_t count, uint64_t item_bytes)
{
    return {.size_bytes = (count > 0 ? count : 1) * item_bytes};
}

} // namespace estampe::contour
