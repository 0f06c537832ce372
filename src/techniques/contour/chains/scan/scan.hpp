// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

struct ScanInputs {
    gpu::BufferId sizes; ///< the length of each list, as one ListSize per list
    gpu::BufferId values;
    bool sizes_are_new = false; ///< the buffer `sizes` has not been written yet in the current frame
    uint32_t value_capacity = 0;
    /// Uses many workgroups, not one workgroup; faster on a GPU, where workgroups run in parallel.
    bool is_spread = false;
    shared::ScanConstants constants;
};

struct Scanned {
    gpu::BufferId sizes;
    gpu::BufferId before; ///< for each value: the sum of all earlier values; the last entry is the total
};

/// Returns the constants for summing the values of the list `values_of`. If `total_to` is a list, the list's
/// length becomes the total, limited to `capacity`.
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

/// Computes the prefix sums of a list whose length only the GPU knows. Cost: one workgroup, or 2 * scan_parts
/// workgroups with `is_spread`.
[[nodiscard]] Scanned add_scan(gpu::Graph& graph, const gpu::Name& name, const ScanInputs& in);

/// Byte offset in the buffer `sizes` of the arguments for an indirect dispatch over a list.
[[nodiscard]] inline uint64_t indirect_offset(uint32_t list)
{
    return list * sizeof(shared::ListSize) + sizeof(uint32_t);
}

/// Describes a buffer for `count` items. The buffer has room for at least one item.
[[nodiscard]] inline gpu::BufferDesc list_of(uint64_t count, uint64_t item_bytes)
{
    return {.size_bytes = (count > 0 ? count : 1) * item_bytes};
}

} // namespace estampe::contour
