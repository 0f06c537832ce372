// SPDX-License-Identifier: MIT
#pragma once

// Which passes of a graph run, and when: those that do not hang on each other side by side.

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/graph/compile.hpp"

namespace estampe::gpu {

/// All that one pass does to one resource.
struct PassUse {
    uint32_t resource = 0;
    AccessSet accesses;
    bool writes = false;
    Layout layout = Layout::undefined; ///< images only
};

/// The kept passes in the order they run in, and what each does.
struct Schedule {
    std::vector<uint32_t> passes;
    std::vector<uint32_t> levels;    ///< by kept pass, rising: passes of one level do not wait for each other
    std::vector<PassUse> uses;       ///< of all passes of the graph, one after another
    std::vector<uint32_t> first_use; ///< by pass of the graph, and the end of the last

    [[nodiscard]] std::span<const PassUse> uses_of(size_t step) const
    {
        const uint32_t pass = passes[step];
        return {uses.data() + first_use[pass], first_use[pass + 1] - first_use[pass]};
    }
};

/// Makes schedule after schedule in the same room.
class Scheduler {
public:
    /// Keeps the passes of `graph` whose work is wanted, and gives each a level after those that it needs and
    /// before those that need it: as few levels as the longest chain has passes. What a level takes is about
    /// what its longest pass does. So passes that wait (Pass::estimated_duration_us()) go where others wait
    /// as long, passes of many groups where the fewest such are, of several levels the first, and all others
    /// as early as they can; in declared order. In a level those of few groups stand first: the time that
    /// they wait for memory is then that of others. Passes with side effects keep their order. Throws
    /// std::logic_error when a pass, kept or not, binds one resource twice with clashing accesses. Cost:
    /// linear in uses, a sort of the passes, levels for each pass of many groups, and levels and passes that
    /// wait for each such pass.
    void run(const Graph& graph, Schedule& schedule);

private:
    /// Versions of resources that some kept pass reads.
    struct Wanted {
        std::vector<uint32_t> first; ///< by resource
        std::vector<uint8_t> is_wanted;

        void forget(const Graph& graph);

        [[nodiscard]] uint8_t& at(uint32_t resource, uint32_t version)
        {
            return is_wanted[first[resource] + version];
        }
    };

    /// The uses of a resource that may be made at the same time, going through passes in order or backwards.
    struct Wave {
        bool is_begun = false;
        bool writes = false;
        Layout layout = Layout::undefined;
        uint32_t from_level = 0; ///< counted from where one begins
        uint32_t past_level = 0; ///< beyond all of them
    };

    /// A pass that told how long it takes.
    struct Long {
        uint32_t step = 0;
        uint32_t us = 0;
    };

    void find_kept(const Graph& graph, Schedule& schedule);
    /// The first level that the passes gone through leave to the next, whose waves begin.
    [[nodiscard]] uint32_t next_level(const Schedule& schedule, size_t step);
    void take_level(Schedule& schedule, size_t step, uint32_t level);
    void find_latest(const Graph& graph, Schedule& schedule);
    void spread(const Graph& graph, Schedule& schedule);
    [[nodiscard]] uint32_t emptiest(uint32_t earliest, uint32_t latest) const;
    [[nodiscard]] uint32_t beside_longest(const Long& pass, uint32_t earliest, uint32_t latest) const;
    void sort_by_levels(const Graph& graph, Schedule& schedule);

    Wanted wanted_;
    std::vector<Wave> waves_;        ///< by resource
    std::vector<uint32_t> level_of_; ///< of each kept pass: the latest, until it is given one
    std::vector<uint32_t> wide_in_level_;
    std::vector<Long> long_;
    uint32_t level_count_ = 0;
    std::vector<uint32_t> order_;
};

} // namespace estampe::gpu
