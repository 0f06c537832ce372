// SPDX-License-Identifier: MIT
#pragma once

// The desert, and the sand that has drifted against the walls and in through the gaps.

#include <cstddef>
#include <span>
#include <vector>

#include <estampe/terrain.hpp>

#include "plan.hpp"

namespace temple {

/// Where the sand lies around the temple, and under its floors. The wind blows from the east.
[[nodiscard]] float sand_level_m(const Plan& plan, uint64_t seed, const glm::vec2& place_m);

/// A hollow that something presses into the sand, with a rim around it.
struct Hollow {
    glm::vec2 place_m{0.0F};
    float depth_m = 0.0F;
    float radius_m = 1.5F;

    bool operator==(const Hollow& other) const = default;
};

inline constexpr size_t most_hollows = 5;

/// Dunes that go with the wind, and among them, still, the temple's own sand.
class Desert {
public:
    Desert(const Plan& plan, uint64_t seed);

    /// The desert with these hollows; of more than `most_hollows` the first ones. They are numbers of the
    /// same graph, so that a renderer draws on with the shader it has. Where it is trodden, somebody has come
    /// down the avenue and gone in when time begins, and left prints. Cost: a copy of a megabyte.
    [[nodiscard]] estampe::Terrain with(std::span<const Hollow> hollows, bool is_trodden = false) const;

private:
    uint64_t seed_;
    std::vector<float> levels_m_; ///< of the mask about the temple
};

/// The desert as it lies when nobody is about.
[[nodiscard]] estampe::Terrain make_desert(const Plan& plan, uint64_t seed);

} // namespace temple
