// SPDX-License-Identifier: MIT
#pragma once

// Describes how a device runs threads, so that passes can divide their work accordingly. Pictures do not
// depend on this profile.

#include <cstdint>

namespace estampe::gpu {

/// A GPU runs thousands of threads in parallel, and the threads of a workgroup in lockstep. A CPU (the
/// software driver lavapipe) runs a few workgroups in parallel, and the threads of a workgroup one after
/// another. Each barrier in a shader makes the CPU loop over the threads of a workgroup once more. Each
/// member function is a choice that depends on whether the device is a GPU or a CPU. Device::execution()
/// returns the profile.
struct ExecutionProfile {
    bool is_processor = false;

    /// Whether the threads of a workgroup load data together into shared memory.
    [[nodiscard]] bool shares_by_groups() const { return !is_processor; }

    /// Whether sums and prefix sums (scans) use many workgroups instead of one.
    [[nodiscard]] bool spreads_scans() const { return !is_processor; }

    /// Whether a pass lists the screen tiles that have work. On a CPU this list costs less than a test in
    /// every pixel.
    [[nodiscard]] bool lists_tiles() const { return is_processor; }

    /// Whether a pixel stops reading its neighbours as soon as possible, or loads all of them at once.
    [[nodiscard]] bool looks_only_where_needed() const { return is_processor; }

    /// Whether images are cleared by a transfer command instead of a compute dispatch.
    [[nodiscard]] bool clears_by_transfer() const { return is_processor; }

    /// Whether height fields are processed row by row, which needs the least work. If not, height fields are
    /// searched in mip pyramids (coarser copies of the field), which occupy many threads.
    [[nodiscard]] bool sweeps() const { return is_processor; }

    /// Number of items per workgroup of 64 threads, for passes with a short test per item.
    [[nodiscard]] uint32_t items_per_group() const { return is_processor ? 256 : 64; }
};

} // namespace estampe::gpu
