// SPDX-License-Identifier: MIT
#pragma once

// Turns a declared graph into an order, lists of barriers between passes, and an assignment of transient
// resources to physical slots. Pure data in, pure data out: no device.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// A set of accesses.
class AccessSet {
public:
    constexpr AccessSet() = default;

    constexpr AccessSet(Access access) : bits_(1u << static_cast<uint32_t>(access)) {}

    [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }

    [[nodiscard]] constexpr bool contains(Access access) const
    {
        return (bits_ & AccessSet(access).bits_) != 0;
    }

    [[nodiscard]] constexpr AccessSet without(AccessSet other) const
    {
        return from_bits(bits_ & ~other.bits_);
    }

    constexpr AccessSet& operator|=(AccessSet other)
    {
        bits_ |= other.bits_;
        return *this;
    }

    friend constexpr AccessSet operator|(AccessSet a, AccessSet b) { return a |= b; }

    constexpr bool operator==(const AccessSet&) const = default;

    /// Calls `visit(Access)` for each member, in the order of the enumeration.
    template <class Visit>
    constexpr void for_each(Visit&& visit) const
    {
        for (uint32_t i = 0; (bits_ >> i) != 0; ++i) {
            if (((bits_ >> i) & 1u) != 0)
                visit(static_cast<Access>(i));
        }
    }

private:
    static constexpr AccessSet from_bits(uint32_t bits)
    {
        AccessSet set;
        set.bits_ = bits;
        return set;
    }

    uint32_t bits_ = 0;
};

constexpr AccessSet operator|(Access a, Access b)
{
    return AccessSet(a) | AccessSet(b);
}

/// A dependency to record before a pass: one a resource and pass at most. Its source scope is the union over
/// `before`, its destination scope the union over `after`. One barrier must name every earlier access,
/// because a layout change is ordered only after the source scope of the barrier that carries it.
struct Barrier {
    uint32_t resource = 0;
    AccessSet before = {};                 ///< what must have finished; see first_use() when empty
    AccessSet after = {};                  ///< what waits
    Layout old_layout = Layout::undefined; ///< images only; equal to `new_layout` when nothing changes
    Layout new_layout = Layout::undefined; ///< images only
    bool operator==(const Barrier&) const = default;

    /// Nothing in this frame came before on this resource or its slot: only a layout change. What earlier
    /// frames did is for whoever executes the graph to wait for, before the first pass and as the source of
    /// these barriers.
    [[nodiscard]] constexpr bool first_use() const { return before.empty(); }
};

/// Memory that several transients with the same description share, one after another.
struct Slot {
    bool is_image = false;
    ImageDesc image;
    BufferDesc buffer;
    AccessSet accesses; ///< every access in this frame: decides the usage flags
};

struct CompiledPass {
    uint32_t pass = 0;             ///< index into Graph::passes()
    std::vector<Barrier> barriers; ///< to be issued together, before it and those that run beside it
};

struct CompiledGraph {
    std::vector<CompiledPass> passes;       ///< in execution order, level by level; culled passes are absent
    std::vector<uint32_t> slot_of_resource; ///< UINT32_MAX for imported and unused resources
    std::vector<Slot> slots;
    std::vector<Layout> final_layout; ///< per resource: the layout images are left in
};

/// Layout that an access needs an image in.
[[nodiscard]] Layout layout_for(Access access);

/// The enumerator's name, for messages and pictures of the graph.
[[nodiscard]] std::string_view name_of(Access access);

/// Compiles `graph`. Throws std::logic_error naming pass and resource when a pass reads a version that was
/// never written or has been overwritten, binds one resource twice with clashing accesses, or overwrites what
/// the host is to read after the frame; and when an exported resource is never written. A depth attachment
/// needs no earlier write: its first pass clears it.
///
/// Order: in levels. Passes of one level hang on none of each other and share the barriers before the level's
/// first, so that a device may run them side by side; Scheduler says which level that is. Side effects keep
/// their order. Culling: a pass stays when it has a side effect, is a host read, writes an exported or
/// imported resource, or writes what a kept pass reads. Slots: transients of equal description whose levels
/// do not overlap share one (buffers: same size); sharing adds the barrier that orders them. What is exported
/// or read by the host has a slot of its own.
///
/// Barriers: a write waits for every access since the last write, a read for the last write unless its kind
/// of access has already waited; a layout change counts as a write. Cost: linear in uses, but for slots,
/// quadratic at worst, and a sort of the passes.
[[nodiscard]] CompiledGraph compile(const Graph& graph);

/// Compiles graph after graph in the same room: those that are no larger than the ones before ask nothing of
/// the heap.
class Compiler {
public:
    Compiler();
    ~Compiler();
    Compiler(const Compiler&) = delete;
    Compiler& operator=(const Compiler&) = delete;

    /// As estampe::gpu::compile(), into `compiled`, whose own room is taken too.
    void compile(const Graph& graph, CompiledGraph& compiled);

private:
    struct Room;
    std::unique_ptr<Room> room_;
};

/// The graph as Graphviz text: passes as boxes, resources as ellipses (one a version), culled passes dashed.
[[nodiscard]] std::string to_dot(const Graph& graph, const CompiledGraph& compiled);

} // namespace estampe::gpu
