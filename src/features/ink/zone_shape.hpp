// SPDX-License-Identifier: MIT
#pragma once

// The area that a mesh covers on the page, as an area in which flowing ink is driven.

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
    float radius_mm = 0.0F;    ///< radius of a disc of the same area
    glm::vec2 min_mm{0.0F};    ///< place of the field's first node
    glm::vec2 size_mm{0.0F};   ///< distance from the field's first node to its last
    /// shared::ink_shape_side nodes each way, row by row: 0 at the node that lies deepest within the area, 1
    /// at the area's edge and beyond. Between them a value falls in proportion to the distance to the edge.
    std::vector<float> field;
};

/// Rasterises triangles and measures how deep each node lies within. None if the triangles cover no node.
/// Cost: some 300,000 operations, and the number of nodes below the triangles.
[[nodiscard]] std::optional<ZoneShape> zone_shape(std::span<const PageTriangle> triangles);

} // namespace estampe::features
