// SPDX-License-Identifier: MIT
#pragma once

// Which passes of a graph run, and when: those that do not hang on each other side by side.

#include <algorithm>
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
    /// before those that need it: as few levels as the longest chain has passes. A level takes as long as its
    /// longest pass, or as all of its work does together if that is more; so each pass, in declared order,
    /// goes where it lengthens a level the least, early rather than late. How long passes take is guessed
    /// from their groups, or told by Pass::lasts(): times are not measured, and the order hangs on the graph
    /// alone. In a level those of few groups stand first: the time that they wait for memory is then that of
    /// others. Passes with side effects keep their order. Throws std::logic_error when a pass, kept or not,
    /// binds one resource twice with clashing accesses. Cost: linear in uses, a sort of the passes, and
    /// levels and passes for each pass.
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

    /// Quarters of a microsecond, about: of a pass, or of all that share a level.
    struct Load {
        uint32_t longest = 0; ///< of one alone
        uint32_t work = 0;    ///< of all, if they filled the device

        [[nodiscard]] static Load of(const PassRecord& pass);

        [[nodiscard]] uint32_t takes() const { return std::max(longest, work); }

        [[nodiscard]] Load with(const Load& other) const
        {
            return {std::max(longest, other.longest), work + other.work};
        }
    };

    void find_kept(const Graph& graph, Schedule& schedule);
    /// The first level that the passes gone through leave to the next, whose waves begin.
    [[nodiscard]] uint32_t next_level(const Schedule& schedule, size_t step);
    void take_level(Schedule& schedule, size_t step, uint32_t level);
    void find_latest(const Graph& graph, Schedule& schedule);
    void spread(const Graph& graph, Schedule& schedule);
    /// Moves a pass from its latest level to the best from `earliest` on; returns that.
    [[nodiscard]] uint32_t move(size_t step, uint32_t earliest);
    void sort_by_levels(const Graph& graph, Schedule& schedule);

    Wanted wanted_;
    std::vector<Wave> waves_;        ///< by resource
    std::vector<uint32_t> level_of_; ///< of each kept pass
    std::vector<Load> load_of_;      ///< of each kept pass
    std::vector<Load> loads_;        ///< of levels
    uint32_t level_count_ = 0;
    std::vector<uint32_t> order_;
};

} // namespace estampe::gpu
