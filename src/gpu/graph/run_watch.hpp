// SPDX-License-Identifier: MIT
#pragma once

// Lets a bench look at each pass by itself, also where the device's own clock is wrong.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// What one pass did and took.
struct PassWork {
    std::string name;
    double ms = 0.0; ///< GPU time; on a processor wall time, less what an empty run takes
    /// What it binds, each image and buffer once, and twice where it is read and written: what memory has to
    /// move at least, but for buffers that are larger than what is in them.
    uint64_t bytes = 0;
    /// Threads times what ops_of() counts in the shader. Nothing where only the device knows how many
    /// threads, and for passes without a shader.
    std::optional<uint64_t> operations;
};

using RunWatch = std::function<void(std::span<const PassWork>)>;

/// From now on each run of any executor of this process runs pass by pass, waits for each, and tells `watch`
/// afterwards; an empty one ends that. Not while anything runs.
void watch_runs(RunWatch watch);

[[nodiscard]] bool are_runs_watched();

/// Tells who watches.
void tell_run(std::span<const PassWork> passes);

/// Bytes of `pass` as PassWork has them.
[[nodiscard]] uint64_t bytes_of(const Graph& graph, const PassRecord& pass);

/// Operations of `pass` as PassWork has them.
[[nodiscard]] std::optional<uint64_t> operations_of(const Graph& graph, const PassRecord& pass);

} // namespace estampe::gpu
