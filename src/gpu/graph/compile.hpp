// SPDX-License-Identifier: MIT
#pragma once

// Turns a declared graph into an order, a list of barriers before each pass, and an assignment of transient resources to
// physical slots. Pure data in, pure data out: no device.

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// A dependency to record before a pass. Stages and accesses follow from `before` and `after` (see execute.cpp).
struct Barrier {
    uint32_t resource = 0;
    Access before = Access::compute_sampled; ///< the last access that matters; ignored when `first_use`
    Access after = Access::compute_sampled;
    Layout old_layout = Layout::undefined;   ///< images only
    Layout new_layout = Layout::undefined;   ///< images only
    bool first_use = false; ///< nothing in this frame came before on this resource or its slot: only a layout change, if any
    bool operator==(const Barrier&) const = default;
};

/// Memory that several transients with the same description share, one after another.
struct Slot {
    bool is_image = false;
    ImageDesc image;
    BufferDesc buffer;
};

struct CompiledPass {
    uint32_t pass = 0;             ///< index into Graph::passes()
    std::vector<Barrier> barriers; ///< to be issued together, before the pass
};

struct CompiledGraph {
    std::vector<CompiledPass> passes;        ///< in execution order; culled passes are absent
    std::vector<uint32_t> slot_of_resource;  ///< UINT32_MAX for imported and unused resources
    std::vector<Slot> slots;
    std::vector<Layout> final_layout;        ///< per resource: the layout images are left in
};

/// Layout that an access needs an image in.
[[nodiscard]] Layout layout_for(Access access);

/// Compiles `graph`. Throws std::logic_error naming pass and resource when a pass reads a version that was never
/// written or has been overwritten, or binds one resource twice with clashing accesses.
///
/// Order: declaration order, which is a topological order by construction. Culling: a pass stays when it has a side
/// effect, writes an exported or imported resource, or writes what a kept pass reads. Slots: transients of equal
/// description whose lifetimes do not overlap share one (buffers: same size); sharing adds the barrier that orders them.
[[nodiscard]] CompiledGraph compile(const Graph& graph);

/// The graph as Graphviz text: passes as boxes, resources as ellipses, culled passes dashed.
[[nodiscard]] std::string to_dot(const Graph& graph, const CompiledGraph& compiled);

} // namespace estampe::gpu
