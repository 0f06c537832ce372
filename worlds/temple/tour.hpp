// SPDX-License-Identifier: MIT
#pragma once

// A walk through a temple that nobody's hands are needed for: from the dunes through court, corridors and
// halls to the last hall and back, again and again.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "plan.hpp"
#include "visit.hpp"

namespace temple {

class Tour {
public:
    /// Of a visit that has just begun, which is to outlive it. Cost: half a second.
    Tour(const Visit& visit, uint64_t seed);

    /// What the walker is to do now.
    [[nodiscard]] walk::Intent intent();

    /// How often it has come back to where it began.
    [[nodiscard]] size_t rounds() const { return rounds_; }

    /// Rooms on the way that are no cells.
    [[nodiscard]] size_t halls() const { return halls_; }

private:
    [[nodiscard]] glm::dvec2 target_m() const { return {way_.at(next_).x, way_.at(next_).z}; }

    /// The place nearest to a room's middle that can be gone to.
    [[nodiscard]] std::optional<glm::dvec2> find_open(const Room& room) const;

    const Visit& visit_;
    walk::Chart chart_;
    std::vector<glm::dvec3> way_;
    size_t next_ = 0;
    size_t rounds_ = 0;
    size_t halls_ = 0;
};

} // namespace temple
