// SPDX-License-Identifier: MIT
#pragma once

// How a device runs threads, as far as passes share their work out by it. Pictures do not depend on it.

#include <cstdint>

namespace estampe::gpu {

/// A GPU runs thousands of threads side by side, those of a workgroup in step. A processor (lavapipe) runs a
/// few workgroups at once and their threads one after the other; each barrier costs it a round over all of
/// them. Each question names one choice that follows from this. Device::execution() returns it.
struct ExecutionProfile {
    bool is_processor = false;

    /// The threads of a workgroup load things together and share what they find.
    [[nodiscard]] bool shares_by_groups() const { return !is_processor; }

    /// Sums and scans go over many workgroups rather than one.
    [[nodiscard]] bool spreads_scans() const { return !is_processor; }

    /// Listing the tiles where there is something to do costs less than all pixels finding out by themselves.
    [[nodiscard]] bool lists_tiles() const { return is_processor; }

    /// A pixel looks about only as far as it has to, rather than loading all that it may want at once.
    [[nodiscard]] bool looks_only_where_needed() const { return is_processor; }

    /// Images are cleared by a transfer rather than by a dispatch.
    [[nodiscard]] bool clears_by_transfer() const { return is_processor; }

    /// Heights are swept row by row, which does least, rather than climbed by pyramids, which keeps many
    /// threads busy.
    [[nodiscard]] bool sweeps() const { return is_processor; }

    /// Items per workgroup of 64 threads, for passes with a short test per item.
    [[nodiscard]] uint32_t items_per_group() const { return is_processor ? 256 : 64; }
};

} // namespace estampe::gpu
