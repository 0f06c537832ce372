// SPDX-License-Identifier: MIT
#pragma once

// How a device runs threads, for passes that divide their work accordingly. Pictures do not depend on the
// profile.

#include <cstdint>

namespace estampe::gpu {

/// A GPU runs thousands of threads in parallel, and the threads of a workgroup in lockstep. A processor
/// (lavapipe) runs a few workgroups in parallel, and the threads of a workgroup one after another; each
/// barrier costs it one more loop over these threads. Each member function names one choice that depends on
/// this difference. Device::execution() returns the profile.
struct ExecutionProfile {
    bool is_processor = false;

    /// Threads of a workgroup load data together and share it.
    [[nodiscard]] bool shares_by_groups() const { return !is_processor; }

    /// Sums and scans use many workgroups instead of one workgroup.
    [[nodiscard]] bool spreads_scans() const { return !is_processor; }

    /// A list of the tiles with work costs less than a test in every pixel.
    [[nodiscard]] bool lists_tiles() const { return is_processor; }

    /// A pixel samples its neighbourhood only as far as necessary, instead of loading all candidates at
    /// once.
    [[nodiscard]] bool looks_only_where_needed() const { return is_processor; }

    /// Images are cleared by a transfer instead of a dispatch.
    [[nodiscard]] bool clears_by_transfer() const { return is_processor; }

    /// Heights are swept row by row, which needs the least work, instead of searched in pyramids, which keep
    /// many threads busy.
    [[nodiscard]] bool sweeps() const { return is_processor; }

    /// Items per workgroup of 64 threads, for passes with a short test per item.
    [[nodiscard]] uint32_t items_per_group() const { return is_processor ? 256 : 64; }
};

} // namespace estampe::gpu
