// SPDX-License-Identifier: MIT
#pragma once

// Compiles a declared frame graph to an execution order, lists of barriers between passes, and an assignment
// of transient resources to memory slots. Compilation is a pure function and needs no device.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// A set of Access values.
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

    /// Calls `visit(Access)` for each access in the set, in the order of the enumeration.
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

/// A barrier on one resource, recorded before a pass. A pass has at most one barrier per resource. The source
/// scope is the union of the accesses in `before`. The destination scope is the union of the accesses in
/// `after`. `before` must list every earlier access, because Vulkan orders a layout change only after the
/// source scope of the same barrier.
struct Barrier {
    uint32_t resource = 0;
    AccessSet before = {}; ///< Accesses that must have finished; if empty, see first_use()
    AccessSet after = {};  ///< Accesses that must wait for the accesses in `before`
    /// Layout of an image before the barrier; equals `new_layout` if unchanged.
    Layout old_layout = Layout::undefined;
    Layout new_layout = Layout::undefined; ///< Layout of an image after the barrier
    bool operator==(const Barrier&) const = default;

    /// Whether this is the first use of the resource and its memory slot in this frame. The barrier then only
    /// changes the layout. The executor must itself wait for accesses of earlier frames: before the first
    /// pass, and in the source scope of barriers before a first use.
    [[nodiscard]] constexpr bool first_use() const { return before.empty(); }
};

/// Memory that several transient resources use one after another. Resources that share a slot have equal
/// descriptions.
struct Slot {
    bool is_image = false;
    ImageDesc image;
    BufferDesc buffer;
    AccessSet accesses; ///< All accesses in this frame; the usage flags follow from them
};

struct CompiledPass {
    uint32_t pass = 0;             ///< Index into Graph::passes()
    std::vector<Barrier> barriers; ///< Recorded together, before the first pass of the pass's level
};

struct CompiledGraph {
    std::vector<CompiledPass> passes; ///< Kept passes in execution order, level by level
    /// For each resource: index into `slots`; UINT32_MAX: imported or unused.
    std::vector<uint32_t> slot_of_resource;
    std::vector<Slot> slots;
    std::vector<Layout> final_layout; ///< For each resource: layout of the image after the frame
};

/// Image layout that an access requires.
[[nodiscard]] Layout layout_for(Access access);

/// The enumerator's name, for messages and graph drawings.
[[nodiscard]] std::string_view name_of(Access access);

/// Compiles `graph`. Throws std::logic_error if a pass reads a version that was never written or that is
/// already overwritten. Also throws if a pass binds one resource twice with incompatible accesses, if a pass
/// overwrites content that the host reads after the frame, or if an exported resource is never written. The
/// message names the pass and the resource. A depth attachment needs no earlier write, because its first pass
/// clears it.
///
/// Order: the scheduler groups passes into levels; see Scheduler. The passes of one level do not depend on
/// each other. The barriers of a level are recorded before the level's first pass, so a device may run the
/// passes of a level in parallel. Passes with side effects keep their order. Culling removes passes that
/// nothing needs. A pass is kept if it has a side effect, is a host read, writes an exported or imported
/// resource, or writes content that a kept pass reads. Memory slots: transient resources with equal
/// descriptions (buffers: equal sizes) share a slot if the levels that use them do not overlap; a barrier
/// orders their accesses. Exported resources, and resources that the host reads, have their own slots.
///
/// Barriers: a write waits for every access since the last write. A read waits for the last write, unless an
/// earlier read of that access kind has already waited. A layout change counts as a write. Cost: linear in
/// resource uses, plus the assignment of slots (quadratic at worst) and a sort of the passes.
[[nodiscard]] CompiledGraph compile(const Graph& graph);

/// Compiles graphs repeatedly and reuses memory. Compiling a graph that is no larger than earlier graphs
/// allocates nothing on the heap.
class Compiler {
public:
    Compiler();
    ~Compiler();
    Compiler(const Compiler&) = delete;
    Compiler& operator=(const Compiler&) = delete;

    /// Compiles `graph` as estampe::gpu::compile() does, but writes the result to `compiled` and reuses the
    /// memory of `compiled`.
    void compile(const Graph& graph, CompiledGraph& compiled);

private:
    struct Room;
    std::unique_ptr<Room> room_;
};

/// Returns the graph as Graphviz text. Passes are boxes, culled passes are dashed boxes, and each version of
/// a resource is an ellipse.
[[nodiscard]] std::string to_dot(const Graph& graph, const CompiledGraph& compiled);

} // namespace estampe::gpu
