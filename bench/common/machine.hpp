// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/graph/execute.hpp"

namespace estampe::bench {

/// A device, and what runs graphs on it.
class Machine {
public:
    explicit Machine(const std::string& device_name);

    /// Runs the graph. Returns milliseconds: the sum of its passes' GPU times, or wall time on a processor,
    /// whose own clock is wrong for short passes.
    double run(const gpu::Graph& graph);

    /// The passes of the last run.
    [[nodiscard]] const std::vector<PassTiming>& passes() const { return executor.timings(); }

    [[nodiscard]] const std::string& name() const { return device.info().name; }

    gpu::Device device;
    gpu::Executor executor;
};

/// Takes `total` steps, at most `most` of them per graph: calls step(count, is_last).
template <class Step>
void in_batches(uint32_t total, uint32_t most, const Step& step)
{
    for (uint32_t left = total; left > 0;) {
        const uint32_t count = std::min(left, most);
        left -= count;
        step(count, left == 0);
    }
}

} // namespace estampe::bench
