// SPDX-License-Identifier: MIT
#pragma once

// A chart of a scene: finds where a body can walk, and a path between two places, on a grid of squares.

#include <vector>

#include <glm/glm.hpp>

#include "walker.hpp"

namespace walk {

struct ChartLimits {
    glm::dvec2 low_m{-50.0}; ///< Corner of the grid with the smallest x and z
    glm::dvec2 high_m{50.0};
    double square_m = 0.3;
};

/// The squares of a grid that a body can reach, from which it can return, and on which it has room. Each
/// square of the chart has one height.
class Chart {
public:
    /// Explores the ground from `from_m`, where the body stands. Cost: about 10 microseconds for each square
    /// that the body can reach.
    Chart(const Place& place, const Body& body, const glm::dvec3& from_m, const ChartLimits& limits);

    /// Returns whether a place lies on a square that the body can reach.
    [[nodiscard]] bool reaches(const glm::dvec2& place_m) const;

    /// Returns a path between two places, as centres of squares at the height of the feet. The path is short,
    /// but prefers the middle of a room to its walls. Empty if there is no path. Cost: n log n in squares.
    [[nodiscard]] std::vector<glm::dvec3> way(const glm::dvec2& from_m, const glm::dvec2& to_m) const;

    /// Returns the distance from a place to the nearest place without room for the body, at most 2 m. Returns
    /// 0 on squares that the body cannot reach.
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
    std::vector<float> height_m_; ///< Height of each square; not a number on squares that cannot be reached
    std::vector<float> room_m_;
};

} // namespace walk
