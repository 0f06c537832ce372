// SPDX-License-Identifier: MIT
#pragma once

// The desert around the temple, and the sand that the wind has blown against the walls and through their
// openings.

#include <cstddef>
#include <span>
#include <vector>

#include <estampe/terrain.hpp>

#include "plan.hpp"

namespace temple {

/// Returns the height of the sand around the temple and under its floors. The wind blows from the east.
[[nodiscard]] float sand_level_m(const Plan& plan, uint64_t seed, const glm::vec2& place_m);

/// A hollow that a demon presses into the sand, with a rim around it.
struct Hollow {
    glm::vec2 place_m{0.0F};
    float depth_m = 0.0F;
    float radius_m = 1.5F;

    bool operator==(const Hollow& other) const = default;
};

inline constexpr size_t most_hollows = 5;

/// The desert: dunes that move with the wind, and the sand at the temple, which does not move.
class Desert {
public:
    Desert(const Plan& plan, uint64_t seed);

    /// Returns the desert's terrain with the given hollows; only the first `most_hollows` hollows count.
    /// Hollows are parameters of the same height graph, so that a renderer can keep its compiled shader. If
    /// `is_trodden`, the sand has the footprints of somebody who walked down the avenue into the temple
    /// before time 0. Cost: a copy of a megabyte.
    [[nodiscard]] estampe::Terrain with(std::span<const Hollow> hollows, bool is_trodden = false) const;

private:
    uint64_t seed_;
    std::vector<float> levels_m_; ///< Heights of the sand around the temple, as values of a mask
};

/// Returns the desert without hollows and footprints.
[[nodiscard]] estampe::Terrain make_desert(const Plan& plan, uint64_t seed);

} // namespace temple
