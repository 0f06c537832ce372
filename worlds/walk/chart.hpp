// SPDX-License-Identifier: MIT
#pragma once

// Where a body can go, and by what way: squares of ground that are found by going over them.

#include <vector>

#include <glm/glm.hpp>

#include "walker.hpp"

namespace walk {

struct ChartLimits {
    glm::dvec2 low_m{-50.0}; ///< x and z
    glm::dvec2 high_m{50.0};
    double square_m = 0.3;
};

/// The squares that a body can go to and come back from, to all of which it has room, one height each.
class Chart {
public:
    /// From a place where it stands. Cost: about 10 microseconds a square that is reached.
    Chart(const Place& place, const Body& body, const glm::dvec3& from_m, const ChartLimits& limits);

    /// Whether a place is on a square that can be gone to.
    [[nodiscard]] bool reaches(const glm::dvec2& place_m) const;

    /// A way between two places, as the squares' middles at the feet's height: short, but rather in the
    /// middle of a room than along its wall. Empty where there is none. Cost: n log n in squares.
    [[nodiscard]] std::vector<glm::dvec3> way(const glm::dvec2& from_m, const glm::dvec2& to_m) const;

    /// How far a place is from where there is no room, up to 2 m; 0 beyond.
    [[nodiscard]] double room_m(const glm::dvec2& place_m) const;

private:
    [[nodiscard]] glm::ivec2 square_of(const glm::dvec2& place_m) const;
    [[nodiscard]] bool is_in(const glm::ivec2& square) const;
    [[nodiscard]] size_t index(const glm::ivec2& square) const;
    [[nodiscard]] glm::dvec2 middle_m(const glm::ivec2& square) const;
    void flood(const Place& place, const Body& body, const glm::dvec3& from_m);
    void measure_room();

    ChartLimits limits_;
    glm::ivec2 size_{0};
    std::vector<float> height_m_; ///< not a number where it cannot go
    std::vector<float> room_m_;
};

} // namespace walk
