// SPDX-License-Identifier: MIT
#pragma once

// Compiles a declared graph to an execution order, lists of barriers between passes, and an assignment of
// transient resources to memory slots. It is a pure function and needs no device.

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

/// A dependency that is recorded before a pass; at most one per resource and pass. Its source scope is the
/// union of the accesses in `before`, its destination scope the union in `after`. The barrier must name
/// every earlier access, because a layout change is ordered only after the source scope of its own barrier.
struct Barrier {
    uint32_t resource = 0;
    AccessSet before = {};                 ///< Accesses that must have finished; if empty, see first_use()
    AccessSet after = {};                  ///< Accesses that wait
    Layout old_layout = Layout::undefined; ///< Images only; equal to `new_layout` if the layout stays
    Layout new_layout = Layout::undefined; ///< Images only
    bool operator==(const Barrier&) const = default;

    /// Whether the resource and its slot were not used before in this frame, so the barrier only changes the
    /// layout. The executor must itself wait for accesses of earlier frames, before the first pass and in
    /// the source scope of these barriers.
    [[nodiscard]] constexpr bool first_use() const { return before.empty(); }
};

/// Memory that several transient resources with the same description share, one after another.
struct Slot {
    bool is_image = false;
    ImageDesc image;
    BufferDesc buffer;
    AccessSet accesses; ///< All accesses in this frame, which determine the usage flags
};

struct CompiledPass {
    uint32_t pass = 0;             ///< Index into Graph::passes()
    std::vector<Barrier> barriers; ///< Recorded together before the first pass of the level
};

struct CompiledGraph {
    std::vector<CompiledPass> passes;       ///< In execution order, level by level; without culled passes
    std::vector<uint32_t> slot_of_resource; ///< UINT32_MAX for imported and unused resources
    std::vector<Slot> slots;
    std::vector<Layout> final_layout; ///< Final layout of each image, by resource
};

/// Image layout that an access requires.
[[nodiscard]] Layout layout_for(Access access);

/// The enumerator's name, for messages and graph drawings.
[[nodiscard]] std::string_view name_of(Access access);

/// Compiles `graph`. Throws std::logic_error that names pass and resource if a pass reads a version that was
/// never written or is overwritten, binds one resource twice with incompatible accesses, or overwrites what
/// the host reads after the frame; and if an exported resource is never written. A depth attachment needs no
/// earlier write, because its first pass clears it.
///
/// Order: passes are grouped into levels; see Scheduler. The passes of a level do not depend on each other
/// and share the barriers before the level's first pass, so a device may overlap them. Passes with side
/// effects keep their order. Culling: a pass is kept if it has a side effect, is a host read, writes an
/// exported or imported resource, or writes what a kept pass reads. Slots: transient resources with equal
/// descriptions (buffers: equal sizes) share a slot if their levels do not overlap; a barrier orders them.
/// Exported resources and those read by the host have their own slots.
///
/// Barriers: a write waits for every access since the last write. A read waits for the last write, unless
/// its kind of access has already waited. A layout change counts as a write. Cost: linear in uses, plus the
/// slots, quadratic at worst, and a sort of the passes.
[[nodiscard]] CompiledGraph compile(const Graph& graph);

/// Compiles graphs repeatedly with reused memory: a graph that is no larger than the earlier ones causes no
/// heap allocation.
class Compiler {
public:
    Compiler();
    ~Compiler();
    Compiler(const Compiler&) = delete;
    Compiler& operator=(const Compiler&) = delete;

    /// As estampe::gpu::compile(), but writes to `compiled`, whose memory is also reused.
    void compile(const Graph& graph, CompiledGraph& compiled);

private:
    struct Room;
    std::unique_ptr<Room> room_;
};

/// The graph as Graphviz text: passes are boxes, each version of a resource is an ellipse, culled passes are
/// dashed.
[[nodiscard]] std::string to_dot(const Graph& graph, const CompiledGraph& compiled);

} // namespace estampe::gpu
