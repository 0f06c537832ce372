// SPDX-License-Identifier: MIT
#pragma once

// Decides which passes of a frame graph run, and in which order. Independent passes may run in parallel.

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/graph/compile.hpp"

namespace estampe::gpu {

/// All accesses of one pass to one resource.
struct PassUse {
    uint32_t resource = 0;
    AccessSet accesses;
    bool writes = false;
    Layout layout = Layout::undefined; ///< Layout that the pass requires; only for images
};

/// The passes that are not culled, in execution order, with the resources that they use.
struct Schedule {
    std::vector<uint32_t> passes;
    /// Level number of each kept pass, in ascending order. Passes of one level are independent of each other.
    std::vector<uint32_t> levels;
    std::vector<PassUse> uses;       ///< Resource uses of all passes of the graph, pass by pass
    std::vector<uint32_t> first_use; ///< Index of each pass's first use; the last entry is the total

    [[nodiscard]] std::span<const PassUse> uses_of(size_t step) const
    {
        const uint32_t pass = passes[step];
        return {uses.data() + first_use[pass], first_use[pass + 1] - first_use[pass]};
    }
};

/// Computes schedules repeatedly and reuses memory.
class Scheduler {
public:
    /// Keeps the passes of `graph` whose results are needed. Assigns each kept pass to a level after the
    /// passes that write its inputs and before the passes that read its results. The number of levels is the
    /// length of the longest dependency chain. A level lasts about as long as its longest pass. Therefore,
    /// passes with Pass::estimated_duration_us() are assigned to levels with passes of similar duration.
    /// Passes of many workgroups are assigned to the level with the fewest such passes. All other passes are
    /// assigned to their earliest level, in declared order. Within a level, passes of few workgroups are
    /// first, so that the larger passes hide their memory latency. Passes with side effects keep their order.
    ///
    /// Throws std::logic_error if a pass, kept or culled, binds one resource twice with incompatible
    /// accesses. Cost: linear in resource uses, plus a sort of the passes. Each pass of many workgroups also
    /// visits all levels. Each pass with an estimated duration visits all levels and all other passes with an
    /// estimated duration.
    void run(const Graph& graph, Schedule& schedule);

private:
    /// Marks the versions of resources that a kept pass reads.
    struct Wanted {
        std::vector<uint32_t> first; ///< Index of each resource's first version in `is_wanted`
        std::vector<uint8_t> is_wanted;

        void forget(const Graph& graph);

        [[nodiscard]] uint8_t& at(uint32_t resource, uint32_t version)
        {
            return is_wanted[first[resource] + version];
        }
    };

    /// Consecutive uses of a resource that may run at the same time. The scheduler tracks them while it
    /// visits the passes in order or in reverse order.
    struct Wave {
        bool is_begun = false;
        bool writes = false;
        Layout layout = Layout::undefined;
        uint32_t from_level = 0; ///< First level with a use in the list, in the direction of the visit
        uint32_t past_level = 0; ///< First level after all uses in the list
    };

    /// A pass with an estimated duration, which leaves most of the GPU idle.
    struct Long {
        uint32_t step = 0;
        uint32_t us = 0;
    };

    void find_kept(const Graph& graph, Schedule& schedule);
    /// Returns the earliest level for a pass, after all passes visited so far that it depends on. Also starts
    /// waves for the resources of the pass.
    [[nodiscard]] uint32_t next_level(const Schedule& schedule, size_t step);
    void take_level(Schedule& schedule, size_t step, uint32_t level);
    void find_latest(const Graph& graph, Schedule& schedule);
    void spread(const Graph& graph, Schedule& schedule);
    [[nodiscard]] uint32_t emptiest(uint32_t earliest, uint32_t latest) const;
    [[nodiscard]] uint32_t beside_longest(const Long& pass, uint32_t earliest, uint32_t latest) const;
    void sort_by_levels(const Graph& graph, Schedule& schedule);

    Wanted wanted_;
    std::vector<Wave> waves_; ///< The current uses of each resource, by resource
    /// Latest possible level of each kept pass; when the level is chosen, the chosen level.
    std::vector<uint32_t> level_of_;
    std::vector<uint32_t> wide_in_level_;
    std::vector<Long> long_;
    uint32_t level_count_ = 0;
    std::vector<uint32_t> order_;
};

} // namespace estampe::gpu
