// SPDX-License-Identifier: MIT
#pragma once

// Stores recent transforms of nodes that the calling program moves while the scene is drawn.

#include <cstddef>
#include <deque>
#include <map>
#include <span>

#include <estampe/renderer.hpp>

namespace estampe::features {

class PlacedNodes {
public:
    /// Time for which a node's transform is remembered, counted back from the newest record.
    static constexpr double remembered_s = 12.0;

    /// Records the nodes' transforms at a time, and forgets all records of later times.
    void place(std::span<const NodePlace> places, double time_s);

    /// Sets the scene's nodes to their recorded transforms at a time. Transforms are interpolated between
    /// recorded times. Before the first record and after the last one, transforms are constant.
    void put(Scene& scene, double time_s) const;

    [[nodiscard]] bool empty() const { return stands_.empty(); }

private:
    struct Stand {
        double time_s = 0.0;
        Transform transform;
    };

    std::map<Index, std::deque<Stand>> stands_;
};

/// Checks the nodes and transforms that the calling program gives. Throws Error if a node does not exist or a
/// number is not finite.
void check_places(std::span<const NodePlace> places, size_t node_count, double time_s);

/// Clears the animation channels of the nodes that the calling program moves. The channels remain, without
/// keys, to mark the nodes as moving. Returns true if one of the nodes has a mesh that was treated as static
/// before.
[[nodiscard]] bool take_over(Scene& scene, std::span<const NodePlace> places);

} // namespace estampe::features
