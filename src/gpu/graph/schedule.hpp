// SPDX-License-Identifier: MIT
#pragma once

// Decides which passes of a graph run, and in which order; independent passes may overlap.

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
    Layout layout = Layout::undefined; ///< Images only
};

/// The kept passes in execution order, with their uses.
struct Schedule {
    std::vector<uint32_t> passes;
    /// Level of each kept pass, ascending; passes of one level are independent.
    std::vector<uint32_t> levels;
    std::vector<PassUse> uses;       ///< Uses of all passes of the graph, consecutively
    std::vector<uint32_t> first_use; ///< Index of each pass's first use, and the total at the end

    [[nodiscard]] std::span<const PassUse> uses_of(size_t step) const
    {
        const uint32_t pass = passes[step];
        return {uses.data() + first_use[pass], first_use[pass + 1] - first_use[pass]};
    }
};

/// Computes schedules repeatedly with reused memory.
class Scheduler {
public:
    /// Keeps the passes of `graph` whose results are needed, and assigns each to a level after its inputs
    /// and before its users. The number of levels is that of the longest dependency chain. A level lasts
    /// about as long as its longest pass. Therefore passes with Pass::estimated_duration_us() go to levels
    /// with passes of similar duration, passes of many groups to the levels with the fewest such passes (the
    /// first of several), and all others to their earliest level, in declared order. Within a level, passes
    /// of few groups come first, so that the others hide their memory latency. Passes with side effects keep
    /// their order.
    ///
    /// Throws std::logic_error if a pass, kept or not, binds one resource twice with incompatible accesses.
    /// Cost: linear in uses, a sort of the passes, all levels for each pass of many groups, and all levels
    /// and long passes for each long pass.
    void run(const Graph& graph, Schedule& schedule);

private:
    /// Versions of resources that a kept pass reads.
    struct Wanted {
        std::vector<uint32_t> first; ///< Index of a resource's first version, by resource
        std::vector<uint8_t> is_wanted;

        void forget(const Graph& graph);

        [[nodiscard]] uint8_t& at(uint32_t resource, uint32_t version)
        {
            return is_wanted[first[resource] + version];
        }
    };

    /// Uses of a resource that may overlap, while the passes are walked in order or backwards.
    struct Wave {
        bool is_begun = false;
        bool writes = false;
        Layout layout = Layout::undefined;
        uint32_t from_level = 0; ///< First level of the uses, counted in the direction of the walk
        uint32_t past_level = 0; ///< First level after all of the uses
    };

    /// A pass with an estimated duration.
    struct Long {
        uint32_t step = 0;
        uint32_t us = 0;
    };

    void find_kept(const Graph& graph, Schedule& schedule);
    /// The earliest level of a pass after those walked so far, whose waves are started.
    [[nodiscard]] uint32_t next_level(const Schedule& schedule, size_t step);
    void take_level(Schedule& schedule, size_t step, uint32_t level);
    void find_latest(const Graph& graph, Schedule& schedule);
    void spread(const Graph& graph, Schedule& schedule);
    [[nodiscard]] uint32_t emptiest(uint32_t earliest, uint32_t latest) const;
    [[nodiscard]] uint32_t beside_longest(const Long& pass, uint32_t earliest, uint32_t latest) const;
    void sort_by_levels(const Graph& graph, Schedule& schedule);

    Wanted wanted_;
    std::vector<Wave> waves_;        ///< By resource
    std::vector<uint32_t> level_of_; ///< Latest level of each kept pass, until its level is chosen
    std::vector<uint32_t> wide_in_level_;
    std::vector<Long> long_;
    uint32_t level_count_ = 0;
    std::vector<uint32_t> order_;
};

} // namespace estampe::gpu
