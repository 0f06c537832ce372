// SPDX-License-Identifier: MIT
#pragma once

// A second set of texture coordinates in which no two triangles share a place: the surface is cut into charts
// that are nearly flat, each laid down along its own normal, and the charts are packed into a square.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::charts {

/// Triangles that lie flat side by side.
struct Chart {
    std::vector<uint32_t> triangles;
    std::vector<glm::vec2> corners_m; ///< three a triangle, at the scale of the surface, none below zero
    glm::vec2 size_m{0.0F};
};

/// No triangle leans further than this from the plane of its chart, so that none is drawn together by more
/// than the cosine.
inline constexpr float steepest_lean_rad = 0.785F;

/// Cuts triangles into charts that do not overlap themselves. `corners` holds three places a triangle;
/// triangles without an area belong to no chart. Charts grow from the largest triangle over shared edges
/// while normals agree (after Cohen-Steiner et al., "Variational Shape Approximation", 2004, with one
/// refit). The same triangles give the same charts. Cost: about 2 us a triangle.
[[nodiscard]] std::vector<Chart> cut_charts(std::span<const glm::vec3> corners);

/// The triangles as coordinates of the file's own lay them, as one chart; nothing where these overlap, or
/// leave an area out.
[[nodiscard]] std::optional<Chart> own_chart(std::span<const glm::vec3> corners,
                                             std::span<const glm::vec2> uvs);

/// Where the charts lie in a square picture.
struct Atlas {
    uint32_t size = 0;               ///< texels a side
    std::vector<glm::vec2> corners;  ///< three a triangle, in texels from the top left; texel centres at .5
    std::vector<uint32_t> triangles; ///< those that lie in the picture
    float texels_per_m = 0.0F;
};

/// Texels that belong to a chart on each side of it, for filters to reach into.
inline constexpr uint32_t gutter = 2;

/// Packs the charts as large as they fit (with the skyline packer of stb). `triangle_count` counts all
/// triangles, those in no chart too. Throws Error when not even the smallest charts fit into `size`. Cost:
/// about ten packings of all charts.
[[nodiscard]] Atlas pack_charts(std::span<const Chart> charts, size_t triangle_count, uint32_t size);

/// A texel that lies on a triangle, or beside one.
struct Texel {
    uint32_t place = 0; ///< row by row
    uint32_t triangle = 0;
    glm::vec2 weights{0.0F}; ///< of the second and the third corner, at the nearest point of the triangle
};

/// The texels within one texel of a triangle, in the order of their places. Cost: linear in texels.
[[nodiscard]] std::vector<Texel> covered_texels(const Atlas& atlas);

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
