// SPDX-License-Identifier: MIT
#pragma once

// Nodes that a program moves while the scene is drawn: where each stood lately.

#include <cstddef>
#include <deque>
#include <map>
#include <span>

#include <estampe/renderer.hpp>

namespace estampe::features {

class PlacedNodes {
public:
    /// How long before the newest moment something is still known.
    static constexpr double remembered_s = 12.0;

    /// They stand so at that moment; what was said of later ones is forgotten.
    void place(std::span<const NodePlace> places, double time_s);

    /// Puts the scene's nodes where they stood at a moment: on the straight way between two that are known,
    /// at the ends before and after all of them.
    void put(Scene& scene, double time_s) const;

    [[nodiscard]] bool empty() const { return stands_.empty(); }

private:
    struct Stand {
        double time_s = 0.0;
        Transform transform;
    };

    std::map<Index, std::deque<Stand>> stands_;
};

/// Throws Error for a node that is none, and for what is not finite.
void check_places(std::span<const NodePlace> places, size_t node_count, double time_s);

/// Takes the nodes' places out of the animations' hands, which are left with channels that say that they
/// move. Returns whether a mesh was taken to stand for ever until now.
[[nodiscard]] bool take_over(Scene& scene, std::span<const NodePlace> places);

} // namespace estampe::features
