// SPDX-License-Identifier: MIT
#pragma once

// Computes a second set of texture coordinates in which no two triangles overlap. The surface is cut into
// nearly flat charts, each chart is projected along its own normal, and the charts are packed into a square.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::charts {

/// Adjacent triangles that are nearly coplanar, and their projection into the plane.
struct Chart {
    std::vector<uint32_t> triangles;
    /// Positions of the corners in the chart, three per triangle, in metres on the surface; never negative.
    std::vector<glm::vec2> corners_m;
    glm::vec2 size_m{0.0F};
};

/// Largest angle between a triangle and the plane of its chart. A triangle shrinks in the projection by the
/// cosine of its angle, so this limit bounds the shrinking.
inline constexpr float steepest_lean_rad = 0.785F;

/// Cuts triangles into charts whose triangles do not overlap in the projection. `corners` holds three
/// positions per triangle. Triangles with zero area belong to no chart. A chart starts at the largest free
/// triangle and grows across shared edges while the normals are similar (after Cohen-Steiner et al.,
/// "Variational Shape Approximation", 2004, with one refit). The same input always gives the same result.
/// Cost: about 2 us per triangle.
[[nodiscard]] std::vector<Chart> cut_charts(std::span<const glm::vec3> corners);

/// Makes one chart of the texture coordinates in the file. Returns nothing if triangles overlap in texture
/// space or have no area there.
[[nodiscard]] std::optional<Chart> own_chart(std::span<const glm::vec3> corners,
                                             std::span<const glm::vec2> uvs);

/// Positions of the charts in a square texture, the atlas.
struct Atlas {
    uint32_t size = 0; ///< texels per side of the atlas
    /// Positions of the corners in the atlas, three per triangle, in texels from the top left; texel centres
    /// at .5.
    std::vector<glm::vec2> corners;
    std::vector<uint32_t> triangles; ///< indices of the triangles that are in the atlas
    float texels_per_m = 0.0F;
};

/// Width in texels of the border around each chart. The border gets the colours of its chart, so that texture
/// filters do not read texels of other charts.
inline constexpr uint32_t gutter = 2;

/// Packs the charts into a square of `size` texels, at the largest possible scale (with the skyline packer of
/// the library stb). `triangle_count` counts all triangles, including those in no chart. Throws Error when
/// the charts do not fit even at the smallest scale. Cost: about ten packings of all charts.
[[nodiscard]] Atlas pack_charts(std::span<const Chart> charts, size_t triangle_count, uint32_t size);

/// A texel of the atlas that is inside a triangle or next to one.
struct Texel {
    uint32_t place = 0; ///< index of the texel in the atlas, row by row
    uint32_t triangle = 0;
    /// Barycentric weights of the second and third corner, at the point of the triangle nearest to the texel.
    glm::vec2 weights{0.0F};
};

/// Returns all texels that are at most one texel away from a triangle, sorted by `place`. Cost: linear in
/// texels.
[[nodiscard]] std::vector<Texel> covered_texels(const Atlas& atlas);

using FlatTriangle = std::array<glm::vec2, 3>;

/// Returns whether the interiors of two triangles intersect. Triangles that only share an edge or a corner do
/// not intersect.
[[nodiscard]] bool overlap(const FlatTriangle& a, const FlatTriangle& b);

/// Triangles in a plane that do not overlap each other, with a grid to find quickly the triangles near a new
/// triangle.
class OverlapGrid {
public:
    explicit OverlapGrid(float cell_m) : cell_m_(cell_m) {}

    /// Adds the triangle unless it overlaps a triangle in the grid. Returns whether the triangle was added.
    /// Cost: linear in the triangles and grid cells of its bounding square. If that square has thousands of
    /// cells, linear in all triangles.
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
    std::vector<uint32_t> wide_; ///< large triangles; every new triangle is compared with them
};

} // namespace estampe::charts
