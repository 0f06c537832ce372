// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::charts {

using FlatTriangle = std::array<glm::vec2, 3>;

/// Whether the insides of two triangles meet; a shared edge or corner is no meeting.
[[nodiscard]] bool overlap(const FlatTriangle& a, const FlatTriangle& b);

/// Triangles of a plane that do not overlap, found again by the square they lie in.
class OverlapGrid {
public:
    explicit OverlapGrid(float cell_m) : cell_m_(cell_m) {}

    /// Adds the triangle unless it overlaps one that is there; returns whether it was added. Cost: linear in
    /// the triangles and cells of its bounding square, or in all triangles where that has thousands of cells.
    bool add(const FlatTriangle& triangle);

private:
    struct Cells {
        glm::ivec2 first;
        glm::ivec2 last;
    };

    [[nodiscard]] Cells cells_of(const FlatTriangle& triangle) const;
    [[nodiscard]] bool is_free(const FlatTriangle& triangle, std::span<const uint32_t> others) const;

    float cell_m_;
    std::vector<FlatTriangle> triangles_;
    std::unordered_map<uint64_t, std::vector<uint32_t>> cells_;
    std::vector<uint32_t> wide_; ///< of so many cells that each is compared with all
};

} // namespace estampe::charts
