// SPDX-License-Identifier: MIT
#pragma once

// Makes a second set of texture coordinates in which no two triangles overlap. The surface is cut into nearly
// flat charts, each chart is projected along its own normal, and the charts are packed into a square.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::charts {

/// Adjacent triangles that lie nearly in one plane.
struct Chart {
    std::vector<uint32_t> triangles;
    std::vector<glm::vec2> corners_m; ///< three per triangle, at the scale of the surface, not negative
    glm::vec2 size_m{0.0F};
};

/// Largest angle between a triangle and the plane of its chart. It limits how much the projection shrinks a
/// triangle, to the cosine of this angle.
inline constexpr float steepest_lean_rad = 0.785F;

/// Cuts triangles into charts that do not overlap themselves. `corners` holds three positions per triangle;
/// triangles without an area belong to no chart. Charts grow from the largest triangle over shared edges
/// while normals agree (after Cohen-Steiner et al., "Variational Shape Approximation", 2004, with one refit).
/// The result is deterministic. Cost: about 2 us per triangle.
[[nodiscard]] std::vector<Chart> cut_charts(std::span<const glm::vec3> corners);

/// One chart made of the file's own texture coordinates; nothing if triangles overlap in them or have no area
/// in them.
[[nodiscard]] std::optional<Chart> own_chart(std::span<const glm::vec3> corners,
                                             std::span<const glm::vec2> uvs);

/// Places of the charts in a square picture.
struct Atlas {
    uint32_t size = 0;               ///< texels per side
    std::vector<glm::vec2> corners;  ///< three per triangle, in texels from the top left; texel centres at .5
    std::vector<uint32_t> triangles; ///< the triangles that lie in the picture
    float texels_per_m = 0.0F;
};

/// Width in texels of the border around each chart. The border belongs to the chart, so that filters do not
/// read other charts.
inline constexpr uint32_t gutter = 2;

/// Packs the charts as large as they fit (with the skyline packer of stb). `triangle_count` counts all
/// triangles, including those in no chart. Throws Error when even the smallest charts do not fit into `size`.
/// Cost: about ten packings of all charts.
[[nodiscard]] Atlas pack_charts(std::span<const Chart> charts, size_t triangle_count, uint32_t size);

/// A texel that lies on a triangle or beside one.
struct Texel {
    uint32_t place = 0; ///< index in the picture, row by row
    uint32_t triangle = 0;
    /// Barycentric weights of the second and third corner, at the triangle's nearest point.
    glm::vec2 weights{0.0F};
};

/// The texels within one texel of a triangle, sorted by `place`. Cost: linear in texels.
[[nodiscard]] std::vector<Texel> covered_texels(const Atlas& atlas);

using FlatTriangle = std::array<glm::vec2, 3>;

/// Whether the interiors of two triangles intersect; sharing an edge or a corner does not count.
[[nodiscard]] bool overlap(const FlatTriangle& a, const FlatTriangle& b);

/// Triangles of a plane that do not overlap, in a grid that finds the neighbours of a new one.
class OverlapGrid {
public:
    explicit OverlapGrid(float cell_m) : cell_m_(cell_m) {}

    /// Adds the triangle unless it overlaps one in the grid; returns whether it was added. Cost: linear in
    /// the triangles and cells of its bounding square, or in all triangles if that square has thousands of
    /// cells.
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
    std::vector<uint32_t> wide_; ///< they cover many cells and are compared with every new triangle
};

} // namespace estampe::charts
