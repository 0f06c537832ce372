// SPDX-License-Identifier: MIT
#pragma once

// The area that a mesh covers on the page. Flowing ink is moved within this area.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::features {

/// A triangle on the page, in millimetres from the upper left corner, y down.
using PageTriangle = std::array<glm::vec2, 3>;

/// The union of triangles on the page.
struct ZoneShape {
    glm::vec2 middle_mm{0.0F}; ///< centre of gravity of the area
    float radius_mm = 0.0F;    ///< radius of a disc with the same area as the shape
    glm::vec2 min_mm{0.0F};    ///< place of the first grid point of `field`
    glm::vec2 size_mm{0.0F};   ///< distance from the first grid point of `field` to the last
    /// Grid of shared::ink_shape_side points along x and y, row by row. The value is 0 at the point deepest
    /// within the area, and 1 at the area's edge and outside. Between the deepest point and the edge, the
    /// value is proportional to the distance from the deepest level.
    std::vector<float> field;
};

/// Rasterises triangles on a grid, and measures how deep each grid point lies within their union. None if the
/// triangles cover no grid point. Cost: some 300,000 operations, and the number of grid points in the
/// triangles.
[[nodiscard]] std::optional<ZoneShape> zone_shape(std::span<const PageTriangle> triangles);

} // namespace estampe::features
