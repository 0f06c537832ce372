// SPDX-License-Identifier: MIT
#pragma once

// How a device runs threads, for passes that divide their work accordingly. Pictures do not depend on it.

#include <cstdint>

namespace estampe::gpu {

/// A GPU runs thousands of threads in parallel, those of a workgroup in lockstep. A processor (lavapipe)
/// runs a few workgroups in parallel and the threads of each one after another; each barrier costs it one
/// loop over all of them. Each member function names one choice that depends on this. Device::execution()
/// returns the profile.
struct ExecutionProfile {
    bool is_processor = false;

    /// Threads of a workgroup load data together and share it.
    [[nodiscard]] bool shares_by_groups() const { return !is_processor; }

    /// Sums and scans use many workgroups instead of one.
    [[nodiscard]] bool spreads_scans() const { return !is_processor; }

    /// A list of the tiles with work costs less than a test by every pixel.
    [[nodiscard]] bool lists_tiles() const { return is_processor; }

    /// A pixel samples its neighbourhood only as far as necessary, instead of loading all candidates at
    /// once.
    [[nodiscard]] bool looks_only_where_needed() const { return is_processor; }

    /// Images are cleared by a transfer instead of a dispatch.
    [[nodiscard]] bool clears_by_transfer() const { return is_processor; }

    /// Heights are swept row by row, which takes the least work, instead of climbed by pyramids, which keeps
    /// many threads busy.
    [[nodiscard]] bool sweeps() const { return is_processor; }

    /// Items per workgroup of 64 threads, for passes with a short test per item.
    [[nodiscard]] uint32_t items_per_group() const { return is_processor ? 256 : 64; }
};

} // namespace estampe::gpu
